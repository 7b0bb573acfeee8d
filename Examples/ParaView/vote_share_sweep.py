# SPDX-License-Identifier: BSD-3-Clause
"""The vote share swept as an animation: a frame for each number of views that may be wrong, and a contact sheet.

    PV_PLUGIN_PATH=PLUGINS pvpython vote_share_sweep.py CAPTURE FOLDER [--votes N] [--depth N]

PLUGINS is the folder that the plugin was built into. CAPTURE holds masks, or images that are silhouettes already,
and their cameras; `vtksilhouette synthesize torn --noise-blobs 6 --noise-contour 1` makes one that is worth a
sweep. FOLDER gets frame-00.png and so on, the marching cubes' surface from the first camera, and sheet.png.
"""

import argparse
import os
import sys

from paraview.simple import *

from pictures import label, look_from_first_camera, show_mesh, white_view, write_sheet

parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
parser.add_argument("capture")
parser.add_argument("folder")
parser.add_argument("--votes", type=int, default=5, help="the last frame's background votes")
parser.add_argument("--depth", type=int, default=7)
arguments = parser.parse_args()

reader = SilhouetteCaptureReader(FileName=arguments.capture)
extractor = SilhouetteExtractor(Input=reader)
octree = SilhouetteOctree(Input=extractor, Depth=arguments.depth)
cubes = VotingMarchingCubes(Input=octree, Views=OutputPort(octree, 1))


def views():
    """How many views the octree was carved from."""
    octree.UpdatePipeline()
    count = octree.FieldData.GetArray("NumberOfViews")
    return int(count.GetRange()[0]) if count else 0


def sweep(votes, number_of_views):
    """One surface: octree and vote must ask the same views, so both are told. Returns the share."""
    octree.BackgroundVotes = votes
    cubes.VoteShare = 1.0 - votes / number_of_views
    cubes.UpdatePipeline()
    return cubes.VoteShare


number_of_views = views()
if number_of_views <= arguments.votes:
    sys.exit(f"{arguments.capture}: {number_of_views} views, too few for {arguments.votes} background votes; "
             "where there are none, the messages above say why")
os.makedirs(arguments.folder, exist_ok=True)

view = white_view(400, 400)
sweep(arguments.votes, number_of_views)  # the largest surface: all frames look at it from one place
show_mesh(cubes, view)
look_from_first_camera(view, reader)
words = label(view, "")

frames = []
print("votes  share  triangles")
for votes in range(arguments.votes + 1):
    share = sweep(votes, number_of_views)
    triangles = cubes.GetDataInformation().GetNumberOfCells()
    if triangles == 0:
        sys.exit(f"{arguments.capture}: no surface at {votes} background votes; the messages above say why")
    print(f"{votes:5}  {share:.3f}  {triangles:9}")
    words.Text = f"{number_of_views - votes} of {number_of_views} views, share {share:.2f}"
    frames.append(os.path.join(arguments.folder, f"frame-{votes:02}.png"))
    SaveScreenshot(frames[-1], view)

if not write_sheet(frames, os.path.join(arguments.folder, "sheet.png"), columns=3):
    sys.exit(f"{arguments.folder}: the sheet could not be written")
