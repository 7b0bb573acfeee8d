# SPDX-License-Identifier: BSD-3-Clause
"""The plugin's pipeline in pvpython: from a synthetic capture to a judged mesh, all ports, readers, errors, aborts."""
import unittest

import numpy

import plugin
from plugin import fetch, field, output, triangles
from paraview import servermanager, simple
from paraview.simple import OutputPort

plugin.load(globals())


def pipeline(depth=6, views=12, size=128):
    """A capture, its octree, both surfaces and the evaluation."""
    capture = SyntheticCapture(Width=size, Height=size, NumberOfViews=views)
    octree = SilhouetteOctree(Input=OutputPort(capture, 0), Depth=depth)
    cubes = VotingMarchingCubes(Input=OutputPort(octree, 0), Views=OutputPort(octree, 1))
    hulls = LocalHullSurface(Input=cubes, Octree=OutputPort(octree, 0), Views=OutputPort(octree, 1))
    judge = SilhouetteEvaluator(Input=OutputPort(hulls, 0), Views=OutputPort(octree, 1),
                                Truth=OutputPort(capture, 1), Octree=OutputPort(octree, 0))
    return capture, octree, cubes, hulls, judge


class TestPipeline(plugin.PluginTest):
    def test_a_sound_mesh(self):
        with plugin.Messages() as messages:
            capture, octree, cubes, hulls, judge = pipeline()
            table = fetch(judge)
        self.assertEqual(messages.text, "")
        self.assertEqual(table.GetNumberOfRows(), 12)
        self.assertEqual(field(table, "Sound"), 1)
        self.assertEqual(field(table, "LostSurface"), 0)
        self.assertGreater(field(table, "MeanIoU"), 0.95)
        self.assertEqual(field(table, "Triangles"), len(triangles(fetch(hulls))))
        self.assertGreater(len(triangles(fetch(cubes))), 1000)

    def test_all_ports(self):
        capture, octree, cubes, hulls, judge = pipeline()
        for port, views in ((0, 12), (2, 12)):
            images = output(capture, port)
            self.assertEqual(images.GetNumberOfPartitionedDataSets(), views)
            self.assertEqual(images.GetPartition(0, 0).GetDimensions(), (128, 128, 1))
            projection = images.GetPartition(3, 0).GetFieldData().GetArray("Projection")
            self.assertEqual(projection.GetNumberOfComponents() * projection.GetNumberOfTuples(), 12)
        self.assertGreater(len(triangles(output(capture, 1))), 1000)
        grid = fetch(octree, 0)
        self.assertEqual(grid.GetClassName(), "vtkHyperTreeGrid")
        self.assertEqual({grid.GetCellData().GetArrayName(n) for n in range(3)},
                         {"State", "Generation", "LatticeCode"})
        self.assertEqual(output(octree, 1).GetNumberOfPartitionedDataSets(), 12)
        pieces = output(hulls, 1)
        ids = {pieces.GetCellData().GetArray("HullId").GetTuple1(n) for n in range(pieces.GetNumberOfCells())}
        self.assertGreater(len(ids), 10)

    def test_octree_is_drawn_by_state(self):
        """What the GUI shows as soon as it is applied: the array of states comes first and is the active one."""
        capture, octree, *_ = pipeline(depth=4)
        grid = fetch(octree, 0)
        self.assertEqual(grid.GetCellData().GetScalars().GetName(), "State")
        self.assertGreater(grid.GetMask().GetNumberOfValues(), 0)

    def test_settings_reach_the_classes(self):
        capture, octree, cubes, hulls, judge = pipeline(depth=4)
        coarse = len(triangles(fetch(cubes)))
        octree.Depth = 5
        self.assertGreater(len(triangles(fetch(cubes))), 3 * coarse)
        hulls.FillCavities = 0
        hulls.Mode = "Thesis"
        self.assertEqual(hulls.GetClientSideObject().GetClassName(), "vtkLocalHullSurfacer")
        self.assertGreater(len(triangles(fetch(hulls))), 0)
        capture.Shape = "Sphere"
        octree.BackgroundVotes = 2
        with plugin.Messages() as messages:
            fetch(cubes)
        self.assertIn("background votes", messages.text)
        cubes.VoteShare = 10 / 12
        with plugin.Messages() as messages:
            self.assertGreater(len(triangles(fetch(cubes))), 0)
        self.assertEqual(messages.text, "")

    def test_extractor(self):
        capture = SyntheticCapture(Width=64, Height=64, NumberOfViews=6)
        extractor = SilhouetteExtractor(Input=OutputPort(capture, 2), UseBackgroundColor=1,
                                        BackgroundColor=[0, 0, 1], Operations=[0, 1, 1, 2])
        with plugin.Messages() as messages:
            found = output(extractor)
        self.assertEqual(messages.text, "")
        self.assertEqual(found.GetNumberOfPartitionedDataSets(), 6)
        self.assertEqual(found.GetPartition(0, 0).GetNumberOfScalarComponents(), 1)
        extractor.Tolerance = 4
        with plugin.Messages() as messages:
            self.assertEqual(output(extractor).GetNumberOfPartitionedDataSets(), 0)
        self.assertIn("tolerance: 4 is not a number from 0 to 3", messages.text)


class TestReader(plugin.PluginTest):
    def write_capture(self, views=6, size=64):
        """A capture folder, from the synthetic source's masks."""
        capture = SyntheticCapture(Width=size, Height=size, NumberOfViews=views)
        images = output(capture, 0)
        lines = []
        from vtkmodules.vtkIOImage import vtkPNGWriter
        for n in range(views):
            image = images.GetPartition(n, 0)
            writer = vtkPNGWriter()
            writer.SetFileName(str(self.folder / ("%02d.png" % n)))
            writer.SetInputData(image)
            writer.Write()
            values = image.GetFieldData().GetArray("Projection")
            numbers = [values.GetComponent(t, c) for t in range(values.GetNumberOfTuples())
                       for c in range(values.GetNumberOfComponents())]
            lines.append("%02d.png " % n + " ".join("%.17g" % number for number in numbers))
        self.camera_file = self.folder / "projections.txt"
        self.camera_file.write_text("\n".join(lines) + "\n")
        return capture

    def readers_of(self, file):
        """The readers that ParaView offers for a file."""
        session = servermanager.ActiveConnection.Session
        factory = servermanager.vtkSMProxyManager.GetProxyManager().GetReaderFactory()
        found = factory.GetReaders(str(file), session)
        return [found.GetString(n) for n in range(1, found.GetNumberOfStrings(), 3)]

    def test_offered_for_camera_files(self):
        """ParaView's CSV reader takes any .txt and comes first in the alphabet: the dialog offers both."""
        self.write_capture()
        self.assertIn("SilhouetteCaptureReader", self.readers_of(self.camera_file))
        text = self.camera_file.read_text()
        for name in ("notes.txt", "projections.csv"):
            (self.folder / name).write_text(text)
            self.assertNotIn("SilhouetteCaptureReader", self.readers_of(self.folder / name))
        self.camera_file.write_text("no cameras\n")
        self.assertNotIn("SilhouetteCaptureReader", self.readers_of(self.camera_file))

    def test_offered_for_middlebury_files(self):
        self.write_capture()
        names = sorted(path.name for path in self.folder.glob("*.png"))
        camera = " 100 0 32 0 100 32 0 0 1 1 0 0 0 1 0 0 0 1 0 0 5"
        file = self.folder / "temple_par.txt"
        self.camera_file.unlink()
        file.write_text("%d\n" % len(names) + "".join(name + camera + "\n" for name in names))
        self.assertIn("SilhouetteCaptureReader", self.readers_of(file))

    def test_offered_for_other_programs(self):
        self.write_capture()
        names = sorted(path.name for path in self.folder.glob("*.png"))
        self.camera_file.unlink()
        (self.folder / "cameras.txt").write_text("1 SIMPLE_PINHOLE 64 64 100 32 32\n")
        (self.folder / "images.txt").write_text("".join(f"{n} 1 0 0 0 0 0 5 1 {name}\n\n" for n, name in enumerate(names)))
        frames = ", ".join(f'{{"file_path": "{name}", "transform_matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,5],[0,0,0,1]]}}' for name in names)
        (self.folder / "transforms.json").write_text(f'{{"camera_angle_x": 0.7, "frames": [{frames}]}}')
        for name in ("cameras.txt", "images.txt", "transforms.json"):
            self.assertIn("SilhouetteCaptureReader", self.readers_of(self.folder / name))

    def test_a_capture_from_disk(self):
        capture = self.write_capture()
        reader = SilhouetteCaptureReader(FileName=str(self.camera_file))
        self.assertEqual(output(reader, 0).GetNumberOfPartitionedDataSets(), 6)
        cameras = output(reader, 1)
        self.assertGreater(cameras.GetNumberOfCells(), 6)
        seen = {cameras.GetCellData().GetArray("View").GetTuple1(n) for n in range(cameras.GetNumberOfCells())}
        self.assertEqual(seen, set(range(6)))
        meshes = []
        for source in (reader, capture):
            octree = SilhouetteOctree(Input=OutputPort(source, 0), Depth=5)
            cubes = VotingMarchingCubes(Input=OutputPort(octree, 0), Views=OutputPort(octree, 1))
            meshes.append(triangles(fetch(cubes)))
        self.assertGreater(len(meshes[0]), 100)
        self.assertTrue(numpy.array_equal(*meshes))

    def test_views_are_chosen(self):
        self.write_capture()
        reader = SilhouetteCaptureReader(FileName=str(self.camera_file), Views="0,2-3")
        self.assertEqual(output(reader, 0).GetNumberOfPartitionedDataSets(), 3)

    def expect_message(self, *words):
        reader = SilhouetteCaptureReader(FileName=str(self.camera_file))
        octree = SilhouetteOctree(Input=OutputPort(reader, 0), Depth=4)
        cubes = VotingMarchingCubes(Input=OutputPort(octree, 0), Views=OutputPort(octree, 1))
        with plugin.Messages() as messages:
            cubes.UpdatePipeline()
            reader.UpdatePipeline()
        for word in ("vtkSilhouetteCaptureReader", *words):
            self.assertIn(word, messages.text)
        self.assertEqual(output(reader, 0).GetNumberOfPartitionedDataSets(), 0)
        with plugin.Messages():
            self.assertEqual(fetch(cubes).GetNumberOfCells(), 0)

    def test_bad_captures(self):
        self.write_capture()
        good = self.camera_file.read_text()
        (self.folder / "03.png").write_bytes(b"no picture")
        self.expect_message("03.png")
        (self.folder / "03.png").unlink()
        self.expect_message("03.png")
        self.camera_file.write_text(good.replace("00.png ", "00.png nan ", 1))
        self.expect_message("projections.txt")
        self.camera_file.write_text("")
        self.expect_message("projections.txt")
        self.camera_file.unlink()
        self.expect_message("projections.txt")


class TestAbort(plugin.PluginTest):
    """The classes honour AbortExecute in ParaView too: the run ends, its output is empty, no error is raised."""

    def test_each_filter(self):
        capture, octree, cubes, hulls, judge = pipeline(depth=6)
        judge.UpdatePipeline()
        for source, name, values, empty in (
                (octree, "Depth", (5, 6), lambda data: data.GetMaxNumberOfTrees() == 0),
                (cubes, "GenerateNormals", (1, 0), lambda data: data.GetNumberOfCells() == 0),
                (hulls, "GenerateNormals", (1, 0), lambda data: data.GetNumberOfCells() == 0),
                (judge, "SampleSpacing", (0.5, 0), lambda data: data.GetNumberOfRows() == 0)):
            with self.subTest(source.GetXMLName()):
                heard = []

                def stop(caller, _):
                    if caller.GetProgress() < 1.0:
                        heard.append(caller.GetProgress())
                        caller.SetAbortExecute(1)

                filter_ = source.GetClientSideObject()
                tag = filter_.AddObserver("ProgressEvent", stop)
                setattr(source, name, values[0])
                with plugin.Messages() as messages:
                    source.UpdatePipeline()
                filter_.RemoveObserver(tag)
                self.assertTrue(heard)
                self.assertNotIn("ERR", messages.text)
                self.assertTrue(empty(filter_.GetOutputDataObject(0)))
                # Newer VTK than 9.1 leaves the flag to whoever set it; and an aborted filter runs again when something
                # has changed.
                filter_.SetAbortExecute(0)
                setattr(source, name, values[1])
                source.UpdatePipeline()
                self.assertFalse(empty(filter_.GetOutputDataObject(0)))


if __name__ == "__main__":
    unittest.main()
