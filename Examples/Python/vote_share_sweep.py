# SPDX-License-Identifier: BSD-3-Clause
"""One capture at several shares of the vote: a contact sheet, and the numbers that it should be read with.

    python3 -m vtksilhouette.offscreen vote_share_sweep.py CAPTURE SHEET.png [--shares 1 0.9 ...] [--depth N]

CAPTURE holds masks, or images that are silhouettes already, and their cameras; `vtksilhouette synthesize torn
--noise-blobs 6 --noise-contour 1` makes one that is worth a sweep. A column for each share: marching cubes above,
seen from the first camera, local hulls below.
"""

import argparse
import sys

import vtkmodules.vtkRenderingFreeType  # noqa: F401  text
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  what renders
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)

from vtksilhouette import (vtkLocalHullSurfacer, vtkSilhouetteCaptureReader, vtkSilhouetteEvaluator,
                           vtkSilhouetteExtractor, vtkSilhouetteOctreeSource, vtkVotingMarchingCubes)

PANEL = 300  # pixels


class Sweep:
    """The pipeline, connected once. Whoever changes a share runs again what depends on it, and nothing else."""

    def __init__(self, capture, depth):
        self.reader = vtkSilhouetteCaptureReader()
        self.reader.SetFileName(capture)
        self.extractor = vtkSilhouetteExtractor()
        self.extractor.SetInputConnection(self.reader.GetOutputPort())
        self.octree = vtkSilhouetteOctreeSource()
        self.octree.SetInputConnection(self.extractor.GetOutputPort())
        self.octree.SetDepth(depth)
        self.cubes = vtkVotingMarchingCubes()
        self.cubes.SetInputConnection(self.octree.GetOutputPort(0))
        self.cubes.SetViewsConnection(self.octree.GetOutputPort(1))
        self.hulls = vtkLocalHullSurfacer()
        self.hulls.SetInputConnection(self.cubes.GetOutputPort())
        self.hulls.SetOctreeConnection(self.octree.GetOutputPort(0))
        self.hulls.SetViewsConnection(self.octree.GetOutputPort(1))
        self.evaluator = vtkSilhouetteEvaluator()
        self.evaluator.SetViewsConnection(self.extractor.GetOutputPort())

    def views(self):
        self.extractor.Update()
        return self.extractor.GetOutput().GetNumberOfPartitionedDataSets()

    def at(self, background_votes):
        """The two surfaces, (marching cubes, local hulls), where so many views may call a point background."""
        self.octree.SetBackgroundVotes(background_votes)  # the octree and the vote must ask the same views
        self.cubes.SetShare(1.0 - background_votes / self.views())
        self.hulls.Update()
        return kept(self.cubes.GetOutput()), kept(self.hulls.GetOutput())

    def judge(self, surface):
        """The evaluator's field data, a dictionary of numbers."""
        self.evaluator.SetInputData(surface)
        self.evaluator.Update()
        fields = self.evaluator.GetOutput().GetFieldData()
        arrays = [fields.GetArray(number) for number in range(fields.GetNumberOfArrays())]
        return {array.GetName(): array.GetTuple1(0) for array in arrays if array.GetNumberOfTuples() == 1}


def kept(surface):
    """A copy that stays when the filter runs again; points and triangles are shared, not copied."""
    copy = vtkPolyData()
    copy.ShallowCopy(surface)
    return copy


def panel(surface, cameras, label, place):
    """A renderer in the part of the window that `place`, (left, bottom, right, top), says."""
    normals = vtkPolyDataNormals()
    normals.SetInputData(surface)
    normals.SplittingOff()
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(normals.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.86, 0.80, 0.72)
    text = vtkTextActor()
    text.SetInput(label)
    text.SetPosition(10, 10)
    text.GetTextProperty().SetColor(0.2, 0.2, 0.2)
    text.GetTextProperty().SetFontSize(15)
    renderer = vtkRenderer()
    renderer.SetBackground(1.0, 1.0, 1.0)
    renderer.SetViewport(place)
    renderer.AddActor(actor)
    renderer.AddActor2D(text)
    centre, top, _, _, bottom = (cameras.GetPoint(number) for number in range(5))
    view = renderer.GetActiveCamera()
    view.SetPosition(centre)
    view.SetFocalPoint(surface.GetCenter())
    view.SetViewUp([upper - lower for upper, lower in zip(top, bottom)])
    renderer.ResetCamera()
    return renderer


def write_sheet(columns, cameras, path):
    """`columns` are pairs of (surface, label). Returns whether the file was written."""
    window = vtkRenderWindow()
    window.SetSize(PANEL * len(columns), 2 * PANEL)
    for column, pair in enumerate(columns):
        for row, (surface, label) in enumerate(pair):
            left, top = column / len(columns), 1.0 - row / 2
            window.AddRenderer(panel(surface, cameras, label, (left, top - 0.5, left + 1 / len(columns), top)))
    pixels = vtkWindowToImageFilter()
    pixels.SetInput(window)
    pixels.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(pixels.GetOutputPort())
    writer.SetFileName(path)
    writer.Write()
    return writer.GetErrorCode() == 0


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("capture")
    parser.add_argument("sheet")
    parser.add_argument("--shares", type=float, nargs="+", default=[1.0, 0.95, 0.9, 0.8])
    parser.add_argument("--depth", type=int, default=7)
    arguments = parser.parse_args()

    sweep = Sweep(arguments.capture, arguments.depth)
    columns = []
    print("share  votes  surface         triangles  components  closed  mean IoU  mean XOR")
    for share in arguments.shares:
        votes = int((1.0 - share) * sweep.views() + 1e-9)
        column = []
        for name, surface in zip(("marching cubes", "local hulls"), sweep.at(votes)):
            if surface.GetNumberOfPolys() == 0:
                return f"{arguments.capture}: no surface at share {share}; VTK's messages above say why"
            found = sweep.judge(surface)
            print(f"{share:5.2f}  {votes:5}  {name:14}  {found['Triangles']:9.0f}  {found['Components']:10.0f}  "
                  f"{'yes' if found['Closed'] else 'no':6}  {found['MeanIoU']:8.4f}  {found['MeanXOR']:8.4f}")
            column.append((surface, f"{name}, {100 * share:.0f} %: IoU {found['MeanIoU']:.3f}"))
        columns.append(column)
    if not write_sheet(columns, sweep.reader.GetCamerasOutput(), arguments.sheet):
        return f"{arguments.sheet} could not be written; VTK's messages above say why"
    return 0


if __name__ == "__main__":
    sys.exit(main())
