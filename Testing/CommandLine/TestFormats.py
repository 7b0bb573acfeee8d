# SPDX-License-Identifier: BSD-3-Clause
"""Every mesh format holds the sound mesh that the metrics tell of."""
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

    def test_truth_in_every_format(self):
        for extension in ("vtp", "stl", "obj"):
            self.reconstruct(mesh="jug." + extension)
            made = self.reconstruct("--truth", self.folder / ("jug." + extension), mesh="same.vtp")
            self.assertLess(made["truth_hausdorff"], 1e-6)


if __name__ == "__main__":
    unittest.main()
