# SPDX-License-Identifier: BSD-3-Clause
"""The comparison runs, small, and its table has the rows and sane values; no time is asserted."""
import os
import pathlib
import subprocess
import sys
import unittest

HERE = pathlib.Path(__file__).resolve().parent


def compare(*options):
    return subprocess.run([sys.executable, str(HERE / "compare.py"), "--program", os.environ["SILHOUETTE_PROGRAM"],
                           "--stages", os.environ["SILHOUETTE_STAGES"], "--size", "256", "--views", "12", *options],
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)


class Compare(unittest.TestCase):
    def test_table(self):
        done = compare("--cells", "32,64", "--sides", "ours,subpixel,hulls,dense,numpy", "--largest", "numpy:32", "--repeats", "2")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in done.stdout.splitlines()
                if line.startswith("| vtk") or line.startswith("| dense") or line.startswith("| numpy")]
        self.assertEqual(len(rows), 9, done.stdout)
        for row in rows:
            self.assertEqual(len(row), 7)
            ratio, processors, memory, xor, error = (float(row[i]) for i in (1, 2, 3, 5, 6))
            self.assertGreater(min(ratio, processors, memory), 0.0)
            self.assertGreater(int(row[4].replace(",", "")), 1000)
            self.assertLess(xor, 15.0, "per cent of the silhouettes")
            self.assertLess(error, 2.0, "cells")
            if row[0].endswith("exact surface"):
                self.assertEqual(ratio, 1.0)
        exact, sub_pixel, dense = (next(float(row[5]) for row in rows[-4:] if name in row[0]) for name in ("exact surf", "sub-pixel", "dense"))
        self.assertLess(abs(exact - dense), 0.5, "both are exact")
        self.assertLess(sub_pixel, exact)

    def test_wrong_arguments(self):
        for options, word in ((("--cells", "100"), "power of two"), (("--shape", "cube", "--cells", "32"), "cube")):
            done = compare(*options)
            self.assertNotEqual(done.returncode, 0)
            self.assertIn(word, done.stderr)


if __name__ == "__main__":
    unittest.main()
