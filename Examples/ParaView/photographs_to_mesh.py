# SPDX-License-Identifier: BSD-3-Clause
"""A folder of photographs in, a mesh and its picture out, in the style of ParaView.

    PV_PLUGIN_PATH=PLUGINS pvpython photographs_to_mesh.py CAPTURE MESH.ply PICTURE.png [--depth N]

PLUGINS is the folder that the plugin was built into. CAPTURE is a capture's folder or its camera file: photographs
on a blue background (`vtksilhouette synthesize jug` makes one). The mesh is, byte for byte, that of

  vtksilhouette reconstruct CAPTURE --carving strict --key blue:0.08 --largest-region -o MESH.ply
"""

import argparse
import sys

from paraview.simple import *

from pictures import look_from_first_camera, show_mesh, white_view

parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
parser.add_argument("capture")
parser.add_argument("mesh")
parser.add_argument("picture")
parser.add_argument("--depth", type=int, default=8)
arguments = parser.parse_args()

# The pipeline. The octree's second output is the views, prepared for the filters below.
reader = SilhouetteCaptureReader(FileName=arguments.capture, Images="Photographs")
extractor = SilhouetteExtractor(Input=reader, KeyChannel="Blue", LargestRegion=1)
octree = SilhouetteOctree(Input=extractor, Depth=arguments.depth)
views = OutputPort(octree, 1)
cubes = VotingMarchingCubes(Input=octree, Views=views)
hulls = LocalHullSurface(Input=cubes, Octree=octree, Views=views, OutputPointsPrecision="Single")

hulls.UpdatePipeline()
mesh = hulls.GetDataInformation()
if mesh.GetNumberOfCells() == 0:
    sys.exit(f"{arguments.capture}: no mesh; the messages above say why")
print(f"{mesh.GetNumberOfPoints()} points, {mesh.GetNumberOfCells()} triangles")
SaveData(arguments.mesh, proxy=hulls)

# The picture.
view = white_view(600, 600)
show_mesh(hulls, view)
look_from_first_camera(view, reader)
SaveScreenshot(arguments.picture, view)
