# SPDX-License-Identifier: BSD-3-Clause
"""The judge of the examples' pictures."""

from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader


def pixels_of(path):
    """A picture as a (height, width, 3) array of int."""
    reader = vtkPNGReader()
    reader.SetFileName(str(path))
    reader.Update()
    width, height, _ = reader.GetOutput().GetDimensions()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars()).reshape(height, width, -1).astype(int)


def faults(pixels, least_brightness=100):
    """What is wrong with a picture of an object on a white ground; an empty list where nothing is.

    100 is for colours such as (219, 204, 184), seen by a light at the camera.
    """
    drawn = (pixels < 250).any(axis=2)
    found = []
    if not 0.05 < drawn.mean() < 0.6:  # the object's bounding sphere fills the picture
        found.append(f"{100 * drawn.mean():.1f} % of the picture is drawn")
    if drawn[0].any() or drawn[-1].any() or drawn[:, 0].any() or drawn[:, -1].any():
        found.append("the object is cut by the picture's border")
    brightness = pixels[drawn].mean() if drawn.any() else 0.0
    if brightness < least_brightness:
        found.append(f"dark: a mean of {brightness:.0f} of 255")
    if drawn.any() and pixels[drawn].std() < 10:  # a round object is shaded
        found.append("flat: no shading")
    return found
