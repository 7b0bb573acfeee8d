# SPDX-License-Identifier: BSD-3-Clause
"""
pvbatch with one, two and four ranks: each carves its piece of the octree, and the surfaces, gathered, are the serial
ones, triangle for triangle. The local hulls are made once, by the first; where it fails all do, and nobody waits for ever.
"""
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PARAVIEW_BIN = pathlib.Path(os.environ["PARAVIEW_BIN"])
PIPELINE = pathlib.Path(__file__).with_name("ranks_pipeline.py")


def pvbatch(ranks, folder):
    """Run the pipeline; what each rank has found, a list by rank."""
    command = [PARAVIEW_BIN / "pvbatch"]
    if ranks > 1:
        command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", ranks, *command, "--symmetric"]
    # Threads are shared out, so that four ranks do not ask for four times the processors.
    environment = {**os.environ, "OMPI_MCA_rmaps_base_oversubscribe": "1", "VTK_SMP_MAX_THREADS": "1",
                   "OMPI_MCA_mpi_yield_when_idle": "1"}
    done = subprocess.run([str(word) for word in (*command, PIPELINE, folder)], timeout=500, env=environment,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True, errors="replace")
    if done.returncode != 0:
        raise AssertionError("pvbatch with %d ranks ended with %d:\n%s" % (ranks, done.returncode, done.stdout))
    return [json.loads((folder / ("rank%d.json" % rank)).read_text()) for rank in range(ranks)]


def triangles(found, surface):
    """All ranks' triangles in one sorted list; coordinates as they were."""
    return sorted(tuple(corners) for rank in found for corners in rank[surface])


class TestRanks(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="vtksilhouette-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.serial = pvbatch(1, cls.folder)

    def test_the_serial_run_is_sound(self):
        (rank,) = self.serial
        self.assertEqual(rank["sound"], 1)
        self.assertGreater(len(rank["cubes"]), 1000)
        self.assertEqual((rank["ranks"], rank["piece"], rank["pieces"]), (1, 0, 1))

    def check(self, ranks):
        found = pvbatch(ranks, self.folder)
        self.assertEqual([rank["ranks"] for rank in found], [ranks] * ranks)
        self.assertEqual([(rank["piece"], rank["pieces"]) for rank in found], [(n, ranks) for n in range(ranks)])
        for key in ("octants_tested", "intersection_octants", "inside_octants"):
            self.assertEqual(sum(rank[key] for rank in found), self.serial[0][key], key)
        for surface in ("cubes", "hulls"):
            self.assertEqual(triangles(found, surface), triangles(self.serial, surface))
            for rank in found:
                self.assertGreater(len(rank[surface]), 0)
                self.assertLess(len(rank[surface]), len(self.serial[0][surface]))
        # The evaluation is the first rank's, of the whole.
        self.assertEqual([rank["rows"] for rank in found], [self.serial[0]["rows"]] + [0] * (ranks - 1))
        self.assertEqual(found[0]["sound"], 1)
        self.assertEqual(found[0]["triangles"], self.serial[0]["triangles"])

        self.check_that_the_first_rank_makes_the_hulls(found)
        self.check_that_all_fail_alike(found)

    def check_that_the_first_rank_makes_the_hulls(self, found):
        serial = self.serial[0]
        self.assertEqual([rank["alone"]["hulls"] for rank in found], [rank["hulls"] for rank in found])
        # In order: the shares follow each other.
        self.assertEqual([triangle for rank in found for triangle in rank["alone"]["hulls"]], serial["hulls"])
        for what in ("cubes", "octants", "views"):
            self.assertEqual([rank["alone"][what] for rank in found],
                             [serial["alone"][what]] + [0] * (len(found) - 1), what)

    def check_that_all_fail_alike(self, found):
        for rank, one in enumerate(found):
            self.assertEqual(one["failures"]["mended"], len(one["hulls"]))
            for name, first, others in (("surfacer", "cover offset 5 is", "cover offset 5 is"),
                                        ("octree", "depth 99", "rank 0 could not make")):
                failure = one["failures"][name]
                # ParaView may update more than once.
                self.assertEqual((failure["triangles"], len(set(failure["messages"]))), (0, 1), failure)
                self.assertIn(first if rank == 0 else others, failure["messages"][0])

    def test_two_ranks(self):
        self.check(2)

    def test_four_ranks(self):
        self.check(4)


if __name__ == "__main__":
    if not shutil.which("mpirun"):
        print("skipped: there is no mpirun")
        sys.exit(77)
    if not (PARAVIEW_BIN / "pvbatch").exists():
        print("skipped: there is no pvbatch in %s" % PARAVIEW_BIN)
        sys.exit(77)
    unittest.main()
