# SPDX-License-Identifier: BSD-3-Clause
"""For mpirun, see TestRanks.py: each rank updates pipelines with all others, and writes what came of it into a folder."""
import hashlib
import json
import os
import sys

from mpi4py import MPI  # noqa: F401 starts MPI
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkParallelCore import vtkMultiProcessController
from vtkmodules.vtkParallelMPI import vtkMPIController
import vtksilhouette

controller = vtkMPIController()
controller.Initialize()
vtkMultiProcessController.SetGlobalController(controller)
rank, ranks = controller.GetLocalProcessId(), controller.GetNumberOfProcesses()


class Pipeline:
    """From a capture to the surface, with nobody but the surfacer asking; and what it and the octree had to say."""

    def __init__(self):
        self.capture = vtksilhouette.vtkSyntheticCaptureSource()
        self.capture.SetWidth(96)
        self.capture.SetHeight(96)
        self.capture.SetNumberOfViews(8)
        self.octree = vtksilhouette.vtkSilhouetteOctreeSource()
        self.octree.SetInputConnection(self.capture.GetOutputPort())
        self.octree.SetDepth(5)
        self.cubes = vtksilhouette.vtkVotingMarchingCubes()
        self.cubes.SetInputConnection(self.octree.GetOutputPort(0))
        self.cubes.SetViewsConnection(self.octree.GetOutputPort(1))
        self.hulls = vtksilhouette.vtkLocalHullSurfacer()
        self.hulls.SetInputConnection(0, self.cubes.GetOutputPort())
        self.hulls.SetOctreeConnection(self.octree.GetOutputPort(0))
        self.hulls.SetViewsConnection(self.octree.GetOutputPort(1))
        self.hulls.GenerateNormalsOn()
        self.errors = []
        for source in (self.octree, self.hulls):
            self.hear(source)

    def hear(self, source):
        def note(_, __, text):
            self.errors.append(text)
        note.CallDataType = "string0"
        source.AddObserver("ErrorEvent", note)
        source.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)

    def update(self, piece=rank, pieces=ranks, port=0):
        """Ask for a piece of an output; what the output then is."""
        hulls = self.hulls.GetExecutive()
        hulls.UpdateInformation()
        request = hulls.GetOutputInformation(port)
        request.Set(hulls.UPDATE_PIECE_NUMBER(), piece)
        request.Set(hulls.UPDATE_NUMBER_OF_PIECES(), pieces)
        request.Set(hulls.UPDATE_NUMBER_OF_GHOST_LEVELS(), 0)
        done = hulls.Update(port)
        return {"done": done, "data": digest(self.hulls.GetOutputDataObject(port))}

    def upstream(self):
        """How much this rank holds of what comes before the surfacer."""
        views = self.octree.GetOutputDataObject(1)
        return {"octants": self.octree.GetOutputDataObject(0).GetNumberOfElements(vtkDataObject.CELL),
                "views": views.GetNumberOfPartitionedDataSets(),
                "triangles": self.cubes.GetOutputDataObject(0).GetNumberOfCells(),
                "images": self.capture.GetOutputDataObject(0).GetNumberOfPartitionedDataSets()}


def digest(data):
    """A surface to the last bit: its counts, and of each array name, type, size and what a hash makes of its bytes."""
    def one(array):
        return [array.GetName(), array.GetClassName(), array.GetNumberOfComponents(), array.GetNumberOfTuples(),
                hashlib.sha256(memoryview(array)).hexdigest() if array.GetNumberOfValues() else ""]
    arrays = {"points": [one(data.GetPoints().GetData())] if data.GetPoints() else [],
              "triangles": [one(data.GetPolys().GetConnectivityArray())]}
    for name, some in (("point", data.GetPointData()), ("cell", data.GetCellData()), ("field", data.GetFieldData())):
        arrays[name] = sorted(one(some.GetAbstractArray(i)) for i in range(some.GetNumberOfArrays()))
    arrays["active"] = [array.GetName() if array else None
                        for array in (data.GetPointData().GetNormals(), data.GetCellData().GetScalars())]
    return {"points": data.GetNumberOfPoints(), "cells": data.GetNumberOfCells(), "arrays": arrays}


def shares():
    """Both outputs: of all ranks together, then as each makes its own of the whole."""
    together, alone = Pipeline(), Pipeline()
    alone.hulls.SetController(None)
    found = {"together": [together.update(port=port) for port in (0, 1)], "upstream": together.upstream(),
             "alone": [alone.update(port=port) for port in (0, 1)], "errors": together.errors}
    found["again"] = together.update(port=0)  # nothing has changed
    together.hulls.SetIslandShare(0.5)
    alone.hulls.SetIslandShare(0.5)
    found["changed"], found["changed_alone"] = together.update(), alone.update()
    return found


def one_hull():
    """A solid of a single hull: all ranks but one get none."""
    together, alone = Pipeline(), Pipeline()
    for pipeline in (together, alone):
        pipeline.capture.SetShapeToSphere()
        pipeline.hulls.SetHullTolerance(100.0)
        pipeline.hulls.SetSeedBlock(64)
    alone.hulls.SetController(None)
    return {"together": together.update(port=1), "alone": alone.update(port=1)}


def other_pieces():
    """What is not a piece for each rank is made without the others: here by the first rank alone."""
    pipeline = Pipeline()
    found = {"together": pipeline.update()}
    if rank == 0:
        found["whole"] = pipeline.update(0, 1)
        found["some"] = [pipeline.update(piece, ranks + 1) for piece in range(ranks + 1)]
    pipeline.hulls.Modified()
    found["afterwards"] = pipeline.update()
    return found


def refusals():
    """The surfacer refuses a setting; then it is mended."""
    pipeline = Pipeline()
    pipeline.hulls.SetCoverOffset(5.0)
    found = {"failed": pipeline.update(), "errors": list(pipeline.errors)}
    pipeline.hulls.SetCoverOffset(0.03)
    found["mended"] = pipeline.update()
    return found


def failing_inputs():
    """The octree refuses a setting, once the pipeline has run; then it is mended."""
    pipeline = Pipeline()
    found = {"before": pipeline.update()}
    pipeline.octree.SetDepth(99)
    found.update(failed=pipeline.update(), errors=list(pipeline.errors))
    pipeline.octree.SetDepth(5)
    found["mended"] = pipeline.update()
    return found


def one_rank_fails():
    """The inputs of the last rank fail alone."""
    pipeline = Pipeline()
    failing = failing_source()
    if rank == ranks - 1:
        pipeline.hulls.SetInputConnection(0, failing.GetOutputPort())
    return {"failed": pipeline.update(), "errors": pipeline.errors}


def failing_source():
    from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase

    class Failing(VTKPythonAlgorithmBase):
        def __init__(self):
            super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkPolyData")

        def RequestInformation(self, request, inputs, outputs):
            outputs.GetInformationObject(0).Set(self.CAN_HANDLE_PIECE_REQUEST(), 1)
            return 1

        def RequestData(self, request, inputs, outputs):
            return 0

    source = Failing()
    source.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
    return source


def stops():
    """The first rank is asked to stop half-way, and after that nobody is."""
    pipeline = Pipeline()
    if rank == 0:
        def stop(*_):
            if pipeline.hulls.GetProgress() > 0.4:
                pipeline.hulls.AbortExecuteOn()
        tag = pipeline.hulls.AddObserver("ProgressEvent", stop)
    found = {"stopped": pipeline.update(), "errors": pipeline.errors}
    if rank == 0:
        pipeline.hulls.RemoveObserver(tag)
        pipeline.hulls.AbortExecuteOff()
    pipeline.hulls.Modified()
    found["afterwards"] = pipeline.update()
    return found


if __name__ == "__main__":
    written = {"rank": rank, "ranks": ranks}
    for part in (shares, one_hull, other_pieces, refusals, failing_inputs, one_rank_fails, stops):
        written[part.__name__] = part()
    with open(os.path.join(sys.argv[1], f"rank{rank}.json"), "w", encoding="utf-8") as file:
        json.dump(written, file)
