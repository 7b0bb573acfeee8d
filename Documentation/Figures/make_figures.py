# SPDX-License-Identifier: BSD-3-Clause
"""Makes every figure of README.md and Documentation, with the package itself and no display.

    python3 -m vtksilhouette.offscreen Documentation/Figures/make_figures.py [FIGURE ...] [--folder FOLDER]

Without names all figures are made, in two minutes or so, into the folder of this script. What each shows is
in its function's first line.
"""

import argparse
import colorsys
import os
import struct
import tempfile
import zlib

import numpy as np

import vtkmodules.vtkRenderingFreeType  # noqa: F401  text
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkThreshold
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter
from vtkmodules.vtkFiltersHyperTree import vtkHyperTreeGridToUnstructuredGrid
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkImagingColor import vtkImageQuantizeRGBToIndex
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkLight, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkTextActor, vtkWindowToImageFilter)

from vtksilhouette import (
    vtkLocalHullSurfacer, vtkSilhouetteCaptureReader, vtkSilhouetteExtractor, vtkSilhouetteOctreeSource,
    vtkSyntheticCaptureSource, vtkVotingMarchingCubes)

WHITE = (1.0, 1.0, 1.0)
CLAY = (0.93, 0.66, 0.49)  # the jug, as on its photographs
SAND = (0.87, 0.84, 0.76)  # marching cubes
BLUE = (0.58, 0.74, 0.88)  # local hulls
OCTANTS = {1: (0.95, 0.76, 0.48), 2: (0.42, 0.60, 0.84)}  # intersection, inside
INNER = (0.80, 0.27, 0.22)  # the inner side of a surface, seen through holes
SAMPLES = 3  # along each side of a pixel; every picture is their mean


# -- pipelines ---------------------------------------------------------------------------------------------


class Pipeline:
    """A synthetic capture and what the filters make of it."""

    def __init__(self, shape, depth, pixels=512, views=36, background_votes=0, **noise):
        self.capture = vtkSyntheticCaptureSource()
        self.capture.SetShape(shape)
        self.capture.SetNumberOfViews(views)
        self.capture.SetWidth(pixels)
        self.capture.SetHeight(pixels)
        for kind, amount in noise.items():
            getattr(self.capture, "SetNoise" + kind)(amount)
        self.octree = vtkSilhouetteOctreeSource()
        self.octree.SetInputConnection(self.capture.GetOutputPort())
        self.octree.SetDepth(depth)
        self.octree.SetBackgroundVotes(background_votes)
        self.cubes = vtkVotingMarchingCubes()
        self.cubes.SetInputConnection(0, self.octree.GetOutputPort(0))
        self.cubes.SetInputConnection(1, self.octree.GetOutputPort(1))
        self.cubes.SetShare(1.0 - background_votes / views)
        self.cubes.GenerateNormalsOn()
        self.hulls = vtkLocalHullSurfacer()
        self.hulls.SetInputConnection(0, self.cubes.GetOutputPort(0))
        self.hulls.SetInputConnection(1, self.octree.GetOutputPort(0))
        self.hulls.SetInputConnection(2, self.octree.GetOutputPort(1))
        self.hulls.GenerateNormalsOn()


def result(algorithm, port=0):
    """A copy of an output, which the pipeline can then go on to change."""
    algorithm.Update(port)
    copy = algorithm.GetOutputDataObject(port).NewInstance()
    copy.ShallowCopy(algorithm.GetOutputDataObject(port))
    return copy


def cut_open(grid, keep):
    """The octree's octants as faces of cubes: those whose centre `keep`, given an (n, 3) array, accepts."""
    cells = vtkHyperTreeGridToUnstructuredGrid()
    cells.SetInputData(grid)
    cells.Update()
    cubes = cells.GetOutput()
    points = vtk_to_numpy(cubes.GetPoints().GetData())
    corners = vtk_to_numpy(cubes.GetCells().GetConnectivityArray()).reshape(-1, 8)
    kept = numpy_to_vtk(keep(points[corners].mean(axis=1)).astype(np.uint8), deep=True)
    kept.SetName("Kept")
    cubes.GetCellData().AddArray(kept)
    threshold = vtkThreshold()
    threshold.SetInputData(cubes)
    threshold.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, "Kept")
    threshold.SetLowerThreshold(0.5)
    faces = vtkDataSetSurfaceFilter()
    faces.SetInputConnection(threshold.GetOutputPort())
    faces.Update()
    return faces.GetOutput()


def paint(surface, array, colour_of):
    """Gives the cells the colours that `colour_of` gives to the array's values."""
    values = vtk_to_numpy(surface.GetCellData().GetArray(array))
    table = {value: colour_of(value) for value in np.unique(values).tolist()}
    colours = numpy_to_vtk((255.0 * np.array([table[value] for value in values.tolist()])).astype(np.uint8),
                           deep=True)
    colours.SetName("Colour")
    surface.GetCellData().SetScalars(colours)
    return surface


# -- pictures ----------------------------------------------------------------------------------------------


def actor(surface, colour=None, flat=False, edges=False):
    """A surface in one colour or, without, in those of paint()."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.SetScalarVisibility(colour is None)
    mapper.SetScalarModeToUseCellData()
    made = vtkActor()
    made.SetMapper(mapper)
    look = made.GetProperty()
    look.SetAmbient(0.25 if flat else 0.18)
    look.SetDiffuse(0.82)
    look.SetSpecular(0.0 if flat else 0.10)
    look.SetSpecularPower(25.0)
    if colour is not None:
        look.SetColor(colour)
    if flat:
        look.SetInterpolationToFlat()
    else:
        look.SetInterpolationToPhong()
        inner = vtkActor().GetProperty()
        inner.SetColor(INNER)
        inner.SetAmbient(0.5)
        inner.SetDiffuse(0.5)
        made.SetBackfaceProperty(inner)
    if edges:
        look.EdgeVisibilityOn()
        look.SetEdgeColor(0.30, 0.28, 0.26)
        look.SetLineWidth(0.4 * SAMPLES)
    return made


def light(renderer, right, up, intensity):
    """A light that stays with the camera, beside and above it in units of its distance."""
    made = vtkLight()
    made.SetLightTypeToCameraLight()
    made.SetPosition(right, up, 1.0)
    made.SetFocalPoint(0.0, 0.0, 0.0)
    made.SetIntensity(intensity)
    renderer.AddLight(made)


def picture(surface_actor, width, height, half_height=1.0, centre=(0.0, 0.0, 0.0), turn=-60.0, above=22.0,
            label=None, beside=None):
    """A (height, width, 3) array of uint8, row 0 at the top: z upwards, from `turn` and `above`, degrees."""
    renderer = vtkRenderer()
    renderer.SetBackground(WHITE)
    renderer.AddActor(surface_actor)
    if beside:
        renderer.AddActor(beside)
    light(renderer, -0.7, 0.9, 0.85)
    light(renderer, 0.9, 0.2, 0.35)
    light(renderer, 0.0, -0.8, 0.20)
    camera = renderer.GetActiveCamera()
    camera.ParallelProjectionOn()
    camera.SetFocalPoint(centre)
    turn, above = np.radians(turn), np.radians(above)
    towards = np.array([np.cos(turn) * np.cos(above), np.sin(turn) * np.cos(above), np.sin(above)])
    camera.SetPosition(np.array(centre) + 10.0 * towards)
    camera.SetViewUp(0.0, 0.0, 1.0)
    camera.SetParallelScale(half_height)
    camera.SetClippingRange(1.0, 20.0)
    if label:
        renderer.AddActor2D(text(label, width))
    window = vtkRenderWindow()
    window.SetMultiSamples(0)
    window.SetSize(SAMPLES * width, SAMPLES * height)
    window.AddRenderer(renderer)
    window.Render()
    grab = vtkWindowToImageFilter()
    grab.SetInput(window)
    grab.ReadFrontBufferOff()
    grab.Update()
    return shrunk(array_of(grab.GetOutput()), SAMPLES)


def text(label, width):
    made = vtkTextActor()
    made.SetInput(label)
    made.SetPosition(SAMPLES * width / 2, SAMPLES * 8)
    style = made.GetTextProperty()
    style.SetFontFamilyToArial()
    style.SetFontSize(SAMPLES * 16)
    style.SetColor(0.25, 0.25, 0.25)
    style.SetJustificationToCentered()
    return made


def array_of(image):
    """A vtkImageData as a (height, width, 3) array, row 0 at the top."""
    width, height, _ = image.GetDimensions()
    scalars = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)
    return np.repeat(scalars[::-1], 3 // scalars.shape[2], axis=2)


def shrunk(pixels, factor):
    """Each block of factor x factor pixels becomes their mean."""
    height, width = pixels.shape[0] // factor, pixels.shape[1] // factor
    blocks = pixels[:height * factor, :width * factor].reshape(height, factor, width, factor, 3)
    return blocks.mean(axis=(1, 3)).round().astype(np.uint8)


def framed(pixels, width, height):
    """A picture in the middle of a white one."""
    made = np.full((height, width, 3), 255, np.uint8)
    top, left = (height - pixels.shape[0]) // 2, (width - pixels.shape[1]) // 2
    made[top:top + pixels.shape[0], left:left + pixels.shape[1]] = pixels
    return made


def write(pixels, path):
    """A PNG of the 256 colours that suit the picture: VTK's writer knows no palettes, three times as large."""
    height, width, _ = pixels.shape
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(pixels.reshape(-1, 3), deep=True))
    quantize = vtkImageQuantizeRGBToIndex()
    quantize.SetInputData(image)
    quantize.SetNumberOfColors(256)
    quantize.Update()
    indices = vtk_to_numpy(quantize.GetOutput().GetPointData().GetScalars()).reshape(height, width)
    table = quantize.GetLookupTable()
    colours = [table.GetTableValue(index)[:3] for index in range(table.GetNumberOfTableValues())]
    rows = np.hstack([np.zeros((height, 1), np.uint8), indices.astype(np.uint8)])  # 0: rows are as they are
    with open(path, "wb") as file:
        file.write(b"\x89PNG\r\n\x1a\n")
        for kind, data in ((b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 3, 0, 0, 0)),
                           (b"PLTE", np.rint(255.0 * np.array(colours)).astype(np.uint8).tobytes()),
                           (b"IDAT", zlib.compress(rows.tobytes(), 9)), (b"IEND", b"")):
            file.write(struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data)))
    print(f"{path}: {width} x {height}, {os.path.getsize(path) // 1024} KiB")


# -- figures -----------------------------------------------------------------------------------------------


def view_image(collection, view, side):
    """The middle of one of the capture's images, the mean of blocks of pixels, `side` pixels wide."""
    pixels = array_of(collection.GetPartitionedDataSet(view).GetPartition(0))
    margin = pixels.shape[0] // 16
    pixels = pixels[margin:-margin, margin:-margin]
    factor = pixels.shape[0] // side
    spare = (pixels.shape[0] - side * factor) // 2
    return shrunk(pixels[spare:, spare:], factor)[:side, :side]


def octants_picture(grid, width, height, **where):
    def behind_the_cut(centres):
        return (centres[:, 0] < 0.0) | (centres[:, 1] > 0.0)

    octants = paint(cut_open(grid, behind_the_cut), "State", OCTANTS.get)
    return picture(actor(octants, flat=True, edges=True), width, height, **where)


def jug():
    """README's opener: photographs and silhouettes of a jug, the octree cut open, and the mesh."""
    pipeline = Pipeline(vtkSyntheticCaptureSource.JUG, 7, 896)
    mesh = result(pipeline.hulls)
    pipeline.octree.SetDepth(5)
    octree = result(pipeline.octree)
    pipeline.capture.Update(2)
    gap, side = 8, 196
    photographs, masks = pipeline.capture.GetPhotographsOutput(), pipeline.capture.GetOutput()
    columns = []
    for view in (15, 18):
        column = np.vstack([view_image(photographs, view, side), np.full((gap, side, 3), 255, np.uint8),
                            view_image(masks, view, side)])
        columns += [column, np.full((2 * side + gap, gap, 3), 255, np.uint8)]
    where = {"half_height": 1.06, "centre": (-0.03, 0.0, 0.0), "turn": -55.0}
    return np.hstack([framed(np.hstack(columns[:-1]), 410, 420), octants_picture(octree, 400, 420, **where),
                      picture(actor(mesh, CLAY), 390, 420, **where)])


def octree():
    """The jug's octree at depths 4, 5 and 6, cut open, by state: intersection octants, inside octants."""
    pipeline = Pipeline(vtkSyntheticCaptureSource.JUG, 4)
    pictures = []
    for depth in (4, 5, 6):
        pipeline.octree.SetDepth(depth)
        pictures.append(octants_picture(result(pipeline.octree), 320, 330, half_height=1.2,
                                        centre=(0.0, 0.0, -0.06), turn=-55.0, label=f"depth {depth}"))
    return np.hstack(pictures)


def figure_6_3():
    """Four surfaces of a sphere with camera noise, faithful voting, by the share of votes: inner side red."""
    pipeline = Pipeline(vtkSyntheticCaptureSource.SPHERE, 6, Camera=4.0)
    pipeline.cubes.SetModeToFaithful()
    pipeline.cubes.SetEdgePlacementToMiddle()
    pictures = []
    for share in (1.0, 0.9, 0.8, 0.7):
        pipeline.cubes.SetShare(share)
        pictures.append(picture(actor(result(pipeline.cubes), SAND), 220, 255, 1.14, (0.0, 0.0, -0.12),
                                label=f"{100 * share:.0f} %"))
    return np.hstack(pictures)


def local_hulls():
    """The local hulls of a torus, a colour each, and the surface."""
    pipeline = Pipeline(vtkSyntheticCaptureSource.TORUS, 6, views=90)
    pipeline.hulls.SetSeedBlock(8)
    hulls = paint(result(pipeline.hulls, 1), "HullId", pastel)
    surface = result(pipeline.hulls)
    where = {"half_height": 0.92, "turn": 120.0, "above": -35.0}
    return np.hstack([picture(actor(hulls, flat=True), 420, 380, **where),
                      picture(actor(surface, BLUE), 420, 380, **where)])


def pastel(number):
    """A soft colour; neighbouring numbers differ."""
    return colorsys.hls_to_rgb(number * 0.61803 % 1.0, 0.74 + 0.06 * (number % 3 - 1), 0.45)


def noise():
    """A torn silhouette, strict marching cubes, and local hulls with three background votes allowed."""
    torn = {"pixels": 640, "Blobs": 12, "Contour": 1.0}
    strict = Pipeline(vtkSyntheticCaptureSource.JUG, 7, **torn)
    forgiving = Pipeline(vtkSyntheticCaptureSource.JUG, 7, background_votes=3, **torn)
    where = {"half_height": 1.02, "centre": (0.0, 0.0, 0.0), "turn": -55.0}
    strict.capture.Update()
    mask = view_image(strict.capture.GetOutput(), torn_view(strict.capture), 280)
    return np.hstack([framed(mask, 310, 340),
                      picture(actor(result(strict.cubes), SAND), 310, 340, **where),
                      picture(actor(result(forgiving.hulls), BLUE), 310, 340, **where)])


def torn_view(capture):
    """The view whose silhouette has lost most of the photograph's object."""
    clean = vtkSyntheticCaptureSource()
    clean.SetWidth(capture.GetWidth())
    clean.SetHeight(capture.GetHeight())
    clean.Update()
    lost = [np.count_nonzero(array_of(clean.GetOutput().GetPartitionedDataSet(view).GetPartition(0))) -
            np.count_nonzero(array_of(capture.GetOutput().GetPartitionedDataSet(view).GetPartition(0)))
            for view in range(capture.GetNumberOfViews())]
    return int(np.argmax(lost))


def pipeline():
    """What each output of the pipeline holds, from a folder of photographs to hulls."""
    width, height = 300, 310
    made = Pipeline(vtkSyntheticCaptureSource.JUG, 6, 560)
    with tempfile.TemporaryDirectory() as folder:
        write_capture(made.capture, folder)
        reader = vtkSilhouetteCaptureReader()
        reader.SetFileName(folder)
        extractor = vtkSilhouetteExtractor()
        extractor.SetInputConnection(reader.GetOutputPort())
        extractor.SetKeyChannelToBlue()
        made.octree.SetInputConnection(extractor.GetOutputPort())
        mesh = result(made.hulls)
    made.hulls.SetSeedBlock(8)
    hulls = paint(result(made.hulls, 1), "HullId", pastel)
    made.octree.SetDepth(5)
    octants = result(made.octree)
    where = {"half_height": 1.2, "centre": (-0.03, 0.0, -0.12), "turn": -55.0}
    return np.vstack([
        np.hstack([captioned(view_image(reader.GetOutput(), 15, 240), width, height, "reader, 0: photographs"),
                   cameras_picture(reader.GetCamerasOutput(), mesh, width, height, "reader, 1: cameras"),
                   captioned(view_image(extractor.GetOutput(), 15, 240), width, height, "extractor, 0: silhouettes")]),
        np.hstack([octants_picture(octants, width, height, label="octree source, 0: octree", **where),
                   picture(actor(mesh, CLAY), width, height, label="local hull surfacer, 0: mesh", **where),
                   picture(actor(hulls, flat=True), width, height, label="local hull surfacer, 1: hulls", **where)])])


def write_capture(capture, folder):
    """A synthetic capture's photographs as a capture folder: `images/` and `projections.txt`."""
    os.mkdir(os.path.join(folder, "images"))
    views = result(capture, 2)
    writer = vtkPNGWriter()
    with open(os.path.join(folder, "projections.txt"), "w", encoding="utf-8") as file:
        for view in range(views.GetNumberOfPartitionedDataSets()):
            image = views.GetPartitionedDataSet(view).GetPartition(0)
            numbers = image.GetFieldData().GetArray("Projection").GetTuple(0)
            file.write(f"{view:03}.png {' '.join(map(repr, numbers))}\n")
            writer.SetInputData(image)
            writer.SetFileName(os.path.join(folder, "images", f"{view:03}.png"))
            writer.Write()


def cameras_picture(cameras, mesh, width, height, label):
    """The reader's frustums, with the mesh that they look at."""
    lines = actor(cameras, (0.35, 0.42, 0.52), flat=True)
    lines.GetProperty().SetLineWidth(0.6 * SAMPLES)
    lines.GetProperty().LightingOff()
    return picture(lines, width, height, half_height=5.2, turn=-55.0, label=label, beside=actor(mesh, CLAY))


def captioned(pixels, width, height, label):
    """A picture in the middle of a white one, with a label below it."""
    empty = picture(actor(vtkPolyData(), WHITE), width, height, label=label)
    top, left = 20, (width - pixels.shape[1]) // 2
    empty[top:top + pixels.shape[0], left:left + pixels.shape[1]] = pixels
    return empty


FIGURES = {"jug": jug, "octree": octree, "figure-6-3": figure_6_3, "local-hulls": local_hulls, "noise": noise,
           "pipeline": pipeline}


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("figures", nargs="*", metavar="FIGURE", help=", ".join(FIGURES))
    parser.add_argument("--folder", default=os.path.dirname(os.path.abspath(__file__)))
    arguments = parser.parse_args()
    for name in arguments.figures:
        if name not in FIGURES:
            parser.error(f"there is no figure {name}; the figures are {', '.join(FIGURES)}")
    os.makedirs(arguments.folder, exist_ok=True)
    for name in arguments.figures or FIGURES:
        write(FIGURES[name](), os.path.join(arguments.folder, name + ".png"))


if __name__ == "__main__":
    main()
