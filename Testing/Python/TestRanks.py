# SPDX-License-Identifier: BSD-3-Clause
"""
Two and four MPI ranks: the first makes the local hulls' surface for all, and each rank's share is, to the last bit, what it
makes of the whole by itself. Where one fails or is stopped all end alike, and nobody waits for ever.
"""
import importlib.util
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PIPELINE = pathlib.Path(__file__).with_name("ranks_pipeline.py")
NEEDED = ("mpi4py", "vtkmodules.vtkParallelMPI")


def run(ranks):
    """What each rank has found, a list by rank."""
    with tempfile.TemporaryDirectory(prefix="vtksilhouette-") as folder:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", str(ranks), sys.executable, str(PIPELINE),
                   folder]
        # Threads are shared out, so that four ranks do not ask for four times the processors.
        environment = {**os.environ, "OMPI_MCA_rmaps_base_oversubscribe": "1", "VTK_SMP_MAX_THREADS": "1",
                       "OMPI_MCA_mpi_yield_when_idle": "1"}
        done = subprocess.run(command, timeout=300, env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              universal_newlines=True, errors="replace")
        if done.returncode != 0:
            raise AssertionError(f"{ranks} ranks ended with {done.returncode}:\n{done.stdout}")
        return [json.loads(pathlib.Path(folder, f"rank{rank}.json").read_text()) for rank in range(ranks)]


class Ranks:
    """The tests for a number of ranks."""

    RANKS = 0

    @classmethod
    def setUpClass(cls):
        cls.found = run(cls.RANKS)

    def each(self, part):
        for rank in self.found:
            with self.subTest(rank=rank["rank"]):
                yield rank["rank"], rank[part]

    def assert_made(self, update):
        self.assertEqual(update["done"], 1)
        self.assertGreater(update["data"]["cells"], 0)

    def assert_empty(self, update, done):
        self.assertEqual((update["done"], update["data"]["points"], update["data"]["cells"]), (done, 0, 0))

    def test_all_are_in_it(self):
        self.assertEqual([(rank["rank"], rank["ranks"]) for rank in self.found],
                         [(rank, self.RANKS) for rank in range(self.RANKS)])

    def test_shares_are_those_of_the_whole(self):
        for _, found in self.each("shares"):
            self.assertEqual(found["errors"], [])
            self.assert_made(found["together"][0])
            self.assertEqual(found["together"], found["alone"])
            self.assertEqual(found["again"], found["alone"][0])
            self.assertEqual(found["changed"], found["changed_alone"])

    def test_shares_without_triangles_too(self):
        hulls = [found["together"]["data"]["cells"] for _, found in self.each("one_hull")]
        self.assertEqual(sorted(hulls)[:-1], [0] * (self.RANKS - 1))
        for _, found in self.each("one_hull"):
            self.assertEqual(found["together"], found["alone"])

    def test_the_first_rank_alone_asks_for_the_inputs(self):
        for rank, found in self.each("shares"):
            for what, count in found["upstream"].items():
                self.assertEqual(count > 0, rank == 0, what)

    def test_other_pieces_are_made_alone(self):
        first = self.found[0]["other_pieces"]
        self.assert_made(first["whole"])
        self.assertEqual(sum(piece["data"]["cells"] for piece in first["some"]), first["whole"]["data"]["cells"])
        for _, found in self.each("other_pieces"):
            self.assert_made(found["together"])
            self.assertEqual(found["afterwards"], found["together"])

    def test_a_refusal_is_everybodys(self):
        for _, found in self.each("refusals"):
            self.assert_empty(found["failed"], 0)
            self.assertEqual(len(found["errors"]), 1)
            self.assertIn("cover offset 5 is", found["errors"][0])
            self.assert_made(found["mended"])

    def test_inputs_that_fail_are_everybodys(self):
        for rank, found in self.each("failing_inputs"):
            self.assert_made(found["before"])
            self.assert_empty(found["failed"], 0)
            self.assertEqual(len(found["errors"]), 1)
            self.assertIn("depth 99" if rank == 0 else "rank 0 could not make what the surface is made from",
                          found["errors"][0])
            self.assertEqual(found["mended"], found["before"])

    def test_inputs_that_fail_on_the_last_rank_alone_are_too(self):
        last = self.RANKS - 1
        for rank, found in self.each("one_rank_fails"):
            self.assert_empty(found["failed"], 0)
            self.assertEqual(len(found["errors"]), int(rank < last))
            if rank < last:
                self.assertIn(f"rank {last} could not", found["errors"][0])

    def test_all_stop_with_the_first(self):
        for _, found in self.each("stops"):
            self.assertEqual(found["errors"], [])
            self.assert_empty(found["stopped"], 1)
            self.assert_made(found["afterwards"])


class TestTwoRanks(Ranks, unittest.TestCase):
    RANKS = 2


class TestFourRanks(Ranks, unittest.TestCase):
    RANKS = 4


def missing():
    """What is needed and not there, or an empty text."""
    if not shutil.which("mpirun"):
        return "mpirun"
    return next((name for name in NEEDED if not importlib.util.find_spec(name)), "")


if __name__ == "__main__":
    if missing():
        print("skipped: there is no " + missing())
        sys.exit(77)
    unittest.main()
