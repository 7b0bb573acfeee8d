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
    def interrupt(self, how, after, *arguments, times=1):
        child = subprocess.Popen([PROGRAM, *map(str, arguments)], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        time.sleep(after)
        self.assertIsNone(child.poll(), "over before it was interrupted")
        for _ in range(times):
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

    def test_twice_at_once_is_once(self):
        """As timeout and some shells do it."""
        self.interrupt(signal.SIGTERM, 0.5, "synthesize", self.folder / "new", "--views", 400, "--size", "1024x1024",
                       times=2)
        self.assertEqual(self.names(), [])

    def test_the_second_ends_at_once(self):
        child = subprocess.Popen([PROGRAM, "reconstruct", str(self.capture), "-o", str(self.folder / "x.ply"), "--depth",
                                  "12", "-q"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        time.sleep(1.0)
        while child.poll() is None:
            child.send_signal(signal.SIGTERM)
            time.sleep(0.1)
        self.assertIn(child.returncode, (-signal.SIGTERM, INTERRUPTED))

    def test_outputs_come_together(self):
        """Whenever it is interrupted, all outputs are the old ones or all are new."""
        names = ("x.ply", "x.json", "x.png", "x.htg") if program.PICTURES else ("x.ply", "x.json", "x.htg")
        options = [word for name in names[1:] for word in ("--" + {"j": "metrics", "p": "image", "h": "octree"}[name[2]], name)]
        ends = set()
        for after in (0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0, 1.3, 1.7, 2.5):
            for name in names:
                (self.folder / name).write_text("old")
            child = subprocess.Popen([PROGRAM, "reconstruct", str(self.capture), "-o", "x.ply", *options, "--depth", "6",
                                      "-q"], cwd=self.folder, stderr=subprocess.DEVNULL)
            time.sleep(after)
            child.send_signal(signal.SIGINT)
            child.wait(timeout=SOON)
            self.assertEqual(sorted(os.listdir(self.folder)), sorted(names))
            old = {(self.folder / name).read_bytes() == b"old" for name in names}
            self.assertEqual(len(old), 1, f"after {after} s")
            ends |= old
        self.assertIn(True, ends)

    def test_ignored_signals_stay_ignored(self):
        command = 'trap "" INT; "$0" reconstruct "$1" -o "$2" --depth 6 & sleep 0.2; kill -INT $!; wait $!'
        mesh = self.folder / "x.ply"
        done = subprocess.run(["sh", "-c", command, PROGRAM, str(self.capture), str(mesh)], stdout=subprocess.DEVNULL)
        self.assertEqual(done.returncode, program.OK)
        self.assertTrue(mesh.exists())


if __name__ == "__main__":
    unittest.main()
