# SPDX-License-Identifier: BSD-3-Clause
"""A folder of photographs in, a mesh and its picture out, by VTK's pipeline.

    python3 -m vtksilhouette.offscreen photographs_to_mesh.py CAPTURE MESH.ply PICTURE.png [--depth N]

CAPTURE holds photographs on a blue background and their cameras (`vtksilhouette synthesize jug` makes one).
The mesh is, byte for byte, that of

  vtksilhouette reconstruct CAPTURE --carving strict --key blue:0.08 --largest-region -o MESH.ply
"""

import argparse
import sys

import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  what renders
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOPLY import vtkPLYWriter
from vtkmodules.vtkRenderingCore import (
    vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow, vtkWindowToImageFilter)

from vtksilhouette import (vtkLocalHullSurfacer, vtkSilhouetteCaptureReader, vtkSilhouetteExtractor,
                           vtkSilhouetteOctreeSource, vtkVotingMarchingCubes)

parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
parser.add_argument("capture")
parser.add_argument("mesh")
parser.add_argument("picture")
parser.add_argument("--depth", type=int, default=8)
arguments = parser.parse_args()

# The pipeline: each filter's output is the next one's input. Nothing runs before Update().
reader = vtkSilhouetteCaptureReader()
reader.SetFileName(arguments.capture)
reader.SetImageChoiceToPhotographs()

extractor = vtkSilhouetteExtractor()
extractor.SetInputConnection(reader.GetOutputPort())
extractor.SetKeyChannelToBlue()
extractor.LargestRegionOn()

octree = vtkSilhouetteOctreeSource()
octree.SetInputConnection(extractor.GetOutputPort())
octree.SetDepth(arguments.depth)

cubes = vtkVotingMarchingCubes()
cubes.SetInputConnection(octree.GetOutputPort(0))
cubes.SetViewsConnection(octree.GetOutputPort(1))

hulls = vtkLocalHullSurfacer()
hulls.SetInputConnection(cubes.GetOutputPort())
hulls.SetOctreeConnection(octree.GetOutputPort(0))
hulls.SetViewsConnection(octree.GetOutputPort(1))
hulls.SetOutputPointsPrecision(hulls.SINGLE_PRECISION)  # what a PLY file keeps: sound as stored

hulls.Update()
mesh = hulls.GetOutput()
if mesh.GetNumberOfPolys() == 0:
    sys.exit(f"{arguments.capture}: no mesh; VTK's messages above say why")
print(f"{mesh.GetNumberOfPoints()} points, {mesh.GetNumberOfPolys()} triangles")

writer = vtkPLYWriter()
writer.SetInputConnection(hulls.GetOutputPort())
writer.SetFileName(arguments.mesh)
writer.Write()

# The picture: the mesh from where the first camera stood, upright as its photograph. The reader's second output
# has five points a camera: its centre and its image's corners, clockwise from the top left.
normals = vtkPolyDataNormals()
normals.SetInputConnection(hulls.GetOutputPort())
normals.SplittingOff()
mapper = vtkPolyDataMapper()
mapper.SetInputConnection(normals.GetOutputPort())
actor = vtkActor()
actor.SetMapper(mapper)
actor.GetProperty().SetColor(0.86, 0.80, 0.72)
renderer = vtkRenderer()
renderer.SetBackground(1.0, 1.0, 1.0)
renderer.AddActor(actor)
centre, top, _, _, bottom = (reader.GetCamerasOutput().GetPoint(number) for number in range(5))
view = renderer.GetActiveCamera()
view.SetPosition(centre)
view.SetFocalPoint(mesh.GetCenter())
view.SetViewUp([upper - lower for upper, lower in zip(top, bottom)])
renderer.ResetCamera()

window = vtkRenderWindow()
window.SetSize(600, 600)
window.AddRenderer(renderer)
pixels = vtkWindowToImageFilter()
pixels.SetInput(window)
pixels.ReadFrontBufferOff()
picture = vtkPNGWriter()
picture.SetInputConnection(pixels.GetOutputPort())
picture.SetFileName(arguments.picture)
picture.Write()
if writer.GetErrorCode() or picture.GetErrorCode():
    sys.exit("not all could be written; VTK's messages above say why")
