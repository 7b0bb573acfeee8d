# SPDX-License-Identifier: BSD-3-Clause
"""Wrong arguments end with exit code 2 and one line that says what was expected; help teaches."""
import unittest

import program
from program import ProgramTest


class Wrong(ProgramTest):
    SHAPE = "sphere"

    def wrong(self, words, *arguments):
        self.bad(program.ARGUMENTS, words + ["--help"], *arguments)
        self.assertEqual(self.names(), [])

    def wrong_reconstruct(self, words, *arguments):
        self.wrong(words, "reconstruct", self.capture, "-o", self.folder / "x.ply", *arguments)

    def test_commands(self):
        self.wrong(["no command", "reconstruct"])
        self.wrong(["'carve'", "reconstruct"], "carve")
        self.wrong(["CAPTURE"], "reconstruct")
        self.wrong(["--output"], "reconstruct", self.capture)
        self.wrong(["--capture"], "evaluate", "mesh.ply")
        self.wrong(["FOLDER"], "synthesize")
        self.wrong_reconstruct(["--frobnicate"], "--frobnicate")

    def test_octree(self):
        for depth in ("0", "17", "8.5", "deep", "-1"):
            self.wrong_reconstruct(["--depth", depth, "1 to 16"], "--depth=" + depth)
        self.wrong_reconstruct(["--depth", "--leaf-edge"], "--depth", 5, "--leaf-edge", 0.1)
        self.wrong_reconstruct(["--leaf-edge", "above 0"], "--leaf-edge", 0)
        for bounds in ("0,1,0,1,0", "0,1,0,1,1,0", "0,1,0,1,0,nan", "0,1,0,1,0,1,", "a"):
            self.wrong_reconstruct(["--bounds", bounds, "x0,x1,y0,y1,z0,z1"], "--bounds", bounds)
        self.wrong_reconstruct(["--outside", "nowhere"], "--outside", "nowhere")

    def test_surface(self):
        self.wrong_reconstruct(["--surface", "balloon"], "--surface", "balloon")
        for share in ("0", "1.01", "nan"):
            self.wrong_reconstruct(["--vote-share", share, "above 0 and at most 1"], "--vote-share", share)
        self.wrong_reconstruct(["--background-votes", "-1"], "--background-votes=-1")
        self.wrong_reconstruct(["marching-cubes", "voting"], "--surface", "marching-cubes", "--vote-share", 0.9)
        self.wrong_reconstruct(["--edges"], "--edges", "blunt")
        self.wrong_reconstruct(["--votes"], "--votes", "fair")
        self.wrong_reconstruct(["--threads"], "--threads", "many")

    def test_options_that_mean_nothing(self):
        for option in (["--mode", "thesis"], ["--mode", "robust"], ["--no-repair"], ["--drop-islands"], ["--no-tunnels"]):
            for surface in ("voting", "marching-cubes"):
                self.wrong_reconstruct([option[0], "--surface " + surface, "local-hull"], "--surface", surface, *option)
        for option in ("--no-repair", "--no-alignment", "--no-correction", "--no-thin-hulls", "--no-handles", "--no-tunnels"):
            self.wrong_reconstruct([option, "--mode thesis", "robust"], "--mode", "thesis", option)
        for option in (["--dilate", 1], ["--background-votes", 0], ["--vote-share", 1], ["--votes", "faithful"],
                       ["--surface", "marching-cubes"]):
            self.wrong_reconstruct(["--carving", "tolerant", option[0]], "--carving", "tolerant", *option)
        self.wrong_reconstruct(["--background-votes", "3 contradicts --votes faithful"], "--votes", "faithful",
                               "--background-votes", 3)
        self.good("reconstruct", self.capture, "-o", self.folder / "x.ply", "--depth", 3, "--carving", "tolerant", "--dilate", 0)
        self.good("reconstruct", self.capture, "-o", self.folder / "x.ply", "--depth", 3, "--mode", "thesis", "--drop-islands")
        (self.folder / "x.ply").unlink()
        self.wrong(["--sample-spacing", "--truth"], "evaluate", self.capture / "truth.ply", "--capture", self.capture,
                   "--sample-spacing", 0.1)

    def test_silhouettes(self):
        for key in ("blue", "blue:0", "pink:0.1", "blue:1.5", "blue:x"):
            self.wrong_reconstruct(["--key", "'" + key + "'", "blue:0.08"], "--key", key)
        for colour in ("0,0", "0,0,2", "a,b,c"):
            self.wrong_reconstruct(["--background", "'" + colour + "'"], "--background", colour)
        self.wrong_reconstruct(["--tolerance", "3"], "--background", "0,0,0", "--tolerance", 4)
        self.wrong_reconstruct(["--tolerance", "--background"], "--tolerance", 1)
        self.wrong_reconstruct(["--threshold"], "--threshold", "nan")
        self.wrong_reconstruct(["--opening", "-1"], "--opening=-1")
        # Together they reach 1000 pixels at most; opening and closing reach twice their radius.
        self.wrong_reconstruct(["--opening", "radius 600", "1200", "1000"], "--opening", 600)
        self.wrong_reconstruct(["--dilate", "radius 1", "1001", "1000"], "--closing", 400, "--erode", 200, "--dilate", 1)
        self.bad(program.FILES, ["nowhere"], "reconstruct", self.folder / "nowhere", "-o", self.folder / "x.ply",
                 "--opening", 500)
        self.wrong_reconstruct(["--fill-holes"], "--fill-holes", 1.5)

    def test_outputs(self):
        self.wrong(["--output", "mesh.xyz", "vtp, ply, stl or obj"], "reconstruct", self.capture, "-o",
                   self.folder / "mesh.xyz")
        self.wrong_reconstruct(["--metrics", "x.ply", "does not end in .json"], "--metrics", self.folder / "x.ply")

    def test_synthesize(self):
        target = self.folder / "new"
        for size in ("0x5", "100", "axb", "20000x20000", "10x10x10"):
            self.wrong(["--size", "'" + size + "'"], "synthesize", target, "--size", size)
        self.wrong(["--shape", "cow"], "synthesize", target, "--shape", "cow")
        self.wrong(["--views"], "synthesize", target, "--views", 0)
        self.wrong(["--noise-blobs", "4", "3"], "synthesize", target, "--views", 3, "--noise-blobs", 4)
        self.wrong(["--noise-pixels"], "synthesize", target, "--noise-pixels", 2)
        for seed in ("-1", "4294967296", "1.5", "99999999999999999999"):
            self.wrong(["--seed", f"'{seed}'", "0 to 4294967295"], "synthesize", target, "--seed=" + seed)
        self.wrong(["--mesh", "--shape"], "synthesize", target, "--mesh", "a.ply", "--shape", "jug")
        self.good("synthesize", target, "--size", "1e2x4e1", "--views", 2, "--quiet")
        self.assertEqual(program.png_size(target / "masks" / "view_000.png"), (100, 40))


class Help(ProgramTest):
    SHAPE = "sphere"

    def test_program(self):
        text = self.good("--help").stdout
        for word in ("reconstruct", "synthesize", "evaluate", "Exit codes", "130", "Examples"):
            self.assertIn(word, text)
        self.assertRegex(self.good("--version").stdout, r"^vtksilhouette \d+\.\d+\.\d+\n$")
        self.assertRegex(self.good("reconstruct", "--version").stdout, r"^vtksilhouette \d+\.\d+\.\d+\n$")

    def test_commands(self):
        options = {
            "reconstruct": """--output --metrics --image --octree --depth --leaf-edge --bounds --outside --surface
                --vote-share --background-votes --votes --edges --largest --views --key --background --tolerance
                --threshold --alpha --invert --opening --closing --dilate --erode --largest-region --fill-holes --truth
                --threads --quiet --version""",
            "synthesize": """--shape --mesh --views --size --seed --noise-contour --noise-blobs --noise-pixels
                --noise-camera --noise-rotation --force""",
            "evaluate": "--capture --truth --metrics --key --background --threshold --opening --views",
        }
        for command, names in options.items():
            text = self.good(command, "--help").stdout
            for word in names.split() + ["xample", "Exit codes", "default"]:
                self.assertIn(word, text, command)
            self.assertLessEqual(max(map(len, text.splitlines())), 120, command)


if __name__ == "__main__":
    unittest.main()
