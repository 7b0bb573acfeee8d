# SPDX-License-Identifier: BSD-3-Clause
"""
The examples and the commands of Documentation/pipelines.md, README.md and Documentation/tutorial.md, run as people run
them, and judged: the meshes are those of the program, byte for byte, and sound; the pictures show something.

SILHOUETTE_PREFIX is the install tree, or the build tree; PYTHONPATH leads to its package. Examples/Cxx is built
and the captures are made here, by the document's own commands.
"""

import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import document
from drawn import faults, pixels_of

PREFIX = pathlib.Path(os.environ["SILHOUETTE_PREFIX"])
PROGRAM = PREFIX / os.environ["SILHOUETTE_PROGRAM"]
EXAMPLES = document.TREE / "Examples"
DINOSAUR = pathlib.Path(os.environ.get("SILHOUETTE_REAL_DATA") or
                        document.TREE.parent / "shared" / "data") / "vgg-dinosaur"
KEY = ("--key", "blue:0.08", "--largest-region")  # as the photographs are told from their background

folder = None  # where everything is made
environment = None  # of the documents' shell blocks


def run(*command, **options):
    return subprocess.run([*map(str, command)], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          universal_newlines=True, timeout=300, **options)


def good(*command, **options):
    """A command that has to succeed: what it printed."""
    done = run(*command, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def python(script, *arguments, drawing=False):
    """The command line of one of the scripts."""
    launcher = ("-m", "vtksilhouette.offscreen") if drawing else ()
    return (sys.executable, *launcher, EXAMPLES / "Python" / script, *arguments)


def setUpModule():
    """Runs every shell block of the document, in its order, in one folder."""
    global folder, environment
    folder = pathlib.Path(tempfile.mkdtemp(prefix="examples-"))
    (folder / "Examples").symlink_to(EXAMPLES)
    (folder / "bin").mkdir()
    (folder / "bin" / "python3").symlink_to(sys.executable)
    (folder / "bin" / "vtksilhouette").symlink_to(PROGRAM)
    environment = {**os.environ, "PATH": f"{folder / 'bin'}:{os.environ['PATH']}", "PREFIX": str(PREFIX)}
    for block in document.blocks(document.text()):
        if block["language"] == "sh":
            good("bash", "-e", "-c", block["code"], env=environment)


def tearDownModule():
    shutil.rmtree(folder)


def evaluated(mesh, capture):
    good(PROGRAM, "evaluate", mesh, "--capture", capture, "--metrics", "evaluation.json")
    return json.loads((folder / "evaluation.json").read_text())


def triangles_of(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(folder / path))
    reader.Update()
    mesh = reader.GetOutput()
    return vtk_to_numpy(mesh.GetPoints().GetData()), vtk_to_numpy(mesh.GetPolys().GetConnectivityArray())


class Package(unittest.TestCase):
    """What is tried is the package in SILHOUETTE_PREFIX, and no other."""

    def test_cmake_found_it(self):
        cache = (folder / "examples" / "CMakeCache.txt").read_text()
        self.assertIn(f"vtkSilhouette_DIR:PATH={PREFIX}/", cache)

    def test_python_found_it(self):
        place = good(sys.executable, "-c", "import vtksilhouette; print(vtksilhouette.__file__)")
        self.assertTrue(place.startswith(f"{PREFIX}/"), place)


class Readme(unittest.TestCase):
    """README's command, its lines of Python and its lines of C++, as they stand there."""

    def setUp(self):
        self.blocks = document.blocks((document.TREE / "README.md").read_text(encoding="utf-8"))
        if not (folder / "my-capture").exists():
            good(PROGRAM, "synthesize", "my-capture", "--size", "128x128", "--views", 12)

    def block(self, language, words):
        code, = [block["code"] for block in self.blocks
                 if block["language"] == language and words in block["code"]]
        return code

    def assert_many_triangles(self, printed):
        self.assertGreater(int(re.fullmatch(r"(\d+) triangles\n", printed).group(1)), 10000)

    def test_command(self):
        good("bash", "-e", "-c", self.block("sh", "my-capture"), env=environment)
        self.assertTrue(evaluated("mesh.ply", "my-capture")["sound"])
        self.assertTrue((folder / "preview.png").exists())

    def test_python(self):
        self.assert_many_triangles(good(sys.executable, "-c", self.block("python", "my-capture")))

    def test_python_of_photographs(self):
        text = (document.TREE / "README.md").read_text(encoding="utf-8")
        reader, *extractor = re.findall(r"`((?:reader|extractor)\.\w+\(\))`", text)
        code, made = self.block("python", "my-capture"), "octree = "
        self.assert_many_triangles(good(sys.executable, "-c", code.replace(made, "\n".join([reader, *extractor, made]))))
        done = run(sys.executable, "-c", code.replace(made, f"{reader}\n{made}"))
        self.assertIn("a photograph without a mask or alpha is no silhouette", done.stderr)

    def test_the_prefix(self):
        clean = {name: value for name, value in environment.items() if name != "PYTHONPATH"}
        where = 'command -v vtksilhouette; python3 -c "import vtksilhouette; print(vtksilhouette.__file__)"'
        program, package = good("bash", "-e", "-c", self.block("sh", "PYTHONPATH") + where, env=clean).splitlines()
        self.assertEqual(program, f"{PREFIX}/bin/vtksilhouette")
        self.assertTrue(package.startswith(f"{PREFIX}/"), package)

    def test_the_versions(self):
        text = (document.TREE / "README.md").read_text(encoding="utf-8")
        for path, asked, words in (("CMakeLists.txt", r"cmake_minimum_required\(VERSION ([\d.]+)\)", "CMake"),
                                   ("CMakeLists.txt", r"find_package\(Eigen3 ([\d.]+)", "Eigen"),
                                   ("CMake/SilhouetteModule.cmake", r"find_package\(VTK ([\d.]+)", "VTK"),
                                   ("CMakeLists.txt", r"CMAKE_CXX_STANDARD (\d+)\)", "C\\+\\+"),
                                   ("Wrapping/CommandLine/CMakeLists.txt", r"find_package\(nlohmann_json ([\d.]+)", "nlohmann-json")):
            version, = re.findall(asked, (document.TREE / path).read_text(encoding="utf-8"))
            self.assertEqual(re.findall(rf"{words} ?(\d[\d.]*)\b(?!\+)", text), [version], words)
        lists = (document.TREE / "CMakeLists.txt").read_text(encoding="utf-8")
        for option in set(re.findall(r"-D(SILHOUETTE_\w+)=", text)):
            self.assertIn(f"option({option} ", lists)

    def test_cxx(self):
        (folder / "readme.inc").write_text(self.block("cpp", "hulls"))
        good("cmake", "-S", document.TREE / "Testing" / "Examples" / "Readme", "-B", "readme",
             f"-DCMAKE_PREFIX_PATH={PREFIX}", f"-DREADME_DIR={folder}", "-DCMAKE_BUILD_TYPE=Release",
             env=environment)
        good("cmake", "--build", "readme", env=environment)
        self.assert_many_triangles(good("readme/readme"))


class Tutorial(unittest.TestCase):
    """The tutorial's commands, one after another in a folder of their own, smaller and coarser than they stand there."""

    QUICK = (("--size 512x512", "--size 256x256"), ("--depth 8", "--depth 6"))

    @classmethod
    def setUpClass(cls):
        cls.place = folder / "tutorial"
        cls.place.mkdir()
        cls.text = document.text("tutorial.md")
        commands = "".join(block["code"] for block in document.blocks(cls.text) if block["language"] == "sh")
        for stated, quick in cls.QUICK:
            if commands.count(stated) != 1:
                raise AssertionError(f"the tutorial's commands no longer say {stated} once")
            commands = commands.replace(stated, quick)
        cls.printed = good("bash", "-e", "-c", f"cd '{cls.place}'\n{commands}", env=environment)
        cls.help = {command: good(PROGRAM, command, "--help") for command in ("reconstruct", "evaluate", "synthesize")}

    def test_they_make_what_is_said(self):
        for name in ("images", "masks", "projections.txt", "truth.ply"):
            self.assertTrue((self.place / "jug" / name).exists(), name)
        metrics = json.loads((self.place / "jug.json").read_text())
        self.assertTrue(metrics["sound"])
        self.assertEqual((metrics["components"], metrics["genus"], metrics["lost_surface"]), (1, 1, 0))
        self.assertGreater(pixels_of(self.place / "jug.png").std(), 10)  # the preview, on a ground of its own
        for words in ("closed, manifold, free of self-intersections", "view_000.png", "truth        mean"):
            self.assertIn(words, self.printed)

    def commands_with(self, option):
        return [command for command, words in self.help.items() if re.search(rf"{option}(?![\w-])", words)]

    def test_its_key_tells_the_background(self):
        key, = re.findall(r"`(--key [^`]*)`", self.text)
        good(PROGRAM, "reconstruct", self.place / "jug", "-o", self.place / "key.ply", "--depth", 5, "--quiet", *key.split())
        self.assertGreater(evaluated(self.place / "key.ply", self.place / "jug")["mean_iou"], 0.98)

    def test_the_options_exist(self):
        named = re.findall(r"(?<![\w-])--[a-z][a-z-]*", self.text + document.text("formats.md"))
        self.assertGreater(len(set(named)), 40)
        for option in set(named) - {"--help"}:
            self.assertTrue(self.commands_with(option), option)

    def test_their_values_are_understood(self):
        made = self.place / "noisy"
        for option, value in re.findall(r"`(--[a-z-]+) ([^` ]+)`", self.text):
            if re.fullmatch("[A-Z][A-Z0-9,]*", value):
                continue  # LENGTH, say, stands for a value
            with self.subTest(f"{option} {value}"):
                if "reconstruct" in self.commands_with(option):
                    done = run(PROGRAM, "reconstruct", "nowhere", "-o", "none.ply", option, value)
                    self.assertEqual(done.returncode, 3, done.stderr)  # the capture is missed, no argument is wrong
                else:
                    good(PROGRAM, "synthesize", made, "--size", "32x32", "--views", 4, "--force", "--quiet", option, value)


class PictureJudge(unittest.TestCase):
    """The judge of the pictures finds what is wrong."""

    def test_it(self):
        good_one = pixels_of(folder / "jug.png")
        self.assertEqual(faults(good_one), [])
        drawn = (good_one < 250).any(axis=2)
        for broken, fault in ((np.full_like(good_one, 255), "0.0 %"), (np.zeros_like(good_one), "dark"),
                              (np.where(drawn[..., np.newaxis], 200, good_one), "flat"),
                              (good_one // np.where(drawn, 4, 1)[..., np.newaxis], "dark"),
                              (good_one[:, good_one.shape[1] // 2:], "cut")):
            self.assertIn(fault, "; ".join(faults(broken)))


class PhotographsToMesh(unittest.TestCase):
    def test_the_mesh_is_the_programs(self):
        # Carved strictly or, as by default, tolerantly: clean silhouettes need no tolerance.
        for carving in ("strict", "tolerant"):
            good(PROGRAM, "reconstruct", "jug", "-o", "program.ply", "--depth", 6, *KEY, "--carving", carving)
            for mesh in ("jug.ply", "jug-cxx.ply"):
                with self.subTest(mesh=mesh, carving=carving):
                    self.assertEqual((folder / mesh).read_bytes(), (folder / "program.ply").read_bytes())

    def test_the_mesh_is_sound(self):
        found = evaluated("jug.ply", "jug")
        self.assertTrue(found["closed"])
        self.assertTrue(found["sound"])
        self.assertEqual((found["components"], found["genus"]), (1, 1))  # a jug with one handle
        self.assertGreater(found["mean_iou"], 0.98)

    def test_the_pictures(self):
        for picture in ("jug.png", "jug-cxx.png"):
            with self.subTest(picture):
                self.assertEqual(faults(pixels_of(folder / picture)), [])

    def test_no_capture(self):
        for command in (python("photographs_to_mesh.py", "nowhere", "none.ply", "none.png", drawing=True),
                        ("examples/PhotographsToMesh", "nowhere", "none.ply", "none.png")):
            with self.subTest(command[0]):
                done = run(*command)
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn("nowhere: there is no such folder or camera file", done.stderr)
                self.assertFalse((folder / "none.ply").exists() or (folder / "none.png").exists())

    def test_the_dinosaur(self):
        if not DINOSAUR.exists():
            self.skipTest(f"no photographs in {DINOSAUR}")
        good(PROGRAM, "reconstruct", DINOSAUR, "-o", "program.ply", "--depth", 7, *KEY)
        good(*python("photographs_to_mesh.py", DINOSAUR, "dino.ply", "dino.png", "--depth", 7, drawing=True))
        good("examples/PhotographsToMesh", DINOSAUR, "dino-cxx.ply", "dino-cxx.png", 7)
        for mesh, picture in (("dino.ply", "dino.png"), ("dino-cxx.ply", "dino-cxx.png")):
            with self.subTest(mesh):
                self.assertEqual((folder / mesh).read_bytes(), (folder / "program.ply").read_bytes())
                self.assertEqual(faults(pixels_of(folder / picture)), [])


class JudgedMesh(unittest.TestCase):
    def commands(self, capture, mesh, depth, threads=0, seconds=3600):
        return (python("judged_mesh.py", capture, mesh, "--depth", depth, "--threads", threads,
                       "--seconds", seconds),
                ("examples/JudgedMesh", capture, mesh, depth, threads, seconds))

    def test_the_mesh_and_its_metrics_are_the_programs(self):
        good(PROGRAM, "synthesize", "twig", "--shape", "twig", "--size", "160x160", "--views", 12,
             "--noise-contour", 1)
        good(PROGRAM, "reconstruct", "twig", "-o", "program.vtp", "--depth", 6, "--metrics", "program.json")
        metrics = json.loads((folder / "program.json").read_text())
        self.assertGreater(metrics["background_votes"], 0, "the capture needs tolerance")
        expected = triangles_of("program.vtp")
        for command in self.commands("twig", "twig.vtp", 6):
            with self.subTest(command[0]):
                printed = good(*command)
                for made, theirs in zip(triangles_of("twig.vtp"), expected):
                    np.testing.assert_array_equal(made, theirs)
                iou, lost = re.search(r"mean IoU ([\d.]+), .* component\(s\), (\d+) octants lost", printed).groups()
                self.assertAlmostEqual(float(iou), metrics["mean_iou"], delta=1e-4)
                self.assertEqual(int(lost), 0)
                self.assertEqual(printed.count("XOR"), 12)

    def test_torn_silhouettes_give_a_sound_mesh(self):
        self.assertEqual((folder / "torn.vtp").read_bytes(), (folder / "torn-cxx.vtp").read_bytes())
        self.assertTrue(evaluated("torn.vtp", "torn")["sound"])

    def test_threads_change_nothing(self):
        meshes = set()
        for threads in (1, 2, 8):
            for command in self.commands("torn", "again.vtp", 5, threads):
                good(*command)
                meshes.add((folder / "again.vtp").read_bytes())
        self.assertEqual(len(meshes), 1)

    def test_time_is_up(self):
        for command in self.commands("torn", "none.vtp", 8, seconds=0):
            self.fails(command, "the time was up in vtkSilhouette")

    def test_errors_name_their_cause(self):
        for capture, depth, words in (("nowhere", 6, "nowhere: there is no such folder or camera file"),
                                      ("torn", 17, "depth 17 is out of range: 1 to 16 are possible")):
            for command in self.commands(capture, "none.vtp", depth):
                self.fails(command, words)

    def fails(self, command, words):
        done = run(*command)
        self.assertEqual(done.returncode, 1, done.stdout + done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        self.assertIn(words, done.stderr)
        self.assertFalse((folder / "none.vtp").exists())


class VoteShareSweep(unittest.TestCase):
    SHARES = (1.0, 0.9, 0.8)

    @classmethod
    def setUpClass(cls):
        cls.printed = good(*python("vote_share_sweep.py", "torn", "shares.png", "--depth", 5,
                                   "--shares", *cls.SHARES, drawing=True))

    def test_the_surfaces_are_the_programs(self):
        rows = [line.split() for line in self.printed.splitlines()[1:]]
        self.assertEqual(len(rows), 2 * len(self.SHARES))
        for share, cubes, hulls in zip(self.SHARES, rows[0::2], rows[1::2]):
            for row, kind in ((cubes, "voting"), (hulls, "local-hull")):
                with self.subTest(share=share, kind=kind):
                    good(PROGRAM, "reconstruct", "torn", "-o", "share.vtp", "--depth", 5, "--surface", kind,
                         "--vote-share", share, "--metrics", "share.json")
                    metrics = json.loads((folder / "share.json").read_text())
                    votes, _, _, triangles, components, closed, iou, _ = row[1:]
                    self.assertEqual((int(votes), int(triangles), int(components)),
                                     (metrics["background_votes"], metrics["triangles"], metrics["components"]))
                    self.assertEqual(closed, "yes")
                    self.assertAlmostEqual(float(iou), metrics["mean_iou"], delta=1e-4)

    def test_the_sheet(self):
        pixels = pixels_of(folder / "shares.png")
        self.assertEqual(pixels.shape, (600, 300 * len(self.SHARES), 3))
        panels = [pixels[row:row + 300, column:column + 300] for row in (0, 300)
                  for column in range(0, pixels.shape[1], 300)]
        for panel in panels:
            self.assertEqual(faults(panel), [])
        for panel in panels[1:]:
            differing = (panel != panels[0]).any(axis=2).mean()
            self.assertGreater(differing, 0.01, "two panels are alike")

    def test_a_share_out_of_range(self):
        done = run(*python("vote_share_sweep.py", "torn", "none.png", "--depth", 4, "--shares", 0.0,
                           drawing=True))
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("torn: no surface at share 0.0", done.stderr)
        self.assertFalse((folder / "none.png").exists())


class NumpyMasks(unittest.TestCase):
    def test_the_ball(self):
        printed = good(*python("numpy_masks.py", "ball.obj"))
        count, made, ball = re.fullmatch(r"(\d+) triangles, volume ([\d.]+), of the ball ([\d.]+)\n", printed).groups()
        self.assertAlmostEqual(float(ball), np.pi / 6.0, delta=1e-4)
        self.assertAlmostEqual(float(made), float(ball), delta=0.02 * float(ball))  # a pixel is 1.5 % of the radius
        lines = (folder / "ball.obj").read_text().splitlines()
        triangles = [tuple(map(int, line.split()[1:])) for line in lines if line.startswith("f ")]
        self.assertEqual(len(triangles), int(count))
        edges = {(t[i], t[i - 2]) for t in triangles for i in range(3)}
        self.assertEqual(len(edges), 3 * len(triangles), "each edge once in each direction: manifold, oriented")
        self.assertEqual(edges, {(last, first) for first, last in edges}, "closed")


if __name__ == "__main__":
    unittest.main()
