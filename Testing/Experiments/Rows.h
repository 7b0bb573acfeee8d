// SPDX-License-Identifier: BSD-3-Clause
/**
 * The results: a row for each case and method, in a file of comma-separated values that grows as the study
 * goes.
 */
#pragma once

#include "Cases.h"

#include <array>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace silhouette::experiments
{

/** What is measured; NaN where it has no value. Lengths are in leaf octants. */
enum Column : std::size_t
{
  Faces,
  OpenEdges,
  NonManifoldEdges,
  NonManifoldVertices,
  InconsistentEdges,
  SelfIntersections,
  Pieces,
  SurvivorPieces, ///< of the octree that the surface was made from
  Genus,
  Lost,       ///< survivors of that octree that the surface neither crosses nor encloses, nor the method gave up
  Dropped,    ///< survivors that the method gave up by option
  Error,      ///< mean distance to the reference, mean of both directions
  ErrorTo,    ///< mesh to reference
  ErrorFrom,  ///< reference to mesh
  Largest,    ///< the greatest of both directions
  SolidError, ///< as Error, to the solid's own mesh; with the first seed, of the methods that run with all
  XorShare,   ///< over the views used; likewise
  Volume,     ///< cubic world units
  Seconds,    ///< of the surface alone: without views and carving
  TimeRatio,  ///< to exact marching cubes of the same run
  ColumnCount
};

extern const std::array<const char*, ColumnCount> ColumnNames;

struct Row
{
  Case at;
  std::string method;
  Settings settings;
  std::array<double, ColumnCount> value;
  std::string note;    ///< what the method says of its run
  std::string failure; ///< why there is no surface; empty where there is one

  Row() { this->value.fill(std::numeric_limits<double>::quiet_NaN()); }
};

/** Whether both are of the same case, method and settings. */
bool sameRun(const Row& a, const Row& b);

/**
 * The rows of a file; none where there is no file. Throws InvalidInput for a file that is not one of ours.
 */
std::vector<Row> readRows(const std::filesystem::path& file);

/** Add a row to a file, with the head if the file is new. Throws InvalidInput where it cannot be written. */
void appendRow(const std::filesystem::path& file, const Row& row);

} // namespace silhouette::experiments
