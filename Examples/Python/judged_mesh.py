# SPDX-License-Identifier: BSD-3-Clause
"""A capture in, a judged mesh out: errors as exceptions, a time limit, threads, and the metrics read.

    python3 judged_mesh.py CAPTURE MESH.vtp [--depth N] [--threads N] [--seconds S]

CAPTURE holds masks, or images that are silhouettes already, and their cameras. The mesh is that of
`vtksilhouette reconstruct CAPTURE -o MESH.vtp`, triangle for triangle. Exit code 0: it is sound, and written.
"""

import argparse
import sys
import time

from vtkmodules.vtkCommonCore import vtkSMPTools
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from vtksilhouette import (vtkLocalHullSurfacer, vtkSilhouetteCaptureReader, vtkSilhouetteEvaluator,
                           vtkSilhouetteExtractor, vtkSilhouetteOctreeSource, vtkVotingMarchingCubes)


class Watch:
    """Runs filters; their errors become exceptions, and so does the end of the time."""

    def __init__(self, seconds):
        self.deadline = time.monotonic() + seconds
        self.errors = []

    def run(self, algorithm):
        """Updates one filter that was not run before; what is upstream should have been, so that the first
        error is the cause and not a consequence."""
        def on_error(caller, event, text):
            self.errors.append(text.split("\n", 1)[1].strip())  # without the line that names VTK's source file

        on_error.CallDataType = "string0"
        algorithm.AddObserver("ErrorEvent", on_error)
        algorithm.GetExecutive().AddObserver("ErrorEvent", on_error)  # VTK's executive repeats that there was one
        algorithm.AddObserver("ProgressEvent", self.stop_in_time)
        algorithm.Update()
        if self.errors:
            raise RuntimeError(self.errors[0])
        if algorithm.GetAbortExecute():
            raise TimeoutError(f"the time was up in {algorithm.GetClassName()}")

    def stop_in_time(self, algorithm, event):
        if time.monotonic() > self.deadline:
            algorithm.SetAbortExecute(True)


def value(data, name):
    """A value of a data object's field data."""
    return data.GetFieldData().GetArray(name).GetTuple1(0)


def reconstruct(capture, depth, watch):
    """The filter that makes the surface and the one that judges it, both up to date."""
    reader = vtkSilhouetteCaptureReader()
    reader.SetFileName(capture)
    reader.ReleaseDataFlagOn()  # images are given up as soon as the silhouettes are made
    extractor = vtkSilhouetteExtractor()
    extractor.SetInputConnection(reader.GetOutputPort())
    watch.run(reader)
    watch.run(extractor)

    octree = vtkSilhouetteOctreeSource()
    octree.SetInputConnection(extractor.GetOutputPort())
    octree.SetDepth(depth)
    octree.AutomaticToleranceOn()  # forgives wrong silhouettes where they would cut the object
    watch.run(octree)
    views, votes = value(octree.GetOutput(), "NumberOfViews"), value(octree.GetOutput(), "BackgroundVotes")

    cubes = vtkVotingMarchingCubes()
    cubes.SetInputConnection(octree.GetOutputPort(0))
    cubes.SetViewsConnection(octree.GetOutputPort(1))
    cubes.SetShare((views - votes) / views)  # as many views as the octree has asked
    watch.run(cubes)

    hulls = vtkLocalHullSurfacer()
    hulls.SetInputConnection(cubes.GetOutputPort())
    hulls.SetOctreeConnection(octree.GetOutputPort(0))
    hulls.SetViewsConnection(octree.GetOutputPort(1))
    watch.run(hulls)

    evaluator = vtkSilhouetteEvaluator()
    evaluator.SetInputConnection(hulls.GetOutputPort())
    evaluator.SetViewsConnection(extractor.GetOutputPort())  # as extracted, not as the octree may dilate them
    evaluator.SetOctreeConnection(octree.GetOutputPort(0))
    watch.run(evaluator)
    return hulls, evaluator


def report(table):
    """Prints a line a view, the worst first, and what the mesh is as a whole."""
    rows = range(table.GetNumberOfRows())
    for row in sorted(rows, key=lambda row: -table.GetValueByName(row, "XOR").ToDouble()):
        name, iou, xor = (table.GetValueByName(row, column) for column in ("Name", "IoU", "XOR"))
        print(f"{name.ToString():20} IoU {iou.ToDouble():.4f}  XOR {100 * xor.ToDouble():.2f} %")
    print(f"mean IoU {value(table, 'MeanIoU'):.4f}, volume {value(table, 'Volume'):.6g}, "
          f"{value(table, 'Components'):.0f} component(s), {value(table, 'LostSurface'):.0f} octants lost")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("capture")
    parser.add_argument("mesh")
    parser.add_argument("--depth", type=int, default=8)
    parser.add_argument("--threads", type=int, default=0, help="0: as many as there are processors")
    parser.add_argument("--seconds", type=float, default=3600.0, help="the time after which to give up")
    arguments = parser.parse_args()

    vtkSMPTools.Initialize(arguments.threads)  # the mesh is the same, byte for byte, for any number
    try:
        hulls, evaluator = reconstruct(arguments.capture, arguments.depth, Watch(arguments.seconds))
    except (RuntimeError, TimeoutError) as error:
        return str(error)
    report(evaluator.GetOutput())
    if not value(evaluator.GetOutput(), "Sound"):
        return "the mesh is not sound"

    writer = vtkXMLPolyDataWriter()
    writer.SetInputConnection(hulls.GetOutputPort())
    writer.SetFileName(arguments.mesh)
    writer.Write()
    return f"{arguments.mesh} could not be written" if writer.GetErrorCode() else 0


if __name__ == "__main__":
    sys.exit(main())
