# SPDX-License-Identifier: BSD-3-Clause
"""pvserver with one and two ranks: a client connects, loads the plugin, runs the pipeline and fetches the data."""
import json
import os
import pathlib
import shutil
import socket
import subprocess
import sys
import tempfile
import time
import unittest

PARAVIEW_BIN = pathlib.Path(os.environ["PARAVIEW_BIN"])
CLIENT = pathlib.Path(__file__).with_name("server_client.py")
ENVIRONMENT = {**os.environ, "VTK_SMP_MAX_THREADS": "1", "OMPI_MCA_mpi_yield_when_idle": "1"}


def free_port():
    with socket.socket() as listening:
        listening.bind(("localhost", 0))
        return listening.getsockname()[1]


class Server:
    """A pvserver, for the time of a with block; its messages are in `log`."""

    def __init__(self, ranks, folder):
        self.port = free_port()
        self.log = folder / "server.log"
        command = [PARAVIEW_BIN / "pvserver", "--force-offscreen-rendering", "--server-port=%d" % self.port]
        if ranks > 1:
            command = ["mpirun", "--allow-run-as-root", "--oversubscribe", "-n", ranks, *command]
        self.command = [str(word) for word in command]

    def __enter__(self):
        with open(self.log, "w") as log:
            self.process = subprocess.Popen(self.command, stdout=log, stderr=subprocess.STDOUT, env=ENVIRONMENT)
        until = time.monotonic() + 120
        while "Accepting connection" not in self.log.read_text():
            if self.process.poll() is not None or time.monotonic() > until:
                self.process.kill()
                raise RuntimeError("pvserver does not accept connections:\n" + self.log.read_text())
            time.sleep(0.2)
        return self

    def __exit__(self, *_):
        if self.process.poll() is None:
            self.process.terminate()
            self.process.wait(60)


def run_client(port, folder):
    """What the client has found."""
    output = folder / "found.json"
    done = subprocess.run([str(PARAVIEW_BIN / "pvpython"), str(CLIENT), str(port), str(output)], timeout=400,
                          env=ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, universal_newlines=True,
                          errors="replace")
    if done.returncode != 0:
        raise AssertionError("the client ended with %d:\n%s" % (done.returncode, done.stdout))
    return json.loads(output.read_text())


class TestServer(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="vtksilhouette-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.expected = run_client(0, cls.folder)

    def check(self, ranks):
        with Server(ranks, self.folder) as server:
            found = run_client(server.port, self.folder)
            # The server ends when its client has gone.
            self.assertEqual(server.process.wait(60), 0, server.log.read_text())
        self.assertTrue(found["remote"])
        self.assertEqual(found["ranks"], ranks)
        self.assertEqual((found["Sound"], found["LostSurface"]), (1, 0))
        for key in ("rows", "Triangles"):
            self.assertEqual(found[key], self.expected[key], key)
        self.assertGreater(len(found["cubes"]), 1000)
        for key in ("cubes", "hulls"):
            self.assertEqual(sorted(found[key]), sorted(self.expected[key]), key)
        return found, server

    def test_within_the_client(self):
        self.assertFalse(self.expected["remote"])
        self.assertIn("background votes", self.expected["message"])

    def test_a_server(self):
        found, server = self.check(1)
        self.assertEqual(found["cells"], self.expected["cells"])
        self.assertIn("background votes", found["message"] + server.log.read_text())

    def test_a_server_of_two_ranks(self):
        if not shutil.which("mpirun"):
            self.skipTest("there is no mpirun")
        self.check(2)


if __name__ == "__main__":
    if not (PARAVIEW_BIN / "pvserver").exists():
        print("skipped: there is no pvserver in %s" % PARAVIEW_BIN)
        sys.exit(77)
    unittest.main()
