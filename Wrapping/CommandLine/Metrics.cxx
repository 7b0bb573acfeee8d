// SPDX-License-Identifier: BSD-3-Clause
#include "Metrics.h"

#include "OutputFiles.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkHyperTreeGrid.h"
#include "vtkInformation.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include <sys/resource.h>

namespace silhouette::program
{
namespace
{

vtkDataArray* fieldArray(vtkDataObject* data, const char* name)
{
  return data->GetFieldData() ? data->GetFieldData()->GetArray(name) : nullptr;
}

/** JSON has no infinity and no NaN. */
Metrics number(double value)
{
  return std::isfinite(value) ? Metrics(value) : Metrics(nullptr);
}

double memoryMiB()
{
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024.0;
}

void addCarvedByView(Metrics& metrics, vtkHyperTreeGrid* octree, vtkPartitionedDataSetCollection* views)
{
  Metrics shares = Metrics::object();
  vtkDataArray* carved = fieldArray(octree, "CarvedByView");
  const std::vector<std::string> names = viewNames(views);
  for (std::size_t i = 0; carved && i < names.size(); ++i)
  {
    shares[names[i]] = number(carved->GetComponent(static_cast<vtkIdType>(i), 0));
  }
  metrics["carved_by_view"] = shares;
}

/** "1,234,567". */
std::string grouped(std::uint64_t value)
{
  std::string digits = std::to_string(value);
  for (std::size_t i = digits.size(); i > 3;)
  {
    i -= 3;
    digits.insert(i, ",");
  }
  return digits;
}

std::string counted(const Metrics& value, const std::string& one, const std::string& many)
{
  const auto count = value.get<std::uint64_t>();
  return grouped(count) + " " + (count == 1 ? one : many);
}

double real(const Metrics& value)
{
  return value.is_number() ? value.get<double>() : std::nan("");
}

template <typename... Values>
std::string formatted(const char* format, Values... values)
{
  char text[256];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

/** What is wrong with a mesh, in words; empty where nothing is. */
std::string defects(const Metrics& metrics)
{
  const std::pair<const char*, const char*> kinds[] = { { "open_edges", "open edges" },
    { "non_manifold_edges", "non-manifold edges" }, { "non_manifold_vertices", "non-manifold vertices" },
    { "inconsistent_edges", "inconsistently oriented edges" }, { "self_intersections", "self-intersections" } };
  std::string text;
  for (const auto& [key, words] : kinds)
  {
    if (metrics[key].get<std::uint64_t>() > 0)
    {
      text += (text.empty() ? "" : ", ") + grouped(metrics[key].get<std::uint64_t>()) + " " + words;
    }
  }
  return text;
}

} // namespace

std::vector<std::string> viewNames(vtkPartitionedDataSetCollection* views)
{
  std::vector<std::string> names;
  for (unsigned int i = 0; i < views->GetNumberOfPartitionedDataSets(); ++i)
  {
    const char* name = views->HasMetaData(i) ? views->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()) : nullptr;
    names.push_back(name && *name ? name : "view " + std::to_string(i));
  }
  return names;
}

double fieldValue(vtkDataObject* data, const char* name)
{
  return hasField(data, name) ? fieldArray(data, name)->GetComponent(0, 0) : 0.0;
}

std::uint64_t fieldCount(vtkDataObject* data, const char* name)
{
  return hasField(data, name) ? fieldArray(data, name)->GetVariantValue(0).ToTypeUInt64() : 0;
}

bool hasField(vtkDataObject* data, const char* name)
{
  vtkDataArray* array = fieldArray(data, name);
  return array && array->GetNumberOfValues() > 0;
}

double leafEdge(vtkHyperTreeGrid* octree)
{
  vtkDataArray* cube = fieldArray(octree, "RootCube");
  const bool isThere = cube && cube->GetNumberOfValues() == 4;
  return isThere ? std::ldexp(cube->GetVariantValue(3).ToDouble(), -static_cast<int>(fieldCount(octree, "Depth"))) : 0.0;
}

void addOctree(Metrics& metrics, vtkHyperTreeGrid* octree, vtkPartitionedDataSetCollection* views)
{
  vtkDataArray* cube = fieldArray(octree, "RootCube");
  metrics["views"] = fieldCount(octree, "NumberOfViews");
  metrics["depth"] = fieldCount(octree, "Depth");
  if (cube && cube->GetNumberOfValues() == 4)
  {
    double values[4];
    for (int i = 0; i < 4; ++i)
    {
      values[i] = cube->GetVariantValue(i).ToDouble();
    }
    metrics["leaf_edge"] = leafEdge(octree);
    metrics["root_cube"] = { { "origin", { values[0], values[1], values[2] } }, { "edge", values[3] } };
  }
  metrics["background_votes"] = fieldCount(octree, "BackgroundVotes");
  metrics["dilation"] = fieldCount(octree, "Dilation");
  for (const auto& [key, name] : { std::pair<const char*, const char*>("uncovered_share", "UncoveredShare"),
         std::pair<const char*, const char*>("strict_uncovered_share", "StrictUncoveredShare") })
  {
    metrics[key] = hasField(octree, name) ? number(fieldValue(octree, name)) : Metrics(nullptr);
  }
  metrics["octants_tested"] = fieldCount(octree, "OctantsTested");
  metrics["view_tests"] = fieldCount(octree, "ViewTests");
  metrics["inside"] = fieldCount(octree, "InsideOctants");
  metrics["intersection"] = fieldCount(octree, "IntersectionOctants");
  addCarvedByView(metrics, octree, views);
}

void addMesh(Metrics& metrics, vtkTable* evaluation)
{
  const std::pair<const char*, const char*> counts[] = { { "points", "Points" }, { "triangles", "Triangles" },
    { "open_edges", "OpenEdges" }, { "non_manifold_edges", "NonManifoldEdges" },
    { "non_manifold_vertices", "NonManifoldVertices" }, { "inconsistent_edges", "InconsistentEdges" },
    { "self_intersections", "SelfIntersections" }, { "components", "Components" } };
  for (const auto& [key, name] : counts)
  {
    metrics[key] = fieldCount(evaluation, name);
  }
  metrics["closed"] = fieldCount(evaluation, "Closed") != 0;
  metrics["sound"] = fieldCount(evaluation, "Sound") != 0;
  metrics["genus"] =
    hasField(evaluation, "Genus") ? Metrics(static_cast<int>(fieldValue(evaluation, "Genus"))) : Metrics(nullptr);
  metrics["volume"] = number(fieldValue(evaluation, "Volume"));
  metrics["area"] = number(fieldValue(evaluation, "Area"));
}

void addAgreement(Metrics& metrics, vtkTable* evaluation)
{
  metrics["mean_iou"] = number(fieldValue(evaluation, "MeanIoU"));
  metrics["mean_xor"] = number(fieldValue(evaluation, "MeanXOR"));
  metrics["total_iou"] = number(fieldValue(evaluation, "TotalIoU"));
  metrics["total_xor"] = number(fieldValue(evaluation, "TotalXOR"));
  metrics["false_object"] = fieldCount(evaluation, "FalseObject");
  metrics["false_background"] = fieldCount(evaluation, "FalseBackground");
  const std::pair<const char*, const char*> counts[] = { { "false_object", "FalseObject" },
    { "false_background", "FalseBackground" }, { "silhouette_pixels", "SilhouettePixels" },
    { "mesh_pixels", "MeshPixels" } };
  Metrics rows = Metrics::array();
  for (vtkIdType row = 0; row < evaluation->GetNumberOfRows(); ++row)
  {
    Metrics view;
    view["name"] = std::string(evaluation->GetValueByName(row, "Name").ToString());
    view["iou"] = number(evaluation->GetValueByName(row, "IoU").ToDouble());
    view["xor"] = number(evaluation->GetValueByName(row, "XOR").ToDouble());
    for (const auto& [key, name] : counts)
    {
      view[key] = evaluation->GetValueByName(row, name).ToTypeUInt64();
    }
    rows.push_back(view);
  }
  metrics["per_view"] = rows;
}

void addTruth(Metrics& metrics, vtkTable* evaluation)
{
  if (!hasField(evaluation, "TruthMean"))
  {
    return;
  }
  const std::pair<const char*, const char*> distances[] = { { "mesh_to_truth_mean", "MeshToTruthMean" },
    { "truth_to_mesh_mean", "TruthToMeshMean" }, { "truth_mean", "TruthMean" }, { "truth_rms", "TruthRMS" },
    { "truth_hausdorff", "TruthHausdorff" }, { "mesh_to_truth_maximum", "MeshToTruthMaximum" },
    { "truth_to_mesh_maximum", "TruthToMeshMaximum" }, { "sample_spacing", "SampleSpacing" } };
  for (const auto& [key, name] : distances)
  {
    metrics[key] = number(fieldValue(evaluation, name));
  }
}

void addCost(Metrics& metrics, const std::vector<std::pair<std::string, double>>& seconds)
{
  Metrics stages = Metrics::object();
  double total = 0.0;
  for (const auto& [key, taken] : seconds)
  {
    stages[key] = taken;
    total += taken;
  }
  stages["total"] = total;
  metrics["seconds"] = stages;
  metrics["peak_memory_mib"] = memoryMiB();
}

void writeMetrics(const Metrics& metrics, const StagedFile& file)
{
  // Names of files may be no UTF-8; they must not cost the metrics.
  writeText(file, metrics.dump(2, ' ', false, Metrics::error_handler_t::replace) + "\n");
}

std::string describeMesh(const Metrics& metrics)
{
  const std::string wrong = defects(metrics);
  const bool sound = metrics["sound"].get<bool>();
  std::string text = "mesh         " + counted(metrics["points"], "point", "points") + ", " +
    counted(metrics["triangles"], "triangle", "triangles") + ", " +
    counted(metrics["components"], "component", "components");
  text += metrics["genus"].is_null() ? "" : ", genus " + std::to_string(metrics["genus"].get<int>());
  text += formatted(", volume %.6g\n", real(metrics["volume"]));
  text += "             ";
  text += sound ? "closed, manifold, free of self-intersections" : wrong.empty() ? "oriented inwards" : wrong;
  return text + "\n";
}

std::string describeAgreement(const Metrics& metrics)
{
  return formatted("silhouettes  mean IoU %.4f, mean XOR %.2f %%", real(metrics["mean_iou"]),
           100.0 * real(metrics["mean_xor"])) +
    " (" + counted(metrics["per_view"].size(), "view", "views") + "); false object " +
    grouped(metrics["false_object"].get<std::uint64_t>()) + ", false background " +
    grouped(metrics["false_background"].get<std::uint64_t>()) + " pixels\n";
}

std::string describeTruth(const Metrics& metrics)
{
  if (!metrics.contains("truth_mean"))
  {
    return {};
  }
  return formatted("truth        mean %.4g (mesh to truth %.4g, truth to mesh %.4g), RMS %.4g, Hausdorff %.4g\n",
    real(metrics["truth_mean"]), real(metrics["mesh_to_truth_mean"]),
    real(metrics["truth_to_mesh_mean"]), real(metrics["truth_rms"]),
    real(metrics["truth_hausdorff"]));
}

std::string describeCost(const Metrics& metrics)
{
  return formatted("cost         %.1f s, %.0f MiB\n", real(metrics["seconds"]["total"]),
    real(metrics["peak_memory_mib"]));
}

} // namespace silhouette::program
