// SPDX-License-Identifier: BSD-3-Clause
/**
 * Pieces of Markdown that the tables are put together from.
 */
#pragma once

#include <string>
#include <vector>

namespace silhouette::experiments
{

/** A number in a printf pattern. */
std::string format(const char* pattern, double value);
/** A length in octants: three decimals for small ones. */
std::string length(double value);
/** A table's line of cells. */
std::string line(const std::vector<std::string>& cells);
/** Head and rule; the first column is text, the others numbers. */
std::string head(const std::vector<std::string>& cells);

} // namespace silhouette::experiments
