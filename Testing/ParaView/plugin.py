# SPDX-License-Identifier: BSD-3-Clause
"""The plugin under test, loaded; what its tests share. For scripts that run in pvpython or pvbatch."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

from paraview import servermanager, simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow

PLUGIN = os.environ["SILHOUETTE_PLUGIN"]
PROGRAM = os.environ.get("SILHOUETTE_PROGRAM", "")
PARAVIEW_BIN = pathlib.Path(os.environ["PARAVIEW_BIN"])
TEMPORARY = pathlib.Path(os.environ["SILHOUETTE_TEMPORARY_DIR"])
TREE = pathlib.Path(__file__).resolve().parents[2]


def load(names, remote=False):
    """Load the plugin; its functions (SilhouetteOctree, ...) go into `names`, a module's globals()."""
    simple.LoadPlugin(PLUGIN, remote=remote, ns=names)


def skip(why):
    """End a test script as skipped."""
    print("skipped: " + why, flush=True)
    sys.exit(77)


class Messages:
    """What is written into VTK's output window in a with block: errors and warnings, as `text`."""

    def __enter__(self):
        self.before = vtkOutputWindow.GetInstance()
        self.window = vtkStringOutputWindow()
        vtkOutputWindow.SetInstance(self.window)
        self.text = ""
        return self

    def __exit__(self, *_):
        self.text = self.window.GetOutput() or ""
        vtkOutputWindow.SetInstance(self.before)


class PluginTest(unittest.TestCase):
    """A test in a folder of its own that leaves no proxies behind."""

    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="vtksilhouette-"))
        self.addCleanup(shutil.rmtree, self.folder, ignore_errors=True)
        self.addCleanup(simple.ResetSession)


def run(command, timeout=300, **options):
    """Run a command; its output and errors as one text."""
    return subprocess.run([str(word) for word in command], timeout=timeout, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, universal_newlines=True, errors="replace", **options)


def triangles(surface):
    """A mesh's triangles by their corners' coordinates, (n, 3, 3), in order."""
    cells = surface.GetPolys()
    points = vtk_to_numpy(surface.GetPoints().GetData()) if surface.GetNumberOfPoints() else None
    if points is None or cells.GetNumberOfCells() == 0:
        import numpy
        return numpy.zeros((0, 3, 3))
    ids = vtk_to_numpy(cells.GetConnectivityArray())
    assert ids.size == 3 * cells.GetNumberOfCells(), "not triangles"
    return points[ids].reshape(-1, 3, 3)


def field(data, name):
    """The first value of a field array."""
    return data.GetFieldData().GetArray(name).GetTuple1(0)


def fetch(source, port=0):
    """The data of an output, brought up to date and brought here, to the client."""
    return servermanager.Fetch(simple.OutputPort(source, port))


def output(source, port=0):
    """The same where client and server are one process, for what ParaView's Fetch takes apart: collections."""
    source.UpdatePipeline()
    return source.GetClientSideObject().GetOutputDataObject(port)
