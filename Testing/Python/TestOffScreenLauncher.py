# SPDX-License-Identifier: BSD-3-Clause
"""python3 -m vtksilhouette.offscreen SCRIPT, and what happens without it."""

import os
import subprocess
import sys
import tempfile
import unittest

from vtksilhouette import offscreen

SCRIPT = """
import os, sys
import vtkmodules.vtkRenderingOpenGL2
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow
window = vtkRenderWindow()
window.AddRenderer(vtkRenderer())
window.Render()
print("renderer", "llvmpipe" in window.ReportCapabilities())
print("arguments", sys.argv[1:])
print("preloaded for children", "silhouetteglx" in os.environ.get("LD_PRELOAD", ""))
sys.exit(3)
"""


class TestOffScreenLauncher(unittest.TestCase):
    def test_a_script_renders(self):
        with tempfile.TemporaryDirectory() as folder:
            script = os.path.join(folder, "script.py")
            with open(script, "w") as file:
                file.write(SCRIPT)
            run = subprocess.run([sys.executable, "-m", "vtksilhouette.offscreen", script, "one", "--two"],
                                 capture_output=True, text=True)
        self.assertIn("renderer True", run.stdout, run.stderr)
        self.assertIn("arguments ['one', '--two']", run.stdout)
        self.assertIn("preloaded for children False", run.stdout)
        self.assertEqual(run.returncode, 3, "the script's exit code is passed on")

    def test_help(self):
        run = subprocess.run([sys.executable, "-m", "vtksilhouette.offscreen", "--help"],
                             capture_output=True, text=True)
        self.assertIn("SCRIPT", run.stdout)
        self.assertEqual(run.returncode, 0)

    def test_an_unprepared_process_is_told(self):
        if "LD_PRELOAD" not in offscreen.environment():
            self.skipTest("VTK's own window needs no preparation")
        with self.assertRaisesRegex(RuntimeError, "python3 -m vtksilhouette.offscreen"):
            offscreen.enable()


if __name__ == "__main__":
    unittest.main()
