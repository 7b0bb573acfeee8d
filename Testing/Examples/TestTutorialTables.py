# SPDX-License-Identifier: BSD-3-Clause
"""The tables of Documentation/tutorial.md, and formats.md's of the metrics, are what the program finds: cameras that are wrong on purpose, captures of few
and many views, and octants of several sizes. A figure may differ by a fifth, as the program grows better.

    python3 TestTutorialTables.py --print      the tables as they are now, and no test
"""

import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

import numpy as np

import document

PROGRAM = pathlib.Path(os.environ["SILHOUETTE_PREFIX"]) / os.environ["SILHOUETTE_PROGRAM"]
SIZE = 256
OCTANT = 3.75  # pixels: 256 pixels, depth 6


def run(folder, *arguments):
    return subprocess.run([PROGRAM, *map(str, arguments)], cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                          universal_newlines=True, timeout=100)


def metrics(folder, *arguments):
    """Those of a reconstruction; a string where it fails."""
    done = run(folder, "reconstruct", *arguments, "-o", "mesh.ply", "--metrics", "mesh.json", "--quiet")
    return json.loads((folder / "mesh.json").read_text()) if done.returncode == 0 else done.stderr


def shifted(du, dv, view=None):
    """All pixels, or one view's, so far to the right and down."""
    def change(names, matrices):
        for number in range(len(matrices)) if view is None else [view]:
            matrices[number] = np.array([[1, 0, du], [0, 1, dv], [0, 0, 1]]) @ matrices[number]
    return change


def rolled(view, degrees):
    """One view turned about the middle of its image."""
    def change(names, matrices):
        c, s, m = np.cos(np.radians(degrees)), np.sin(np.radians(degrees)), (SIZE - 1) / 2
        matrices[view] = np.array([[c, -s, m - c * m + s * m], [s, c, m - s * m - c * m], [0, 0, 1]]) @ matrices[view]
    return change


def scaled(factor, about=(SIZE - 1) / 2):
    def change(names, matrices):
        m = about - factor * about
        matrices[:] = [np.array([[factor, 0, m], [0, factor, m], [0, 0, 1]]) @ matrix for matrix in matrices]
    return change


def exchanged(names, matrices):
    names[3], names[9] = names[9], names[3]


def one_off(names, matrices):
    names[:] = names[1:] + names[:1]


def mirrored(names, matrices):
    matrices[:] = [np.array([[-1, 0, SIZE - 1], [0, 1, 0], [0, 0, 1]]) @ matrix for matrix in matrices]


WRONG = {"nothing": shifted(0, 0),
         "all matrices, half a pixel to the right": shifted(0.5, 0),
         "all, half a pixel down": shifted(0, 0.5),
         "all, a pixel to the right and down": shifted(1, 1),
         "one matrix, 1 pixel": shifted(1, 0, 10),
         "one, 4 pixels": shifted(4, 0, 10),
         "one, 20 pixels": shifted(20, 0, 10),
         "one, turned by 5 degrees": rolled(10, 5),
         "two images exchanged": exchanged,
         "all images one line further": one_off,
         "all mirrored": mirrored,
         "all focal lengths, 5 % too long": scaled(1.05)}
NOISY = {"masks with 1 pixel of noise": "nothing",
         "the same, half a pixel to the right": "all matrices, half a pixel to the right"}
VIEWS = (4, 8, 12, 18, 36, 72)
SHARES = (("pebble", 64, (3, 4, 5, 6)), ("pebble", 128, (4, 5, 6)), ("jug", 64, (3, 4, 5, 6)), ("jug", 128, (4, 5, 6)))


class Captures:
    """The captures, made where they are asked for."""

    def __init__(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = pathlib.Path(self.temporary.name)

    def synthesized(self, *options):
        name = "-".join(map(str, options)).replace("--", "")
        if not (self.folder / name).exists():
            done = run(self.folder, "synthesize", name, *options, "--quiet")
            if done.returncode != 0:
                raise RuntimeError(done.stderr)
        return name

    def changed(self, change, *options):
        """A capture of the jug with other matrices, or names."""
        capture = self.synthesized("--size", f"{SIZE}x{SIZE}", *options)
        lines = [line.split() for line in (self.folder / capture / "projections.txt").read_text().splitlines()]
        names = [line[0] for line in lines]
        matrices = [np.array(line[1:], dtype=float).reshape(3, 4) for line in lines]
        change(names, matrices)
        place = self.folder / "changed"
        place.mkdir(exist_ok=True)
        if (place / "masks").is_symlink():
            (place / "masks").unlink()
        (place / "masks").symlink_to(self.folder / capture / "masks")
        (place / "projections.txt").write_text("".join(
            " ".join([name, *(repr(float(value)) for value in matrix.ravel())]) + "\n"
            for name, matrix in zip(names, matrices)))
        return "changed"

    def wrong(self, change, *options):
        """The figures of a row: mean XOR and the worst view's, %, `alignment`, `shift`, and `background_votes`."""
        found = metrics(self.folder, self.changed(change, *options), "--depth", 6)
        worst = max(view["xor"] for view in found["per_view"])
        return [100 * found["mean_xor"], 100 * worst, found["alignment"], found["shift"], found["background_votes"]]

    def distance(self, shape, size, depth, views=36, *options):
        """Mean distance between mesh and truth, and mean XOR, %."""
        capture = self.synthesized("--shape", shape, "--size", f"{size}x{size}", "--views", views)
        found = metrics(self.folder, capture, "--depth", depth, "--truth", f"{capture}/truth.ply", *options)
        return [found["truth_mean"], 100 * found["mean_xor"]]


def measured(captures):
    """All rows: (label, figures)."""
    for label, change in WRONG.items():
        yield label, captures.wrong(change)
    for label, change in NOISY.items():
        yield label, captures.wrong(WRONG[change], "--noise-contour", 1)
    for shape in ("pebble", "jug"):
        yield f"{shape}, views", [captures.distance(shape, SIZE, 6, views)[0] for views in VIEWS]
    yield "jug, rings", [captures.distance("jug", SIZE, 6, 36, "--views", "0-21")[0],  # the ring 15 degrees high
                         captures.distance("jug", SIZE, 6, 22)[0]]
    for shape, size, depths in SHARES:
        found = [captures.distance(shape, size, depth) for depth in depths]
        yield f"{shape}, {size} px, distance", [row[0] for row in found]
        yield f"{shape}, {size} px, XOR", [row[1] for row in found]


def stated(text):
    """The rows of the tutorial's tables: label to figures, what is no figure left out."""
    rows = {}
    for line in text.splitlines():
        cells = [cell.strip() for cell in line.strip("|").split("|")]
        if line.startswith("|") and len(cells) > 2:
            rows[cells[0]] = [float(cell.split()[0]) for cell in cells[1:] if cell[:1].isdigit()]
    return rows


class TestTables(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.captures = Captures()
        cls.addClassCleanup(cls.captures.temporary.cleanup)
        cls.rows = stated(document.text("tutorial.md"))

    def test_the_figures(self):
        for label, found in measured(self.captures):
            with self.subTest(label):
                self.assertIn(label, self.rows)
                self.assertEqual(len(self.rows[label]), len(found))
                least = 0.05 if label in {**WRONG, **NOISY} else 0.0  # per cent, pixels, octants
                for figure, value in zip(self.rows[label], found):
                    self.assertAlmostEqual(figure, value, delta=max(0.2 * abs(value), least))

    def test_errors_and_warnings(self):
        apart = "the viewing cones of the silhouettes have no point in common"
        for change, words in ((scaled(0.5, 0), apart), (scaled(2.0, 0), apart),
                              (lambda names, matrices: matrices.__setitem__(
                                  slice(None), [poses_inverted(matrix) for matrix in matrices]), "do not close around")):
            found = metrics(self.captures.folder, self.captures.changed(change), "--depth", 6)
            self.assertIsInstance(found, str)
            self.assertIn(words, found)
            self.assertIn(words, document.text("tutorial.md").replace("\n", " "))
        done = run(self.captures.folder, "reconstruct", self.captures.changed(mirrored), "-o", "mesh.ply", "--depth", 5)
        self.assertIn("36 of 36 projections are mirrored", done.stderr)


class TestMetrics(unittest.TestCase):
    """Documentation/formats.md has every key of the metrics, and no other."""

    def test_the_keys(self):
        captures = Captures()
        self.addCleanup(captures.temporary.cleanup)
        capture = captures.synthesized("--size", "64x64", "--views", 8)
        truth = ("--truth", f"{capture}/truth.ply")
        found = metrics(captures.folder, capture, "--depth", 4, *truth)
        done = run(captures.folder, "evaluate", "mesh.ply", "--capture", capture, *truth, "--metrics", "evaluation.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        keys = {*found, *json.loads((captures.folder / "evaluation.json").read_text())}
        table = document.text("formats.md").split("## Metrics")[1].split("\nA pixel is covered")[0]
        rows = [line.strip("|").split("|") for line in table.splitlines() if line.startswith("| `")]
        named = [name for row in rows for name in re.findall("`([a-z_]+)`", row[0])]
        self.assertEqual(sorted(named), sorted(keys))
        per_view, = [row[1] for row in rows if "`per_view`" in row[0]]
        self.assertEqual(set(re.findall("`([a-z_]+)`", per_view)), set(found["per_view"][0]))


def poses_inverted(matrix):
    """K [R^T, -R^T t]: the camera's pose in the world where the world's in the camera is due."""
    flip = np.eye(3)[::-1]
    q, r = np.linalg.qr((flip @ matrix[:, :3]).T)
    signs = np.diag(np.sign(np.diag(flip @ r.T @ flip)))
    k, turn = flip @ r.T @ flip @ signs, signs @ flip @ q.T
    return k @ np.column_stack([turn.T, -turn.T @ np.linalg.inv(k) @ matrix[:, 3]])


if __name__ == "__main__":
    if sys.argv[1:] == ["--print"]:
        for name, figures in measured(Captures()):
            print(f"| {name} |", " | ".join(f"{figure:.4g}" for figure in figures), "|", flush=True)
    else:
        unittest.main()
