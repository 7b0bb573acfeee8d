# SPDX-License-Identifier: BSD-3-Clause
"""Examples/Python/projections_from_cameras.py: cameras that are known, written as other programs write them, project as
they did; what cannot be a matrix is refused, with file, line or view, and value; the program reads the list."""

import json
import os
import pathlib
import re
import shlex
import struct
import subprocess
import sys
import tempfile
import unittest

import numpy as np

TREE = pathlib.Path(__file__).resolve().parents[2]
SCRIPT = TREE / "Examples" / "Python" / "projections_from_cameras.py"
PROGRAM = pathlib.Path(os.environ["SILHOUETTE_PREFIX"]) / os.environ["SILHOUETTE_PROGRAM"]
WIDTH, HEIGHT = 640, 480
NAMES = ("a.png", "with blank.png", "#c.png")


class Camera:
    """A pinhole camera whose pixels count from the centre of the top-left one; x right, y down, z forward."""

    def __init__(self, seed, fx=700.0, fy=690.0, cx=310.25, cy=251.5):
        random = np.random.default_rng(seed)
        self.fx, self.fy, self.cx, self.cy = fx, fy, cx, cy
        self.rotation, _ = np.linalg.qr(random.normal(size=(3, 3)))
        self.rotation *= np.sign(np.linalg.det(self.rotation))
        self.translation = np.array([*random.uniform(-0.3, 0.3, 2), 5.0])

    def pixels(self, points):
        """Closed form, coordinate by coordinate."""
        x, y, z = (points @ self.rotation.T + self.translation).T
        return np.stack([self.fx * x / z + self.cx, self.fy * y / z + self.cy], axis=1)

    def k(self):
        return [[self.fx, 0.0, self.cx], [0.0, self.fy, self.cy], [0.0, 0.0, 1.0]]

    def rotation_vector(self):
        """Axis and angle, from the matrix's trace and its skew part."""
        angle = np.arccos((np.trace(self.rotation) - 1.0) / 2.0)
        skew = self.rotation - self.rotation.T
        return angle / (2.0 * np.sin(angle)) * np.array([skew[2, 1], skew[0, 2], skew[1, 0]])

    def quaternion(self):
        """w, x, y, z, from axis and angle."""
        vector = self.rotation_vector()
        angle = np.linalg.norm(vector)
        return np.array([np.cos(angle / 2.0), *(np.sin(angle / 2.0) * vector / angle)])

    def to_world(self):
        """The matrix that brings the camera's right, up and back to the world."""
        matrix = np.eye(4)
        right, down, forward = self.rotation
        matrix[:3] = np.stack([right, -down, -forward, -self.rotation.T @ self.translation], axis=1)
        return matrix.tolist()


def cameras(**intrinsics):
    return [Camera(seed, **intrinsics) for seed in range(len(NAMES))]


class ProjectionsTest(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.list = self.folder / "projections.txt"

    def convert(self, kind, name):
        return subprocess.run([sys.executable, SCRIPT, kind, name, "projections.txt"], cwd=self.folder, timeout=60,
                              stdout=subprocess.PIPE, stderr=subprocess.PIPE, universal_newlines=True)

    def matrices(self, kind, name):
        done = self.convert(kind, name)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return self.listed()

    def listed(self):
        """The matrices of the list, by name."""
        lines = [shlex.split(line) for line in self.list.read_text(encoding="utf-8").splitlines()]
        return {line[0]: np.array(line[1:], dtype=float).reshape(3, 4) for line in lines}

    def assert_projects(self, matrices, expected, names=NAMES):
        self.assertEqual(tuple(matrices), tuple(names))
        points = np.random.default_rng(9).uniform(-1.0, 1.0, (50, 3))
        for matrix, camera in zip(matrices.values(), expected):
            found = np.column_stack([points, np.ones(50)]) @ matrix.T
            self.assertGreater(found[:, 2].min(), 0.0, "in front of the camera")
            np.testing.assert_allclose(found[:, :2] / found[:, 2:], camera.pixels(points), rtol=0.0, atol=1e-9)

    def refused(self, kind, name, *words):
        done = self.convert(kind, name)
        self.assertEqual(done.returncode, 1, done.stderr)
        self.assertEqual(len(done.stderr.splitlines()), 1, done.stderr)
        for word in words:
            self.assertIn(word, done.stderr)
        self.assertFalse(self.list.exists())


class Colmap(ProjectionsTest):
    def write(self, models, given=None, points="1.5 2.5 -1 3.5 4.5 17"):
        """The text model of the cameras; an image's numbers are not its place, and one image has no points."""
        (self.folder / "cameras.txt").write_text("# Camera list\n" + "".join(
            f"{7 - place} {model} {WIDTH} {HEIGHT} {parameters}\n" for place, (model, parameters) in enumerate(models)))
        lines = ["# Image list"]
        for place, (name, camera) in enumerate(zip(NAMES, given or cameras())):
            pose = " ".join(repr(float(value)) for value in (*camera.quaternion(), *camera.translation))
            lines += [f"{20 + 3 * place} {pose} {7 - place % len(models)} {name}", "" if place == 1 else points]
        (self.folder / "images.txt").write_text("\n".join(lines) + "\n")

    def edit(self, name, old, new):
        path = self.folder / name
        self.assertIn(old, path.read_text())
        path.write_text(path.read_text().replace(old, new, 1))

    PINHOLE = ("PINHOLE", "700 690 310.75 252")  # the corner family's principal point: half a pixel more

    def test_pinhole(self):
        self.write([self.PINHOLE])
        self.assert_projects(self.matrices("colmap", "."), cameras())

    def test_a_camera_for_each_image(self):
        given = [Camera(0), Camera(1, 500.0, 500.0, 300.0, 200.0), Camera(2, 800.0, 810.0, 319.5, 239.5)]
        self.write([self.PINHOLE, ("SIMPLE_PINHOLE", "500 300.5 200.5"), ("PINHOLE", "800 810 320 240")], given)
        self.assert_projects(self.matrices("colmap", "."), given)

    def test_distortion_is_refused_by_name(self):
        for model, parameters in (("SIMPLE_RADIAL", "700 320 240 0.01"), ("OPENCV", "700 690 320 240 0 0 0 0"),
                                  ("FULL_OPENCV", "700 690 320 240 0 0 0 0 0 0 0 0"), ("NONE_KNOWN", "1 2 3")):
            with self.subTest(model):
                self.write([(model, parameters)])
                self.refused("colmap", ".", "cameras.txt line 2", f"camera 7 has the model {model}", "undistort")

    def test_what_is_wrong_is_named(self):
        for name, old, new, words in (
                ("cameras.txt", "310.75", "", ("cameras.txt line 2", "PINHOLE", "['700', '690', '252']", "4 finite")),
                ("cameras.txt", "310.75", "nan", ("cameras.txt line 2", "'nan'")),
                ("cameras.txt", "700", "-700", ("cameras.txt line 2", "-700")),
                ("cameras.txt", "7 PINHOLE 640 480 700 690 310.75 252", "7 PINHOLE", ("cameras.txt line 2", "'7 PINHOLE'")),
                ("images.txt", " 7 a.png", " 8 a.png", ("images.txt line 2", "'a.png' has camera 8")),
                ("images.txt", " 7 a.png", " a.png", ("images.txt line 2", "expected number, quaternion")),
                ("images.txt", " 5.0 7 a.png", " x5 7 a.png", ("images.txt line 2", "'a.png'", "'x5'")),
                ("images.txt", "20 ", "20 9", ("images.txt line 2", "quaternion of 'a.png' is no rotation")),
                ("images.txt", "1.5 2.5 -1 ", "1.5 2.5 ", ("images.txt line 3", "points of 'a.png'", "5 values")),
                ("images.txt", "with blank.png", "a.png", ("the image name 'a.png' occurs twice",)),
                ("images.txt", "with blank.png", 'a".png', ("the image name 'a\".png' cannot stand",))):
            with self.subTest(f"{old} {new}"):
                self.write([self.PINHOLE])
                self.edit(name, old, new)
                self.refused("colmap", ".", *words)

    def test_a_line_of_points_is_missing(self):
        self.write([self.PINHOLE])
        self.edit("images.txt", "1.5 2.5 -1 3.5 4.5 17\n", "")
        self.refused("colmap", ".", "images.txt line 3", "points of 'a.png'")

    def test_files_are_missing(self):
        self.refused("colmap", ".", "cameras.txt")
        (self.folder / "cameras.txt").write_text("1 PINHOLE 640 480 700 690 320 240\n")
        self.refused("colmap", ".", "images.txt")
        (self.folder / "images.txt").write_text("# nothing\n")
        self.refused("colmap", ".", "no views")


class Nerf(ProjectionsTest):
    def write(self, given, frames=None, **keys):
        frames = frames or [{"file_path": f"./{name}", "transform_matrix": camera.to_world()}
                            for name, camera in zip(NAMES, given)]
        (self.folder / "transforms.json").write_text(json.dumps({**keys, "frames": frames}))
        return frames

    def test_intrinsics_as_numbers(self):
        self.write(cameras(), fl_x=700.0, fl_y=690.0, cx=310.75, cy=252.0, w=WIDTH, h=HEIGHT, camera_model="OPENCV", k1=0.0)
        self.assert_projects(self.matrices("nerf", "transforms.json"), cameras())

    def test_a_frames_own_come_first(self):
        given = cameras()
        given[1] = Camera(1, 500.0, 500.0, 300.0, 200.0)
        frames = self.write(given)
        frames[1].update(fl_x=500.0, fl_y=500.0, cx=300.5, cy=200.5)
        self.write(given, frames, fl_x=700.0, fl_y=690.0, cx=310.75, cy=252.0)
        self.assert_projects(self.matrices("nerf", "transforms.json"), given)

    def test_an_angle_and_the_images_size(self):
        focal = 0.5 * WIDTH / np.tan(0.35)  # the middle of the image: (w - 1) / 2 where the first pixel's centre is 0
        given = cameras(fx=focal, fy=focal, cx=319.5, cy=239.5)
        self.write(given, camera_angle_x=0.7, w=WIDTH, h=HEIGHT)
        self.assert_projects(self.matrices("nerf", "transforms.json"), given)
        self.list.unlink()
        frames = [{"file_path": f"./train/r_{place}", "transform_matrix": camera.to_world()}
                  for place, camera in enumerate(given)]  # as Blender's: no size, no extension
        self.write(given, frames, camera_angle_x=0.7)
        self.refused("nerf", "transforms.json", "transforms.json frame 0, 'train/r_0.png'", '"w" and "h" are not given')
        (self.folder / "train").mkdir()
        for place in range(len(given)):
            (self.folder / "train" / f"r_{place}.png").write_bytes(
                b"\x89PNG\r\n\x1a\n" + struct.pack(">I4sII", 13, b"IHDR", WIDTH, HEIGHT))
        self.assert_projects(self.matrices("nerf", "transforms.json"), given,
                             [f"train/r_{place}.png" for place in range(len(given))])

    def test_what_is_wrong_is_named(self):
        good = {"fl_x": 700.0, "cx": 320.0, "cy": 240.0}
        frame = "transforms.json frame 0, 'a.png'"
        for keys, words in (
                ({**good, "k1": 0.1}, (frame, "k1 is 0.1", "undistort")),
                ({**good, "p2": -1e-5}, (frame, "p2 is -1e-05")),
                ({**good, "camera_model": "OPENCV_FISHEYE"}, (frame, "OPENCV_FISHEYE", "undistort")),
                ({**good, "is_fisheye": True}, (frame, "fisheye")),
                ({**good, "fl_x": "wide"}, (frame, "fl_x is 'wide'")),
                ({**good, "fl_x": 0.0}, (frame, "focal lengths 0")),
                ({"cx": 320.0, "cy": 240.0, "w": WIDTH}, (frame, 'no "camera_angle_x"')),
                ({"camera_angle_x": 0.7, "w": 0, "h": HEIGHT}, (frame, "w is 0.0")),
                ({"camera_angle_x": [], "w": WIDTH, "h": HEIGHT}, (frame, "camera_angle_x is []"))):
            with self.subTest(keys):
                self.write(cameras(), **keys)
                self.refused("nerf", "transforms.json", *words)
        for matrix, words in ((np.eye(3).tolist(), "4 x 4"), (np.diag([2.0, 1, 1, 1]).tolist(), "no rotation"),
                              (np.diag([-1.0, 1, 1, 1]).tolist(), "no rotation"), ("none", "'none'")):
            with self.subTest(matrix):
                self.write((), [{"file_path": "a.png", "transform_matrix": matrix}], **good)
                self.refused("nerf", "transforms.json", frame, "transform_matrix", words)
        for text, words in (("{", "transforms.json: Expecting"), ("[]", 'no "frames"'), ('{"frames": 5}', 'no "frames"'),
                            ('{"frames": [5]}', "frame 0"), ('{"frames": []}', "no views")):
            with self.subTest(text):
                (self.folder / "transforms.json").write_text(text)
                self.refused("nerf", "transforms.json", "transforms.json", words)


class OpenCV(ProjectionsTest):
    def write(self, views, **keys):
        (self.folder / "cameras.json").write_text(json.dumps({**keys, "views": views}))

    def views(self, turn=lambda camera: camera.rotation.tolist()):
        return [{"image": name, "R": turn(camera), "t": camera.translation.tolist()}
                for name, camera in zip(NAMES, cameras())]

    def test_matrices(self):
        self.write(self.views(), K=Camera(0).k(), dist=[0.0, 0.0, 0.0, 0.0, 0.0])
        self.assert_projects(self.matrices("opencv", "cameras.json"), cameras())

    def test_columns_as_solve_pnp_gives_them(self):
        views = self.views(lambda camera: camera.rotation_vector().reshape(3, 1).tolist())
        for view in views:
            view["t"] = [[value] for value in view["t"]]
        self.write(views, K=Camera(0).k(), dist=[[0.0, 0.0, 0.0, 0.0, 0.0]])
        self.assert_projects(self.matrices("opencv", "cameras.json"), cameras())

    def test_a_views_own_matrix(self):
        given = cameras()
        given[2] = Camera(2, 500.0, 510.0, 300.0, 200.0)
        views = self.views()
        views[2]["K"] = given[2].k()
        self.write(views, K=Camera(0).k())
        self.assert_projects(self.matrices("opencv", "cameras.json"), given)

    def test_no_turn_and_skew(self):
        self.write([{"image": "a.png", "R": [0, 0, 0], "t": [0, 0, 2]}], K=[[100, 3, 50], [0, 90, 40], [0, 0, 1]])
        np.testing.assert_array_equal(self.matrices("opencv", "cameras.json")["a.png"],
                                      [[100, 3, 50, 100], [0, 90, 40, 80], [0, 0, 1, 2]])

    def test_what_is_wrong_is_named(self):
        view = "cameras.json view 1, 'with blank.png'"
        for keys, words in (({"dist": [0.0, 0.2]}, ("dist[1] is 0.2", "undistort")), ({"dist": 0.2}, ('no "dist", a list',)),
                            ({"K": [[1, 0], [0, 1]]}, ("K is [[1, 0], [0, 1]]", "3 x 3")),
                            ({"K": [[700, 0, 320], [0, 700, 240], [0, 0, 2]]}, ("K is", "2.0")),
                            ({"K": [[700, 0, 320], [0, -700, 240], [0, 0, 1]]}, ("-700",)),
                            ({"R": (2.0 * np.eye(3)).tolist()}, ("R is no rotation",)),
                            ({"R": [[1, 0], [0]]}, ("R is [[1, 0], 0]",)), ({"R": [1, 2]}, ("R is [1, 2]",)),
                            ({"t": [1, 2]}, ("t is [1, 2]", "3 finite")), ({"t": [0, 0, "far"]}, ("'far'",))):
            with self.subTest(keys):
                views = self.views()
                views[1].update(keys)
                self.write(views, K=Camera(0).k())
                self.refused("opencv", "cameras.json", view, *words)
        for key in ("R", "t", "image"):
            with self.subTest(key):
                views = self.views()
                del views[1][key]
                self.write(views, K=Camera(0).k())
                self.refused("opencv", "cameras.json", "cameras.json view 1", f'no "{key}"')
        self.write(self.views())
        self.refused("opencv", "cameras.json", "view 0", 'no "K"')

    def test_the_input_is_kept(self):
        self.list.write_text(json.dumps({"K": Camera(0).k(), "views": self.views()}))
        before = self.list.read_text()
        done = self.convert("opencv", "projections.txt")
        self.assertEqual(done.returncode, 1)
        self.assertIn("projections.txt is both", done.stderr)
        self.assertEqual(self.list.read_text(), before)


class Document(ProjectionsTest):
    """Documentation/formats.md's commands, one for each format, in a folder that has what they name."""

    def test_its_commands(self):
        text = (TREE / "Documentation" / "formats.md").read_text(encoding="utf-8")
        commands = re.findall(r"^python3 (Examples/Python/projections_from_cameras.py) (\w+) (\S+) (\S+)$", text, re.MULTILINE)
        self.assertEqual([command[1] for command in commands], ["colmap", "nerf", "opencv"])
        Colmap.write(self, [Colmap.PINHOLE])
        Nerf.write(self, cameras(), fl_x=700.0, fl_y=690.0, cx=310.75, cy=252.0)
        OpenCV.write(self, OpenCV.views(self), K=Camera(0).k())
        (self.folder / "my-capture").mkdir()
        (self.folder / "sparse").symlink_to(".")
        (self.folder / "my-capture" / "transforms.json").symlink_to("../transforms.json")
        self.list = self.folder / "my-capture" / "projections.txt"
        for script, *arguments in commands:
            subprocess.run([sys.executable, TREE / script, *arguments], cwd=self.folder, check=True,
                           stdout=subprocess.DEVNULL)
            self.assert_projects(self.listed(), cameras())


class Capture(ProjectionsTest):
    """The program reads the list and finds the capture's mesh: the way there and back through COLMAP's text."""

    def run_program(self, *arguments):
        subprocess.run([PROGRAM, *arguments, "--quiet"], cwd=self.folder, check=True, timeout=60)

    def test_the_mesh(self):
        self.run_program("synthesize", "jug", "--size", "96x96", "--views", "12")
        path = self.folder / "jug" / "projections.txt"
        cameras_text, images_text = "", ""
        for place, line in enumerate(path.read_text().splitlines()):
            name, *values = line.split()
            matrix = np.array(values, dtype=float).reshape(3, 4)
            camera = Camera(0)
            camera.rotation = matrix[:, :3].copy()  # K's rows are taken off the matrix's, from the last to the first
            camera.rotation[2] /= np.linalg.norm(matrix[2, :3])
            matrix /= np.linalg.norm(matrix[2, :3])
            offsets = [matrix[row, :3] @ camera.rotation[2] for row in (0, 1)]
            for row in (0, 1):
                camera.rotation[row] = matrix[row, :3] - offsets[row] * camera.rotation[2]
            focal = [np.linalg.norm(camera.rotation[row]) for row in (0, 1)]
            camera.rotation[:2] /= np.reshape(focal, (2, 1))
            translation = [(matrix[row, 3] - offsets[row] * matrix[2, 3]) / focal[row] for row in (0, 1)] + [matrix[2, 3]]
            pose = " ".join(repr(float(value)) for value in (*camera.quaternion(), *translation))
            numbers = " ".join(repr(float(value)) for value in (*focal, offsets[0] + 0.5, offsets[1] + 0.5))
            cameras_text += f"{place} PINHOLE 96 96 {numbers}\n"
            images_text += f"{place} {pose} {place} {name}\n\n"
        (self.folder / "cameras.txt").write_text(cameras_text)
        (self.folder / "images.txt").write_text(images_text)
        self.run_program("reconstruct", "jug", "-o", "expected.ply", "--depth", "4")
        self.matrices("colmap", ".")
        path.write_text(self.list.read_text())
        self.run_program("reconstruct", "jug", "-o", "found.ply", "--depth", "4", "--truth", "expected.ply",
                         "--metrics", "found.json")
        self.assertLess(json.loads((self.folder / "found.json").read_text())["truth_hausdorff"], 1e-6)


if __name__ == "__main__":
    unittest.main()
