// SPDX-License-Identifier: BSD-3-Clause
#include "SelfIntersections.h"

#include "BoxTree.h"
#include "MeshCheck.h"
#include "TriangleIntersection.h"

#include <algorithm>
#include <functional>
#include <string>

namespace silhouette
{

namespace
{

constexpr std::size_t Block = 8;         ///< items whose pairs are written to one place
constexpr std::size_t MostBatches = 128; ///< times that a run asks whether it is cancelled
constexpr std::size_t ThreadBlocks = 8;  ///< that keep a thread busy until it is asked once more

using PairList = std::vector<TrianglePair>;

/** Run find(item, list) for all items and return what the lists hold, in the items' order. */
PairList collect(std::size_t items, const std::function<void(std::size_t, PairList&)>& find,
  Execution& execution, double from)
{
  const std::size_t blocks = (items + Block - 1) / Block;
  const std::size_t busy = ThreadBlocks * std::size_t(std::max(execution.threads(), 1));
  const std::size_t batches = std::clamp(blocks / busy, std::size_t(1), MostBatches);
  std::vector<PairList> lists(blocks);
  for (std::size_t batch = 0; batch < batches; ++batch)
  {
    execution.checkpoint(from + (1.0 - from) * double(batch) / double(batches));
    const std::size_t firstBlock = blocks * batch / batches;
    execution.forRanges(blocks * (batch + 1) / batches - firstBlock, 1,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t b = firstBlock + first; b < firstBlock + last; ++b)
        {
          for (std::size_t i = b * Block; i < std::min(items, (b + 1) * Block); ++i)
          {
            find(i, lists[b]);
          }
        }
      });
  }
  PairList result;
  for (const PairList& list : lists)
  {
    result.insert(result.end(), list.begin(), list.end());
  }
  return result;
}

std::vector<std::int32_t> checkedSubset(const Mesh& mesh, std::vector<std::int32_t> subset)
{
  std::sort(subset.begin(), subset.end());
  subset.erase(std::unique(subset.begin(), subset.end()), subset.end());
  if (!subset.empty() && (subset.front() < 0 || std::size_t(subset.back()) >= mesh.triangles.size()))
  {
    const std::int32_t wrong = subset.front() < 0 ? subset.front() : subset.back();
    throw InvalidInput("triangle " + std::to_string(wrong) + " of the subset is none of the mesh's " +
      std::to_string(mesh.triangles.size()) + " triangles");
  }
  return subset;
}

std::vector<Triangle> trianglesOf(const Mesh& mesh, const std::vector<std::int32_t>& subset)
{
  std::vector<Triangle> result;
  result.reserve(subset.size());
  for (const std::int32_t t : subset)
  {
    result.push_back(mesh.triangles[t]);
  }
  return result;
}

/** Pairs among `triangles`, numbered by their place in it. */
PairList pairsAmong(
  const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles, Execution& execution)
{
  execution.checkpoint(0.0);
  const BoxTree tree = triangleTree(points, triangles, execution);
  PairList pairs = collect(
    tree.leafCount(),
    [&](std::size_t leaf, PairList& list)
    {
      tree.overlappingPairs(leaf,
        [&](std::int32_t a, std::int32_t b)
        {
          if (trianglesIntersect(points, triangles[a], triangles[b]))
          {
            list.push_back({ std::min(a, b), std::max(a, b) });
          }
        });
    },
    execution, 0.2);
  for (std::size_t t = 0; t < triangles.size(); ++t)
  {
    if (isDegenerate(points, triangles[t]))
    {
      pairs.push_back({ std::int32_t(t), std::int32_t(t) });
    }
  }
  std::sort(pairs.begin(), pairs.end());
  execution.progress(1.0);
  return pairs;
}

} // namespace

std::vector<TrianglePair> selfIntersections(const Mesh& mesh, Execution& execution)
{
  checkMesh(mesh);
  return pairsAmong(mesh.points, mesh.triangles, execution);
}

std::vector<TrianglePair> selfIntersectionsAmong(
  const Mesh& mesh, const std::vector<std::int32_t>& subset, Execution& execution)
{
  checkMesh(mesh);
  const std::vector<std::int32_t> sorted = checkedSubset(mesh, subset);
  PairList pairs = pairsAmong(mesh.points, trianglesOf(mesh, sorted), execution);
  for (TrianglePair& pair : pairs)
  {
    pair = { sorted[pair[0]], sorted[pair[1]] };
  }
  return pairs;
}

std::vector<TrianglePair> selfIntersectionsWith(
  const Mesh& mesh, const std::vector<std::int32_t>& subset, Execution& execution)
{
  Phase among(execution, 0.0, 0.5);
  PairList pairs = selfIntersectionsAmong(mesh, subset, among);
  const std::vector<std::int32_t> sorted = checkedSubset(mesh, subset);
  std::vector<std::uint8_t> inSubset(mesh.triangles.size(), 0);
  for (const std::int32_t t : sorted)
  {
    inSubset[t] = 1;
  }
  const BoxTree tree = triangleTree(mesh.points, trianglesOf(mesh, sorted), execution);
  const auto meetOutsider = [&](std::size_t item, PairList& list)
  {
    const Triangle& outsider = mesh.triangles[item];
    if (inSubset[item] != 0)
    {
      return;
    }
    tree.overlapping(triangleBox(mesh.points, outsider),
      [&](std::int32_t place)
      {
        const auto t = std::int32_t(item);
        if (trianglesIntersect(mesh.points, mesh.triangles[sorted[place]], outsider))
        {
          list.push_back({ std::min(sorted[place], t), std::max(sorted[place], t) });
        }
      });
  };
  const PairList others = collect(mesh.triangles.size(), meetOutsider, execution, 0.5);
  pairs.insert(pairs.end(), others.begin(), others.end());
  std::sort(pairs.begin(), pairs.end());
  execution.progress(1.0);
  return pairs;
}

} // namespace silhouette
