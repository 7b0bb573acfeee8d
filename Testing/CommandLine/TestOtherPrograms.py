# SPDX-License-Identifier: BSD-3-Clause
"""One capture with its cameras as a P list and as other programs write them: one mesh."""
import filecmp
import json
import math
import shutil
import struct
import unittest
import zipfile

from program import ARGUMENTS, FILES, ProgramTest


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


class Camera:
    """K, R and t of a P list's line: K's rows are taken off the matrix's, from the last to the first."""

    def __init__(self, line):
        self.name, *values = line.split()
        rows = [[float(value) for value in values[4 * row:4 * row + 4]] for row in range(3)]
        scale = math.sqrt(dot(rows[2][:3], rows[2][:3]))
        rows = [[value / scale for value in row] for row in rows]
        forward = rows[2][:3]
        self.centre, self.focal, turned, moved = [], [], [], []
        for row in rows[:2]:
            offset = dot(row[:3], forward)
            rest = [value - offset * along for value, along in zip(row, forward)]
            focal = math.sqrt(dot(rest, rest))
            self.centre.append(offset)
            self.focal.append(focal)
            turned.append([value / focal for value in rest])
            moved.append((row[3] - offset * rows[2][3]) / focal)
        self.rotation = [*turned, forward]
        self.translation = [*moved, rows[2][3]]

    def quaternion(self):
        """w, x, y, z; the squares from the diagonal, the signs from what is beside it, the largest first."""
        m = self.rotation
        signs = ((1, 1, 1), (1, -1, -1), (-1, 1, -1), (-1, -1, 1))
        squares = [1 + sum(sign * m[i][i] for i, sign in enumerate(row)) for row in signs]
        largest = max(range(4), key=squares.__getitem__)
        products = [[0, m[2][1] - m[1][2], m[0][2] - m[2][0], m[1][0] - m[0][1]],
                    [0, 0, m[1][0] + m[0][1], m[0][2] + m[2][0]], [0, 0, 0, m[2][1] + m[1][2]], [0] * 4]
        values = [products[min(i, largest)][max(i, largest)] for i in range(4)]
        values[largest] = squares[largest]
        length = math.sqrt(dot(values, values))
        return [value / length for value in values]

    def to_world(self):
        """Camera to world, the camera's axes right, up and back."""
        right, down, forward = self.rotation
        centre = [-sum(self.rotation[row][axis] * self.translation[row] for row in range(3)) for axis in range(3)]
        return [[right[axis], -down[axis], -forward[axis], centre[axis]] for axis in range(3)] + [[0.0, 0.0, 0.0, 1.0]]

    def parameters(self):
        """fx, fy, cx, cy, the first pixel's centre at (0.5, 0.5)."""
        return [*self.focal, self.centre[0] + 0.5, self.centre[1] + 0.5]


def words(numbers):
    return " ".join(map(repr, numbers))


def write_text(cameras, folder):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "cameras.txt").write_text("# Camera list\n" + "".join(
        f"{7 + place} PINHOLE 128 128 {words(camera.parameters())}\n" for place, camera in enumerate(cameras)))
    (folder / "images.txt").write_text("# Image list\n" + "".join(
        f"{9 * place} {words(camera.quaternion())} {words(camera.translation)} {7 + place} {camera.name}\n1.5 2.5 -1\n"
        for place, camera in reversed(list(enumerate(cameras)))))


def write_binary(cameras, folder):
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "cameras.bin").write_bytes(struct.pack("<Q", len(cameras)) + b"".join(
        struct.pack("<iiQQ4d", 7 + place, 1, 128, 128, *camera.parameters()) for place, camera in enumerate(cameras)))
    (folder / "images.bin").write_bytes(struct.pack("<Q", len(cameras)) + b"".join(
        struct.pack("<I7dI", 9 * place, *camera.quaternion(), *camera.translation, 7 + place) + camera.name.encode() + b"\0" +
        struct.pack("<Qddq", 1, 1.5, 2.5, -1) for place, camera in reversed(list(enumerate(cameras)))))


def write_transforms(cameras, folder):
    frames = [{"file_path": "images/" + camera.name, "mask_path": "masks/" + camera.name, "transform_matrix": camera.to_world(),
               **dict(zip(("fl_x", "fl_y", "cx", "cy"), camera.parameters()))} for camera in cameras]
    (folder / "transforms.json").write_text(json.dumps({"w": 128, "h": 128, "camera_model": "OPENCV", "frames": frames}))


def write_opencv(cameras, folder):
    def matrix(name, rows, columns, values):
        return f"{name}: !!opencv-matrix\n         rows: {rows}\n         cols: {columns}\n         dt: d\n         data: [ {', '.join(map(repr, values))} ]\n"
    views = "".join(f"   -\n      image: \"{camera.name}\"\n      "
                    + matrix("camera_matrix", 3, 3, [camera.focal[0], 0.0, camera.centre[0], 0.0, camera.focal[1], camera.centre[1], 0.0, 0.0, 1.0]) + "      "
                    + matrix("R", 3, 3, sum(camera.rotation, [])) + "      " + matrix("tvec", 3, 1, camera.translation) for camera in cameras)
    (folder / "cameras.yml").write_text("%YAML:1.0\n---\nimage_width: 128\nimage_height: 128\nviews:\n" + views)


def write_metashape(cameras, folder):
    sensors = "".join(f"<sensor id='{place}' type='frame'><resolution width='128' height='128'/><calibration type='frame' class='adjusted'>"
                      f"<f>{camera.focal[1]!r}</f><b1>{camera.focal[0] - camera.focal[1]!r}</b1><cx>{camera.centre[0] + 0.5 - 64!r}</cx>"
                      f"<cy>{camera.centre[1] + 0.5 - 64!r}</cy></calibration></sensor>" for place, camera in enumerate(cameras))
    poses = ""
    for place, camera in enumerate(cameras):
        back = [[column if axis in (0, 3) else -column for axis, column in enumerate(row)] for row in camera.to_world()]
        poses += (f"<camera id='{place}' sensor_id='{place}' label='{camera.name[:-len('.png')]}'><transform>"
                  + words(sum(back[:3], []) + [0.0, 0.0, 0.0, 1.0]) + "</transform></camera>")
    (folder / "export.xml").write_text("<?xml version='1.0' encoding='UTF-8'?>\n<document version='1.5.0'><chunk label='Chunk 1' enabled='true'><sensors>"
                                       + sensors + "</sensors><cameras>" + poses + "</cameras></chunk></document>")


def write_pmvs(lines, folder):
    (folder / "txt").mkdir()
    for place, line in enumerate(lines):
        values = line.split()[1:]
        (folder / "txt" / f"{place:08d}.txt").write_text("CONTOUR\n" + "".join(" ".join(values[4 * row:4 * row + 4]) + "\n" for row in range(3)))
    (folder / "images").rename(folder / "visualize")
    for kind in ("visualize", "masks"):
        for place, file in enumerate(sorted((folder / kind).iterdir())):
            file.rename(folder / kind / f"{place:08d}.png")


def write_neus(lines, folder):
    with zipfile.ZipFile(folder / "cameras_sphere.npz", "w", zipfile.ZIP_DEFLATED) as archive:
        for place, line in enumerate(lines):
            for name, values in (("world", [float(value) for value in line.split()[1:]] + [0.0, 0.0, 0.0, 1.0]), ("scale", [2.0] * 16)):
                header = "{'descr': '<f8', 'fortran_order': False, 'shape': (4, 4), }"
                header += " " * (-(10 + len(header) + 1) % 64) + "\n"
                archive.writestr(f"{name}_mat_{place}.npy",
                                 b"\x93NUMPY\x01\x00" + struct.pack("<H", len(header)) + header.encode() + struct.pack("<16d", *values))
    (folder / "images").rename(folder / "image")
    (folder / "masks").rename(folder / "mask")


class OtherProgramsTest(ProgramTest):
    def setUp(self):
        super().setUp()
        self.lines = (self.capture / "projections.txt").read_text().splitlines()
        self.cameras = [Camera(line) for line in self.lines]
        self.copy = self.copy_of_capture()
        (self.copy / "projections.txt").unlink()

    def mesh(self, name, *arguments, capture=None):
        self.reconstruct(*arguments, capture=capture or self.copy, mesh=name)
        return self.folder / name

    def assert_close(self, mesh, capture=None):
        expected = self.mesh("expected.obj", capture=self.capture)
        found = self.evaluate(mesh, "--truth", expected, capture=capture or self.copy)
        self.assertLess(found["truth_hausdorff"], 1e-6)

    def test_colmap(self):
        write_text(self.cameras, self.copy / "sparse" / "0")
        text = self.mesh("text.obj")
        self.assert_close(text)
        self.assertTrue(filecmp.cmp(text, self.mesh("images.obj", capture=self.copy / "sparse" / "0" / "images.txt"), False))
        shutil.rmtree(self.copy / "sparse")
        write_binary(self.cameras, self.copy / "sparse")
        self.assertTrue(filecmp.cmp(text, self.mesh("binary.obj"), False))
        self.assertTrue(filecmp.cmp(text, self.mesh("folder.obj", capture=self.copy / "sparse"), False))

    def test_transforms(self):
        write_transforms(self.cameras, self.copy)
        mesh = self.mesh("transforms.obj")
        self.assert_close(mesh)
        self.assertTrue(filecmp.cmp(mesh, self.mesh("json.obj", capture=self.copy / "transforms.json"), False))

    def test_opencv(self):
        write_opencv(self.cameras, self.copy)
        self.assert_close(self.mesh("opencv.obj"))

    def test_metashape(self):
        write_metashape(self.cameras, self.copy)
        self.assert_close(self.mesh("metashape.obj"))

    def test_pmvs(self):
        write_pmvs(self.lines, self.copy)
        self.assert_close(self.mesh("pmvs.obj"))
        self.assert_close(self.mesh("txt.obj", capture=self.copy / "txt"))

    def test_neus(self):
        write_neus(self.lines, self.copy)
        self.assert_close(self.mesh("neus.obj"))
        self.assert_close(self.mesh("npz.obj", capture=self.copy / "cameras_sphere.npz"))

    def test_masks_in_the_images_place(self):
        write_transforms(self.cameras, self.copy)
        data = json.loads((self.copy / "transforms.json").read_text())
        for frame in data["frames"]:
            del frame["mask_path"]
            frame["file_path"] = "./masks/" + frame["file_path"][len("images/"):-len(".png")]  # as Blender's: no extension
        (self.copy / "transforms.json").write_text(json.dumps(data))
        self.assert_close(self.mesh("blender.obj"))

    def test_views_and_families(self):
        write_text(self.cameras, self.copy)
        self.bad(ARGUMENTS, ["--views", "99"], "reconstruct", self.copy, "-o", self.folder / "mesh.ply", "--views", "99")
        self.bad(ARGUMENTS, ["--pixels", "states its pixel family, corner"], "reconstruct", self.copy, "-o", self.folder / "mesh.ply", "--pixels", "corner")
        self.reconstruct("--pixels", "integer", capture=self.copy)  # as without: no list's family is asked for

    def test_sizes_are_held_against_the_images(self):
        write_text(self.cameras, self.copy)
        path = self.copy / "cameras.txt"
        path.write_text(path.read_text().replace("PINHOLE 128 128", "PINHOLE 256 192"))
        self.bad(FILES, ["view_000.png has 128 x 128 pixels, its camera is for 256 x 192"], "reconstruct", self.copy, "-o",
                 self.folder / "mesh.ply")

    def test_inputs_are_kept(self):
        write_text(self.cameras, self.copy / "sparse")
        write_transforms(self.cameras, self.folder)
        shutil.copytree(self.copy / "images", self.folder / "images")
        shutil.copytree(self.copy / "masks", self.folder / "other")
        path = self.folder / "transforms.json"
        path.write_text(path.read_text().replace('"masks/', '"other/'))
        for capture, file in ((self.copy, self.copy / "sparse" / "cameras.txt"), (self.copy, self.copy / "sparse" / "images.txt"),
                              (self.folder, path), (self.folder, self.folder / "other" / "view_003.png")):
            with self.subTest(file):
                before = file.read_bytes()
                (self.folder / "link.json").unlink(missing_ok=True)
                (self.folder / "link.json").symlink_to(file)
                self.bad(ARGUMENTS, ["would take the place of the input", file.name], "reconstruct", capture, "-o", self.folder / "mesh.ply",
                         "--metrics", self.folder / "link.json")
                self.assertEqual(file.read_bytes(), before)


if __name__ == "__main__":
    unittest.main()
