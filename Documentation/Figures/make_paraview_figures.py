# SPDX-License-Identifier: BSD-3-Clause
"""Makes the figures of Documentation/paraview.md, with ParaView itself.

    vtksilhouette synthesize jug --size 512x512 --views 24
    vtksilhouette synthesize torn --size 512x512 --views 24 --noise-blobs 8 --noise-contour 1
    PV_PLUGIN_PATH=PLUGINS pvpython make_paraview_figures.py jug torn [FIGURE ...] [--folder FOLDER]

PLUGINS is the folder that the plugin was built into. An X server is needed (xvfb-run will do); the figure of the
windows starts an Xvfb and a paraview of its own, that of the server two ranks of pvserver. Without names all are made,
in five minutes or so, into the folder of this script. What each shows is in its function's first line.
"""

import argparse
import os
import pathlib
import struct
import subprocess
import sys
import tempfile
import time

import numpy as np
from paraview import servermanager
from paraview.simple import *
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOImage import vtkPNGWriter

HERE = pathlib.Path(__file__).resolve().parent
EXAMPLES = HERE.parents[1] / "Examples" / "ParaView"
sys.path.append(str(EXAMPLES))

from pictures import (  # noqa: E402
    GREY, color_by_state, label, look_from_first_camera, show_mesh, white_view, write_sheet)

BIN = pathlib.Path("/proc/self/exe").resolve().parent  # where pvpython is; sys.executable does not say


class Pipeline:
    """A capture's silhouettes and what the filters make of them."""

    def __init__(self, capture, depth, votes=0):
        self.reader = SilhouetteCaptureReader(FileName=capture)
        self.extractor = SilhouetteExtractor(Input=self.reader)
        self.octree = SilhouetteOctree(Input=self.extractor, Depth=depth, BackgroundVotes=votes)
        views = OutputPort(self.octree, 1)
        self.cubes = VotingMarchingCubes(Input=self.octree, Views=views)
        self.hulls = LocalHullSurface(Input=self.cubes, Octree=self.octree, Views=views)


def save(path, view):
    SaveScreenshot(str(path), view, CompressionLevel="9")
    return str(path)


def legend(colors, view, **properties):
    """The colours' bar, in grey letters."""
    bar = GetScalarBar(colors, view)
    SetProperties(bar, TitleColor=GREY, LabelColor=GREY, Visibility=1, **properties)


def side_by_side(folder, panels, sheet):
    """`panels` draw one after the other: functions that get a view and return what to hide again."""
    files = []
    for number, panel in enumerate(panels):
        view = white_view(400, 400)
        panel(view)
        files.append(save(folder / f"panel-{number}.png", view))
        Delete(view)
    if not write_sheet(files, str(sheet), columns=len(files)):
        sys.exit(f"{sheet}: could not be written")


def cameras(captures, folder, target):
    """The cameras as frustums, numbered by colour, around the mesh."""
    made = Pipeline(captures[0], 7)
    view = white_view(900, 500)
    show_mesh(made.hulls, view)
    Show(OutputPort(made.reader, 1), view, LineWidth=1.5)
    legend(GetColorTransferFunction("View"), view, Title="View", ComponentTitle="", RangeLabelFormat="%.0f")
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = (4.0, -8.0, 3.5), (0.0, 0.0, 0.0), (0.0, 0.0, 1.0)
    ResetCamera(view)
    view.GetActiveCamera().Zoom(1.5)
    save(target, view)


def octree(captures, folder, target):
    """The octree by state: whole, and cut open by ParaView's Clip."""
    made = Pipeline(captures[0], 6)
    half = Clip(Input=made.octree, Invert=1)
    half.HyperTreeGridClipper.Normal = [0.0, -1.0, 0.0]

    def panel(source, words, bar):
        def draw(view):
            colors = color_by_state(Show(source, view))
            look_from(view)
            if bar:
                legend(colors, view, Title="State", ComponentTitle="", WindowLocation="Upper Right Corner")
            label(view, words)
        return draw

    def look_from(view):
        view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = (2.0, -4.0, 2.0), (0, 0, 0), (0, 0, 1)
        ResetCamera(view)

    side_by_side(folder, [panel(made.octree, "Silhouette Octree", False), panel(half, "Clip", True)], target)


def hulls(captures, folder, target):
    """Torn silhouettes: marching cubes, the surface made whole, and its local hulls, a colour each."""
    made = Pipeline(captures[1], 7)

    def panel(words, draw):
        def all_of_it(view):
            draw(view)
            look_from_first_camera(view, made.reader)
            label(view, words)
        return all_of_it

    def by_hull(view):
        display = Show(OutputPort(made.hulls, 1), view, Ambient=0.1)
        ColorBy(display, ("CELLS", "HullId"))
        display.RescaleTransferFunctionToDataRange()

    side_by_side(folder, [panel("Voting Marching Cubes", lambda view: show_mesh(made.cubes, view)),
                          panel("Local Hull Surface", lambda view: show_mesh(made.hulls, view)),
                          panel("its Hulls, by HullId", by_hull)], target)


def run(*command, **options):
    subprocess.run([str(word) for word in command], check=True, **options)


def votes(captures, folder, target):
    """The sheet of Examples/ParaView/vote_share_sweep.py."""
    run(BIN / "pvpython", EXAMPLES / "vote_share_sweep.py", captures[1], folder / "votes", "--votes", 2)
    os.replace(folder / "votes" / "sheet.png", target)


def growing(captures, folder, target):
    """The sheet of Examples/ParaView/growing_octree.py."""
    run(BIN / "pvpython", EXAMPLES / "growing_octree.py", captures[0], folder / "growing", "--depth", 6)
    os.replace(folder / "growing" / "sheet.png", target)


def ranks(captures, folder, target):
    """The picture of Examples/ParaView/on_a_server.py, with two ranks."""
    # What pvpython's own MPI has put there would make mpirun believe to be one of its ranks.
    environment = {name: value for name, value in os.environ.items() if not name.startswith(("OMPI_", "PMIX_"))}
    environment.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                       OMPI_MCA_rmaps_base_oversubscribe="1")
    server = subprocess.Popen(["mpirun", "-n", "2", BIN / "pvserver", "--server-port=11555"], env=environment)
    try:
        time.sleep(5)
        run(BIN / "pvpython", EXAMPLES / "on_a_server.py", "localhost", 11555, os.path.abspath(captures[0]), target)
    finally:
        server.terminate()
        server.wait()


WINDOWS = """
from paraview.simple import *
reader = SilhouetteCaptureReader(registrationName="projections.txt", FileName=r"{capture}/projections.txt",
                                 Images="Photographs")
extractor = SilhouetteExtractor(registrationName="SilhouetteExtractor1", Input=reader, KeyChannel="Blue",
                                LargestRegion=1)
octree = SilhouetteOctree(registrationName="SilhouetteOctree1", Input=extractor, Depth=7)
views = OutputPort(octree, 1)
cubes = VotingMarchingCubes(registrationName="VotingMarchingCubes1", Input=octree, Views=views)
hulls = LocalHullSurface(registrationName="LocalHullSurface1", Input=cubes, Octree=octree, Views=views)
view = GetActiveViewOrCreate("RenderView")
view.UseColorPaletteForBackground, view.Background = 0, [1.0, 1.0, 1.0]
Show(hulls, view, DiffuseColor=[0.86, 0.80, 0.72])
Show(OutputPort(reader, 1), view, LineWidth=1.5)
view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [4.0, -8.0, 3.5], [0, 0, 0], [0, 0, 1]
ResetCamera()
view.GetActiveCamera().Zoom(1.6)
SetActiveSource(hulls)
Render()
open(r"{folder}/drawn", "w").close()
"""
SETTINGS = """[General]
GeneralSettings.ShowWelcomeDialog=false
[MainWindow]
Size=@Size(1240 800)
Position=@Point(0 0)
"""


def windows(captures, folder, target):
    """ParaView's windows with the pipeline, the octree's panel, the mesh and the cameras: a picture of the screen."""
    settings = folder / "home" / ".config" / "ParaView"
    settings.mkdir(parents=True)
    manager = servermanager.vtkSMProxyManager
    version = f"{manager.GetVersionMajor()}.{manager.GetVersionMinor()}.{manager.GetVersionPatch()}"
    (settings / f"ParaView{version}.ini").write_text(SETTINGS)
    (folder / "windows.py").write_text(WINDOWS.format(capture=os.path.abspath(captures[0]), folder=folder))
    read, write = os.pipe()
    screen = subprocess.Popen(["Xvfb", "-displayfd", str(write), "-screen", "0", "1240x800x24", "-nolisten", "tcp",
                               "-noreset", "-fbdir", folder], pass_fds=[write])
    environment = {**os.environ, "HOME": str(folder / "home"), "DISPLAY": ":" + os.read(read, 16).decode().strip()}
    paraview = subprocess.Popen([BIN / "paraview", f"--script={folder / 'windows.py'}"], env=environment)
    try:
        for _ in range(180):
            if (folder / "drawn").exists():
                break
            time.sleep(1)
        time.sleep(10)  # until panels are laid out
        write_screen(folder / "Xvfb_screen0", target)
    finally:
        paraview.kill()
        paraview.wait()
        screen.terminate()
        screen.wait()


def write_screen(dump, path):
    """A screen as Xvfb keeps it, X's window dump of 32 bits a pixel, as a PNG file."""
    data = dump.read_bytes()
    header = struct.unpack(">25I", data[:100])
    size, width, height, line, colors = (header[place] for place in (0, 4, 5, 12, 19))
    pixels = np.frombuffer(data, np.uint8, line * height, size + 12 * colors).reshape(height, line)
    pixels = pixels[::-1, :4 * width].reshape(-1, 4)[:, 2::-1].copy()  # blue first, top row first
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(pixels))
    writer = vtkPNGWriter()
    writer.SetInputData(image)
    writer.SetCompressionLevel(9)
    writer.SetFileName(str(path))
    writer.Write()


FIGURES = {figure.__name__: figure for figure in (windows, cameras, octree, growing, hulls, votes, ranks)}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("jug")
    parser.add_argument("torn")
    parser.add_argument("figures", nargs="*", help=", ".join(FIGURES))
    parser.add_argument("--folder", type=pathlib.Path, default=HERE)
    arguments = parser.parse_args()
    for name in arguments.figures or FIGURES:
        with tempfile.TemporaryDirectory() as folder:
            FIGURES[name]((arguments.jug, arguments.torn), pathlib.Path(folder), arguments.folder / f"paraview-{name}.png")
        print(f"paraview-{name}.png", flush=True)


if __name__ == "__main__":
    main()
