# SPDX-License-Identifier: BSD-3-Clause
"""Cameras of other programs in, a P list out: the projections.txt of a capture.

    python3 projections_from_cameras.py colmap FOLDER projections.txt          cameras.txt and images.txt in FOLDER
    python3 projections_from_cameras.py nerf transforms.json projections.txt   NeRF's, Blender's, nerfstudio's
    python3 projections_from_cameras.py opencv cameras.json projections.txt    {"K": 3 x 3, "views": [{"image": name,
                                                                               "R": 3 x 3 or 3, "t": 3}, ...]}

The list's pixels count from the centre of the top-left one, its cameras' axes are right, down and forward. What has
lens distortion is refused: no matrix holds it.
"""

import argparse
import json
import pathlib
import posixpath
import struct
import sys

import numpy as np

INTEGER, CORNER = 0.0, 0.5  # where a format has the centre of the top-left pixel
IMAGES = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp", ".pgm", ".ppm")
NERF_MODELS = (None, "SIMPLE_PINHOLE", "PINHOLE", "OPENCV")  # the last where its distortion is 0


class Refused(Exception):
    """What is wrong, with file, line or view, and value."""


def numbers(values, shape, what):
    """Finite numbers of that shape, an array."""
    try:
        found = np.array(values, dtype=float)
    except (TypeError, ValueError):
        found = np.array(np.nan)
    if found.shape != shape or not np.isfinite(found).all():
        raise Refused(f"{what} is {values!r}: {' x '.join(map(str, shape)) or 'one'} finite number(s) are needed")
    return found


def rotation(matrix, what):
    if np.abs(matrix @ matrix.T - np.eye(3)).max() > 1e-3 or np.linalg.det(matrix) < 0.0:
        raise Refused(f"{what} is no rotation: {matrix.tolist()}")
    return matrix


def intrinsics(fx, fy, cx, cy, family, what):
    if fx <= 0.0 or fy <= 0.0:
        raise Refused(f"{what}: focal lengths {fx:g} and {fy:g} are not above 0")
    return np.array([[fx, 0.0, cx - family], [0.0, fy, cy - family], [0.0, 0.0, 1.0]])


def undistorted(values, what):
    """Refuses a list of (name, value) where a value is not 0."""
    for name, value in values:
        if numbers(value, (), f"{what}: {name}") != 0.0:
            raise Refused(f"{what}: {name} is {value!r}, lens distortion: undistort the images, and give their cameras")


def member(data, key, what, kind=object):
    if not isinstance(data, dict) or not isinstance(data.get(key), kind) or key not in data:
        raise Refused(f"{what}: no \"{key}\"" + (", a list" if kind is list else ""))
    return data[key]


def flat(values):
    """A row or a column, as OpenCV's arrays are, as a plain list; what is neither as it is."""
    if not isinstance(values, list):
        return values
    if len(values) == 1 and isinstance(values[0], list):
        return values[0]
    return [value[0] if isinstance(value, list) and len(value) == 1 else value for value in values]


def read_json(path):
    try:
        return json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise Refused(f"{path}: {error}") from None


def colmap(folder):
    """Of COLMAP's text model: corner family; quaternion and t bring the world to the camera."""
    cameras = {}
    for line, text in enumerate((folder / "cameras.txt").read_text(encoding="utf-8").splitlines(), 1):
        words = text.split()
        if not words or words[0].startswith("#"):
            continue
        what = f"{folder / 'cameras.txt'} line {line}"
        if len(words) < 4:
            raise Refused(f"{what}: expected number, model, width, height and parameters, found {text!r}")
        count = {"SIMPLE_PINHOLE": 3, "PINHOLE": 4}.get(words[1])
        if count is None:
            raise Refused(f"{what}: camera {words[0]} has the model {words[1]}, neither PINHOLE nor SIMPLE_PINHOLE: "
                          "undistort the images, and give their model")
        values = numbers(words[4:], (count,), f"{what}: the parameters of {words[1]}")
        cameras[words[0]] = intrinsics(values[0], values[-3], *values[-2:], CORNER, what)
    return colmap_views(folder / "images.txt", cameras)


def colmap_views(path, cameras):
    lines = enumerate(path.read_text(encoding="utf-8").splitlines(), 1)
    for line, text in lines:
        if not text.strip() or text.startswith("#"):
            continue
        what = f"{path} line {line}"
        words = text.split(maxsplit=9)
        if len(words) < 10:
            raise Refused(f"{what}: expected number, quaternion, translation, camera and name, found {text!r}")
        pose = numbers(words[1:8], (7,), f"{what}: the pose of '{words[9].strip()}'")
        if words[8] not in cameras:
            raise Refused(f"{what}: '{words[9].strip()}' has camera {words[8]}, which cameras.txt has not")
        points = next(lines, (0, ""))[1].split()  # the image's second line; it may be empty
        if len(points) % 3 != 0:
            raise Refused(f"{path} line {line + 1}: expected the points of '{words[9].strip()}', x, y and number each, "
                          f"found {len(points)} values")
        turn = rotation(quaternion(pose[:4]), f"{what}: the quaternion of '{words[9].strip()}'")
        yield words[9].strip(), cameras[words[8]], turn, pose[4:]


def quaternion(values):
    """The matrix of w, x, y, z; no rotation where its length is not 1."""
    w, x, y, z = values
    return np.array([[w * w + x * x - y * y - z * z, 2 * (x * y - w * z), 2 * (x * z + w * y)],
                     [2 * (x * y + w * z), w * w - x * x + y * y - z * z, 2 * (y * z - w * x)],
                     [2 * (x * z - w * y), 2 * (y * z + w * x), w * w - x * x - y * y + z * z]])


def nerf(path):
    """Of transforms.json: corner family; the matrix brings the camera, right, up and back, to the world."""
    data = read_json(path)
    for number, frame in enumerate(member(data, "frames", path, list)):
        name = posixpath.normpath(str(member(frame, "file_path", f"{path} frame {number}")))
        if pathlib.PurePosixPath(name).suffix.lower() not in IMAGES:
            name += ".png"  # as Blender's leave it out
        what = f"{path} frame {number}, '{name}'"
        given = {**data, **frame}  # a frame's own over those of all
        if given.get("camera_model") not in NERF_MODELS or given.get("is_fisheye"):
            raise Refused(f"{what}: the camera model is {given.get('camera_model', 'fisheye')}: undistort the images, and "
                          "give their cameras")
        undistorted([(key, given[key]) for key in ("k1", "k2", "k3", "k4", "p1", "p2") if key in given], what)
        pose = numbers(member(frame, "transform_matrix", what), (4, 4), f"{what}: transform_matrix")
        turn = rotation(pose[:3, :3] * (1.0, -1.0, -1.0), f"{what}: transform_matrix").T
        yield name, nerf_intrinsics(given, path.parent / name, what), turn, -turn @ pose[:3, 3]


def nerf_intrinsics(given, image, what):
    def value(key, otherwise):
        return float(numbers(given[key], (), f"{what}: {key}")) if key in given else otherwise()

    def size(key):
        length = value(key, lambda: png_size(image, what)["wh".index(key)])
        if length <= 0:
            raise Refused(f"{what}: {key} is {length!r}, not above 0")
        return length

    def from_angle():
        return 0.5 * size("w") / np.tan(0.5 * float(numbers(member(given, "camera_angle_x", what), (),
                                                            f"{what}: camera_angle_x")))

    fx = value("fl_x", from_angle)
    return intrinsics(fx, value("fl_y", lambda: fx), value("cx", lambda: 0.5 * size("w")),
                      value("cy", lambda: 0.5 * size("h")), CORNER, what)


def png_size(image, what):
    """Width and height, from the file's head."""
    head = image.read_bytes()[:24] if image.exists() else b""
    if head[:8] != b"\x89PNG\r\n\x1a\n" or len(head) < 24:
        raise Refused(f"{what}: \"w\" and \"h\" are not given, and {image} is no PNG file that has them")
    return struct.unpack(">II", head[16:])


def opencv(path):
    """Of matrices as OpenCV's calibration has them: integer family; R, a matrix or a rotation vector, and t bring the
    world to the camera. "K" and "dist" stand in a view, or before "views" for all."""
    data = read_json(path)
    for number, view in enumerate(member(data, "views", path, list)):
        name = str(member(view, "image", f"{path} view {number}"))
        what = f"{path} view {number}, '{name}'"
        given = {**data, **view}
        dist = flat(member({"dist": [], **given}, "dist", what, list))
        undistorted([(f"dist[{i}]", value) for i, value in enumerate(dist)], what)
        k = numbers(member(given, "K", what), (3, 3), f"{what}: K")
        if k[1, 0] != 0.0 or (k[2] != (0.0, 0.0, 1.0)).any():
            raise Refused(f"{what}: K is {k.tolist()}: fx s cx, 0 fy cy, 0 0 1 are needed")
        matrix = intrinsics(k[0, 0], k[1, 1], k[0, 2], k[1, 2], INTEGER, what)
        matrix[0, 1] = k[0, 1]
        turn = flat(member(view, "R", what, list))
        if any(isinstance(row, list) for row in turn):
            turn = rotation(numbers(turn, (3, 3), f"{what}: R"), f"{what}: R")
        else:
            turn = rotation_vector(numbers(turn, (3,), f"{what}: R"))
        yield name, matrix, turn, numbers(flat(member(view, "t", what)), (3,), f"{what}: t")


def rotation_vector(vector):
    """The matrix that turns about the vector by its length, radians."""
    angle = np.linalg.norm(vector)
    if angle == 0.0:
        return np.eye(3)
    x, y, z = vector / angle
    cross = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sin(angle) * cross + (1.0 - np.cos(angle)) * (cross @ cross)


def p_list(views, source):
    """The text of a P list; a view is (image name, K, R, t)."""
    lines = {}
    for name, k, turn, translation in views:
        if name in lines or '"' in name or not name:
            raise Refused(f"{source}: the image name '{name}' " +
                          ("occurs twice" if name in lines else "cannot stand in a list"))
        quote = '"' if name.startswith("#") or any(letter.isspace() for letter in name) else ""
        matrix = k @ np.column_stack([turn, translation])
        lines[name] = " ".join([f"{quote}{name}{quote}", *(repr(float(value)) for value in matrix.ravel())])
    if not lines:
        raise Refused(f"{source}: no views")
    return "".join(line + "\n" for line in lines.values())


def main():
    readers = {"colmap": colmap, "nerf": nerf, "opencv": opencv}
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("format", choices=readers)
    parser.add_argument("cameras", type=pathlib.Path)
    parser.add_argument("list", type=pathlib.Path)
    arguments = parser.parse_args()
    try:
        text = p_list(readers[arguments.format](arguments.cameras), arguments.cameras)
        if arguments.list.exists() and arguments.list.samefile(arguments.cameras):
            raise Refused(f"{arguments.list} is both what is read and what is to be written")
        whole = arguments.list.with_name(arguments.list.name + ".part")
        whole.write_text(text, encoding="utf-8")
        whole.replace(arguments.list)
    except (Refused, OSError, UnicodeDecodeError) as error:
        sys.exit(f"projections_from_cameras.py: {error}")
    print(f"{arguments.list}: {len(text.splitlines())} views")


if __name__ == "__main__":
    main()
