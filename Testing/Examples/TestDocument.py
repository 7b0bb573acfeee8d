# SPDX-License-Identifier: BSD-3-Clause
"""Documentation/pipelines.md says what is: its code stands in the examples, its table is what the outputs hold."""

import os
import subprocess
import tempfile
import unittest

import vtksilhouette

import document


class TestBlocks(unittest.TestCase):
    def test_the_code_is_in_the_examples(self):
        text = document.text()
        self.assertEqual(document.untrue_blocks(text), [])
        languages = [block["language"] for block in document.blocks(text)]
        self.assertEqual(len(languages), text.count("```") // 2, "a block that is not understood")
        self.assertEqual(set(languages), {"python", "cpp", "cmake", "sh"})

    def test_what_is_wrong_is_found(self):
        named = "<!-- Examples/Python/judged_mesh.py -->\n"
        for planted, words in (("```python\nwatch.run(reader)\n```", "no file is named"),
                               (named + "```python\nwatch.run(rader)\n```", "not in Examples"),
                               (named + "```python\nwatch.run(reader)\nwatch.run(octree)\n```", "not in Examples"),
                               (named + "```python\n```", "not in Examples"),
                               ("<!-- Examples/none.py -->\n```python\nwatch.run(reader)\n```", "does not exist")):
            with self.subTest(planted):
                found = document.untrue_blocks(planted)
                self.assertEqual(len(found), 1)
                self.assertIn(words, found[0])
        true = named + "```python\nwatch.run(reader)\nwatch.run(extractor)\n```"
        self.assertEqual(document.untrue_blocks(true), [])


def synthesized(folder):
    """A small capture of eight views in `folder`: its path."""
    capture = os.path.join(folder, "jug")
    program = os.path.join(os.environ["SILHOUETTE_PREFIX"], os.environ["SILHOUETTE_PROGRAM"])
    subprocess.run([program, "synthesize", capture, "--size", "96x96", "--views", "8", "--quiet"], check=True)
    return capture


def pipeline(capture):
    """The filters by class name, up to date."""
    made = {name: getattr(vtksilhouette, name)() for name in (
        "vtkSilhouetteCaptureReader", "vtkSilhouetteExtractor", "vtkSilhouetteOctreeSource",
        "vtkVotingMarchingCubes", "vtkLocalHullSurfacer", "vtkSilhouetteEvaluator")}
    reader, extractor, octree, cubes, hulls, evaluator = made.values()
    reader.SetFileName(capture)
    extractor.SetInputConnection(reader.GetOutputPort())
    octree.SetInputConnection(extractor.GetOutputPort())
    octree.SetDepth(4)
    cubes.SetInputConnection(octree.GetOutputPort(0))
    cubes.SetViewsConnection(octree.GetOutputPort(1))
    hulls.SetInputConnection(cubes.GetOutputPort())
    hulls.SetOctreeConnection(octree.GetOutputPort(0))
    hulls.SetViewsConnection(octree.GetOutputPort(1))
    evaluator.SetInputConnection(hulls.GetOutputPort())
    evaluator.SetViewsConnection(extractor.GetOutputPort())
    evaluator.SetOctreeConnection(octree.GetOutputPort(0))
    evaluator.Update()
    return made


def array_of(output, where, name):
    """An array of a data object, of its first view where it is views; None where it is not there."""
    if output.IsA("vtkPartitionedDataSetCollection"):
        output = output.GetPartitionedDataSet(0).GetPartition(0)
    arrays = {"points": lambda: output.GetPointData(), "cells": lambda: output.GetCellData(),
              "rows": lambda: output.GetRowData(), "field": lambda: output.GetFieldData()}[where]()
    return arrays.GetScalars() if name == "scalars" else arrays.GetAbstractArray(name)


def type_of(array):
    name = array.GetDataTypeAsString()
    return "unsigned 64-bit" if name in ("unsigned long", "unsigned long long") else name


class TestTable(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.filters = pipeline(synthesized(folder.name))
        cls.filters["vtkLocalHullSurfacer"].Update(1)
        cls.rows = document.outputs(document.text())

    def test_every_row(self):
        for name, port, where, array, kind, least, most in self.rows:
            with self.subTest(f"{name} {port}: {array}"):
                found = array_of(self.filters[name].GetOutputDataObject(port), where, array)
                self.assertIsNotNone(found)
                self.assertEqual(type_of(found), kind)
                self.assertIn(found.GetNumberOfComponents(), range(least, most + 1))
                self.assertGreater(found.GetNumberOfTuples(), 0)

    def test_no_output_is_left_out(self):
        ports = {(name, port) for name, made in self.filters.items()
                 for port in range(made.GetNumberOfOutputPorts())}
        self.assertEqual({row[:2] for row in self.rows}, ports)

    def test_field_data_pass_through(self):
        octree, cubes, hulls, table = (made.GetOutputDataObject(0) for made in list(self.filters.values())[2:])
        for name in ("Depth", "RootCube", "BackgroundVotes", "CarvedByView"):
            for data in (octree, cubes, hulls):
                self.assertIsNotNone(array_of(data, "field", name), name)
        self.assertIsNotNone(array_of(table, "field", "Survivors"))


class TestWhatRuns(unittest.TestCase):
    """What the document says of changes, released images, hulls on demand, and filters that were stopped."""

    def setUp(self):
        self.filters = pipeline(self.capture)
        self.ran = []
        for name, made in self.filters.items():
            made.AddObserver("StartEvent", lambda caller, event, name=name: self.ran.append(name))

    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.capture = synthesized(folder.name)

    def test_what_was_changed_and_what_is_below(self):
        names = list(self.filters)
        self.filters["vtkSilhouetteEvaluator"].Update()
        self.assertEqual(self.ran, [])
        self.filters["vtkVotingMarchingCubes"].SetEdgePlacementToMiddle()
        self.filters["vtkSilhouetteEvaluator"].Update()
        self.assertEqual(self.ran, names[3:])

    def test_hulls_on_demand(self):
        hulls = self.filters["vtkLocalHullSurfacer"]
        self.assertEqual(hulls.GetOutputDataObject(1).GetNumberOfCells(), 0, "nothing has asked for them")
        surface = hulls.GetOutput().GetPoints()
        hulls.Update(1)
        first = hulls.GetOutputDataObject(1).GetNumberOfCells()
        self.assertGreater(first, 0)
        self.assertIs(hulls.GetOutput().GetPoints(), surface)
        hulls.SetSeedBlock(16)
        hulls.Update()
        self.assertEqual(hulls.GetOutputDataObject(1).GetNumberOfCells(), first, "those of before")
        hulls.Update(1)
        self.assertLess(hulls.GetOutputDataObject(1).GetNumberOfCells(), first, "larger seeds give fewer hulls")

    def test_released_images(self):
        reader, octree = self.filters["vtkSilhouetteCaptureReader"], self.filters["vtkSilhouetteOctreeSource"]
        reader.ReleaseDataFlagOn()
        reader.Modified()
        octree.Update()
        self.assertEqual(reader.GetOutput().GetNumberOfPartitionedDataSets(), 0)
        self.assertEqual(reader.GetCamerasOutput().GetNumberOfPoints(), 5 * 8)
        self.ran.clear()
        octree.SetDepth(5)
        octree.Update()
        self.assertEqual(self.ran, ["vtkSilhouetteOctreeSource"])

    def test_a_stopped_filter(self):
        octree = self.filters["vtkSilhouetteOctreeSource"]
        stop = octree.AddObserver("ProgressEvent", lambda caller, event: caller.SetAbortExecute(True))
        octree.SetDepth(5)
        octree.Update()
        self.assertTrue(octree.GetAbortExecute())
        self.assertEqual(octree.GetOutput().GetNumberOfVertices(), 0)
        octree.RemoveObserver(stop)
        octree.Update()
        self.assertEqual(octree.GetOutput().GetNumberOfVertices(), 0, "not run again by itself")
        octree.Modified()
        octree.Update()
        self.assertFalse(octree.GetAbortExecute())
        self.assertGreater(octree.GetOutput().GetNumberOfVertices(), 0)


if __name__ == "__main__":
    unittest.main()
