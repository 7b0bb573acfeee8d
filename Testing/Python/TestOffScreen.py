# SPDX-License-Identifier: BSD-3-Clause
"""Rendering in memory in a process that was started for it."""

import os
import unittest

import numpy as np

from vtksilhouette import offscreen

offscreen.enable()

from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkFiltersSources import vtkSphereSource  # noqa: E402
from vtkmodules.vtkRenderingCore import (  # noqa: E402
    vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter)


def picture(width=120, height=80):
    """A white sphere on black, (height, width, 3), row 0 at the bottom, and its window."""
    sphere = vtkSphereSource()
    sphere.SetThetaResolution(64)
    sphere.SetPhiResolution(64)
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(sphere.GetOutputPort())
    actor = vtkActor()
    actor.SetMapper(mapper)
    renderer = vtkRenderer()
    renderer.AddActor(actor)
    window = vtkRenderWindow()
    window.AddRenderer(renderer)
    window.SetSize(width, height)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetParallelScale(1.0)
    renderer.ResetCameraClippingRange()
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.Update()
    pixels = vtk_to_numpy(grab.GetOutput().GetPointData().GetScalars())
    return pixels.reshape(height, width, 3).copy(), window


class TestOffScreen(unittest.TestCase):
    def test_it_is_osmesa(self):
        self.assertNotIn("DISPLAY", os.environ)
        window = picture()[1]
        self.assertIn(window.GetClassName(), ("vtkSilhouetteOSMesaRenderWindow", "vtkOSOpenGLRenderWindow"))
        self.assertIn("llvmpipe", window.ReportCapabilities())

    def test_it_draws(self):
        pixels = picture()[0]
        self.assertEqual(pixels[0, 0].tolist(), [0, 0, 0])
        self.assertGreater(pixels[40, 60, 0], 240)
        # A disc of radius 20 pixels, half a pixel along its edge allowed.
        self.assertAlmostEqual(np.count_nonzero(pixels[:, :, 0]), np.pi * 20**2, delta=np.pi * 20)

    def test_it_repeats_itself(self):
        first, _ = picture()
        second, _ = picture()
        np.testing.assert_array_equal(first, second)


if __name__ == "__main__":
    unittest.main()
