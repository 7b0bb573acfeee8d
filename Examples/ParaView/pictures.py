# SPDX-License-Identifier: BSD-3-Clause
"""What the scripts beside this file share: a white view, the first camera's place, colours by state, sheets."""

import os
import sys

from paraview import servermanager
from paraview.simple import (
    ColorBy, CreateView, GenerateSurfaceNormals, GetColorTransferFunction, ResetCamera, Show, Text)
from vtkmodules.vtkFiltersCore import vtkImageAppend
from vtkmodules.vtkIOImage import vtkPNGReader, vtkPNGWriter

if not hasattr(servermanager.filters, "SilhouetteOctree"):
    sys.exit("the Silhouette plugin is not loaded: set PV_PLUGIN_PATH to the folder that it was built into")

CLAY = (0.86, 0.80, 0.72)
GREY = (0.25, 0.25, 0.25)
STATES = {1: ("intersection", (0.95, 0.76, 0.48)), 2: ("inside", (0.42, 0.60, 0.84))}


def white_view(width, height):
    """A render view on a white ground, without the axes in its corner."""
    return CreateView("RenderView", ViewSize=[width, height], UseColorPaletteForBackground=0,
                      Background=[1.0, 1.0, 1.0], OrientationAxesVisibility=0)


def look_from_first_camera(view, reader):
    """What is shown, from where the first camera stood, upright as its photograph.

    The capture reader's second output has five points a camera: its centre and its image's corners, clockwise from
    the top left.
    """
    lines = servermanager.Fetch(reader, idx=1)
    centre, top, _, corner, bottom = (lines.GetPoint(number) for number in range(5))
    axis = [(first + last) / 2.0 - eye for first, last, eye in zip(top, corner, centre)]
    view.CameraPosition = centre
    view.CameraFocalPoint = [eye + step for eye, step in zip(centre, axis)]
    view.CameraViewUp = [upper - lower for upper, lower in zip(top, bottom)]
    ResetCamera(view)


def show_mesh(mesh, view):
    """A mesh, shaded smoothly."""
    return Show(GenerateSurfaceNormals(Input=mesh, Splitting=0), view, DiffuseColor=CLAY, Ambient=0.2)


def color_by_state(display):
    """Octants by State, a category with a colour each."""
    ColorBy(display, ("CELLS", "State"))
    display.Ambient = 0.4
    colors = GetColorTransferFunction("State")
    colors.InterpretValuesAsCategories = 1
    colors.AnnotationsInitialized = 1
    colors.Annotations = [word for state, (name, _) in STATES.items() for word in (str(state), name)]
    colors.IndexedColors = [component for _, color in STATES.values() for component in color]
    return colors


def label(view, words):
    """A line of text at the lower left; set its `Text` to change it."""
    text = Text(Text=words)
    Show(text, view, WindowLocation="Lower Left Corner", Color=GREY, FontSize=16)
    return text


def write_sheet(frames, sheet, columns):
    """The pictures `frames`, of equal sizes, side by side in one file. Returns whether it was written."""
    rows = vtkImageAppend()
    rows.SetAppendAxis(1)
    for first in reversed(range(0, len(frames), columns)):  # the last row is the lowest
        row = vtkImageAppend()
        for frame in frames[first:first + columns]:
            reader = vtkPNGReader()
            reader.SetFileName(frame)
            row.AddInputConnection(reader.GetOutputPort())
        rows.AddInputConnection(row.GetOutputPort())
    writer = vtkPNGWriter()
    writer.SetInputConnection(rows.GetOutputPort())
    writer.SetFileName(sheet)
    writer.Write()
    return writer.GetErrorCode() == 0 and os.path.exists(sheet)
