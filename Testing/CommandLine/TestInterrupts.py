# SPDX-License-Identifier: BSD-3-Clause
"""An interrupt ends the program soon, with exit code 130, and leaves nothing half-made."""
import os
import signal
import subprocess
import time
import unittest

import program
from program import INTERRUPTED, PROGRAM, ProgramTest

SOON = 30 # seconds; generous, for busy machines


class Interrupts(ProgramTest):
    def interrupt(self, how, after, *arguments):
        child = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(after)
        self.assertIsNone(child.poll(), "over before it was interrupted")
        child.send_signal(how)
        out, error = child.communicate(timeout=SOON)
        self.assertEqual(child.returncode, INTERRUPTED, error)
        self.assertEqual(out, b"")
        self.assertEqual(error, b"vtksilhouette: error: interrupted\n")

    def test_reconstruct(self):
        place = self.folder / "place"
        place.mkdir()
        (place / "x.ply").write_text("old")
        for how, after in ((signal.SIGINT, 0.3), (signal.SIGTERM, 1.0), (signal.SIGHUP, 2.0)):
            self.interrupt(how, after, "reconstruct", self.capture, "-o", place / "x.ply", "--depth", 11, "--metrics",
                           place / "x.json")
            self.assertEqual((place / "x.ply").read_text(), "old")
            self.assertEqual(os.listdir(place), ["x.ply"])

    def test_synthesize(self):
        for after in (0.5, 2.5):
            self.interrupt(signal.SIGINT, after, "synthesize", self.folder / "new", "--views", 400, "--size",
                           "1024x1024")
            self.assertEqual(self.names(), [])

    def test_ignored_signals_stay_ignored(self):
        command = 'trap "" INT; "$0" reconstruct "$1" -o "$2" --depth 6 & sleep 0.2; kill -INT $!; wait $!'
        mesh = self.folder / "x.ply"
        done = subprocess.run(["sh", "-c", command, PROGRAM, str(self.capture), str(mesh)], stdout=subprocess.DEVNULL)
        self.assertEqual(done.returncode, program.OK)
        self.assertTrue(mesh.exists())


if __name__ == "__main__":
    unittest.main()
