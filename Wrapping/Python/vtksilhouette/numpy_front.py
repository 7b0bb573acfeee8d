# SPDX-License-Identifier: BSD-3-Clause
"""Numpy silhouettes in, a numpy mesh out.

    from vtksilhouette.numpy_front import reconstruct

    points, triangles = reconstruct(masks, projections, depth=8)

A mask is a 2-D array, True (or above 127) where a pixel shows the object, row 0 at the TOP, as imageio,
OpenCV and matplotlib load pictures. Its projection P is the camera's 3 x 4 matrix: w (u, v, 1) = P (X, Y, Z,
1), u to the right, v down, in pixels, the centre of the top-left pixel at (0, 0), w > 0 for points in front
of the camera. The mesh is in the unit of (X, Y, Z).

These functions run the filters vtkSilhouetteOctreeSource, vtkVotingMarchingCubes and vtkLocalHullSurfacer;
who needs more of their options, their counts or a pipeline uses them directly.
"""

import math
import operator
import warnings
from dataclasses import dataclass

import numpy as np

from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData

from .vtkSilhouetteFiltersModeling import (
    vtkLocalHullSurfacer,
    vtkSilhouetteOctreeSource,
    vtkVotingMarchingCubes,
)

__all__ = ["Octree", "octree", "reconstruct"]

SURFACES = ("local-hull", "voting", "marching-cubes")
CARVINGS = ("tolerant", "strict")
DEPTHS = (1, 16)
_OUTSIDE = {
    "border": vtkSilhouetteOctreeSource.BORDER,
    "unknown": vtkSilhouetteOctreeSource.UNKNOWN,
    "background": vtkSilhouetteOctreeSource.BACKGROUND,
}
_MODES = {"robust": vtkLocalHullSurfacer.ROBUST, "thesis": vtkLocalHullSurfacer.THESIS}
_EDGES = {"exact": vtkVotingMarchingCubes.EXACT, "middle": vtkVotingMarchingCubes.MIDDLE,
          "sub-pixel": vtkVotingMarchingCubes.SUB_PIXEL}


@dataclass(frozen=True)
class Octree:
    """Octants that the silhouettes did not carve away.

    states       (n,) uint8: 2 inside: at most k views have any background in it, k being the background votes that
                 vote_share leaves, 0 of all views; 1 intersection: more views have, but at most k see nothing else
    generations  (n,) uint8: subdivisions of the root cube; an octant's edge is edge / 2 ** generation
    coordinates  (n, 3) int64: the octant's place among the 2 ** generation octants along each axis
    origin       (3,) float64: the root cube's corner of least coordinates
    edge         float: the root cube's edge
    depth        int: the last generation

    Octants do not overlap: inside octants of any generation, and intersection octants of the last.
    """

    states: np.ndarray
    generations: np.ndarray
    coordinates: np.ndarray
    origin: np.ndarray
    edge: float
    depth: int

    def edges(self):
        """Edge length of each octant, (n,) float64."""
        return self.edge * np.exp2(-self.generations.astype(np.float64))

    def centres(self):
        """Centre of each octant, (n, 3) float64."""
        return self.origin + (self.coordinates + 0.5) * self.edges()[:, np.newaxis]

    def volume(self):
        """Volume of all octants together: an upper bound of the visual hull's."""
        return float(np.sum(self.edges() ** 3))


def reconstruct(masks, projections, depth=8, bounds=None, surface="local-hull", vote_share=None,
                outside="border", edges="exact", names=None, carving="tolerant", mode="robust",
                drop_islands=0.0, repair=True, alignment=True, correction=True, thin_hulls=True,
                handles=True, tunnels=True):
    """Reconstructs the mesh of an object from silhouettes.

    masks        sequence of m 2-D arrays, row 0 at the top; they may differ in size. Object is True, or
                 above 127, or not 0 where the largest value is 1; other largest values from 2 to 127 are an error
    projections  (m, 3, 4) array: the camera of each mask
    depth        1 to 16: subdivisions of the cube around the object. One more halves the triangles' edges,
                 and takes about four times the time and memory
    bounds       (xmin, xmax, ymin, ymax, zmin, zmax) around the object; None finds them from the silhouettes
    surface      "local-hull" (default): closed, manifold, free of self-intersections, with no thin part lost;
                 "voting": marching cubes with the views' votes; "marching-cubes": the same with all views
    vote_share   above 0 to 1: the share of the views that must call a point inside. Below 1, single wrong
                 silhouettes are outvoted, and the object grows. None: what `carving` settles
    outside      what a view says beyond its image: "border" (nothing beyond a side that the object touches,
                 else background), "unknown" or "background"
    edges        where the surface crosses an edge of the grid: "exact", by the pixels' squares; "sub-pixel", by
                 distances between pixels, nearer to smooth contours; or in its "middle"
    names        sequence of m names of the views, for messages; None numbers them
    carving      without vote_share: "tolerant" (default), the least share of votes, and at worst dilation of the
                 silhouettes, that brings back parts thinner than the noise where strict carving cuts them; or
                 "strict", all views. "marching-cubes" is always strict

    For "local-hull" alone:
    mode         "robust" (default): corrected by what the views agree on; "thesis": one convex hull for each chain
                 of slices, combined
    drop_islands 0 to 1: pieces of the octree with fewer octants than this share of the largest one's are given up,
                 and octants that only false pixels uphold; 0 keeps all
    repair       repair silhouettes: speckles, filled in the object and erased in the background, and what a single
                 view cuts deep and wide out of the object, filled
    alignment    shift views against an error of their cameras, where one is measured
    correction   move the surface to where the views agree on average
    thin_hulls   round parts thinner than an octant
    handles      join handles that noise has cut
    tunnels      fill narrow tunnels that noise and the grid leave

    Returns (points, triangles): (n, 3) float64 and (k, 3) int64 indices into points, counter-clockwise seen
    from outside.

    Raises TypeError where an argument is of another type, ValueError with its name and value where it is out of
    range, before any work and for any surface; and RuntimeError with the filter's message where the views give no
    object: nothing survives the carving (the message names views without which something would be left), they do not bound it, or a projection is of
    rank below 3. What is doubtful but not fatal comes as a RuntimeWarning.

        >>> points, triangles = reconstruct(masks, projections, depth=7)
        >>> trimesh.Trimesh(points, triangles).export("object.ply")
    """
    _check_choice("surface", surface, SURFACES)
    _check_choice("carving", carving, CARVINGS)
    if surface == "marching-cubes" and vote_share not in (None, 1.0):
        raise ValueError(f"surface 'marching-cubes' asks all views, vote_share {vote_share} needs 'voting' "
                         "or 'local-hull'")
    share = 1.0 if vote_share is None else _share(vote_share)
    cubes = vtkVotingMarchingCubes()
    cubes.SetEdgePlacement(_choice("edges", edges, _EDGES))
    hulls = _local_hulls(mode, drop_islands, RepairSilhouettes=("repair", repair),
                         AlignViews=("alignment", alignment), CorrectField=("correction", correction),
                         ThinHulls=("thin_hulls", thin_hulls), JoinHandles=("handles", handles),
                         FillTunnels=("tunnels", tunnels))
    source = _octree_source(masks, projections, depth, bounds, share, outside, names)
    if vote_share is None and carving == "tolerant" and surface != "marching-cubes":
        source.AutomaticToleranceOn()
        _update([source])
        fields = source.GetOutput().GetFieldData()
        views, votes = (fields.GetArray(name).GetTuple1(0) for name in ("NumberOfViews", "BackgroundVotes"))
        share = (views - votes) / views

    cubes.SetInputConnection(0, source.GetOutputPort(0))
    cubes.SetInputConnection(1, source.GetOutputPort(1))
    cubes.SetShare(share)
    filters = [source, cubes]
    if surface == "local-hull":
        hulls.SetInputConnection(0, cubes.GetOutputPort(0))
        hulls.SetInputConnection(1, source.GetOutputPort(0))
        hulls.SetInputConnection(2, source.GetOutputPort(1))
        filters.append(hulls)
    _update(filters)

    mesh = filters[-1].GetOutput()
    if mesh.GetNumberOfPoints() == 0:
        return np.empty((0, 3), np.float64), np.empty((0, 3), np.int64)
    points = vtk_to_numpy(mesh.GetPoints().GetData()).astype(np.float64)
    triangles = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).astype(np.int64).reshape(-1, 3)
    return points, triangles


def octree(masks, projections, depth=8, bounds=None, vote_share=1.0, outside="border", names=None):
    """Carves the octree of silhouettes; the arguments are those of reconstruct(), all views needed by default.

    Returns an Octree: the octants that survived, with their centres and edge lengths.

    Raises what reconstruct() does: TypeError where an argument is of another type, ValueError with its name and value
    where it is out of range, before any work; and RuntimeError with the filter's message where the views give no object.
    What is doubtful but not fatal comes as a RuntimeWarning.

        >>> tree = octree(masks, projections, depth=6)
        >>> solid = tree.centres()[tree.states == 2]
    """
    source = _octree_source(masks, projections, depth, bounds, _share(vote_share), outside, names)
    _update([source])
    grid = source.GetOutput()
    cells = grid.GetCellData()
    states = vtk_to_numpy(cells.GetArray("State"))
    generations = vtk_to_numpy(cells.GetArray("Generation"))
    codes = vtk_to_numpy(cells.GetArray("LatticeCode")).astype(np.uint64)
    fields = grid.GetFieldData()
    reached = int(fields.GetArray("Depth").GetTuple1(0))
    root = vtk_to_numpy(fields.GetArray("RootCube")).astype(np.float64).ravel()

    kept = (states == 2) | ((states == 1) & (generations == reached))
    coordinates = np.stack([_every_third_bit(codes[kept] >> np.uint64(axis)) for axis in range(3)], axis=1)
    return Octree(states[kept], generations[kept], coordinates, root[:3].copy(), float(root[3]), reached)


def _octree_source(masks, projections, depth, bounds, vote_share, outside, names):
    """The source with its views and parameters, not yet run."""
    source = vtkSilhouetteOctreeSource()
    source.SetDepth(_depth(depth))
    source.SetOutsidePolicy(_choice("outside", outside, _OUTSIDE))
    if bounds is not None:
        source.AutomaticBoundsOff()
        source.SetBounds(*_box(bounds))
    images = _images(masks)
    matrices = _matrices(projections, len(images))
    for image, matrix, name in zip(images, matrices, _names(names, len(images))):
        source.AddView(image, matrix.ravel().tolist(), name)
    source.SetBackgroundVotes(len(images) - max(1, math.ceil(vote_share * len(images) - 1e-9)))
    return source


def _local_hulls(mode, drop_islands, **switches):
    """The surfacer with its parameters; a switch is the setter's name with the argument's name and value."""
    hulls = vtkLocalHullSurfacer()
    hulls.SetMode(_choice("mode", mode, _MODES))
    share = _number("drop_islands", drop_islands)
    if not 0.0 <= share <= 1.0:
        raise ValueError(f"drop_islands is {drop_islands!r}, it is 0 to 1")
    hulls.SetIslandShare(share)
    for setter, (name, value) in switches.items():
        if not isinstance(value, (bool, np.bool_, int, np.integer)):
            raise TypeError(f"{name} is {value!r}, it is True or False")
        if value not in (0, 1):
            raise ValueError(f"{name} is {value!r}, it is True or False")
        getattr(hulls, "Set" + setter)(bool(value))
    return hulls


def _depth(depth):
    try:
        number = operator.index(depth)
    except TypeError:
        raise TypeError(f"depth is {depth!r}, it is a whole number") from None
    if not DEPTHS[0] <= number <= DEPTHS[1]:
        raise ValueError(f"depth is {number}, it is {DEPTHS[0]} to {DEPTHS[1]}")
    return number


def _share(vote_share):
    share = _number("vote_share", vote_share)
    if not 0.0 < share <= 1.0:
        raise ValueError(f"vote_share is {vote_share!r}, it is above 0 and at most 1")
    return share


def _box(bounds):
    """The six bounds, as a list."""
    box = _numbers("bounds", bounds).ravel()
    if box.shape != (6,) or not np.all(np.isfinite(box)) or not np.all(box[0::2] < box[1::2]):
        raise ValueError(f"bounds are {bounds!r}, they are xmin < xmax, ymin < ymax, zmin < zmax")
    return box.tolist()


def _images(masks):
    try:
        views = enumerate(masks)
    except TypeError:
        raise TypeError(f"masks are {masks!r:.200}, they are a sequence of 2-D arrays") from None
    images = [_image(mask, view) for view, mask in views]
    if not images:
        raise ValueError("masks are 0, at least 1 view is needed")
    return images


def _names(names, count):
    """A name for each of `count` views, or None."""
    if names is None:
        return [None] * count
    try:
        texts = [str(names[view]) for view in range(len(names))]
    except (TypeError, KeyError):
        raise TypeError(f"names are {names!r:.200}, they are a sequence of names") from None
    if len(texts) != count:
        raise ValueError(f"{count} masks, but {len(texts)} names")
    return texts


def _image(mask, view):
    """A mask as VTK holds images: the bottom row first."""
    array = np.asarray(mask)
    if array.ndim != 2 or array.size == 0:
        raise ValueError(f"mask {view} has shape {array.shape}, it is a 2-D array (rows, columns)")
    if array.dtype == np.bool_:
        array = array.astype(np.uint8) * np.uint8(255)
    elif np.issubdtype(array.dtype, np.integer):
        if array.min() < 0 or array.max() > 255:
            raise ValueError(f"mask {view} has values from {array.min()} to {array.max()}, "
                             "integers are 0 to 255")
        if 1 < array.max() <= 127:
            raise ValueError(f"mask {view} has values from {array.min()} to {array.max()}, none of which is object: that is "
                             "True, above 127, or not 0 where the largest value is 1, as in 'mask > 0'")
        array = array.astype(np.uint8)
    else:
        raise TypeError(f"mask {view} has dtype {array.dtype}, it is bool or integer: say what is object, "
                        "as in 'mask > 0.5'")
    rows, columns = array.shape
    image = vtkImageData()
    image.SetDimensions(columns, rows, 1)
    scalars = numpy_to_vtk(np.ascontiguousarray(array[::-1]).ravel(), deep=True)
    scalars.SetName("Silhouette")
    image.GetPointData().SetScalars(scalars)
    return image


def _matrices(projections, count):
    """The projections as one (count, 3, 4) array of finite numbers."""
    matrices = _numbers("projections", projections)
    if matrices.shape != (count, 3, 4):
        raise ValueError(f"{count} masks need projections of shape ({count}, 3, 4), not {matrices.shape}")
    for view, matrix in enumerate(matrices):
        if not np.all(np.isfinite(matrix)):
            raise ValueError(f"projection {view} is not finite: {matrix.tolist()}")
    return matrices


def _numbers(name, values):
    """An array of float64; complex numbers are none."""
    try:
        array = np.asarray(values)
        if np.iscomplexobj(array):
            raise TypeError
        return array.astype(np.float64)
    except (TypeError, ValueError):
        raise TypeError(f"{name} are {values!r:.200}, they are an array of numbers") from None


def _number(name, value):
    try:
        return float(value)
    except (TypeError, ValueError):
        raise TypeError(f"{name} is {value!r}, it is a number") from None


def _check_choice(name, value, choices):
    if not isinstance(value, str):
        raise TypeError(f"{name} is {value!r}, it is one of {', '.join(choices)}")
    if value not in choices:
        raise ValueError(f"{name} is {value!r}, it is one of {', '.join(choices)}")


def _choice(name, value, choices):
    _check_choice(name, value, choices)
    return choices[value]


def _every_third_bit(codes):
    """Bits 0, 3, 6, ... of each code, moved together: one coordinate of a Morton code."""
    coordinates = np.zeros(codes.shape, np.int64)
    for bit in range(21):
        coordinates |= ((codes >> np.uint64(3 * bit)) & np.uint64(1)).astype(np.int64) << bit
    return coordinates


def _update(filters):
    """Updates the last of the filters; the first error of any of them becomes a RuntimeError."""
    errors = []
    doubts = []

    def note_error(caller, event, text):
        errors.append(_message(text))

    def note_warning(caller, event, text):
        doubts.append(_message(text))

    note_error.CallDataType = "string0"
    note_warning.CallDataType = "string0"
    observed = []
    for each in filters:
        # The executive speaks up after a filter has failed; unheard, it would write to the console.
        for speaker in (each, each.GetExecutive()):
            observed.append((speaker, speaker.AddObserver("ErrorEvent", note_error)))
            observed.append((speaker, speaker.AddObserver("WarningEvent", note_warning)))
    try:
        filters[-1].Update()
    finally:
        for speaker, tag in observed:
            speaker.RemoveObserver(tag)
    for doubt in doubts:
        warnings.warn(doubt, RuntimeWarning, stacklevel=3)
    if errors:
        raise RuntimeError(errors[0])


def _message(text):
    """VTK's text without where in the source it was raised: 'ERROR: In FILE, line N\\nCLASS (0x0): TEXT'."""
    body = text.split("\n", 1)[-1].strip()
    return body.split("): ", 1)[-1]
