// SPDX-License-Identifier: BSD-3-Clause
/**
 * The core's octree travels with the grid that shows it, under a key of the data object's information, so that the
 * filters of one pipeline need not read it back, and know which views the carving left undecided. A copy of the grid
 * loses it, a change of the grid makes it void, and it is read from the grid's arrays again. Private to the module.
 */
#pragma once

#include "Octree.h"

#include <memory>

class vtkDataObject;
class vtkHyperTreeGrid;

namespace silhouette::modeling
{

using SharedOctree = std::shared_ptr<const Octree>;

/** Let the octree travel with the grid that storeOctree made of it, once the grid is complete. */
void attachOctree(vtkHyperTreeGrid* grid, SharedOctree octree);

/** Drop what travels with a data object; harmless where nothing does. */
void forgetOctree(vtkDataObject* data);

/** The octree that travels with the grid where nothing has changed since, else octreeOf(grid). Throws as it does. */
SharedOctree sharedOctree(vtkHyperTreeGrid* grid);

} // namespace silhouette::modeling
