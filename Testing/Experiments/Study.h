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

/** The files of the rows of ablation and scaling. */
std::filesystem::path ablationFile(const std::filesystem::path& folder);
std::filesystem::path scalingFile(const std::filesystem::path& folder);
/** The file of the rows of the islands. */
std::filesystem::path islandsFile(const std::filesystem::path& folder);

/**
 * Run what the options ask for and is not in the results yet, and say on the standard output what is done.
 * Throws InvalidInput for names that are unknown, and where results are there that are neither to be gone on
 * with nor to be replaced.
 */
void runStudy(const StudyOptions& options);

/**
 * The robust local hulls without each of their stages, into ablationFile(): of the options' cases, their first
 * seed; unless they say otherwise of four objects, clean and under the strongest noise. Errors as above.
 */
void runAblation(const StudyOptions& options);

/**
 * Exact marching cubes and the robust local hulls at depths 6 to 9 and images of 512 to 2,048 pixels, clean and
 * under contour noise of half an octant of the depth, into scalingFile(): unless the options say otherwise of
 * two objects, their first seed. Errors as above.
 */
void runScaling(const StudyOptions& options);

/**
 * Flipped pixels, with and without the islands that they leave, into islandsFile(): exact marching cubes, the
 * robust local hulls, and these with small islands dropped, of the options' objects, their first seed. Errors
 * as above.
 */
void runIslands(const StudyOptions& options);

} // namespace silhouette::experiments
