# SPDX-License-Identifier: BSD-3-Clause
"""
Examples/ParaView run as people run them, with PV_PLUGIN_PATH alone, and judged: the meshes are sound and, where
SILHOUETTE_PROGRAM is given, the program's, byte for byte; the numbers of the sweep and of the server's ranks too; the
pictures show something. And what Documentation/paraview.md shows: its commands run, its code stands in the scripts, its
properties exist.
"""
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np

TREE = pathlib.Path(__file__).resolve().parents[2]
PLUGINS = pathlib.Path(os.environ["SILHOUETTE_PLUGIN"]).parent
PROGRAM = os.environ.get("SILHOUETTE_PROGRAM", "")
BIN = pathlib.Path(os.environ["PARAVIEW_BIN"])
DINOSAUR = pathlib.Path(os.environ.get("SILHOUETTE_REAL_DATA") or TREE.parent / "shared" / "data") / "vgg-dinosaur"
KEY = ("--carving", "strict", "--key", "blue:0.08", "--largest-region")
# Open MPI: as root, and more ranks than processors. Others do not look at these.
MPI = {"OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1", "OMPI_MCA_rmaps_base_oversubscribe": "1"}
# What pvpython's own MPI has put there would make mpirun believe to be one of its ranks.
ENVIRONMENT = {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_", "PMI_"))}
ENVIRONMENT.update(MPI, PV_PLUGIN_PATH=str(PLUGINS))
SCRIPTS = ("photographs_to_mesh.py", "vote_share_sweep.py", "growing_octree.py", "on_a_server.py")

sys.path.append(str(TREE / "Testing" / "Examples"))

import document  # noqa: E402
from drawn import faults, pixels_of  # noqa: E402
from paraview import servermanager, simple  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGWriter  # noqa: E402

simple.LoadPlugin(os.environ["SILHOUETTE_PLUGIN"], ns=globals())

folder = None  # where everything is made


def run(*command, environment=ENVIRONMENT):
    return subprocess.run([str(word) for word in command], cwd=folder, env=environment, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, universal_newlines=True, errors="replace", timeout=400)


def script(name, *arguments, **options):
    return run(BIN / "pvpython", TREE / "Examples" / "ParaView" / name, *arguments, **options)


def good(done):
    """What a command that has to succeed printed."""
    if done.returncode != 0 or "ERR|" in done.stderr:
        raise AssertionError(f"{done.args} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def write_capture(name, **noise):
    """A capture of the synthetic source as a folder: photographs, masks, and where there is noise, masks only."""
    source = SyntheticCapture(Width=192, Height=192, NumberOfViews=14, **noise)  # noqa: F821  the plugin's
    source.UpdatePipeline()
    kinds = {"masks": 0} if noise else {"masks": 0, "images": 2}
    lines = []
    for kind, port in kinds.items():
        (folder / name / kind).mkdir(parents=True)
        images = source.GetClientSideObject().GetOutputDataObject(port)
        lines = []
        for number in range(images.GetNumberOfPartitionedDataSets()):
            image = images.GetPartition(number, 0)
            matrix = image.GetFieldData().GetArray("Projection").GetTuple(0)
            lines.append(" ".join([f"view-{number:02}.png", *map(repr, matrix)]))
            writer = vtkPNGWriter()
            writer.SetInputData(image)
            writer.SetFileName(str(folder / name / kind / f"view-{number:02}.png"))
            writer.Write()
    (folder / name / "projections.txt").write_text("\n".join(lines) + "\n")


def setUpModule():
    global folder
    folder = pathlib.Path(tempfile.mkdtemp(prefix="paraview-examples-"))
    write_capture("jug")
    write_capture("torn", NoiseBlobs=5, NoiseContour=1.0)


def tearDownModule():
    shutil.rmtree(folder)


def program(*arguments):
    """Runs the program, or skips the test where there is none."""
    if not PROGRAM:
        raise unittest.SkipTest("no SILHOUETTE_PROGRAM to compare with")
    return good(run(PROGRAM, *arguments))


def triangles(surface, capture, depth, share=1):
    """How many triangles the program's surface has."""
    printed = folder / "program.ply"
    program("reconstruct", capture, "-o", printed, "--depth", depth, "--surface", surface, "--vote-share", share,
            "--carving", "strict", "--quiet")
    with open(printed, "rb") as file:
        return int(re.search(rb"element face (\d+)", file.read(1000)).group(1))


class Document(unittest.TestCase):
    TEXT = document.text("paraview.md")

    def test_the_code_is_in_the_scripts(self):
        self.assertEqual(document.untrue_blocks(self.TEXT), [])

    def test_the_commands(self):
        commands = [block["code"] for block in document.blocks(self.TEXT)
                    if block["language"] == "sh" and "pvpython" in block["code"] and "pvserver" not in block["code"]]
        self.assertEqual([sum(name in command for command in commands) for name in SCRIPTS[:3]], [1, 1, 1])
        (folder / "Examples").symlink_to(TREE / "Examples")
        for command in commands:
            good(run("bash", "-e", "-c", command, environment={**ENVIRONMENT, "PATH": f"{BIN}:{os.environ['PATH']}"}))

    def test_the_properties(self):
        rows = re.findall(r"^\|([\w ]*)\| [\w, ]+ \| (`[^|]*`)[^|]*\| [^|]+\|$", self.TEXT, re.MULTILINE)
        self.assertGreater(len(rows), 7)
        filters = servermanager.filters
        places = iter([servermanager.sources.SilhouetteCaptureReader(), filters.SilhouetteExtractor(),
                       filters.SilhouetteOctree(), filters.VotingMarchingCubes(), filters.LocalHullSurface()])
        for place, names in rows:
            proxy = next(places) if place.strip() else proxy
            for name in re.findall(r"\w+", names):
                self.assertIn(name, proxy.ListProperties(), place)


class Arguments(unittest.TestCase):
    def test_none(self):
        for name in SCRIPTS:
            with self.subTest(name):
                done = script(name)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertIn(f"usage: {name}", done.stderr)

    def test_no_capture(self):
        for name in SCRIPTS[:3]:
            with self.subTest(name):
                done = script(name, "nowhere", *["none", "none.png"][:2 if name == SCRIPTS[0] else 1])
                self.assertEqual(done.returncode, 1, done.stderr)
                self.assertIn("nowhere: there is no such folder or camera file", done.stderr)
                self.assertRegex(done.stderr.splitlines()[-1], r"nowhere: .*messages above say why")
                self.assertEqual(list(folder.glob("none*/*")) + list(folder.glob("none.*")), [])

    def test_no_plugin(self):
        done = script(SCRIPTS[0], "jug", "none.ply", "none.png", environment={**ENVIRONMENT, "PV_PLUGIN_PATH": ""})
        self.assertEqual(done.returncode, 1)
        self.assertIn("the Silhouette plugin is not loaded", done.stderr)


class PhotographsToMesh(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.printed = good(script("photographs_to_mesh.py", "jug", "jug.ply", "jug.png", "--depth", 6))

    def test_the_mesh_is_sound(self):
        mesh = simple.PLYReader(FileNames=[str(folder / "jug.ply")])
        views = SilhouetteCaptureReader(FileName=str(folder / "jug"))  # noqa: F821
        table = servermanager.Fetch(SilhouetteEvaluator(Input=mesh, Views=views))  # noqa: F821
        found = {name: table.GetFieldData().GetArray(name).GetTuple1(0)
                 for name in ("Sound", "Components", "Genus", "MeanIoU")}
        self.assertEqual((found["Sound"], found["Components"], found["Genus"]), (1, 1, 1))  # a jug with one handle
        self.assertGreater(found["MeanIoU"], 0.97)

    def test_the_mesh_is_the_programs(self):
        program("reconstruct", "jug", "-o", "program.ply", "--depth", 6, *KEY)
        self.assertEqual((folder / "jug.ply").read_bytes(), (folder / "program.ply").read_bytes())

    def test_a_camera_file_is_as_good(self):
        good(script("photographs_to_mesh.py", "jug/projections.txt", "file.ply", "file.png", "--depth", 6))
        self.assertEqual((folder / "file.ply").read_bytes(), (folder / "jug.ply").read_bytes())

    def test_the_picture(self):
        self.assertEqual(faults(pixels_of(folder / "jug.png")), [])

    def test_the_dinosaur(self):
        if not DINOSAUR.exists():
            self.skipTest(f"no photographs in {DINOSAUR}")
        program("reconstruct", DINOSAUR, "-o", "program.ply", "--depth", 7, *KEY)
        done = script("photographs_to_mesh.py", DINOSAUR, "dino.ply", "dino.png", "--depth", 7)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual((folder / "dino.ply").read_bytes(), (folder / "program.ply").read_bytes())
        self.assertEqual(faults(pixels_of(folder / "dino.png")), [])


class VoteShareSweep(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.printed = good(script("vote_share_sweep.py", "torn", "sweep", "--votes", 2, "--depth", 5))

    def test_the_surfaces_are_the_programs(self):
        rows = [line.split() for line in self.printed.splitlines()[1:]]
        self.assertEqual([row[0] for row in rows], ["0", "1", "2"])
        for votes, _, count in rows:
            self.assertEqual(int(count), triangles("voting", "torn", 5, 1 - int(votes) / 14))

    def test_the_frames(self):
        frames = [pixels_of(folder / "sweep" / f"frame-{votes:02}.png") for votes in range(3)]
        for frame in frames:
            self.assertEqual(faults(frame), [])
        for frame in frames[1:]:
            self.assertGreater((frame != frames[0]).any(axis=2).mean(), 0.01, "two frames are alike")
        np.testing.assert_array_equal(pixels_of(folder / "sweep" / "sheet.png"), np.concatenate(frames, axis=1))

    def test_more_votes_than_views(self):
        done = script("vote_share_sweep.py", "torn", "many", "--votes", 14, "--depth", 4)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertIn("torn: 14 views, too few for 14 background votes", done.stderr)
        self.assertFalse((folder / "many").exists())


class GrowingOctree(unittest.TestCase):
    INSIDE = np.array([0.42, 0.60, 0.84])

    @classmethod
    def setUpClass(cls):
        good(script("growing_octree.py", "jug", "octree", "--depth", 5))

    def blue(self, pixels):
        """The share of the picture that has the colour of octants inside."""
        drawn = (pixels < 250).any(axis=2)
        return (drawn & (pixels[..., 2] > 1.3 * pixels[..., 0])).mean()

    def test_the_frames(self):
        whole, half = ([pixels_of(folder / "octree" / f"{kind}-{generation:02}.png") for generation in (3, 4, 5)]
                       for kind in ("whole", "half"))
        for frame in whole + half:
            self.assertEqual(faults(frame), [])
        drawn = [(frame < 250).any(axis=2).mean() for frame in whole]
        self.assertEqual(sorted(drawn, reverse=True), drawn, "the octree closes in on the object")
        self.assertEqual([self.blue(frame) for frame in whole], [0, 0, 0], "octants inside show only where cut")
        inside = [self.blue(frame) for frame in half]
        self.assertEqual(sorted(inside), inside, "more is inside from generation to generation")
        self.assertGreater(inside[0], 0)
        sheet = np.concatenate([np.concatenate(row, axis=1) for row in (half, whole)])  # the first row is the lowest
        np.testing.assert_array_equal(pixels_of(folder / "octree" / "sheet.png"), sheet)


class OnAServer(unittest.TestCase):
    RANKS = 2

    def setUp(self):
        launcher = shutil.which("mpirun")
        if not launcher:
            self.skipTest("no mpirun")
        with socket.socket() as free:
            free.bind(("localhost", 0))
            self.port = free.getsockname()[1]
        self.log = open(folder / "server.txt", "w+")
        self.addCleanup(self.log.close)
        self.server = subprocess.Popen([launcher, "-n", str(self.RANKS), BIN / "pvserver", f"--server-port={self.port}"],
                                       env=ENVIRONMENT, stdout=self.log, stderr=self.log)
        self.addCleanup(self.stop)
        for _ in range(600):
            said = (folder / "server.txt").read_text(errors="replace")
            if "Accepting connection" in said:
                return
            if self.server.poll() is not None:
                break
            time.sleep(0.1)
        self.fail(f"the server did not start: {said}")

    def stop(self):
        if self.server.poll() is None:
            self.server.terminate()
        self.server.wait(30)

    def test_each_rank_has_its_piece(self):
        done = script("on_a_server.py", "localhost", self.port, folder / "jug", "server.png", "--depth", 5)
        counts = {name: (int(whole), [int(part) for part in parts.split(" + ")])
                  for whole, name, parts in re.findall(r"(\d+) ([a-z ]+) = ([\d +]+)\n", good(done))}
        self.assertEqual(set(counts), {"octants", "voted triangles", "hull triangles"})
        for name, (whole, parts) in counts.items():
            with self.subTest(name):
                self.assertEqual(len(parts), self.RANKS)
                self.assertEqual(sum(parts), whole)
                self.assertGreater(min(parts), 0)
        parts = counts["hull triangles"][1]
        self.assertLessEqual(max(parts) - min(parts), 1, "an even share")
        pixels = pixels_of(folder / "server.png")
        self.assertEqual(faults(pixels, least_brightness=50), [])
        for first, second in ((0, 2), (2, 0)):  # red for one rank, blue for the other
            self.assertGreater((pixels[..., first] > 2 * pixels[..., second]).mean(), 0.02)
        for name, surface in (("voted triangles", "voting"), ("hull triangles", "local-hull")):
            self.assertEqual(counts[name][0], triangles(surface, "jug", 5))


if __name__ == "__main__":
    unittest.main()
