// SPDX-License-Identifier: BSD-3-Clause
/**
 * The page Documentation/experiments.md: prose (Prose.h), tables and figures put together.
 */
#pragma once

#include "Rows.h"
#include "VoteTable.h"

#include <filesystem>
#include <string>
#include <vector>

namespace silhouette::experiments
{

/** All that the page tells of; what is empty is left out. */
struct Results
{
  std::vector<Row> cases; ///< of one settings or of several, each of which gets its own tables
  std::vector<Row> ablation;
  std::vector<Row> scaling;
  std::vector<Row> islands;
  std::vector<VoteTable> votes;
};

/** The page's text. Figures are named where their files are in `figures`. */
std::string pageOf(const Results& results, const std::filesystem::path& figures);

/**
 * Write the page from the results in `output` to FOLDER/experiments.md; its figures are in FOLDER/Figures.
 */
void writeReport(const std::filesystem::path& output, const std::filesystem::path& folder);

} // namespace silhouette::experiments
