# SPDX-License-Identifier: BSD-3-Clause
"""The three commands, one after the other, on captures that they make themselves."""
import json
import os
import pty
import subprocess
import unittest

import program
from program import PICTURES, PROGRAM, ProgramTest

METRICS = """views depth octants_tested view_tests inside intersection lost_no_corner lost_all_corners lost_surface
dropped_octants cavities_filled carved_by_view points triangles open_edges non_manifold_edges non_manifold_vertices
self_intersections components genus mean_iou mean_xor seconds peak_memory_mib leaf_edge marching_cubes_components
surface vote_share background_votes bounds per_view volume closed carving dilation uncovered_share
strict_uncovered_share mode island_share deficit shift alignment repaired_pixels""".split()
TRUTH_METRICS = "mesh_to_truth_mean truth_to_mesh_mean truth_rms truth_hausdorff".split()


class Synthesize(ProgramTest):
    def test_writes_a_whole_capture(self):
        self.assertEqual(sorted(path.name for path in self.capture.iterdir()),
                         ["images", "masks", "projections.txt", "truth.ply"])
        lines = [line.split() for line in (self.capture / "projections.txt").read_text().splitlines()]
        self.assertEqual(len(lines), 12)
        for line in lines:
            self.assertEqual(len(line), 13)
            for folder in ("images", "masks"):
                self.assertEqual(program.png_size(self.capture / folder / line[0]), (128, 128))
            for number in line[1:]:
                self.assertEqual("%.17g" % float(number), number)

    def test_same_seed_same_bytes(self):
        for name, seed in (("a", 3), ("b", 3), ("c", 4)):
            self.good("synthesize", self.folder / name, "--shape", "sphere", "--size", "96x64", "--views", 5,
                      "--noise-contour", 2, "--noise-blobs", 2, "--noise-pixels", 0.01, "--noise-camera", 1,
                      "--noise-rotation", 0.5, "--seed", seed)

        def content(name):
            files = sorted(path for path in (self.folder / name).rglob("*") if path.is_file())
            return [(str(path.relative_to(self.folder / name)), path.read_bytes()) for path in files]

        self.assertEqual(content("a"), content("b"))
        self.assertNotEqual(content("a"), content("c"))
        self.assertEqual(program.png_size(self.folder / "a" / "masks" / "view_000.png"), (96, 64))

    def test_every_shape_and_a_mesh(self):
        for shape in ("torus", "twig", "pebble", "pumpkin"):
            self.good("synthesize", self.folder / shape, "--shape", shape, "--size", "32x32", "--views", 2)
        self.good("synthesize", self.folder / "own", "--mesh", self.capture / "truth.ply", "--size", "128x128",
                  "--views", 12)
        mask = "masks/view_003.png"
        self.assertEqual((self.folder / "own" / mask).read_bytes(), (self.capture / mask).read_bytes())

    def test_force_replaces_a_capture_only(self):
        target = self.folder / "taken"
        options = ["--shape", "sphere", "--size", "32x32", "--views", 3]
        target.mkdir()
        self.good("synthesize", target, *options)
        self.bad(program.FILES, ["taken", "not empty"], "synthesize", target, *options)
        self.good("synthesize", target, "--force", "--shape", "sphere", "--size", "48x48", "--views", 3)
        self.assertEqual(program.png_size(target / "masks" / "view_000.png"), (48, 48))
        (target / "diary.txt").write_text("mine")
        self.bad(program.FILES, ["taken", "something else"], "synthesize", target, "--force", *options)
        self.assertEqual((target / "diary.txt").read_text(), "mine")
        self.assertEqual(self.names(), ["taken"])


class Reconstruct(ProgramTest):
    def test_jug_with_everything(self):
        image = ["--image", self.folder / "jug.png"] if PICTURES else []
        found = self.reconstruct("--truth", self.capture / "truth.ply", "--octree", self.folder / "jug.htg", *image)
        self.assertEqual([key for key in METRICS + TRUTH_METRICS if key not in found], [])
        self.assert_sound(found)
        self.assertEqual((found["views"], found["depth"], found["lost_surface"]), (12, 5, 0))
        self.assertEqual(found["components"], 1)
        self.assertGreater(found["mean_iou"], 0.95)
        self.assertLess(found["mesh_to_truth_mean"], found["leaf_edge"])
        self.assertEqual(sorted(found["carved_by_view"]), ["view_%03d.png" % i for i in range(12)])
        self.assertTrue(all(0.0 <= share <= 1.0 for share in found["carved_by_view"].values()))
        for stage in ("read", "silhouettes", "carve", "marching_cubes", "local_hulls", "evaluate", "write", "total"):
            self.assertGreaterEqual(found["seconds"][stage], 0.0)
        self.assertGreater(found["peak_memory_mib"], 1.0)
        self.assertIn(b"<HyperTreeGrid", (self.folder / "jug.htg").read_bytes())
        if PICTURES:
            self.assertEqual(max(program.png_size(self.folder / "jug.png")), 1200)
        self.assertEqual([name for name in self.names() if name.startswith(".")], [])

    def test_report(self):
        done = self.good("reconstruct", self.capture, "-o", self.folder / "jug.ply", "--depth", 4)
        for words in ("wrote", "jug.ply", "depth 4", "closed, manifold, free of self-intersections", "mean IoU"):
            self.assertIn(words, done.stdout)
        self.assertEqual(done.stderr, "") # a pipe: no bar
        quiet = self.good("reconstruct", self.capture, "-o", self.folder / "quiet.ply", "--depth", 4, "--quiet")
        self.assertEqual(quiet.stdout + quiet.stderr, "")
        self.assertEqual((self.folder / "quiet.ply").read_bytes(), (self.folder / "jug.ply").read_bytes())

    def test_same_bytes_for_any_number_of_threads(self):
        files = []
        for threads in (1, 2, 8):
            name = "mesh%d.ply" % threads
            self.reconstruct("--threads", threads, mesh=name)
            files.append((self.folder / name).read_bytes())
        self.assertEqual(files[0], files[1])
        self.assertEqual(files[0], files[2])

    def test_bar_on_a_terminal(self):
        terminal, end = pty.openpty()
        child = subprocess.Popen([PROGRAM, "reconstruct", str(self.capture), "-o", str(self.folder / "jug.ply"),
                                  "--depth", "4"], stderr=end, stdout=subprocess.DEVNULL)
        os.close(end)
        shown = b""
        try:
            while True:
                piece = os.read(terminal, 4096)
                if not piece:
                    break
                shown += piece
        except OSError: # the other end is closed
            pass
        os.close(terminal)
        self.assertEqual(child.wait(), program.OK)
        for stage in (b"reading the capture", b"carving the octree", b"marching cubes", b"local hulls", b"100 %"):
            self.assertIn(stage, shown)
        self.assertTrue(shown.endswith(b"\r\x1b[K"), shown[-40:]) # and gone at the end


class Evaluate(ProgramTest):
    SHAPE = "sphere"

    def test_truth_against_itself(self):
        truth = self.capture / "truth.ply"
        found = self.evaluate(truth, "--truth", truth, "--sample-spacing", 0.05)
        self.assert_sound(found)
        self.assertEqual((found["views"], found["components"], found["genus"]), (12, 1, 0))
        self.assertEqual((found["mean_iou"], found["mean_xor"]), (1.0, 0.0))
        self.assertEqual((found["false_object"], found["false_background"]), (0, 0))
        self.assertAlmostEqual(found["volume"], 4.0 / 3.0 * 3.14159265 * 0.9 ** 3, delta=0.02)
        for key in TRUTH_METRICS:
            self.assertLess(found[key], 1e-6)
        self.assertEqual([view["name"] for view in found["per_view"]], ["view_%03d.png" % i for i in range(12)])

    def test_report(self):
        done = self.good("evaluate", self.capture / "truth.ply", "--capture", self.capture)
        for words in ("1 component, genus 0", "closed, manifold", "mean IoU 1.0000", "view_011.png"):
            self.assertIn(words, done.stdout)
        self.assertEqual(done.stderr, "")

    def test_agrees_with_reconstruct(self):
        made = self.reconstruct()
        found = self.evaluate(self.folder / "mesh.ply")
        for key in ("points", "triangles", "genus", "volume", "mean_iou", "mean_xor", "per_view"):
            self.assertEqual(made[key], found[key], key)

    def test_open_mesh(self):
        mesh = self.folder / "patch.obj"
        mesh.write_text("v 0 0 0\nv 0.5 0 0\nv 0 0.5 0\nv 0.5 0.5 0\nf 1 2 3\nf 2/1 4/1/1 -2\n")
        found = self.evaluate(mesh)
        self.assertEqual((found["points"], found["triangles"], found["open_edges"]), (4, 2, 4))
        self.assertIsNone(found["genus"])
        self.assertFalse(found["closed"])
        done = self.good("evaluate", mesh, "--capture", self.capture)
        self.assertIn("4 open edges", done.stdout)

    def test_metrics_are_json(self):
        self.evaluate(self.capture / "truth.ply")
        text = (self.folder / "evaluation.json").read_text()
        self.assertNotIn("NaN", text)
        self.assertIsInstance(json.loads(text), dict)


if __name__ == "__main__":
    unittest.main()
