# SPDX-License-Identifier: BSD-3-Clause
"""The program under test, captures to feed it with, and files to look at what it makes."""
import json
import os
import pathlib
import resource
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

PROGRAM = os.environ.get("SILHOUETTE_PROGRAM", "vtksilhouette")
PICTURES = os.environ.get("SILHOUETTE_PICTURES", "none") != "none"

OK, PROCESSING, ARGUMENTS, FILES, INTERRUPTED = 0, 1, 2, 3, 130


def run(*arguments, cwd=None, timeout=300, memory_mib=None, environment=()):
    """Run the program, its output as text; with so much address space at most, and further variables of the environment."""
    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (memory_mib << 20,) * 2)
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=cwd, timeout=timeout,
                          preexec_fn=limit if memory_mib else None, env={**os.environ, **dict(environment)},
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)


class ProgramTest(unittest.TestCase):
    """A test in a folder of its own, with a small capture of a jug."""

    SHAPE = "jug"

    @classmethod
    def setUpClass(cls):
        cls.shared = pathlib.Path(tempfile.mkdtemp(prefix="vtksilhouette-"))
        cls.capture = cls.shared / cls.SHAPE
        made = run("synthesize", cls.capture, "--shape", cls.SHAPE, "--size", "128x128", "--views", 12, "--quiet")
        if made.returncode != 0:
            raise RuntimeError(made.stderr)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.shared, ignore_errors=True)

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(dir=self.shared))

    def good(self, *arguments, **options):
        """A run that has to succeed."""
        done = run(*arguments, **options)
        self.assertEqual(done.returncode, OK, done.stderr)
        return done

    def bad(self, code, words, *arguments, **options):
        """A run that has to fail: exit code, one line of error that holds all of `words`, and no report."""
        done = run(*arguments, **options)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        self.assertEqual(done.stdout, "")
        lines = [line for line in done.stderr.splitlines() if not line.startswith("vtksilhouette: warning: ")]
        self.assertEqual(len(lines), 1, done.stderr)
        self.assertTrue(lines[0].startswith("vtksilhouette: error: "), lines[0])
        for word in words:
            self.assertIn(word, lines[0])
        return done

    def reconstruct(self, *arguments, capture=None, depth=5, mesh="mesh.ply"):
        """A reconstruction that has to succeed; its metrics."""
        metrics = self.folder / "metrics.json"
        self.good("reconstruct", capture or self.capture, "-o", self.folder / mesh, "--depth", depth,
                  "--metrics", metrics, *arguments)
        return json.loads(metrics.read_text())

    def evaluate(self, mesh, *arguments, capture=None):
        """An evaluation that has to succeed; its metrics."""
        metrics = self.folder / "evaluation.json"
        self.good("evaluate", mesh, "--capture", capture or self.capture, "--metrics", metrics, *arguments)
        return json.loads(metrics.read_text())

    def copy_of_capture(self):
        copy = self.folder / "capture"
        shutil.copytree(self.capture, copy)
        return copy

    def names(self):
        return sorted(path.name for path in self.folder.iterdir())

    def assert_sound(self, metrics):
        for key in ("open_edges", "non_manifold_edges", "non_manifold_vertices", "inconsistent_edges",
                    "self_intersections"):
            self.assertEqual(metrics[key], 0, key)
        self.assertTrue(metrics["closed"])
        self.assertTrue(metrics["sound"])
        self.assertGreater(metrics["volume"], 0.0)


def write_png(file, width, height, pixel):
    """A PNG file of grey or RGB values, as `pixel(x, y)` gives them."""
    first = pixel(0, 0)
    colour = isinstance(first, tuple)
    rows = bytearray()
    for y in range(height):
        rows.append(0)
        for x in range(width):
            value = pixel(x, y)
            rows.extend(value if colour else (value,))

    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))

    header = struct.pack(">IIBBBBB", width, height, 8, 2 if colour else 0, 0, 0, 0)
    pathlib.Path(file).write_bytes(b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) +
                                   chunk(b"IDAT", zlib.compress(bytes(rows))) + chunk(b"IEND", b""))


def png_size(file):
    data = pathlib.Path(file).read_bytes()
    assert data[:8] == b"\x89PNG\r\n\x1a\n", file
    return struct.unpack(">II", data[16:24])


def skip(why):
    """End a test script as skipped."""
    print("skipped: " + why)
    sys.exit(77)
