// SPDX-License-Identifier: BSD-3-Clause
/**
 * The evaluator's numbers as a table and its field data. Private to the module.
 */
#pragma once

#include "MeshDistance.h"
#include "MeshSoundness.h"
#include "SilhouetteComparison.h"
#include "SurvivorCoverage.h"

#include <vector>

class vtkTable;

namespace silhouette::modeling
{

/** A row a view, and the totals over the views. */
void storeAgreement(const std::vector<ViewAgreement>& views, vtkTable* table);
void storeSoundness(const MeshSoundness& soundness, vtkTable* table);
void storeTruth(const MeshComparison& comparison, vtkTable* table);

/** The longest side of a mesh's bounding box. */
double longestSide(const Mesh& mesh);

} // namespace silhouette::modeling
