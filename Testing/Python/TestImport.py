# SPDX-License-Identifier: BSD-3-Clause
"""The package and its classes."""

import sys
import unittest

import vtksilhouette


class TestImport(unittest.TestCase):
    FILTERS = ("vtkSilhouetteOctreeSource", "vtkVotingMarchingCubes", "vtkLocalHullSurfacer")

    def test_filters_are_in_the_package(self):
        for name in self.FILTERS:
            with self.subTest(name):
                instance = getattr(vtksilhouette, name)()
                self.assertTrue(instance.IsA("vtkAlgorithm"))
                self.assertEqual(instance.GetClassName(), name)
                self.assertIn(name, vtksilhouette.__all__)
                self.assertIn(name, str(instance))

    def test_documentation_teaches(self):
        for name in self.FILTERS:
            with self.subTest(name):
                self.assertIn("port", getattr(vtksilhouette, name).__doc__)
        self.assertIn("numpy_front", vtksilhouette.__doc__)

    def test_renders_only_when_asked(self):
        self.assertNotIn("vtkmodules.vtkRenderingOpenGL2", sys.modules)

    def test_defaults(self):
        source = vtksilhouette.vtkSilhouetteOctreeSource()
        self.assertEqual(source.GetDepth(), 8)
        self.assertEqual(source.GetBackgroundVotes(), 0)
        self.assertEqual(vtksilhouette.vtkVotingMarchingCubes().GetShare(), 1.0)


if __name__ == "__main__":
    unittest.main()
