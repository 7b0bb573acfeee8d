# SPDX-License-Identifier: BSD-3-Clause
"""
Photographs that other people took. They are not part of the project: SILHOUETTE_REAL_DATA names their folder, else
they are looked for beside the checkout. Skipped where they are absent.
"""
import os
import pathlib
import unittest

import program
from program import PICTURES, ProgramTest

BESIDE = pathlib.Path(__file__).resolve().parents[2].parent / "shared" / "data"
DATA = pathlib.Path(os.environ.get("SILHOUETTE_REAL_DATA") or BESIDE)
DINOSAUR = DATA / "vgg-dinosaur"
STEGOSAURUS = DATA / "middlebury-dino-sparse-ring"

CLEAN = ["--key", "blue:0.08", "--threshold", 0.12, "--opening", 1, "--largest-region", "--fill-holes", 60]
TORN = ["--background", "0,0,0.75", "--tolerance", 1.1, "--opening", 2]
AUTHORS = ["--threshold", 0.19, "--dilate", 10, "--erode", 7, "--fill-holes", 400]


class RealCaptures(ProgramTest):
    SHAPE = "sphere"

    def assert_keeps_the_promise(self, found):
        self.assert_sound(found)
        self.assertEqual(found["lost_surface"], 0)
        self.assertEqual(found["dropped_octants"], 0)

    def test_dinosaur(self):
        for depth, least in ((7, 0.975), (8, 0.98)):
            picture = ["--image", self.folder / "dino.png"] if PICTURES else []
            found = self.reconstruct(*CLEAN, *picture, capture=DINOSAUR, depth=depth)
            self.assert_keeps_the_promise(found)
            self.assertEqual((found["views"], found["components"]), (36, 1))
            self.assertGreaterEqual(found["mean_iou"], least)

    def test_dinosaur_is_mirrored(self):
        done = self.good("reconstruct", DINOSAUR, *CLEAN, "-o", self.folder / "dino.obj", "--depth", 5)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn("vtksilhouette: warning: ", done.stderr)
        self.assertIn("mirrored", done.stderr)

    def test_torn_silhouettes(self):
        found = self.reconstruct(*TORN, capture=DINOSAUR, depth=7)
        self.assert_keeps_the_promise(found)
        self.assertGreater(found["marching_cubes_components"], 100)
        self.assertLess(found["components"], found["marching_cubes_components"] // 10)

    def test_stegosaurus(self):
        found = self.reconstruct(*AUTHORS, capture=STEGOSAURUS, depth=7)
        self.assert_keeps_the_promise(found)
        self.assertEqual(found["views"], 15)
        self.assertGreaterEqual(found["mean_iou"], 0.97)

    def test_photographs_need_options(self):
        self.bad(program.PROCESSING, ["viff.000.png", "key"], "reconstruct", DINOSAUR, "-o", self.folder / "x.ply")


if __name__ == "__main__":
    if not DINOSAUR.is_dir() or not STEGOSAURUS.is_dir():
        program.skip("no captures in %s; SILHOUETTE_REAL_DATA names their folder" % DATA)
    unittest.main()
