# SPDX-License-Identifier: BSD-3-Clause
"""Every mesh format holds the sound mesh that the metrics tell of."""
import math
import struct
import unittest

from program import ProgramTest


class Formats(ProgramTest):
    def test_read_back_and_sound(self):
        volumes = []
        for extension in ("vtp", "ply", "stl", "obj", "PLY"):
            name = "jug." + extension
            made = self.reconstruct(mesh=name)
            self.assert_sound(made)
            self.assertEqual(made["lost_surface"], 0)
            found = self.evaluate(self.folder / name)
            self.assert_sound(found)
            for key in ("points", "triangles", "components", "genus", "volume", "mean_iou"):
                self.assertEqual(made[key], found[key], name + " " + key)
            volumes.append(made["volume"])
        for volume in volumes:
            self.assertAlmostEqual(volume, volumes[0], delta=1e-4)

    def test_double_precision_is_kept(self):
        self.reconstruct(mesh="jug.obj")
        lines = (self.folder / "jug.obj").read_text().splitlines()
        numbers = [float(word) for line in lines if line.startswith("v ") for word in line.split()[1:]]
        single = [struct.unpack("f", struct.pack("f", number))[0] for number in numbers]
        self.assertGreater(sum(a != b for a, b in zip(numbers, single)), len(numbers) // 2)
        in_obj = self.evaluate(self.folder / "jug.obj")
        self.reconstruct(mesh="jug.vtp")
        in_vtp = self.evaluate(self.folder / "jug.vtp")
        self.assertEqual(in_obj["volume"], in_vtp["volume"])

    def test_binary_stl_size(self):
        made = self.reconstruct(mesh="jug.stl")
        self.assertEqual((self.folder / "jug.stl").stat().st_size, 84 + 50 * made["triangles"])

    def test_every_kind_of_ply(self):
        """Text and binary of both byte orders, wide numbers, many corners, and properties that nobody asked for."""
        corners = 300  # of the caps of a prism, more than a byte counts
        points = [(math.cos(2 * math.pi * n / corners) + 5e5, math.sin(2 * math.pi * n / corners), float(z))
                  for z in (0, 1) for n in range(corners)]
        faces = [tuple(reversed(range(corners))), tuple(range(corners, 2 * corners))]
        faces += [(n, (n + 1) % corners, corners + (n + 1) % corners, corners + n) for n in range(corners)]
        volumes = set()
        for kind in ("ascii", "binary_little_endian", "binary_big_endian"):
            for index in ("vertex_indices", "vertex_index"):
                header = f"ply\nformat {kind} 1.0\ncomment x\nelement vertex {len(points)}\nproperty uchar red\n" \
                         "property double x\nproperty double y\nproperty double z\nproperty float quality\n" \
                         f"element face {len(faces)}\nproperty list ushort int {index}\nproperty short part\n" \
                         "element edge 1\nproperty list uchar uint ends\nend_header\n"
                if kind == "ascii":
                    body = "".join(f"7 {x!r} {y!r} {z!r} 0.5\n" for x, y, z in points)
                    body += "".join(f"{len(face)} {' '.join(map(str, face))} -1\n" for face in faces) + "2 0 1\n"
                    body = body.encode()
                else:
                    order = "<" if "little" in kind else ">"
                    body = b"".join(struct.pack(order + "B3df", 7, *point, 0.5) for point in points)
                    body += b"".join(struct.pack(f"{order}H{len(face)}ih", len(face), *face, -1) for face in faces)
                    body += struct.pack(order + "B2I", 2, 0, 1)
                file = self.folder / "prism.ply"
                file.write_bytes(header.encode() + body)
                found = self.evaluate(file)
                self.assertEqual((found["open_edges"], found["self_intersections"], found["components"]), (0, 0, 1), kind)
                volumes.add(found["volume"])
        self.assertEqual(len(volumes), 1)
        exact = 0.5 * corners * math.sin(2 * math.pi / corners)
        self.assertAlmostEqual(volumes.pop(), exact, places=8)

    def test_truth_in_every_format(self):
        for extension in ("vtp", "stl", "obj"):
            self.reconstruct(mesh="jug." + extension)
            made = self.reconstruct("--truth", self.folder / ("jug." + extension), mesh="same.vtp")
            self.assertLess(made["truth_hausdorff"], 1e-6)


if __name__ == "__main__":
    unittest.main()
