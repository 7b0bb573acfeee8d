# SPDX-License-Identifier: BSD-3-Clause
"""growth.py: a row for each depth and for each number of ranks, and pieces that add up; no time is asserted."""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent


def rows(folder, *options):
    done = subprocess.run([sys.executable, str(HERE / "growth.py"), folder, *options], check=True, stdout=subprocess.PIPE,
                          stderr=subprocess.DEVNULL, universal_newlines=True)
    table = [[cell.strip() for cell in line.split("|")[1:-1]] for line in done.stdout.splitlines() if line.startswith("| ")]
    return table[2:]  # without the head


def number(text):
    return int(text.replace(",", ""))


class Growth(unittest.TestCase):
    def test_depths_pieces_and_ranks(self):
        with tempfile.TemporaryDirectory() as temporary:
            folder = os.path.join(temporary, "capture")
            subprocess.run([os.environ["SILHOUETTE_PROGRAM"], "synthesize", folder, "--views", "8", "--size", "128x128", "-q"],
                           check=True)
            whole = rows(folder, "--depths", "4-5")
            self.assertEqual([row[0] for row in whole], ["4", "5"])
            self.assertGreater(number(whole[1][4]), 3 * number(whole[0][4]))
            self.assertGreater(float(whole[1][7]), 0.0)
            pieces = rows(folder, "--depths", "5", "--pieces", "3")
            self.assertEqual(pieces[0][3:5], whole[1][3:5], "leaves on the surface and faces")
            hulls = rows(folder, "--depths", "4-5", "--local-hulls")
            self.assertEqual([row[:5] for row in hulls], [row[:5] for row in whole])
            self.assertEqual([len(row) for row in hulls], [12, 12])
            self.assertTrue(all(float(cell) > 0.0 for cell in hulls[1][5:]))
            ranks = rows(folder, "--depths", "5", "--ranks", "1,2")
            self.assertEqual([row[0] for row in ranks], ["1", "2"])
            least, most = ranks[0][7].split(" to ")
            self.assertEqual(least, most)
            self.assertEqual(least, whole[1][3])
            self.assertEqual(sum(map(number, ranks[1][7].split(" to "))), number(least), "two ranks share what one has")
            self.assertGreaterEqual(float(ranks[1][3]), 1.0)

    def test_ranks_go_with_one_depth(self):
        done = subprocess.run([sys.executable, str(HERE / "growth.py"), "none", "--depths", "5-6", "--ranks", "1,2"],
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
        self.assertNotEqual(done.returncode, 0)
        self.assertIn("goes with one depth", done.stderr)
        self.assertEqual(done.stdout, "")

    def test_local_hulls_go_with_one_piece(self):
        for other in (["--pieces", "2"], ["--depths", "5", "--ranks", "1,2"]):
            done = subprocess.run([sys.executable, str(HERE / "growth.py"), "none", "--local-hulls", *other],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
            self.assertEqual(done.returncode, 2)
            self.assertIn("--local-hulls goes with one piece", done.stderr)

    def test_a_run_that_fails_is_said_without_a_traceback(self):
        with tempfile.TemporaryDirectory() as nothing:
            done = subprocess.run([sys.executable, str(HERE / "growth.py"), nothing, "--depths", "4"],
                                  stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn(nothing, done.stderr, "the reader's message")
        self.assertEqual(done.stderr.splitlines()[-1], "growth.py: --depth 4 made no octree or surface; what is wrong is said above")
        self.assertEqual(done.stdout, "")


if __name__ == "__main__":
    unittest.main()
