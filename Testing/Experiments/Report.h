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

/** The page's text. Figures are named where their files are in `figures`. */
std::string pageOf(const std::vector<Row>& rows, const std::vector<VoteTable>& votes,
                   const std::filesystem::path& figures);

/**
 * Write the page from the results in `results` to FOLDER/experiments.md; its figures are in FOLDER/Figures.
 */
void writeReport(const std::filesystem::path& results, const std::filesystem::path& folder);

} // namespace silhouette::experiments
