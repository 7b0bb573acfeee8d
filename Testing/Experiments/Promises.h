// SPDX-License-Identifier: BSD-3-Clause
/**
 * What must hold in every run: the promises of the local hulls, and the order of the methods.
 */
#pragma once

#include "Rows.h"

#include <string>
#include <vector>

namespace silhouette::experiments
{

/** A promise of the local hulls, kept by a row or not. */
struct Promise
{
  const char* broken; ///< what a surface is that does not keep it
  bool (*kept)(const Row& row);
};

const std::vector<Promise>& promises();

/** What holds beside these for a solid in flipped pixels once islands and debris are given up. */
const std::vector<Promise>& islandPromises();

/** Where an order applies. */
enum class Where
{
  Clean,
  Noisy,
  NoisyButPixels ///< flipped pixels leave islands, which the octree's promise keeps and voting drops
};

/** The error of one method is at most that of another times `factor`, and `allowance` octants. */
struct Order
{
  const char* better;
  const char* than;
  Where where;
  double factor;
  double allowance;
};

/** The orders that are asserted: the place to tighten. */
const std::vector<Order>& orders();

/** Is the row's surface one of ours, which keep the promises? Of those that lack a stage, only the one that gives islands up has to. */
bool isPromising(const Row& row);

/** A sentence for each promise that is broken and each order that does not hold. */
std::vector<std::string> violations(const std::vector<Row>& rows);

} // namespace silhouette::experiments
