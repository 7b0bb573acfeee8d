# SPDX-License-Identifier: BSD-3-Clause
"""The octree's generations growing, drawn by state: a frame each, and a contact sheet.

    PV_PLUGIN_PATH=PLUGINS pvpython growing_octree.py CAPTURE FOLDER [--depth N]

PLUGINS is the folder that the plugin was built into. CAPTURE holds masks, or images that are silhouettes already,
and their cameras. FOLDER gets a frame for each generation and sheet.png: above the octants, below the same cut open,
those that hold the surface in one colour and those inside in another. The octree is carved once; the first generation
that is drawn is its trees', eight a side.
"""

import argparse
import os
import sys

from paraview.simple import *

from pictures import color_by_state, label, look_from_first_camera, white_view, write_sheet

parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
parser.add_argument("capture")
parser.add_argument("folder")
parser.add_argument("--depth", type=int, default=7)
arguments = parser.parse_args()

reader = SilhouetteCaptureReader(FileName=arguments.capture)
extractor = SilhouetteExtractor(Input=reader)
octree = SilhouetteOctree(Input=extractor, Depth=arguments.depth)
octree.UpdatePipeline()
if octree.GetDataInformation().GetNumberOfCells() == 0:
    sys.exit(f"{arguments.capture}: no octree; the messages above say why")
os.makedirs(arguments.folder, exist_ok=True)

# Generations up to a limit, and of these a half, cut along an axis: both are hyper tree grids.
limited = HyperTreeGridDepthLimiter(Input=octree)
half = Clip(Input=limited, Invert=1)

view = white_view(400, 400)
color_by_state(Show(limited, view))
look_from_first_camera(view, reader)
sight = [focus - place for place, focus in zip(view.CameraPosition, view.CameraFocalPoint)]
axis = max(range(3), key=lambda number: abs(sight[number]))  # the one that is nearest to the first camera's
half.HyperTreeGridClipper.Normal = [-sight[number] if number == axis else 0.0 for number in range(3)]
words = label(view, "")

outside, inside = [], []
trees = min(3, arguments.depth - 1)  # the trees are the octants of this generation
for generation in range(trees, arguments.depth + 1):
    limited.SetDepth = generation - trees
    for source, names, kind in ((limited, outside, "whole"), (half, inside, "half")):
        edge = 2 ** generation
        words.Text = f"generation {generation}: {edge} x {edge} x {edge}"
        color_by_state(Show(source, view))
        names.append(os.path.join(arguments.folder, f"{kind}-{generation:02}.png"))
        SaveScreenshot(names[-1], view)
        Hide(source, view)
    print(f"generation {generation} is drawn")

if not write_sheet(outside + inside, os.path.join(arguments.folder, "sheet.png"), columns=len(outside)):
    sys.exit(f"{arguments.folder}: the sheet could not be written")
