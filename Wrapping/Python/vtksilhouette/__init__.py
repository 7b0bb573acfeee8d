# SPDX-License-Identifier: BSD-3-Clause
"""Closed meshes from silhouettes, as VTK filters.

    import vtksilhouette
    source = vtksilhouette.vtkSilhouetteOctreeSource()   # views in, octree out
    cubes = vtksilhouette.vtkVotingMarchingCubes()       # octree and views in, surface out
    hulls = vtksilhouette.vtkLocalHullSurfacer()         # surface, octree and views in, closed surface out

The classes work like VTK's own (SetInputConnection, Update, GetOutput);
help(vtksilhouette.vtkLocalHullSurfacer) says what each does.

vtksilhouette.numpy_front   numpy masks in, numpy mesh out, without VTK in sight: reconstruct() and octree()
vtksilhouette.offscreen     rendering without a display: python3 -m vtksilhouette.offscreen SCRIPT
"""

# VTK's classes that ours derive from, or take and give, must be known to Python first.
import vtkmodules.vtkCommonExecutionModel  # noqa: F401
import vtkmodules.vtkParallelCore  # noqa: F401

from .version import __version__
from .vtkSilhouetteFiltersModeling import *  # noqa: F401,F403

__all__ = ["__version__", "numpy_front", "offscreen"]
__all__ += sorted(name for name in globals() if name.startswith("vtk") and isinstance(globals()[name], type))
