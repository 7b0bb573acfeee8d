// SPDX-License-Identifier: BSD-3-Clause
/**
 * The study: every case with every method, into OUTPUT/results.csv.
 */
#pragma once

#include "Rows.h"

namespace silhouette::experiments
{

/** The file of the results in a folder. */
std::filesystem::path resultsFile(const std::filesystem::path& folder);
/** The file of the vote tables in a folder. */
std::filesystem::path votesFile(const std::filesystem::path& folder);

/**
 * Run what the options ask for and is not in the results yet, and say on the standard output what is done.
 * Throws InvalidInput for names that are unknown, and where results are there that are neither to be gone on
 * with nor to be replaced.
 */
void runStudy(const StudyOptions& options);

} // namespace silhouette::experiments
