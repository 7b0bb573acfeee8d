# SPDX-License-Identifier: BSD-3-Clause
"""Masks as numpy arrays in, a mesh as numpy arrays out: a ball, whose volume is known.

    python3 numpy_masks.py MESH.obj

The masks could as well come from a segmentation network, the matrices from a calibration by OpenCV: pixels count
from the centre of the top-left one, row 0 is at the top.
"""

import sys

import numpy as np

from vtksilhouette.numpy_front import reconstruct

RADIUS, SIZE, FOCAL, DISTANCE = 0.5, 200, 400.0, 3.0  # the ball's; pixels; pixels; to the ball's centre, the origin


def camera(direction):
    """The 3 x 4 matrix of a camera that looks at the origin from `direction`, a unit vector."""
    right = np.cross(-direction, [0.1, 0.2, 1.0])
    right /= np.linalg.norm(right)
    rotation = np.stack([right, np.cross(-direction, right), -direction])  # rows: right, down, forward
    middle = (SIZE - 1) / 2
    intrinsics = np.array([[FOCAL, 0.0, middle], [0.0, FOCAL, middle], [0.0, 0.0, 1.0]])
    return intrinsics @ np.column_stack([rotation, [0.0, 0.0, DISTANCE]])


def mask():
    """The ball as each of these cameras sees it: a disc, True where a pixel's centre lies in it."""
    radius = FOCAL * RADIUS / np.sqrt(DISTANCE**2 - RADIUS**2)
    rows, columns = np.indices((SIZE, SIZE)) - (SIZE - 1) / 2
    return rows**2 + columns**2 < radius**2


def volume(points, triangles):
    """Of a closed mesh, in the cubed unit of the cameras."""
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    return np.sum(a * np.cross(b, c)) / 6.0


def main(path):
    directions = np.random.default_rng(1).normal(size=(40, 3))
    directions /= np.linalg.norm(directions, axis=1, keepdims=True)
    masks = [mask() for _ in directions]
    projections = [camera(direction) for direction in directions]

    points, triangles = reconstruct(masks, projections, depth=6)

    ball = 4.0 / 3.0 * np.pi * RADIUS**3
    print(f"{len(triangles)} triangles, volume {volume(points, triangles):.4f}, of the ball {ball:.4f}")
    with open(path, "w", encoding="ascii") as file:
        np.savetxt(file, points, "v %.17g %.17g %.17g")
        np.savetxt(file, triangles + 1, "f %d %d %d")  # OBJ counts from 1


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    main(sys.argv[1])
