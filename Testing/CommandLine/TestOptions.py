# SPDX-License-Identifier: BSD-3-Clause
"""What the options of `reconstruct` do."""
import unittest

import program
from program import ARGUMENTS, ProgramTest

SIZE = 96


class Surfaces(ProgramTest):
    def test_kinds(self):
        hull = self.reconstruct()
        cubes = self.reconstruct("--surface", "marching-cubes")
        self.assertEqual((hull["surface"], cubes["surface"]), ("local-hull", "marching-cubes"))
        self.assertEqual(cubes["components"], cubes["marching_cubes_components"])
        self.assertEqual(cubes["marching_cubes_components"], hull["marching_cubes_components"])
        self.assertEqual(cubes["open_edges"], 0)
        self.assertEqual(hull["lost_surface"], 0)

    def test_share_chooses_the_background_votes(self):
        for surface in ("voting", "local-hull"):
            found = self.reconstruct("--surface", surface, "--vote-share", 0.75)
            self.assertEqual((found["vote_share"], found["background_votes"]), (0.75, 3))
            self.assertEqual(found["open_edges"], 0)
        found = self.reconstruct("--surface", "voting", "--background-votes", 2)
        self.assertAlmostEqual(found["vote_share"], 10 / 12)
        found = self.reconstruct("--vote-share", 0.75, "--background-votes", 3)
        self.assertEqual((found["vote_share"], found["background_votes"]), (0.75, 3))

    def test_pieces_make_the_same_mesh(self):
        for kind in ("voting", "marching-cubes"):
            truth = ["--truth", self.capture / "truth.ply"]
            whole = self.reconstruct("--surface", kind, *truth, depth=6, mesh="whole.ply")
            parts = self.reconstruct("--surface", kind, "--pieces", 5, *truth, depth=6, mesh="parts.ply")
            self.assertEqual(parts["sample_spacing"], parts["leaf_edge"])
            self.assert_sound(parts)
            self.assertIsNone(parts.pop("lost_surface"))
            self.assertIsInstance(whole.pop("lost_surface"), int)
            for changing in ("mesh", "seconds", "peak_memory_mib"):
                whole.pop(changing), parts.pop(changing)
            for key, value in whole.items():
                if isinstance(value, float):
                    self.assertAlmostEqual(parts[key], value, places=9, msg=key)
                elif key != "carved_by_view":
                    self.assertEqual(parts[key], value, key)
            for view, share in whole["carved_by_view"].items():
                self.assertAlmostEqual(parts["carved_by_view"][view], share, places=12)
            judged = self.evaluate(self.folder / "parts.ply", "--truth", self.folder / "whole.ply")
            self.assertLess(judged["mesh_to_truth_maximum"], 1e-12)
        self.bad(ARGUMENTS, ["--pieces", "whole"], "reconstruct", self.capture, "-o", self.folder / "no.ply",
                 "--pieces", 2)
        self.bad(ARGUMENTS, ["--pieces", "--octree"], "reconstruct", self.capture, "-o", self.folder / "no.ply",
                 "--surface", "voting", "--pieces", 2, "--octree", self.folder / "no.htg")
        self.assertFalse((self.folder / "no.ply").exists())

    def test_faithful_votes_open_the_surface(self):
        found = self.reconstruct("--surface", "voting", "--vote-share", 0.8, "--votes", "faithful")
        self.assertEqual(found["background_votes"], 0)
        self.assertGreater(found["open_edges"], 0)
        self.assertIsNone(found["genus"])
        self.assert_sound(self.reconstruct("--vote-share", 0.8, "--votes", "faithful"))

    def test_edges(self):
        exact = self.reconstruct("--surface", "marching-cubes")
        middle = self.reconstruct("--surface", "marching-cubes", "--edges", "middle")
        self.assertEqual(exact["triangles"], middle["triangles"])
        self.assertGreater(exact["mean_iou"], middle["mean_iou"])
        sub_pixel = self.reconstruct("--surface", "marching-cubes", "--edges", "sub-pixel")
        self.assertGreater(sub_pixel["mean_iou"], exact["mean_iou"])


class LocalHulls(ProgramTest):
    def test_modes_and_switches(self):
        robust = self.reconstruct()
        thesis = self.reconstruct("--mode", "thesis")
        plain = self.reconstruct("--no-repair", "--no-alignment", "--no-correction", "--no-thin-hulls",
                                 "--no-handles", "--no-tunnels")
        self.assertEqual((robust["mode"], thesis["mode"], plain["mode"]), ("robust", "thesis", "robust"))
        for found in (robust, thesis, plain):
            self.assert_sound(found)
            self.assertEqual((found["lost_surface"], found["dropped_octants"], found["island_share"]), (0, 0, 0.0))
        self.assertEqual((plain["repaired_pixels"], plain["alignment"]), (0, 0.0))
        self.bad(program.ARGUMENTS, ["--mode", "fast"], "reconstruct", self.capture, "-o", self.folder / "x.ply",
                 "--mode", "fast")
        self.bad(program.ARGUMENTS, ["--drop-islands", "1.5"], "reconstruct", self.capture, "-o",
                 self.folder / "x.ply", "--drop-islands", 1.5)


class Carving(ProgramTest):
    """A twig thinner than the cameras' noise."""

    SHAPE = "twig"

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.capture, cls.noisy = cls.shared / "clean", cls.shared / "noisy"
        for folder, noise in ((cls.capture, 0), (cls.noisy, 1.2)):
            made = program.run("synthesize", folder, "--shape", cls.SHAPE, "--size", "384x384", "--views", 20,
                               "--noise-camera", noise, "--seed", 2, "--quiet")
            if made.returncode != 0:
                raise RuntimeError(made.stderr)

    def test_clean_silhouettes_are_carved_strictly(self):
        found = self.reconstruct(depth=6)
        self.assertEqual((found["carving"], found["background_votes"], found["dilation"]), ("tolerant", 0, 0))
        self.assertEqual((found["uncovered_share"], found["strict_uncovered_share"]), (0.0, 0.0))

    def test_noisy_ones_with_the_tolerance_that_covers_them(self):
        found = self.reconstruct(capture=self.noisy, depth=6)
        self.assertGreater(found["strict_uncovered_share"], 0.01)
        self.assertLess(found["uncovered_share"], 0.001)
        self.assertGreater(found["background_votes"] + found["dilation"], 0)
        self.assertAlmostEqual(found["vote_share"], (20 - found["background_votes"]) / 20)
        self.assertEqual(found["lost_surface"], 0)
        strict = self.reconstruct("--carving", "strict", capture=self.noisy, depth=6)
        self.assertEqual((strict["carving"], strict["background_votes"], strict["dilation"]), ("strict", 0, 0))
        self.assertIsNone(strict["uncovered_share"])
        self.assertLess(strict["mean_iou"], found["mean_iou"])
        self.assertLess(found["components"], strict["components"])

    def test_who_settles_it_settles_it(self):
        for options in (["--background-votes", 0], ["--vote-share", 1], ["--dilate", 1], ["--votes", "faithful"]):
            found = self.reconstruct(*options, capture=self.noisy, depth=6)
            self.assertEqual((found["carving"], found["background_votes"], found["dilation"]), ("strict", 0, 0), options)
        # Morphology of no pixels, or of another kind, settles nothing.
        for options in (["--dilate", 0], ["--closing", 1]):
            self.assertEqual(self.reconstruct(*options, capture=self.noisy, depth=6)["carving"], "tolerant", options)

    def test_report(self):
        done = self.good("reconstruct", self.capture, "-o", self.folder / "x.ply", "--depth", 6)
        self.assertIn("carving      strict: it loses parts with 0.00 % of the silhouettes", done.stdout)
        done = self.good("reconstruct", self.noisy, "-o", self.folder / "x.ply", "--depth", 6)
        self.assertRegex(done.stdout, r"carving +tolerant, as strict carving loses parts with \d+\.\d\d % of the "
                                      r"silhouettes, this 0\.0\d %: background votes \d, dilation \d px")
        done = self.good("reconstruct", self.noisy, "-o", self.folder / "x.ply", "--depth", 6, "--carving", "strict")
        self.assertNotIn("carving ", done.stdout)


class Octrees(ProgramTest):
    SHAPE = "sphere"

    def test_bounds_and_leaf_edge(self):
        found = self.reconstruct("--bounds", "-1,1,-1,1,-0.5,0.5")
        self.assertEqual(found["root_cube"], {"origin": [-1.0, -1.0, -1.0], "edge": 2.0})
        self.assertEqual(found["leaf_edge"], 2.0 / 32)
        metrics = self.folder / "m.json"
        self.good("reconstruct", self.capture, "-o", self.folder / "x.ply", "--bounds=-1,1,-1,1,-1,1", "--leaf-edge",
                  0.07, "--metrics", metrics)
        self.assertIn('"depth": 5', metrics.read_text())

    def test_views(self):
        found = self.reconstruct("--views", "0-4,7", depth=4)
        self.assertEqual((found["views"], len(found["per_view"])), (6, 6))
        self.assertIn("view_007.png", found["carved_by_view"])

    def test_outside(self):
        for policy in ("border", "unknown", "background"):
            self.assert_sound(self.reconstruct("--outside", policy, depth=4))

    def test_warnings_name_the_view(self):
        capture = self.copy_of_capture()
        program.write_png(capture / "masks" / "view_002.png", 128, 128, lambda x, y: 255)
        done = self.good("reconstruct", capture, "-o", self.folder / "x.ply", "--depth", 4)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn("vtksilhouette: warning: view 2 (view_002.png): the silhouette is all object", done.stderr)
        done = self.good("reconstruct", self.capture, "-o", self.folder / "x.ply", "--depth", 4, "--views", "0",
                         "--bounds", "-1,1,-1,1,-1,1")
        self.assertIn("only view 0 (view_000.png)", done.stderr)


class Extraction(ProgramTest):
    """Two squares on blue: a large one with a hole and a small one; both in all views of an upright camera ring."""

    SHAPE = "sphere"

    def photographs(self):
        capture = self.copy_of_capture()
        for file in (capture / "masks").iterdir():
            file.unlink()
        (capture / "masks").rmdir()

        def pixel(x, y):
            if 40 <= x < 88 and 40 <= y < 88 and not (62 <= x < 66 and 62 <= y < 66):
                return (200, 180, 160)
            if 4 <= x < 10 and 4 <= y < 10:
                return (200, 180, 160)
            return (10, 10, 190)

        for file in (capture / "images").iterdir():
            program.write_png(file, 128, 128, pixel)
        return capture

    def pixels(self, *options, capture):
        """The pixels of the first silhouette."""
        mesh = self.folder / "tiny.obj"
        mesh.write_text("v 0 0 0\nv 0.1 0 0\nv 0 0.1 0\nf 1 2 3\n")
        found = self.evaluate(mesh, *options, capture=capture)
        return found["per_view"][0]["silhouette_pixels"]

    def test_criteria_and_morphology(self):
        capture = self.photographs()
        key = ["--key", "blue:0.2"]
        whole, hole, speck = 48 * 48, 16, 36
        self.assertEqual(self.pixels(*key, capture=capture), whole - hole + speck)
        self.assertEqual(self.pixels("--background", "0.04,0.04,0.745", "--tolerance", 0.05, capture=capture),
                         whole - hole + speck)
        self.assertEqual(self.pixels("--threshold", 0.76, capture=capture), whole - hole + speck)
        self.assertEqual(self.pixels(*key, "--largest-region", capture=capture), whole - hole)
        self.assertEqual(self.pixels(*key, "--fill-holes", 17, capture=capture), whole + speck)
        self.assertEqual(self.pixels(*key, "--fill-holes", 16, capture=capture), whole - hole + speck)
        self.assertEqual(self.pixels(*key, "--invert", capture=capture), 128 * 128 - (whole - hole + speck))

    def test_morphology_runs_in_the_order_of_the_command_line(self):
        capture = self.photographs()
        key = ["--key", "blue:0.2", "--largest-region"]
        dilated_first = self.pixels(*key, "--dilate", 3, "--erode", 3, capture=capture)
        eroded_first = self.pixels(*key, "--erode", 3, "--dilate", 3, capture=capture)
        self.assertEqual(dilated_first, self.pixels(*key, "--closing", 3, capture=capture))
        self.assertEqual(eroded_first, self.pixels(*key, "--opening", 3, capture=capture))
        self.assertGreater(dilated_first, eroded_first) # the hole is closed, or grows
        thrice = self.pixels(*key, "--erode", 1, "--dilate", 4, "--erode", 3, capture=capture)
        self.assertGreater(thrice, eroded_first)


class Largest(ProgramTest):
    """Two boxes in every mask of three views along the axes."""

    def boxes(self):
        capture = self.folder / "boxes"
        (capture / "masks").mkdir(parents=True)
        far = 1e6 # nearly parallel rays
        rows = {"x.png": ("0 1 0", "0 0 1", "1 0 0"), "y.png": ("1 0 0", "0 0 1", "0 1 0"),
                "z.png": ("1 0 0", "0 1 0", "0 0 1")}
        lines = []
        for name, axes in rows.items():
            u, v, w = [[float(word) for word in axis.split()] for axis in axes]
            middle, scale = 0.5 * (SIZE - 1), SIZE / 4.0
            first = [scale * far * a + middle * b for a, b in zip(u, w)] + [middle * far]
            second = [scale * far * a + middle * b for a, b in zip(v, w)] + [middle * far]
            third = w + [far]
            lines.append(" ".join([name] + [repr(number) for number in first + second + third]))
            program.write_png(capture / "masks" / name, SIZE, SIZE,
                              lambda x, y: 255 if 20 <= x < 50 and 20 <= y < 50 or 70 <= x < 80 and 70 <= y < 80 else 0)
        (capture / "projections.txt").write_text("\n".join(lines) + "\n")
        return capture

    def test_dropped_octants_are_counted(self):
        capture = self.boxes()
        box = ["--bounds", "-2,2,-2,2,-2,2"]
        both = self.reconstruct(*box, capture=capture)
        self.assertEqual((both["components"], both["lost_surface"], both["dropped_octants"]), (2, 0, 0))
        one = self.reconstruct(*box, "--largest", capture=capture)
        self.assert_sound(one)
        self.assertEqual((one["components"], one["lost_surface"]), (1, 0))
        self.assertGreater(one["dropped_octants"], 0)
        self.assertLess(one["volume"], both["volume"])
        self.assertGreater(one["volume"], 0.9 * both["volume"])
        for capture, dropped in ((capture, None), (self.capture, 0)):
            pieces = self.reconstruct("--surface", "voting", "--pieces", 3, "--largest", *(box if dropped is None else []), capture=capture)
            self.assertEqual((pieces["components"], pieces["lost_surface"], pieces["dropped_octants"]), (1, None, dropped))

    def test_islands_are_given_up_and_counted(self):
        capture = self.boxes()
        box = ["--bounds", "-2,2,-2,2,-2,2"]
        both = self.reconstruct(*box, capture=capture)
        kept = self.reconstruct(*box, "--drop-islands=0.001", capture=capture)
        self.assertEqual((kept["components"], kept["dropped_octants"]), (2, 0))
        one = self.reconstruct(*box, "--drop-islands=0.3", capture=capture)
        self.assert_sound(one)
        self.assertEqual((one["components"], one["lost_surface"], one["island_share"]), (1, 0, 0.3))
        self.assertGreater(one["dropped_octants"], 0)
        self.assertLess(one["volume"], both["volume"])
        default = self.reconstruct(*box, "--drop-islands", capture=capture)
        self.assertEqual(default["island_share"], 0.05)


if __name__ == "__main__":
    unittest.main()
