# SPDX-License-Identifier: BSD-3-Clause
"""For pvbatch, see TestRanks.py: runs the pipeline, and each rank writes what it holds itself into a folder."""
import json
import sys

import plugin
from plugin import field
from paraview.simple import OutputPort
from vtkmodules.vtkParallelCore import vtkMultiProcessController

plugin.load(globals())

controller = vtkMultiProcessController.GetGlobalController()
capture = SyntheticCapture(Width=128, Height=128, NumberOfViews=12)
octree = SilhouetteOctree(Input=OutputPort(capture, 0), Depth=6)
cubes = VotingMarchingCubes(Input=OutputPort(octree, 0), Views=OutputPort(octree, 1))
hulls = LocalHullSurface(Input=cubes, Octree=OutputPort(octree, 0), Views=OutputPort(octree, 1))
judge = SilhouetteEvaluator(Input=OutputPort(hulls, 0), Views=OutputPort(octree, 1), Octree=OutputPort(octree, 0))


def own(source):
    """What this rank holds of a source's first output."""
    return source.GetClientSideObject().GetOutputDataObject(0)


cubes.UpdatePipeline()
grid = own(octree)
found = {
    "ranks": controller.GetNumberOfProcesses(),
    "piece": int(field(grid, "Piece")),
    "pieces": int(field(grid, "NumberOfPieces")),
    "octants_tested": field(grid, "OctantsTested"),
    "intersection_octants": field(grid, "IntersectionOctants"),
    "inside_octants": field(grid, "InsideOctants"),
    "cubes": plugin.triangles(own(cubes)).reshape(-1, 9).tolist(),
}
hulls.UpdatePipeline()
found["hulls"] = plugin.triangles(own(hulls)).reshape(-1, 9).tolist()
judge.UpdatePipeline()
table = own(judge)
found["rows"] = table.GetNumberOfRows()
if found["rows"]:
    found["sound"] = int(field(table, "Sound"))
    found["triangles"] = int(field(table, "Triangles"))
with open("%s/rank%d.json" % (sys.argv[1], controller.GetLocalProcessId()), "w") as file:
    json.dump(found, file)
