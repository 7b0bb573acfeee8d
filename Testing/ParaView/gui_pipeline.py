# SPDX-License-Identifier: BSD-3-Clause
"""
For TestGui.py: runs in ParaView's GUI (paraview --script). Builds the pipeline, and takes pictures of the render view:
the octree as it is drawn when it is applied, and the surface in one colour, both seen along y. What they should look
like goes into a file.
"""
import json
import os
import pathlib
import traceback

import plugin
from paraview import simple
from paraview.simple import OutputPort

FOLDER = pathlib.Path(os.environ["SILHOUETTE_GUI_FOLDER"])
SIZE = [600, 450]
SCALE = 1.2  # half the height of what the view shows


def look_along_y(view):
    view.CameraParallelProjection = 1
    view.CameraFocalPoint = [0, 0, 0]
    view.CameraPosition = [0, -5, 0]
    view.CameraViewUp = [0, 0, 1]
    view.CameraParallelScale = SCALE


def build():
    plugin.load(globals())
    view = simple.GetActiveViewOrCreate("RenderView")
    view.UseColorPaletteForBackground = 0
    view.Background = [1, 1, 1]
    view.OrientationAxesVisibility = 0
    capture = SyntheticCapture(registrationName="Capture", Width=256, Height=256, NumberOfViews=24)
    octree = SilhouetteOctree(registrationName="Octree", Input=OutputPort(capture, 0), Depth=6)
    display = simple.Show(OutputPort(octree, 0), view)
    simple.Render(view)  # the first one moves the camera
    look_along_y(view)
    simple.Render(view)
    simple.SaveScreenshot(str(FOLDER / "octree.png"), view, ImageResolution=SIZE)
    colouring = list(display.ColorArrayName)
    grid = plugin.output(octree)
    octant = grid.GetFieldData().GetArray("RootCube").GetValue(3) / 2**octree.Depth
    simple.Hide(OutputPort(octree, 0), view)

    cubes = VotingMarchingCubes(registrationName="Cubes", Input=OutputPort(octree, 0), Views=OutputPort(octree, 1))
    hulls = LocalHullSurface(registrationName="Hulls", Input=cubes, Octree=OutputPort(octree, 0),
                             Views=OutputPort(octree, 1))
    shown = simple.Show(OutputPort(hulls, 0), view)
    shown.ColorArrayName = ["POINTS", ""]
    shown.AmbientColor = shown.DiffuseColor = [1, 0, 1]
    shown.Ambient, shown.Diffuse, shown.Specular = 1, 0, 0  # no shade: a pixel is the surface's or the background's
    simple.HideScalarBarIfNotNeeded(simple.GetColorTransferFunction("State"), view)
    look_along_y(view)
    simple.Render(view)
    simple.SaveScreenshot(str(FOLDER / "surface.png"), view, ImageResolution=SIZE)
    mesh = plugin.triangles(plugin.fetch(hulls))
    simple.SetActiveSource(hulls)
    return {"scale": SCALE, "octant": octant, "colouring": colouring, "triangles": mesh.reshape(-1, 9).tolist()}


def main():
    try:
        found = build()
    except BaseException:
        found = {"error": traceback.format_exc()}
    part = FOLDER / "found.part"
    part.write_text(json.dumps(found))
    part.rename(FOLDER / "found.json")


main()
