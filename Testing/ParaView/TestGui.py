# SPDX-License-Identifier: BSD-3-Clause
"""
ParaView's GUI under Xvfb: opened with a script that loads the plugin and builds the pipeline; pictures of the render
view and of the main window, judged by what they should show. They are left in the build tree's Testing/Temporary.

No baselines: the expected picture is computed from the mesh itself. In the render view a pixel more than one pixel
away from the outline has to be the surface's or the background's as the mesh says, with no exception; at the outline
drivers differ. In the window, whose layout is ParaView's matter, the surface is found by its colour and compared in
shape.
"""
import json
import os
import pathlib
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import numpy

import pictures

PARAVIEW_BIN = pathlib.Path(os.environ["PARAVIEW_BIN"])
TEMPORARY = pathlib.Path(os.environ["SILHOUETTE_TEMPORARY_DIR"])
SCRIPT = pathlib.Path(__file__).with_name("gui_pipeline.py")
# No question in the way, and sizes that do not depend on a user's last session.
SETTINGS = "[General]\nGeneralSettings.ShowWelcomeDialog=false\n"


def is_surface(picture):
    """The pixels of the colour that the script gives the surface, (1, 0, 1), up to the blending at the outline."""
    red, green, blue = (picture[:, :, channel].astype(int) for channel in range(3))
    return (red > 200) & (green < 128) & (blue > 200)


def faults_of_view(picture, triangles, scale):
    """How many pixels off the outline are not what the mesh says."""
    height, width, _ = picture.shape
    expected = pictures.mask_of(triangles, width, height, scale)
    outline = pictures.grown(expected) & pictures.grown(~expected)
    return int(((is_surface(picture) != expected) & ~outline).sum())


def shape_of(mask):
    """Width by height of the mask's box, and the share of the box that it fills."""
    rows, columns = numpy.flatnonzero(mask.any(axis=1)), numpy.flatnonzero(mask.any(axis=0))
    if rows.size == 0:
        return 0.0, 0.0
    height, width = rows[-1] - rows[0] + 1, columns[-1] - columns[0] + 1
    return width / height, mask.sum() / (width * height)


def shows_the_surface(window, triangles, scale):
    """Whether a window's picture shows the surface: large, its box of the same proportions and filled alike, to 2 %."""
    mask = is_surface(window)
    expected = shape_of(pictures.mask_of(triangles, 900, 900, scale))
    return mask.sum() > 10000 and all(abs(a - b) < 0.02 * b for a, b in zip(shape_of(mask), expected))


class TestGui(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="vtksilhouette-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        (cls.folder / "screen").mkdir()
        configuration = cls.folder / ".config" / "ParaView"
        configuration.mkdir(parents=True)
        for name in ("ParaView5.11.0.ini", "ParaView-5.11.0.ini"):
            (configuration / name).write_text(SETTINGS)
        cls.run_gui()
        cls.triangles = numpy.array(cls.found["triangles"]).reshape(-1, 3, 3)

    @classmethod
    def run_gui(cls):
        environment = {**os.environ, "HOME": str(cls.folder), "XDG_CONFIG_HOME": str(cls.folder / ".config"),
                       "XDG_RUNTIME_DIR": str(cls.folder), "SILHOUETTE_GUI_FOLDER": str(cls.folder)}
        command = ["xvfb-run", "-a", "-s", "-screen 0 1280x900x24 -fbdir %s" % (cls.folder / "screen"),
                   str(PARAVIEW_BIN / "paraview"), "--script=%s" % SCRIPT]
        log = cls.folder / "gui.log"
        with open(log, "w") as file:
            gui = subprocess.Popen(command, stdout=file, stderr=subprocess.STDOUT, env=environment,
                                   start_new_session=True)
        try:
            cls.wait_for(lambda: (cls.folder / "found.json").exists() or gui.poll() is not None, 400)
            if not (cls.folder / "found.json").exists():
                raise RuntimeError("ParaView's GUI did not run the script:\n" + log.read_text()[-4000:])
            cls.found = json.loads((cls.folder / "found.json").read_text())
            if "error" in cls.found:
                raise RuntimeError(cls.found["error"])
            # The script holds the GUI up; when it has ended the window is painted.
            cls.window = cls.painted()
            cls.alive = gui.poll() is None
        finally:
            if gui.poll() is None:
                os.killpg(gui.pid, signal.SIGTERM)
                gui.wait(60)
        cls.log = log.read_text()

    @staticmethod
    def wait_for(condition, seconds):
        until = time.monotonic() + seconds
        while not condition() and time.monotonic() < until:
            time.sleep(0.5)

    @classmethod
    def painted(cls):
        """The screen, as soon as it shows the surface; else as it is after a while."""
        triangles = numpy.array(cls.found["triangles"]).reshape(-1, 3, 3)
        screen = cls.folder / "screen" / "Xvfb_screen0"
        cls.wait_for(lambda: shows_the_surface(pictures.read_xwd(screen), triangles, cls.found["scale"]), 60)
        time.sleep(2)  # panels beside the view
        picture = pictures.read_xwd(screen)
        pictures.write_png(TEMPORARY / "ParaViewGuiWindow.png", picture)
        return picture

    def view(self, name):
        picture = pictures.read_png(self.folder / (name + ".png"))
        pictures.write_png(TEMPORARY / ("ParaViewGui%s.png" % name.capitalize()), picture)
        return picture

    def test_nothing_went_wrong(self):
        self.assertTrue(self.alive)
        self.assertNotIn("ERR|", self.log)

    def test_octree_by_state(self):
        """As applied: coloured by state; and the octants cover the surface, with an octant to spare at the outline."""
        self.assertEqual(self.found["colouring"], ["CELLS", "State"])
        picture = self.view("octree")
        height, width, _ = picture.shape
        drawn = picture.min(axis=2) < 224  # the background is white
        surface = pictures.mask_of(self.triangles, width, height, self.found["scale"])
        self.assertEqual((surface & ~pictures.grown(drawn)).sum(), 0)
        near = surface
        for _ in range(int(numpy.ceil(self.found["octant"] * height / (2 * self.found["scale"]))) + 1):
            near = pictures.grown(near)
        self.assertEqual((drawn & ~near).sum(), 0)

    def test_surface(self):
        picture = self.view("surface")
        self.assertGreater(len(self.triangles), 5000)
        self.assertGreater(is_surface(picture).sum(), 10000)
        self.assertEqual(faults_of_view(picture, self.triangles, self.found["scale"]), 0)

    def test_window(self):
        height, width, _ = self.window.shape
        self.assertTrue(shows_the_surface(self.window, self.triangles, self.found["scale"]))
        # Around the view stand the menus, the pipeline and the properties, of other colours than the view's white.
        view = is_surface(self.window) | (self.window.min(axis=2) == 255)
        self.assertGreater((~view).sum(), 0.2 * width * height)
        self.assertLess((self.window.max(axis=2) == 0).sum(), 0.5 * width * height)

    def test_broken_pictures_fail(self):
        picture, scale = self.view("surface"), self.found["scale"]
        middle = numpy.argwhere(pictures.mask_of(self.triangles, 600, 450, scale)).mean(axis=0).astype(int)
        rows = numpy.flatnonzero(is_surface(picture)[:, middle[1]])
        row = rows[len(rows) // 4]
        hole = picture.copy()
        hole[row - 1:row + 2, middle[1] - 1:middle[1] + 2] = 255
        self.assertEqual(faults_of_view(hole, self.triangles, scale), 9)
        speck = picture.copy()
        speck[3, 3] = (255, 0, 255)
        self.assertEqual(faults_of_view(speck, self.triangles, scale), 1)
        self.assertGreater(faults_of_view(numpy.full_like(picture, 255), self.triangles, scale), 10000)
        self.assertGreater(faults_of_view(numpy.roll(picture, 4, axis=1), self.triangles, scale), 50)
        covered = self.window.copy()
        rows = numpy.flatnonzero(is_surface(covered).any(axis=1))
        covered[rows[0]:rows[0] + len(rows) // 10] = 255
        self.assertFalse(shows_the_surface(covered, self.triangles, scale))
        self.assertFalse(shows_the_surface(numpy.zeros_like(self.window), self.triangles, scale))


if __name__ == "__main__":
    for need in ("xvfb-run", "xauth"):
        if not shutil.which(need):
            print("skipped: there is no %s" % need)
            sys.exit(77)
    if not (PARAVIEW_BIN / "paraview").exists():
        print("skipped: there is no paraview in %s" % PARAVIEW_BIN)
        sys.exit(77)
    unittest.main()
