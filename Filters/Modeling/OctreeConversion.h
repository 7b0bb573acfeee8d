// SPDX-License-Identifier: BSD-3-Clause
/**
 * The core's octree against vtkHyperTreeGrid. Private to the module.
 *
 * A grid of 2^r cells a side, r the generation of the tree roots, holds a tree where one was carved; its
 * cells run tree by tree, breadth first. Cell arrays: State (unsigned char), Generation (unsigned char),
 * LatticeCode (64-bit unsigned, Morton within the generation). Background octants are masked. Field data:
 * what names the lattice, the policies and the views.
 *
 * The way back reads the cell arrays and the field data alone, not the trees, so that the order of the cells
 * does not matter; it throws InvalidInput where cells are missing or do not fit together.
 */
#pragma once

#include "Octree.h"

class vtkHyperTreeGrid;

namespace silhouette::modeling
{

void storeOctree(const Octree& octree, vtkHyperTreeGrid* grid);

Octree octreeOf(vtkHyperTreeGrid* grid);

/** A grid without a single cell. */
bool isEmpty(vtkHyperTreeGrid* grid);

} // namespace silhouette::modeling
