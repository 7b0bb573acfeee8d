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

    def test_every_setting_says_what_it_does(self):
        settings = 0
        for name in filter(lambda name: name.startswith("vtk"), vtksilhouette.__all__):
            filter_class = getattr(vtksilhouette, name)
            for setter in vars(filter_class):
                if not setter.startswith("Set") or not hasattr(filter_class, "G" + setter[1:]):
                    continue
                with self.subTest(name + "." + setter):
                    settings += 1
                    lines = getattr(filter_class, setter).__doc__.splitlines()
                    # help() begins with the Python and the C++ signatures.
                    self.assertTrue([line for line in lines if line.strip() and not line.startswith((setter, "C++"))])
        self.assertGreater(settings, 60)

    def test_version(self):
        self.assertRegex(vtksilhouette.__version__, r"^\d+\.\d+\.\d+$")

    def test_renders_only_when_asked(self):
        self.assertNotIn("vtkmodules.vtkRenderingOpenGL2", sys.modules)

    def test_defaults(self):
        source = vtksilhouette.vtkSilhouetteOctreeSource()
        self.assertEqual(source.GetDepth(), 8)
        self.assertEqual(source.GetBackgroundVotes(), 0)
        self.assertEqual(vtksilhouette.vtkVotingMarchingCubes().GetShare(), 1.0)


if __name__ == "__main__":
    unittest.main()
