// SPDX-License-Identifier: BSD-3-Clause
/**
 * The metrics file: one JSON object, its keys in the order in which they were added; null where a value does not
 * exist (the genus of an open mesh).
 */
#pragma once

#include <nlohmann/json.hpp>

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

class vtkDataObject;
class vtkHyperTreeGrid;
class vtkPartitionedDataSetCollection;
class vtkTable;

namespace silhouette::program
{

class StagedFile;

using Metrics = nlohmann::ordered_json;

/** The names of the views of a collection. */
std::vector<std::string> viewNames(vtkPartitionedDataSetCollection* views);

/** A value of a data object's field data; 0 where it is absent. */
double fieldValue(vtkDataObject* data, const char* name);
std::uint64_t fieldCount(vtkDataObject* data, const char* name);
bool hasField(vtkDataObject* data, const char* name);

/** The edge of the last generation's octants, as the octree's field data have it; 0 where they do not. */
double leafEdge(vtkHyperTreeGrid* octree);

/** What the octree is and what it cost: views, depth, leaf_edge, octants_tested, carved_by_view and so on. */
void addOctree(Metrics& metrics, vtkHyperTreeGrid* octree, vtkPartitionedDataSetCollection* views);

/** Of the evaluator's table: what the mesh is: points, open_edges, components, genus, volume and so on. */
void addMesh(Metrics& metrics, vtkTable* evaluation);

/** Of the evaluator's table: mean_iou, mean_xor and the others, per_view. */
void addAgreement(Metrics& metrics, vtkTable* evaluation);

/** Of the evaluator's table, where there was a truth: mesh_to_truth_mean and the others. */
void addTruth(Metrics& metrics, vtkTable* evaluation);

/** seconds by stage and in total, peak_memory_mib. */
void addCost(Metrics& metrics, const std::vector<std::pair<std::string, double>>& seconds);

/** Throws ProgramError (FileFailed). */
void writeMetrics(const Metrics& metrics, const StagedFile& file);

/** In a few lines for people; each ends with a line break. */
std::string describeMesh(const Metrics& metrics);
std::string describeAgreement(const Metrics& metrics);
std::string describeTruth(const Metrics& metrics);
std::string describeCost(const Metrics& metrics);

} // namespace silhouette::program
