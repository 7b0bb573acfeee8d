// SPDX-License-Identifier: BSD-3-Clause
#include "TreePieces.h"

#include "Carving.h"

#include <algorithm>
#include <numeric>

namespace silhouette
{
namespace
{

constexpr int CoarseDepth = 6;

void check(const Piece& piece)
{
  if (piece.count < 1 || piece.number < 0 || piece.number >= piece.count)
  {
    throw InvalidInput(
      "piece " + std::to_string(piece.number) + " of " + std::to_string(piece.count) + " is out of range");
  }
}

} // namespace

std::vector<std::uint64_t> weighTrees(const LatticeViews& views, int backgroundVotes, Execution& execution)
{
  Lattice lattice = views.lattice();
  lattice.depth = std::min(lattice.depth, CoarseDepth);
  CarveOptions options;
  options.backgroundVotes = backgroundVotes;
  const Octree coarse = carve(LatticeViews(views.prepared(), lattice), options, execution);
  const Generation& last = coarse.last();
  const int below = 3 * (lattice.depth - coarse.treeGeneration);
  std::vector<std::uint64_t> weights(std::size_t(1) << 3 * coarse.treeGeneration, 1);
  for (std::size_t i = 0; i < last.size(); ++i)
  {
    weights[last.code[i] >> below] += last.state[i] == OctantState::Intersection ? 64 : 0;
  }
  return weights;
}

std::vector<std::uint64_t> treesOfPiece(const std::vector<std::uint64_t>& weights, const Piece& piece)
{
  check(piece);
  const std::uint64_t whole = std::accumulate(weights.begin(), weights.end(), std::uint64_t(0));
  std::vector<std::uint64_t> trees;
  std::uint64_t before = 0;
  for (std::uint64_t tree = 0; tree < weights.size(); ++tree)
  {
    // A tree belongs to the piece that holds its middle.
    const std::uint64_t middle = 2 * before + weights[tree];
    if (middle * std::uint64_t(piece.count) / (2 * whole) == std::uint64_t(piece.number))
    {
      trees.push_back(tree);
    }
    before += weights[tree];
  }
  return trees;
}

Octree selectTrees(const Octree& octree, const std::vector<std::uint64_t>& trees)
{
  Octree part;
  part.lattice = octree.lattice;
  part.treeGeneration = octree.treeGeneration;
  part.viewCount = octree.viewCount;
  part.backgroundVotes = octree.backgroundVotes;
  part.outside = octree.outside;
  part.fingerprint = octree.fingerprint;
  part.statistics = octree.statistics;
  part.generations.resize(octree.generations.size());
  for (int g = octree.treeGeneration; g <= octree.lattice.depth; ++g)
  {
    const Generation& from = octree.generations[g];
    Generation& to = part.generations[g];
    const int below = 3 * (g - octree.treeGeneration);
    std::uint32_t blocks = 0;
    for (const std::uint64_t tree : trees)
    {
      const auto first = std::lower_bound(from.code.begin(), from.code.end(), tree << below) - from.code.begin();
      const auto last = std::lower_bound(from.code.begin() + first, from.code.end(), (tree + 1) << below) - from.code.begin();
      to.code.insert(to.code.end(), from.code.begin() + first, from.code.begin() + last);
      to.state.insert(to.state.end(), from.state.begin() + first, from.state.begin() + last);
    }
    for (const OctantState state : to.state)
    {
      to.childBlock.push_back(blocks);
      blocks += state == OctantState::Intersection;
    }
  }
  return part;
}

Octree mergeTrees(const std::vector<Octree>& parts)
{
  if (parts.empty())
  {
    throw InvalidInput("no parts of an octree to merge");
  }
  Octree whole = parts.front();
  whole.undecided = UndecidedViews();
  whole.votes.set(nullptr);
  whole.statistics = CarveStatistics();
  whole.statistics.carvedByView.assign(std::size_t(whole.viewCount), 0.0);
  for (const auto& part : parts)
  {
    whole.statistics.octantsTested += part.statistics.octantsTested;
    whole.statistics.viewTests += part.statistics.viewTests;
    for (int view = 0; view < whole.viewCount; ++view)
    {
      whole.statistics.carvedByView[view] += part.statistics.carvedByView[view];
    }
  }
  for (int g = whole.treeGeneration; g <= whole.lattice.depth; ++g)
  {
    std::vector<std::pair<std::uint64_t, OctantState>> octants;
    for (const auto& part : parts)
    {
      const auto& generation = part.generations[g];
      for (std::size_t i = 0; i < generation.size(); ++i)
      {
        octants.emplace_back(generation.code[i], generation.state[i]);
      }
    }
    std::sort(octants.begin(), octants.end());
    Generation merged;
    std::uint32_t blocks = 0;
    for (const auto& octant : octants)
    {
      merged.code.push_back(octant.first);
      merged.state.push_back(octant.second);
      merged.childBlock.push_back(blocks);
      blocks += octant.second == OctantState::Intersection;
    }
    whole.generations[g] = std::move(merged);
  }
  return whole;
}

PieceRange rangeOfPiece(std::size_t items, const Piece& piece)
{
  check(piece);
  const auto count = std::size_t(piece.count), number = std::size_t(piece.number);
  return { items * number / count, items * (number + 1) / count };
}

Mesh selectTriangles(const Mesh& mesh, const PieceRange& range)
{
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  for (std::size_t t = range.first; t < range.last; ++t)
  {
    for (const std::int32_t p : mesh.triangles[t])
    {
      number[p] = 0;
    }
  }
  Mesh part;
  for (std::size_t p = 0; p < number.size(); ++p)
  {
    if (number[p] == 0)
    {
      number[p] = std::int32_t(part.points.size());
      part.points.push_back(mesh.points[p]);
    }
  }
  for (std::size_t t = range.first; t < range.last; ++t)
  {
    const Triangle& whole = mesh.triangles[t];
    part.triangles.push_back({ number[whole[0]], number[whole[1]], number[whole[2]] });
  }
  return part;
}

} // namespace silhouette
