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
  int parts = 0; ///< of what is inside or taken, that the corner touched then
};

/** Which points around a corner are inside, or taken. */
Neighbourhood labelsAround(const CornerSurroundings& surroundings, const std::vector<std::uint8_t>& taken)
{
  Neighbourhood labels(surroundings.beyond);
  for (std::size_t n = 0; n < labels.size(); ++n)
  {
    const std::int32_t corner = surroundings.corners[n];
    labels[n] = n != 13 && (corner >= 0 ? taken[std::size_t(corner)] != 0 : labels[n]);
  }
  return labels;
}

/** Of some corners of the shell, each in its place; found side by side, in the order of the lattice, where neighbours are found fastest. */
std::vector<CornerSurroundings> surroundings(
  const LatticeLabels& labels, const std::vector<std::uint8_t>& taken, const std::uint32_t* corners, std::size_t count, Execution& execution)
{
  std::vector<std::uint32_t> order(count);
  std::iota(order.begin(), order.end(), std::uint32_t(0));
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return corners[a] < corners[b]; });
  std::vector<CornerSurroundings> found(count);
  execution.forRanges(count, 256,
    [&](std::size_t first, std::size_t last)
    {
      CodeCursor shell(labels.shell().corners), cells(labels.shell().cells);
      LabelCache beyond(labels);
      for (std::size_t n = first; n < last; ++n)
      {
        CornerSurroundings& own = found[order[n]];
        const std::uint32_t corner = corners[order[n]];
        const LatticePoint p = fromMorton(labels.shell().corners[corner]);
        const CodesAround codes(p);
        for (int a = 0; a < 27; ++a)
        {
          own.corners[std::size_t(a)] = std::int32_t(shell.find(codes[a]));
          own.beyond |= std::uint32_t(own.corners[std::size_t(a)] < 0 && beyond.insideAt(codes[a])) << a;
        }
        own.parts = topologicalNumbers(labelsAround(own, taken)).inside;
        // Lowest corners of the cells around are those of the 27 that are no step ahead on any axis; the cell ahead on all comes first.
        for (int cell = 7; cell >= 0; --cell)
        {
          const LatticePoint o = cornerOffset(cell);
          const std::ptrdiff_t at = cells.find(codes[o.i + 3 * o.j + 9 * o.k]);
          if (at >= 0 && labels.isSurvivor(std::size_t(at)))
          {
            own.cells[std::size_t(own.cellCount++)] = std::uint32_t(at);
          }
        }
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
    , Changed(Taken.size(), 0)
  {
  }

  /** The corners' surroundings now. */
  std::vector<CornerSurroundings> look(const std::uint32_t* corners, std::size_t count, Execution& execution)
  {
    ++this->Looks;
    return surroundings(this->Labels, this->Taken, corners, count, execution);
  }

  /** Take a corner that the field allows, unless it joins parts that meet anyway; what it joins beyond that is noted. */
  void grow(std::uint32_t corner, const CornerSurroundings& around)
  {
    if (!this->mayTouch(corner, around, 1))
    {
      return;
    }
    const auto parts = this->partsAround(around, {});
    if (!parts.empty() && !this->anyMeet(parts))
    {
      this->take(corner, around, parts);
    }
  }

  /** Take a corner if it joins survivors that touch in it and do not meet otherwise. */
  void join(std::uint32_t corner, const CornerSurroundings& around)
  {
    if (around.cellCount < 2 || !this->mayTouch(corner, around, 2))
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
      this->take(corner, around, parts);
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

  /** False where the corner touched fewer parts when its surroundings were looked at, and none of these has changed since. */
  bool mayTouch(std::uint32_t corner, const CornerSurroundings& around, int parts) const
  {
    return around.parts >= parts || this->Changed[corner] == this->Looks;
  }

  /** A corner, of `among` if that is not empty, of each part around a corner; nothing where a part has none. */
  std::vector<std::uint32_t> partsAround(const CornerSurroundings& surroundings, const std::vector<std::uint32_t>& among)
  {
    const auto& around = surroundings.corners;
    const TopologicalNumbers numbers = topologicalNumbers(labelsAround(surroundings, this->Taken));
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

  void take(std::uint32_t corner, const CornerSurroundings& around, const std::vector<std::uint32_t>& parts)
  {
    this->Taken[corner] = 1;
    for (const std::int32_t other : around.corners)
    {
      if (other >= 0)
      {
        this->Changed[std::size_t(other)] = this->Looks;
      }
    }
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
  std::vector<std::uint32_t> Changed; ///< for each corner the last look after which one around it was taken
  std::uint32_t Looks = 0;
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
    const auto around = joining.look(&corners[first], std::min(Batch, corners.size() - first), execution);
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
