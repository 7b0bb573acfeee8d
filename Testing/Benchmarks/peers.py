# SPDX-License-Identifier: BSD-3-Clause
"""Reconstruct a capture as people do without us: one peer, one process.

    python3 peers.py numpy|open3d CAPTURE N MESH.ply

CAPTURE is a folder with masks/ and projections.txt, N the voxels a side of the cube from -1 to 1. Writes the mesh, closed by
marching cubes (VTK's flying edges), and prints one JSON object: seconds of carving and contouring, without reading the masks
and without what turns one library's voxels into another's, and the peak memory of carving.
"""
import json
import pathlib
import resource
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkFlyingEdges3D
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOPLY import vtkPLYWriter


def read_views(capture):
    """Masks (boolean, top row first) and 3 x 4 projections."""
    views = []
    for line in (capture / "projections.txt").read_text().splitlines():
        words = line.split()
        if len(words) != 13 or words[0].startswith("#"):
            continue
        reader = vtkPNGReader()
        reader.SetFileName(str(capture / "masks" / words[0]))
        reader.Update()
        image = reader.GetOutput()
        width, height, _ = image.GetDimensions()
        pixels = vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[::-1, :, 0]
        views.append((np.ascontiguousarray(pixels > 127), np.array(words[1:], dtype=float).reshape(3, 4)))
    return views


def voxel_centres(n):
    return (np.arange(n) + 0.5) * (2.0 / n) - 1.0


def carve_numpy(views, n):
    """The script that everybody writes: every voxel's centre in every view."""
    axis = voxel_centres(n)
    x, y, z = np.meshgrid(axis, axis, axis, indexing="ij")
    points = np.stack([x.ravel(), y.ravel(), z.ravel(), np.ones(n ** 3)])
    occupied = np.ones(n ** 3, dtype=bool)
    for mask, projection in views:
        height, width = mask.shape
        u, v, w = projection @ points
        column, row = np.rint(u / w).astype(int), np.rint(v / w).astype(int)
        seen = (column >= 0) & (column < width) & (row >= 0) & (row < height)
        inside = np.zeros(n ** 3, dtype=bool)
        inside[seen] = mask[row[seen], column[seen]]
        occupied &= inside
    return occupied.reshape(n, n, n)


def decompose(projection):
    """K, R and t of a metric projection."""
    flip = np.eye(3)[::-1]
    q, r = np.linalg.qr((flip @ projection[:, :3]).T)
    k, rotation = flip @ r.T @ flip, flip @ q.T
    signs = np.diag(np.sign(np.diag(k)))
    k, rotation = k @ signs, signs @ rotation
    t = np.linalg.solve(k, projection[:, 3])
    return k / k[2, 2], rotation * np.sign(np.linalg.det(rotation)), t * np.sign(np.linalg.det(rotation))


def carve_open3d(views, n):
    """VoxelGrid.carve_silhouette. Masks go in as float: of a uint8 mask it silently makes an empty grid."""
    import open3d as o3d
    edge = 2.0 / n
    grid = o3d.geometry.VoxelGrid.create_dense(width=2.0, height=2.0, depth=2.0, voxel_size=edge,
                                               origin=[-1.0, -1.0, -1.0], color=[1.0, 1.0, 1.0])
    for mask, projection in views:
        height, width = mask.shape
        k, rotation, t = decompose(projection)
        camera = o3d.camera.PinholeCameraParameters()
        camera.intrinsic = o3d.camera.PinholeCameraIntrinsic(width, height, k[0, 0], k[1, 1], k[0, 2], k[1, 2])
        camera.intrinsic.intrinsic_matrix = k
        extrinsic = np.eye(4)
        extrinsic[:3, :3], extrinsic[:3, 3] = rotation, t
        camera.extrinsic = extrinsic
        grid.carve_silhouette(o3d.geometry.Image(mask.astype(np.float32)), camera, keep_voxels_outside_image=False)
    return grid


def voxels_of(grid, n):
    """Open3D's voxels as an array: a loop in Python, which counts against nobody."""
    occupied = np.zeros((n + 2, n + 2, n + 2), dtype=bool)
    for voxel in grid.get_voxels():
        occupied[tuple(voxel.grid_index)] = True
    return occupied[:n, :n, :n]


def contour(occupied, n):
    """Flying edges over the voxels' centres, padded by one layer of outside."""
    padded = np.zeros((n + 2,) * 3, dtype=np.uint8)
    padded[1:-1, 1:-1, 1:-1] = occupied
    image = vtkImageData()
    image.SetDimensions(n + 2, n + 2, n + 2)
    image.SetSpacing(2.0 / n, 2.0 / n, 2.0 / n)
    image.SetOrigin(*(3 * [-1.0 - 1.0 / n]))
    values = np.ascontiguousarray(padded.transpose(2, 1, 0)).ravel()
    image.GetPointData().SetScalars(numpy_to_vtk(values))
    edges = vtkFlyingEdges3D()
    edges.SetInputData(image)
    edges.SetValue(0, 0.5)
    edges.ComputeNormalsOff()
    edges.Update()
    return edges


def main():
    if len(sys.argv) != 5 or sys.argv[1] not in ("numpy", "open3d"):
        sys.exit("usage: peers.py numpy|open3d CAPTURE N MESH.ply")
    kind, capture, n, mesh = sys.argv[1], pathlib.Path(sys.argv[2]), int(sys.argv[3]), pathlib.Path(sys.argv[4])
    views = read_views(capture)
    result = {"side": kind, "cells": n, "seconds": {}, "cpu_seconds": {}}

    def timed(name, work):
        start, before = time.perf_counter(), time.process_time()
        value = work()
        result["seconds"][name] = time.perf_counter() - start
        result["cpu_seconds"][name] = time.process_time() - before
        return value

    occupied = timed("carve", lambda: (carve_numpy if kind == "numpy" else carve_open3d)(views, n))
    result["memory_mib"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024.0
    if kind == "open3d":
        occupied = voxels_of(occupied, n)
    edges = timed("contour", lambda: contour(occupied, n))
    writer = vtkPLYWriter()
    writer.SetFileName(str(mesh))
    writer.SetInputConnection(edges.GetOutputPort())
    writer.Write()
    result["faces"] = edges.GetOutput().GetNumberOfPolys()
    print(json.dumps(result))


if __name__ == "__main__":
    main()
