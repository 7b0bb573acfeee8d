# SPDX-License-Identifier: BSD-3-Clause
"""
For TestServer.py: a client runs the pipeline on the server at a port, or within itself at port 0, and writes what it
fetches into a file: the surface's triangles and the evaluation.
"""
import json
import sys

import plugin
from plugin import fetch, field, triangles
from paraview import servermanager, simple
from paraview.simple import OutputPort

port, output = int(sys.argv[1]), sys.argv[2]
if port:
    simple.Connect("localhost", port)
    plugin.load(globals(), remote=True)
plugin.load(globals(), remote=False)

capture = SyntheticCapture(Width=128, Height=128, NumberOfViews=12)
octree = SilhouetteOctree(Input=OutputPort(capture, 0), Depth=6)
cubes = VotingMarchingCubes(Input=OutputPort(octree, 0), Views=OutputPort(octree, 1))
hulls = LocalHullSurface(Input=cubes, Octree=OutputPort(octree, 0), Views=OutputPort(octree, 1))
judge = SilhouetteEvaluator(Input=OutputPort(hulls, 0), Views=OutputPort(octree, 1), Octree=OutputPort(octree, 0))

table = fetch(judge)
found = {
    "remote": servermanager.ActiveConnection.IsRemote(),
    "ranks": servermanager.ActiveConnection.GetNumberOfDataPartitions(),
    "cells": octree.GetDataInformation().GetNumberOfCells(),
    "cubes": triangles(fetch(cubes)).reshape(-1, 9).tolist(),
    "hulls": triangles(fetch(hulls)).reshape(-1, 9).tolist(),
    "rows": table.GetNumberOfRows(),
}
for name in ("Sound", "LostSurface", "Triangles"):
    found[name] = field(table, name)

# A message of the server's reaches the client.
octree.BackgroundVotes = 3
with plugin.Messages() as messages:
    cubes.UpdatePipeline()
found["message"] = messages.text
with open(output, "w") as file:
    json.dump(found, file)
if port:
    simple.Disconnect()
