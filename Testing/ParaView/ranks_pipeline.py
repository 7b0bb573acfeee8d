# SPDX-License-Identifier: BSD-3-Clause
"""For pvbatch, see TestRanks.py: runs pipelines, and each rank writes what it holds itself into a folder."""
import json
import resource
import sys

import plugin
from plugin import field
from paraview.simple import OutputPort
from vtkmodules.vtkParallelCore import vtkMultiProcessController

plugin.load(globals())

controller = vtkMultiProcessController.GetGlobalController()


def pipeline():
    """From a capture to the local hulls' surface."""
    capture = SyntheticCapture(Width=128, Height=128, NumberOfViews=12)
    octree = SilhouetteOctree(Input=OutputPort(capture, 0), Depth=6)
    cubes = VotingMarchingCubes(Input=OutputPort(octree, 0), Views=OutputPort(octree, 1))
    hulls = LocalHullSurface(Input=cubes, Octree=OutputPort(octree, 0), Views=OutputPort(octree, 1))
    return capture, octree, cubes, hulls


capture, octree, cubes, hulls = pipeline()
judge = SilhouetteEvaluator(Input=OutputPort(hulls, 0), Views=OutputPort(octree, 1), Octree=OutputPort(octree, 0))


def own(source):
    """What this rank holds of a source's first output."""
    return source.GetClientSideObject().GetOutputDataObject(0)


def soup(source):
    """The triangles that this rank holds, nine coordinates each."""
    return plugin.triangles(own(source)).reshape(-1, 9).tolist()


def only_the_surfacer_asks():
    """What this rank holds where nobody else asks octree and marching cubes for anything."""
    views, tree, surface, closed = pipeline()
    closed.UpdatePipeline()
    return {"hulls": soup(closed), "cubes": own(surface).GetNumberOfCells(),
            "octants": own(tree).GetNumberOfElements(0), "views": own(views).GetNumberOfPartitionedDataSets()}


def failures():
    """Messages of octree and surfacer, and triangles left, where the one and where the other refuses a setting."""
    found = {}
    _, tree, _, closed = pipeline()
    for name, source, setting, value in (("surfacer", closed, "CoverOffset", 5.0), ("octree", tree, "Depth", 99)):
        messages = []

        def note(_, __, text, messages=messages):
            messages.append(text)
        note.CallDataType = "string0"
        watched = [proxy.GetClientSideObject() for proxy in (tree, closed)]
        watched += [filter.GetExecutive() for filter in watched]
        tags = [filter.AddObserver("ErrorEvent", note if n < 2 else lambda *_: None)
                for n, filter in enumerate(watched)]
        before = source.GetPropertyValue(setting)
        source.SetPropertyWithName(setting, value)
        closed.UpdatePipeline()
        found[name] = {"messages": messages, "triangles": own(closed).GetNumberOfCells()}
        source.SetPropertyWithName(setting, before)
        for filter, tag in zip(watched, tags):
            filter.RemoveObserver(tag)
    closed.UpdatePipeline()
    found["mended"] = own(closed).GetNumberOfCells()
    return found


cubes.UpdatePipeline()
grid = own(octree)
found = {
    "ranks": controller.GetNumberOfProcesses(),
    "piece": int(field(grid, "Piece")),
    "pieces": int(field(grid, "NumberOfPieces")),
    "octants_tested": field(grid, "OctantsTested"),
    "intersection_octants": field(grid, "IntersectionOctants"),
    "inside_octants": field(grid, "InsideOctants"),
    "cubes": soup(cubes),
}
hulls.UpdatePipeline()
found["hulls"] = soup(hulls)
judge.UpdatePipeline()
table = own(judge)
found["rows"] = table.GetNumberOfRows()
if found["rows"]:
    found["sound"] = int(field(table, "Sound"))
    found["triangles"] = int(field(table, "Triangles"))
found["alone"] = only_the_surfacer_asks()
found["failures"] = failures()
found["peak_kib"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss  # for who wants to know
with open("%s/rank%d.json" % (sys.argv[1], controller.GetLocalProcessId()), "w") as file:
    json.dump(found, file)
