// SPDX-License-Identifier: BSD-3-Clause
#include "RobustLabels.h"

#include "Bits.h"
#include "BlockBits.h"
#include "Carving.h"
#include "CodeCursor.h"
#include "IndicesWhere.h"
#include "LabelCache.h"
#include "LatticeRegions.h"
#include "PointBlocks.h"
#include "VotingMarchingCubes.h"

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>

namespace silhouette
{
namespace
{

/** Carve the repaired views and make their surface, with as many background votes as before. */
void carveAgain(const Octree& octree, CorrectedCapture& capture, Execution& execution)
{
  CarveOptions carving;
  carving.backgroundVotes = octree.backgroundVotes;
  Phase first(execution, 0.0, 0.6);
  capture.recarved = carve(LatticeViews(*capture.repaired, octree.lattice), carving, first);
  VotingOptions voting;
  voting.share = 1.0 - double(octree.backgroundVotes) / octree.viewCount;
  Phase second(execution, 0.6, 1.0);
  capture.surface = votingMarchingCubes(*capture.recarved, *capture.repaired, voting, second).mesh;
}

/** Cells of the field's bricks that lie outside by the field and in an inside octant. */
std::vector<std::uint64_t> contradictedCells(const Octree& octree, const BrickField& field, Execution& execution)
{
  std::vector<std::vector<std::uint64_t>> found(field.bricks().size());
  execution.forRanges(found.size(), 8,
    [&](std::size_t first, std::size_t last)
    {
      OctantCursor octants(octree);
      for (std::size_t n = first * BrickField::BrickPoints; n < last * BrickField::BrickPoints; n += 64)
      {
        const std::uint64_t block = field.code(n) >> 6, outside = ~positiveBits(&field.values()[n]);
        // Most blocks are alike, and what they are not need not be asked.
        const std::uint64_t contradicted = outside == 0
          ? 0
          : outside & octants.cellsOfBlock(block, [](const Octree::Location& octant) { return octant.state == OctantState::Inside; });
        for (std::uint64_t left = contradicted; left != 0; left &= left - 1)
        {
          const std::uint64_t cell = 64 * block + std::uint64_t(lowestBit(left));
          if (octree.lattice.hasCell(fromMorton(cell)))
          {
            found[n / BrickField::BrickPoints].push_back(cell);
          }
        }
      }
    });
  std::vector<std::uint64_t> cells;
  for (const auto& some : found)
  {
    cells.insert(cells.end(), some.begin(), some.end());
  }
  return cells;
}

/** Sets of a brick's points: eight blocks, a bit each. */
using BrickBits = std::array<std::uint64_t, 8>;

/** For each of the 27 bricks around and including one, by neighbourOf(): which of that one's points have a neighbour there. */
std::array<BrickBits, 27> pointsBesideBricks()
{
  std::array<BrickBits, 27> beside{};
  const auto touches = [](int x, int side) { return side == 1 || x == (side == 0 ? 0 : BrickField::BrickSize - 1); };
  for (std::uint64_t n = 0; n < BrickField::BrickPoints; ++n)
  {
    const LatticePoint p = fromMorton(n);
    for (int brick = 0; brick < 27; ++brick)
    {
      if (touches(p.i, brick % 3) && touches(p.j, brick / 3 % 3) && touches(p.k, brick / 9))
      {
        beside[std::size_t(brick)][n / 64] |= std::uint64_t(1) << n % 64;
      }
    }
  }
  return beside;
}

/** Which points of a brick have a neighbour in a brick that is not there. */
BrickBits pointsWhereBricksEnd(std::uint64_t brick, BrickCursor& bricks)
{
  static const std::array<BrickBits, 27> beside = pointsBesideBricks();
  const LatticePoint b = fromMorton(brick);
  BrickBits ends{};
  for (int n = 0; n < 27; ++n)
  {
    const LatticePoint q = neighbourOf(b, n);
    const bool isThere = q.i >= 0 && q.j >= 0 && q.k >= 0 && bricks.find(BrickField::BrickPoints * mortonCode(q)) >= 0;
    for (std::size_t block = 0; block < 8 && !isThere; ++block)
    {
      ends[block] |= beside[std::size_t(n)][block];
    }
  }
  return ends;
}

/**
 * Where the bricks end, the field says what the octree says, so that no surface leaves them except through the octree's own
 * intersection octants.
 */
void pinWhereBricksEnd(const Octree& octree, BrickField& field, Execution& execution)
{
  execution.forRanges(field.bricks().size(), 8,
    [&](std::size_t first, std::size_t last)
    {
      BrickCursor bricks(field);
      OctantCursor octants(octree);
      for (std::size_t brick = first; brick < last; ++brick)
      {
        const BrickBits ends = pointsWhereBricksEnd(field.bricks()[brick], bricks);
        for (std::size_t block = 0; block < 8; ++block)
        {
          float* values = &field.values()[brick * BrickField::BrickPoints + 64 * block];
          const std::uint64_t positive = ends[block] != 0 ? positiveBits(values) : 0;
          const std::uint64_t wrong = ends[block] != 0 ? ends[block] & (positive ^ touchingInside(8 * field.bricks()[brick] + block, octants)) : 0;
          for (std::uint64_t left = wrong; left != 0; left &= left - 1)
          {
            values[lowestBit(left)] = (positive & left & (0 - left)) != 0 ? -0.5f : 0.5f;
          }
        }
      }
    });
}

/** Last-generation inside octants of `octree` without an inside corner by the labels' source: they need covering too. */
std::vector<std::uint64_t> disownedOctants(const Octree& octree, const LatticeLabels& labels, Execution& execution)
{
  const std::vector<std::uint64_t> inside = leafCells(octree, OctantState::Inside, execution);
  const auto makeTest = [&]
  {
    return [&, cache = LabelCache(labels)](std::size_t n) mutable
    {
      const LatticePoint lowest = fromMorton(inside[n]);
      bool any = false;
      for (int corner = 0; corner < 8; ++corner)
      {
        any = any || cache.insideAt(lowest + cornerOffset(corner));
      }
      return !any;
    };
  };
  return codesWhere(inside, execution, makeTest);
}

/** Label those of some points outside that are corners of the shell. */
void labelOutside(LatticeLabels& labels, const std::vector<std::uint64_t>& points)
{
  for (const std::uint64_t point : points)
  {
    const std::ptrdiff_t corner = labels.shell().find(point);
    if (corner >= 0)
    {
      labels.setOutside(std::size_t(corner));
    }
  }
}

/** The cells of a block, a bit each, that have all of their corners inside. */
std::uint64_t cellsInside(std::uint64_t block, const LatticeLabels& labels)
{
  std::array<std::uint64_t, 8> corners;
  for (int n = 0; n < 8; ++n)
  {
    corners[std::size_t(n)] = labels.insideOfBlock(mortonCode(fromMorton(block) + cornerOffset(n)));
  }
  bringCorners(corners);
  return std::accumulate(corners.begin(), corners.end(), ~std::uint64_t(0), std::bit_and<std::uint64_t>());
}

/** Those of some cells (Morton codes, ascending) that have a corner outside. */
std::vector<std::uint64_t> cellsWithOutside(const std::vector<std::uint64_t>& cells, const LatticeLabels& labels, Execution& execution)
{
  const auto makeTest = [&]
  {
    return [&, block = ~std::uint64_t(0), whole = std::uint64_t(0)](std::size_t n) mutable
    {
      if (cells[n] >> 6 != block)
      {
        block = cells[n] >> 6;
        whole = cellsInside(block, labels);
      }
      return (whole >> (cells[n] & 63) & 1) == 0;
    };
  };
  return codesWhere(cells, execution, makeTest);
}

/**
 * Labels by a field, which tells about all points: the shell needs only the cells where something is to be contoured or covered, none that has all of its corners
 * inside.
 */
LatticeLabels labelsByField(const Octree& octree, const std::vector<std::uint64_t>& intersection, const std::vector<std::uint64_t>& points,
  const CorrectedCapture& capture, Execution& execution)
{
  const Octree& base = capture.recarved ? *capture.recarved : octree;
  const BrickField& field = *capture.correction.field;
  const LatticeLabels everywhere(base, CornerShell(), field, execution);
  const auto survivors = united(intersection, disownedOctants(octree, everywhere, execution));
  std::vector<std::uint64_t> cells = united(survivors, contradictedCells(base, field, execution));
  if (capture.recarved)
  {
    cells = united(cells, leafCells(base, OctantState::Intersection, execution));
  }
  const auto unsupported = unsupportedPoints(everywhere, survivors, execution);
  cells = united(cellsWithOutside(cells, everywhere, execution), field.mixedCells(execution));
  cells = united(united(cells, cellsAround(points, execution)), cellsAround(unsupported, execution));
  LatticeLabels labels(base, makeCornerShell(cells, execution), field, execution);
  labels.setSurvivors(survivors, execution);
  labelOutside(labels, unsupported);
  return labels;
}

} // namespace

std::vector<std::uint64_t> cellsMissingAround(const CornerShell& shell, const std::vector<std::uint64_t>& points, Execution& execution)
{
  const std::vector<std::uint64_t> cells = cellsAround(points, execution);
  const auto isMissing = [&] { return [&, known = CodeCursor(shell.cells)](std::size_t n) mutable { return known.find(cells[n]) < 0; }; };
  return codesWhere(cells, execution, isMissing);
}

CornerShell extendedShell(const CornerShell& shell, const std::vector<std::uint64_t>& points, Execution& execution)
{
  return withCells(shell, cellsMissingAround(shell, points, execution), execution);
}

CorrectedCapture correctCapture(const Mesh& imperfect, const Octree& octree, const CornerShell& shell, const PreparedViews& views,
  const LocalHullOptions& options, Execution& execution)
{
  CorrectedCapture capture;
  if (options.repairSilhouettes)
  {
    Phase repairing(execution, 0.0, 0.2);
    SilhouetteRepair repair = repairSilhouettes(octree, shell, views, options.repair, repairing);
    for (std::size_t view = 0; view < repair.blobs.size(); ++view)
    {
      capture.repairedPixels += repair.blobs[view] + repair.speckles[view];
    }
    capture.repaired = std::move(repair.views);
    capture.votes = std::move(repair.votes);
  }
  if (capture.repaired)
  {
    Phase carving(execution, 0.2, 0.4);
    carveAgain(octree, capture, carving);
  }
  Phase correcting(execution, 0.4, 1.0);
  capture.correction = correctField(capture.surface ? *capture.surface : imperfect, octree.lattice,
    capture.repaired ? *capture.repaired : views, options.correction, shell.cells, octree.backgroundVotes, correcting);
  if (capture.correction.field)
  {
    pinWhereBricksEnd(capture.recarved ? *capture.recarved : octree, *capture.correction.field, execution);
  }
  return capture;
}

LatticeLabels correctedLabels(const Octree& octree, CornerShell shell, const std::vector<std::uint64_t>& points,
  const PreparedViews& views, const CorrectedCapture& capture, Execution& execution)
{
  if (capture.correction.field)
  {
    return labelsByField(octree, shell.cells, points, capture, execution);
  }
  if (!capture.recarved)
  {
    if (points.empty() && capture.votes && capture.votes->size() == shell.corners.size())
    {
      return LatticeLabels(octree, std::move(shell), *capture.votes, execution);
    }
    return LatticeLabels(octree, points.empty() ? std::move(shell) : extendedShell(shell, points, execution), views, execution);
  }
  const Octree& base = *capture.recarved;
  std::vector<std::uint64_t> survivors = std::move(shell.cells);
  const auto cells = united(united(survivors, leafCells(base, OctantState::Intersection, execution)), cellsAround(points, execution));
  LatticeLabels labels(base, makeCornerShell(cells, execution), *capture.repaired, execution);
  const auto disowned = disownedOctants(octree, labels, execution);
  if (!disowned.empty())
  {
    survivors = united(survivors, disowned);
    labels = LatticeLabels(base, makeCornerShell(united(cells, disowned), execution), *capture.repaired, execution);
  }
  labels.setSurvivors(survivors, execution);
  labelOutside(labels, unsupportedPoints(labels, survivors, execution));
  return labels;
}

} // namespace silhouette
