# SPDX-License-Identifier: BSD-3-Clause
"""A capture carved on a server of several ranks, and which rank made what.

    PV_PLUGIN_PATH=PLUGINS mpirun -n 2 pvserver --server-port=11111 &
    PV_PLUGIN_PATH=PLUGINS pvpython on_a_server.py HOST PORT CAPTURE PICTURE.png [--depth N]

PLUGINS is the folder that the plugin was built into, on either side. CAPTURE is a folder on the server with masks, or
images that are silhouettes already, and their cameras. Octree and marching cubes are made in pieces, one on each
rank, that add up to the whole. Local hulls are decided over the whole, by the first rank, which sends each an
even share of the triangles. The picture shows octree, marching cubes and local hulls, a colour a rank.
"""

import argparse
import sys

from paraview import servermanager
from paraview.simple import *

from pictures import label, look_from_first_camera, white_view

parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
parser.add_argument("host")
parser.add_argument("port", type=int)
parser.add_argument("capture")
parser.add_argument("picture")
parser.add_argument("--depth", type=int, default=7)
arguments = parser.parse_args()

if not Connect(arguments.host, arguments.port, timeout=20):  # what is made from here on is made there
    sys.exit(f"{arguments.host}:{arguments.port}: no server; the messages above say why")
ranks = servermanager.ActiveConnection.GetNumberOfDataPartitions()

reader = SilhouetteCaptureReader(FileName=arguments.capture)
extractor = SilhouetteExtractor(Input=reader)
octree = SilhouetteOctree(Input=extractor, Depth=arguments.depth)
cubes = VotingMarchingCubes(Input=octree, Views=OutputPort(octree, 1))
hulls = LocalHullSurface(Input=cubes, Octree=octree, Views=OutputPort(octree, 1))
hulls.UpdatePipeline()
if hulls.GetDataInformation().GetNumberOfCells() == 0:
    sys.exit(f"{arguments.capture}: no mesh; the server's messages, above too, say why")

octants = HyperTreeGridToUnstructuredGrid(Input=octree)  # which can be given numbers of processes
stages = {name: ProcessIdScalars(Input=source, CellScalars=1)
          for name, source in (("octants", octants), ("voted triangles", cubes), ("hull triangles", hulls))}


def made_by(stage, rank):
    """How many cells of a stage a rank made."""
    part = Threshold(Input=stage, Scalars=("CELLS", "ProcessId"))
    part.LowerThreshold = part.UpperThreshold = rank
    part.UpdatePipeline()
    return part.GetDataInformation().GetNumberOfCells()


for name, stage in stages.items():
    stage.UpdatePipeline()
    counts = " + ".join(str(made_by(stage, rank)) for rank in range(ranks))
    print(f"{stage.GetDataInformation().GetNumberOfCells()} {name} = {counts}")

# Side by side: each is shifted to the right of the one before, as the first camera sees it.
view = white_view(1200, 450)
displays = [Show(stage, view, Representation="Surface", Ambient=0.2) for stage in stages.values()]
look_from_first_camera(view, reader)
sight = [focus - place for place, focus in zip(view.CameraPosition, view.CameraFocalPoint)]
up = view.CameraViewUp
right = [sight[i - 2] * up[i - 1] - sight[i - 1] * up[i - 2] for i in range(3)]
length = sum(value * value for value in right) ** 0.5
low, high = [octants.GetDataInformation().GetBounds()[end::2] for end in (0, 1)]
width = 0.9 * max(last - first for first, last in zip(low, high))
for place, display in enumerate(displays):
    display.Position = [place * width * value / length for value in right]
    ColorBy(display, ("CELLS", "ProcessId"))
GetColorTransferFunction("ProcessId").RescaleTransferFunction(0, max(1, ranks - 1))
view.CameraParallelProjection = 1  # which looks at all three alike
ResetCamera(view)
view.CameraParallelScale *= 0.55  # fitted to a sphere around them, they fill the width
label(view, f"octree, marching cubes, local hulls; a colour for each of {ranks} ranks")
SaveScreenshot(arguments.picture, view)
