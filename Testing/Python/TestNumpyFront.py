# SPDX-License-Identifier: BSD-3-Clause
"""Masks as numpy arrays in, a mesh as numpy arrays out, on a sphere that is known in closed form."""

import unittest
import warnings

import numpy as np

from vtksilhouette.numpy_front import octree, reconstruct

RADIUS = 0.7
CENTRE = np.array([0.3, -0.2, 0.5])
SIZE = (140, 180)  # rows, columns


def camera(direction):
    """A camera at distance 5 from the sphere, looking at a point beside it so that nothing is symmetric."""
    forward = -direction / np.linalg.norm(direction)
    right = np.cross(forward, [0.1, 0.2, 1.0])
    right /= np.linalg.norm(right)
    down = np.cross(forward, right)
    rotation = np.stack([right, down, forward])
    position = CENTRE + np.array([0.05, 0.1, -0.02]) - 5.0 * forward
    intrinsics = np.array([[350.0, 0.0, 88.0], [0.0, 350.0, 71.0], [0.0, 0.0, 1.0]])
    return intrinsics @ np.hstack([rotation, -(rotation @ position)[:, np.newaxis]])


def mask_of(projection, centre=CENTRE, radius=RADIUS):
    """Pixels whose centre's ray meets a sphere; row 0 at the top."""
    inverse = np.linalg.inv(projection[:, :3])
    position = -inverse @ projection[:, 3]
    rows, columns = np.mgrid[0:SIZE[0], 0:SIZE[1]]
    rays = np.stack([columns, rows, np.ones(SIZE)], axis=-1) @ inverse.T
    rays /= np.linalg.norm(rays, axis=-1, keepdims=True)
    offset = centre - position
    return np.linalg.norm(offset - (rays @ offset)[..., np.newaxis] * rays, axis=-1) < radius


def capture(count=20):
    """Views spread over the sphere of directions (golden spiral)."""
    index = np.arange(count) + 0.5
    z = 1.0 - 2.0 * index / count
    angle = index * np.pi * (3.0 - np.sqrt(5.0))
    directions = np.stack([np.sqrt(1 - z**2) * np.cos(angle), np.sqrt(1 - z**2) * np.sin(angle), z], axis=1)
    projections = np.stack([camera(direction) for direction in directions])
    return [mask_of(projection) for projection in projections], projections


ISLAND = np.array([0.0, 0.0, 1.05])  # above the sphere
ISLAND_BOX = np.stack([CENTRE - 1.3, CENTRE + 1.3], axis=1).ravel()


def capture_of_small_ball():
    return [mask_of(projection, CENTRE + ISLAND, 0.15) for projection in capture()[1]]


def volume_of(points, triangles):
    a, b, c = (points[triangles[:, corner]] for corner in range(3))
    return np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0


class TestReconstruct(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.masks, cls.projections = capture()

    def check_closed(self, points, triangles):
        self.assertEqual(points.dtype, np.float64)
        self.assertEqual(triangles.dtype, np.int64)
        self.assertEqual(points.shape[1], 3)
        self.assertEqual(triangles.shape[1], 3)
        edges = np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]])
        forward = {tuple(edge) for edge in edges.tolist()}
        self.assertEqual(len(forward), len(edges), "no edge runs twice in one direction")
        self.assertEqual(forward, {(b, a) for a, b in forward}, "each edge runs once in each direction")
        used = len(np.unique(triangles))
        self.assertEqual(used - len(edges) // 2 + len(triangles), 2, "Euler characteristic of a sphere")

    def test_each_surface_is_the_sphere(self):
        solid = 4.0 / 3.0 * np.pi * RADIUS**3
        for surface in ("local-hull", "voting", "marching-cubes"):
            with self.subTest(surface):
                points, triangles = reconstruct(self.masks, self.projections, depth=6, surface=surface)
                self.check_closed(points, triangles)
                # The visual hull holds the sphere, up to pixels of 1/70 and leaf octants of about 1/45; 20
                # views leave it a few per cent too large.
                self.assertGreater(volume_of(points, triangles), 0.98 * solid)
                self.assertLess(volume_of(points, triangles), 1.10 * solid)
                radii = np.linalg.norm(points - CENTRE, axis=1)
                self.assertGreater(radii.min(), RADIUS - 0.05)
                self.assertLess(radii.max(), RADIUS + 0.15)

    def test_the_top_row_is_the_top(self):
        """Upside down, the views disagree about where the object is: much less survives, or nothing."""
        points, triangles = reconstruct(self.masks, self.projections, depth=5, surface="marching-cubes")
        upright = volume_of(points, triangles)
        box = np.stack([CENTRE - 1.0, CENTRE + 1.0], axis=1).ravel()
        try:
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                flipped = [np.roll(mask[::-1], 30, axis=0) for mask in self.masks]
                points, triangles = reconstruct(flipped, self.projections, depth=5, bounds=box, carving="strict",
                                                surface="marching-cubes")
        except RuntimeError:
            return
        self.assertLess(volume_of(points, triangles), 0.9 * upright)

    def test_bytes_and_ones_are_masks_too(self):
        expected = reconstruct(self.masks, self.projections, depth=4)
        for scale in (1, 255):
            with self.subTest(scale):
                masks = [mask.astype(np.uint8) * scale for mask in self.masks]
                points, triangles = reconstruct(masks, self.projections, depth=4)
                np.testing.assert_array_equal(points, expected[0])
                np.testing.assert_array_equal(triangles, expected[1])

    def test_given_bounds(self):
        box = (-0.7, 1.3, -1.2, 0.8, -0.5, 1.5)
        points, triangles = reconstruct(self.masks, self.projections, depth=5, bounds=box)
        self.check_closed(points, triangles)
        self.assertTrue(np.all(points >= [-0.7, -1.2, -0.5]) and np.all(points <= [1.3, 0.8, 1.5]))

    def test_votes_outvote_a_wrong_mask(self):
        masks = [mask.copy() for mask in self.masks]
        masks[3][:, 70:] = False
        solid = 4.0 / 3.0 * np.pi * RADIUS**3
        strict = reconstruct(masks, self.projections, depth=5, surface="voting", vote_share=1.0)
        voted = reconstruct(masks, self.projections, depth=5, surface="voting", vote_share=0.9)
        self.assertLess(volume_of(*strict), 0.7 * solid)
        self.assertGreater(volume_of(*voted), 0.9 * solid)
        self.check_closed(*voted)

    def test_tolerance_is_found(self):
        masks = [mask.copy() for mask in self.masks]
        masks[3][:, 70:] = False
        solid = 4.0 / 3.0 * np.pi * RADIUS**3
        for surface in ("local-hull", "voting"):
            with self.subTest(surface):
                found = reconstruct(masks, self.projections, depth=5, surface=surface)
                self.assertGreater(volume_of(*found), 0.9 * solid)
                self.check_closed(*found)
        strict = reconstruct(masks, self.projections, depth=5, surface="voting", carving="strict")
        self.assertLess(volume_of(*strict), 0.7 * solid)
        clean = reconstruct(self.masks, self.projections, depth=5)
        np.testing.assert_array_equal(clean[0], reconstruct(self.masks, self.projections, depth=5, carving="strict")[0])

    def test_thesis_mode(self):
        points, triangles = reconstruct(self.masks, self.projections, depth=5, mode="thesis")
        self.check_closed(points, triangles)
        self.assertGreater(volume_of(points, triangles), 0.98 * 4.0 / 3.0 * np.pi * RADIUS**3)

    def test_islands(self):
        """A second, smaller ball is a quarter as wide: a piece of the octree that may be given up."""
        masks = [mask | small for mask, small in zip(self.masks, capture_of_small_ball())]
        both = reconstruct(masks, self.projections, depth=6, bounds=ISLAND_BOX)
        one = reconstruct(masks, self.projections, depth=6, bounds=ISLAND_BOX, drop_islands=0.2)
        self.check_closed(*one)
        self.assertGreater(both[0][:, 2].max(), CENTRE[2] + 1.1)
        self.assertLess(one[0][:, 2].max(), CENTRE[2] + RADIUS + 0.2)

    def test_octree(self):
        tree = octree(self.masks, self.projections, depth=5)
        self.assertEqual(tree.depth, 5)
        self.assertTrue(np.all((tree.states == 1) | (tree.states == 2)))
        self.assertTrue(np.all(tree.generations[tree.states == 1] == 5))
        distance = np.linalg.norm(tree.centres() - CENTRE, axis=1)
        # Inside octants are object in every view; the carved rest is not there at all.
        self.assertLess(distance[tree.states == 2].max(), RADIUS + 0.15)
        self.assertLess(distance.max(), RADIUS + 0.25)
        solid = 4.0 / 3.0 * np.pi * RADIUS**3
        inside = np.sum(tree.edges()[tree.states == 2] ** 3)
        self.assertLess(inside, 1.1 * solid)
        self.assertGreater(tree.volume(), solid)


class TestErrors(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.masks, cls.projections = capture(6)

    def check(self, kind, pattern, masks=None, projections=None, **options):
        masks = self.masks if masks is None else masks
        projections = self.projections if projections is None else projections
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with self.assertRaisesRegex(kind, pattern):
                reconstruct(masks, projections, **options)

    def test_masks(self):
        self.check(ValueError, r"mask 1 has shape \(4, 4, 3\)", [self.masks[0], np.zeros((4, 4, 3), bool)])
        self.check(TypeError, "mask 0 has dtype float64", [self.masks[0] * 1.0])
        self.check(ValueError, "from 0 to 300", [self.masks[0].astype(np.int32) * 300])
        for largest in (2, 3, 127):
            self.check(ValueError, f"mask 1 has values from 0 to {largest}, none of which is object: .* above 127, or not 0",
                       [self.masks[0], self.masks[1] * np.uint8(largest)])
        for masks in (None, 5):
            with self.assertRaisesRegex(TypeError, f"masks are {masks}, they are a sequence of 2-D arrays"):
                reconstruct(masks, self.projections)
            with self.assertRaisesRegex(TypeError, f"masks are {masks}, they are a sequence of 2-D arrays"):
                octree(masks, self.projections)

    def test_projections(self):
        self.check(ValueError, r"\(6, 3, 4\), not \(5, 3, 4\)", projections=self.projections[:5])
        broken = self.projections.copy()
        broken[2, 1, 1] = np.nan
        self.check(ValueError, "projection 2 is not finite", projections=broken)

    def test_options(self):
        self.check(ValueError, "'hull', it is one of local-hull", surface="hull")
        self.check(ValueError, "vote_share is 0", vote_share=0)
        self.check(ValueError, "needs 'voting'", surface="marching-cubes", vote_share=0.5)
        self.check(ValueError, "bounds are", bounds=(0, 1, 2))
        self.check(ValueError, "'nowhere', it is one of border", outside="nowhere")
        self.check(ValueError, "5 names", names=list("abcde"))
        for names in (5, {"a", "b"}, {"a": 1, "b": 2}, iter("abcdef")):
            self.check(TypeError, "names are .*, they are a sequence of names", names=names)
        self.check(ValueError, "carving is 'lax', it is one of tolerant, strict", carving="lax")
        self.check(ValueError, "mode is 'fast', it is one of robust, thesis", mode="fast")
        self.check(ValueError, "masks are 0", masks=[], projections=np.empty((0, 3, 4)))
        self.check(ValueError, "bounds are", bounds=(0, np.inf, 0, 1, 0, 1))
        for depth in (5.5, "5", None):
            self.check(TypeError, f"depth is {depth!r}, it is a whole number", depth=depth)
        for depth in (-1, 0, 17, 40):
            self.check(ValueError, f"depth is {depth}, it is 1 to 16", depth=depth)
        for share in (0, -0.5, 1.5, np.nan):
            self.check(ValueError, f"vote_share is {share}, it is above 0", vote_share=share)
        self.check(TypeError, "vote_share is 'all', it is a number", vote_share="all")
        for name in ("surface", "carving", "outside", "mode", "edges"):
            self.check(TypeError, rf"{name} is \['a'\], it is one of", **{name: ["a"]})
        for bounds in ("abc", [[0, 1], [0]], np.full(6, 1j)):
            self.check(TypeError, "bounds are .*, they are an array of numbers", bounds=bounds)
        for projections in ("abc", [[1.0], [1.0, 2.0]], self.projections * 1j):
            self.check(TypeError, "(?s)projections are .*, they are an array of numbers", projections=projections)

    def test_switches_may_be_numpy_numbers(self):
        masks = self.masks
        first = reconstruct(masks, self.projections, depth=4, repair=np.int64(1), tunnels=np.bool_(False))
        np.testing.assert_array_equal(first[0], reconstruct(masks, self.projections, depth=4, tunnels=False)[0])

    def test_options_are_looked_at_for_any_surface(self):
        for surface in ("local-hull", "voting", "marching-cubes"):
            with self.subTest(surface):
                self.check(ValueError, "mode is 'nonsense', it is one of", surface=surface, mode="nonsense")
                self.check(ValueError, "edges is 'blunt', it is one of", surface=surface, edges="blunt")
                for share in (-1, 2, np.nan):
                    self.check(ValueError, f"drop_islands is {share}, it is 0 to 1", surface=surface, drop_islands=share)
                self.check(TypeError, "drop_islands is None, it is a number", surface=surface, drop_islands=None)
                for name in ("repair", "alignment", "correction", "thin_hulls", "handles", "tunnels"):
                    for no in ("no", 1.0, None):
                        self.check(TypeError, f"{name} is {no!r}, it is True or False", surface=surface, **{name: no})
                    self.check(ValueError, f"{name} is 2, it is True or False", surface=surface, **{name: 2})

    def test_options_of_the_octree(self):
        for wrong, words in (({"depth": 17}, "depth is 17"), ({"vote_share": 0}, "vote_share is 0"),
                             ({"outside": "nowhere"}, "outside is 'nowhere'"), ({"bounds": (0, 1)}, "bounds are")):
            with self.assertRaisesRegex(ValueError, words):
                octree(self.masks, self.projections, **wrong)

    def test_errors_of_the_filters(self):
        flat = self.projections.copy()
        flat[1, 2] = flat[1, 1]
        self.check(RuntimeError, "rank 2", projections=flat)
        empty = [np.zeros(SIZE, bool)] + self.masks[1:]
        self.check(RuntimeError, "left.png", masks=empty, names=["left.png"] + list("bcdef"),
                   bounds=(-1, 1, -1, 1, -1, 1))


if __name__ == "__main__":
    unittest.main()
