# SPDX-License-Identifier: BSD-3-Clause
"""State files (.pvsm, .py) and Python traces, loaded again in a process of their own, give the same mesh."""
import sys
import unittest

import numpy

import plugin
from plugin import fetch, triangles
from paraview import simple, smstate, smtrace
from paraview.simple import OutputPort

plugin.load(globals())

# What the other process does: it runs a state, and writes the triangles of the surface that it finds there.
LOADER = """
import sys
import numpy
import plugin
plugin.load(globals())
from paraview import simple
state, output = sys.argv[1:]
if state.endswith(".pvsm"):
    simple.LoadState(state)
else:
    exec(compile(open(state).read(), state, "exec"))
surface = simple.FindSource("Hulls")
numpy.save(output, plugin.triangles(plugin.fetch(surface)))
"""


def build():
    """A pipeline with settings that are not the defaults."""
    capture = SyntheticCapture(registrationName="Capture", Shape="Torus", Width=96, Height=96, NumberOfViews=10,
                               NoiseContour=0.4, Seed=5)
    octree = SilhouetteOctree(registrationName="Octree", Input=OutputPort(capture, 0), Depth=5, BackgroundVotes=1)
    cubes = VotingMarchingCubes(registrationName="Cubes", Input=OutputPort(octree, 0), Views=OutputPort(octree, 1),
                                VoteShare=0.9)
    return LocalHullSurface(registrationName="Hulls", Input=cubes, Octree=OutputPort(octree, 0),
                            Views=OutputPort(octree, 1), IslandShare=0.01, ThinHulls=0)


class TestStates(plugin.PluginTest):
    def setUp(self):
        super().setUp()
        self.loader = self.folder / "loader.py"
        self.loader.write_text(LOADER)

    def loaded(self, state):
        mesh = self.folder / "mesh.npy"
        done = plugin.run([plugin.PARAVIEW_BIN / "pvpython", self.loader, state, mesh])
        self.assertEqual(done.returncode, 0, done.stdout)
        return numpy.load(mesh)

    def assert_the_same(self, state, expected):
        self.assertGreater(len(expected), 500)
        self.assertTrue(numpy.array_equal(self.loaded(state), expected))

    def test_pvsm(self):
        expected = triangles(fetch(build()))
        state = self.folder / "state.pvsm"
        simple.SaveState(str(state))
        self.assertIn("SilhouetteOctree", state.read_text())
        self.assert_the_same(state, expected)

    def test_python_state(self):
        expected = triangles(fetch(build()))
        state = self.folder / "state.py"
        state.write_text(smstate.get_state())  # what the GUI's "Save State" writes
        self.assertIn("SilhouetteOctree(registrationName='Octree'", state.read_text())
        self.assert_the_same(state, expected)

    def test_trace(self):
        trace = smtrace.start_trace()
        hulls = build()
        hulls.UpdatePipeline()
        text = smtrace.stop_trace()
        self.assertIn("Depth = 5", text)
        expected = triangles(fetch(hulls))
        state = self.folder / "trace.py"
        state.write_text(text)
        self.assert_the_same(state, expected)


if __name__ == "__main__":
    unittest.main()
