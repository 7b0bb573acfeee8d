# SPDX-License-Identifier: BSD-3-Clause
"""
The dinosaur that other people photographed, in ParaView's pipeline: the mesh that the program makes with the same
settings, triangle for triangle. SILHOUETTE_REAL_DATA names the captures' folder, else they are looked for beside the
checkout. Skipped where they are absent.
"""
import os
import pathlib
import unittest

import numpy

import plugin
from plugin import fetch, field, triangles
from paraview.simple import OutputPort
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

plugin.load(globals())

BESIDE = plugin.TREE.parent / "shared" / "data"
DATA = pathlib.Path(os.environ.get("SILHOUETTE_REAL_DATA") or BESIDE)
DINOSAUR = DATA / "vgg-dinosaur"


class TestDinosaur(plugin.PluginTest):
    DEPTH = 7

    def program(self):
        """The program's mesh, in a format that keeps doubles."""
        mesh = self.folder / "dinosaur.vtp"
        done = plugin.run([plugin.PROGRAM, "reconstruct", DINOSAUR, "-o", mesh, "--depth", self.DEPTH,
                           "--key", "blue:0.08", "--threshold", 0.12, "--opening", 1, "--largest-region",
                           "--fill-holes", 60], env={**os.environ, "LD_LIBRARY_PATH": ""})
        self.assertEqual(done.returncode, 0, done.stdout)
        reader = vtkXMLPolyDataReader()
        reader.SetFileName(str(mesh))
        reader.Update()
        return triangles(reader.GetOutput())

    def test_the_mesh_is_the_programs(self):
        reader = SilhouetteCaptureReader(FileName=str(DINOSAUR / "projections.txt"))
        extractor = SilhouetteExtractor(Input=OutputPort(reader, 0), KeyChannel="Blue", KeyExcess=0.08, UseThreshold=1,
                                        Threshold=0.12, Operations=[0, 1], LargestRegion=1, FillHoles=60)
        octree = SilhouetteOctree(Input=extractor, Depth=self.DEPTH)
        cubes = VotingMarchingCubes(Input=OutputPort(octree, 0), Views=OutputPort(octree, 1))
        hulls = LocalHullSurface(Input=cubes, Octree=OutputPort(octree, 0), Views=OutputPort(octree, 1))
        found = triangles(fetch(hulls))
        judge = SilhouetteEvaluator(Input=OutputPort(hulls, 0), Views=OutputPort(octree, 1),
                                    Octree=OutputPort(octree, 0))
        table = fetch(judge)
        self.assertEqual(field(table, "Sound"), 1)
        self.assertEqual(field(table, "LostSurface"), 0)
        self.assertGreater(field(table, "MeanIoU"), 0.97)
        expected = self.program()
        self.assertGreater(len(expected), 10000)
        self.assertEqual(found.shape, expected.shape)
        self.assertTrue(numpy.array_equal(found, expected), "greatest difference %g" % abs(found - expected).max())


if __name__ == "__main__":
    if not DINOSAUR.is_dir():
        plugin.skip("no capture in %s; SILHOUETTE_REAL_DATA names the captures' folder" % DATA)
    if not os.access(plugin.PROGRAM, os.X_OK):
        plugin.skip("no program to compare with; SILHOUETTE_PROGRAM names it")
    unittest.main()
