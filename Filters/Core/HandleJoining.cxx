// SPDX-License-Identifier: BSD-3-Clause
#include "HandleJoining.h"

#include "CodeCursor.h"
#include "Error.h"
#include "LabelCache.h"
#include "ShellPaths.h"
#include "SimplePoint.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <string>

namespace silhouette
{
namespace
{

void check(const HandleJoiningOptions& options)
{
  if (!(options.reach >= 0.0))
  {
    throw InvalidInput("handle reach " + std::to_string(options.reach) + " octants an octant: at least 0 is needed");
  }
  if (!(options.loop >= 0.0))
  {
    throw InvalidInput("handle loop " + std::to_string(options.loop) + " of the lattice's side: at least 0 is needed");
  }
}

/** What lies around a corner. */
struct CornerSurroundings
{
  std::array<std::int32_t, 27> corners; ///< of the shell, or -1
  std::uint32_t beyond = 0;             ///< the points that are no corners of the shell and inside, a bit each
  std::array<std::uint32_t, 8> cells;   ///< the surviving ones of the shell
  int cellCount = 0;
};

/** Of some corners of the shell, each in its place; found side by side, in the order of the lattice, where neighbours are found fastest. */
std::vector<CornerSurroundings> surroundings(const LatticeLabels& labels, const std::uint32_t* corners, std::size_t count, Execution& execution)
{
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), std::uint32_t(0));
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return corners[a] < corners[b]; });
  std::vector<CornerSurroundings> found(count);
  execution.forRanges(count, 256,
    [&](std::size_t first, std::size_t last)
    {
      CodeCursor shell(labels.shell().corners);
      LabelCache beyond(labels);
      for (std::size_t n = first; n < last; ++n)
      {
        CornerSurroundings& own = found[order[n]];
        const LatticePoint p = fromMorton(labels.shell().corners[corners[order[n]]]);
        for (int a = 0; a < 27; ++a)
        {
          const LatticePoint q = neighbourOf(p, a);
          own.corners[std::size_t(a)] = std::int32_t(shell.find(mortonCode(q)));
          own.beyond |= std::uint32_t(own.corners[std::size_t(a)] < 0 && beyond.insideAt(q)) << a;
        }
        own.cellCount = labels.cellsAround(p, own.cells);
      }
    });
  return found;
}

class Joining
{
public:
  Joining(const LatticeLabels& labels, int loop)
    : Labels(labels)
    , Loop(loop)
    , Taken(labels.inside())
    , From(Taken.size(), Nobody)
    , Paths(labels.shell(), Taken)
  {
  }

  /** Take a corner that the field allows, unless it joins parts that meet anyway; what it joins beyond that is noted. */
  void grow(std::uint32_t corner, const CornerSurroundings& around)
  {
    const auto parts = this->partsAround(around, {});
    if (!parts.empty() && !this->anyMeet(parts))
    {
      this->take(corner, parts);
    }
  }

  /** Take a corner if it joins survivors that touch in it and do not meet otherwise. */
  void join(std::uint32_t corner, const CornerSurroundings& around)
  {
    if (around.cellCount < 2)
    {
      return;
    }
    std::vector<std::uint32_t> ends;
    for (int n = 0; n < around.cellCount; ++n)
    {
      const auto& corners = this->Labels.shell().cellCorners[around.cells[std::size_t(n)]];
      ends.insert(ends.end(), corners.begin(), corners.end());
    }
    const auto parts = this->partsAround(around, ends);
    if (parts.size() > 1 && !this->anyMeet(parts))
    {
      this->take(corner, parts);
    }
  }

  /** Shell corners, each once. */
  std::vector<std::uint32_t> joints()
  {
    std::sort(this->Joints.begin(), this->Joints.end());
    this->Joints.erase(std::unique(this->Joints.begin(), this->Joints.end()), this->Joints.end());
    return this->Joints;
  }

private:
  static constexpr std::uint32_t Nobody = 0xffffffffu;

  /** A corner, of `among` if that is not empty, of each part around a corner; nothing where a part has none. */
  std::vector<std::uint32_t> partsAround(const CornerSurroundings& surroundings, const std::vector<std::uint32_t>& among)
  {
    Neighbourhood labels;
    const auto& around = surroundings.corners;
    for (int n = 0; n < 27; ++n)
    {
      labels[n] = n != 13 && (around[n] >= 0 ? this->Taken[std::size_t(around[n])] != 0 : (surroundings.beyond >> n & 1) != 0);
    }
    const TopologicalNumbers numbers = topologicalNumbers(labels);
    std::vector<std::uint32_t> parts(numbers.inside, Nobody); // a corner of each, of the shell
    for (int n = 0; n < 27; ++n)
    {
      const bool counts = numbers.insideComponent[n] >= 0 && around[n] >= 0 && isBesideCentre(n) &&
        (among.empty() || std::find(among.begin(), among.end(), std::uint32_t(around[n])) != among.end());
      if (counts && parts[numbers.insideComponent[n]] == Nobody)
      {
        parts[numbers.insideComponent[n]] = std::uint32_t(around[n]);
      }
    }
    return std::count(parts.begin(), parts.end(), Nobody) > 0 ? std::vector<std::uint32_t>() : parts;
  }

  bool anyMeet(const std::vector<std::uint32_t>& parts)
  {
    for (std::size_t a = 0; a < parts.size(); ++a)
    {
      for (std::size_t b = a + 1; b < parts.size(); ++b)
      {
        if (this->Paths.meet(parts[a], parts[b], this->Loop))
        {
          return true;
        }
      }
    }
    return false;
  }

  void take(std::uint32_t corner, const std::vector<std::uint32_t>& parts)
  {
    this->Taken[corner] = 1;
    this->From[corner] = parts[0];
    if (parts.size() > 1)
    {
      this->Joints.push_back(corner);
      for (std::uint32_t part : parts)
      {
        for (; part != Nobody && !this->Labels.inside()[part]; part = this->From[part])
        {
          this->Joints.push_back(part);
        }
      }
    }
  }

  const LatticeLabels& Labels;
  int Loop;
  std::vector<std::uint8_t> Taken;
  std::vector<std::uint32_t> From; ///< towards the solid
  ShellPaths Paths;
  std::vector<std::uint32_t> Joints;
};

} // namespace

int loopSteps(const Lattice& lattice, const HandleJoiningOptions& options)
{
  return int(std::min(options.loop, 1e3) * lattice.cells());
}

std::vector<std::uint64_t> handleJoints(
  const LatticeLabels& labels, double deficit, const HandleJoiningOptions& options, Execution& execution)
{
  check(options);
  const float least = float(-options.reach * deficit);
  const auto& shell = labels.shell();
  std::vector<std::uint32_t> corners;
  for (std::uint32_t c = 0; labels.field() && options.joinHandles && c < shell.corners.size(); ++c)
  {
    if (!labels.inside()[c] && !labels.octree().lattice.onBorder(fromMorton(shell.corners[c])))
    {
      corners.push_back(c);
    }
  }
  std::stable_sort(corners.begin(), corners.end(),
    [&](std::uint32_t a, std::uint32_t b) { return labels.support()[a] > labels.support()[b]; });
  Joining joining(labels, loopSteps(labels.octree().lattice, options));
  constexpr std::size_t Batch = 1 << 17; // what lies around so many is remembered, some 20 MB
  for (std::size_t first = 0; first < corners.size(); first += Batch)
  {
    execution.checkpoint(double(first) / double(corners.size()));
    const auto around = surroundings(labels, &corners[first], std::min(Batch, corners.size() - first), execution);
    for (std::size_t n = 0; n < around.size(); ++n)
    {
      const std::uint32_t corner = corners[first + n];
      labels.support()[corner] > least ? joining.grow(corner, around[n]) : joining.join(corner, around[n]);
    }
  }
  execution.checkpoint(1.0);
  std::vector<std::uint64_t> joints;
  for (const std::uint32_t corner : joining.joints())
  {
    joints.push_back(shell.corners[corner]);
  }
  return joints;
}

} // namespace silhouette
