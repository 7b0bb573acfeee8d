// SPDX-License-Identifier: BSD-3-Clause
#include "HandleJoining.h"

#include "Error.h"
#include "CodeCursor.h"
#include "LabelCache.h"
#include "ShellPaths.h"
#include "SimplePoint.h"

#include <algorithm>
#include <cstdlib>
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

class Joining
{
public:
  Joining(const LatticeLabels& labels, int loop)
    : Labels(labels)
    , Shell(labels.shell().corners)
    , Beyond(labels)
    , Loop(loop)
    , Taken(labels.inside())
    , From(Taken.size(), Nobody)
    , Paths(labels.shell(), Taken)
  {
  }

  /** Take a corner that the field allows, unless it joins parts that meet anyway; what it joins beyond that is noted. */
  void grow(std::uint32_t corner)
  {
    const auto parts = this->partsAround(corner, {});
    if (!parts.empty() && !this->anyMeet(parts))
    {
      this->take(corner, parts);
    }
  }

  /** Take a corner if it joins survivors that touch in it and do not meet otherwise. */
  void join(std::uint32_t corner)
  {
    std::array<std::uint32_t, 8> cells;
    const int count = this->Labels.cellsAround(fromMorton(this->Labels.shell().corners[corner]), cells);
    if (count < 2)
    {
      return;
    }
    std::vector<std::uint32_t> ends;
    for (int n = 0; n < count; ++n)
    {
      const auto& corners = this->Labels.shell().cellCorners[cells[n]];
      ends.insert(ends.end(), corners.begin(), corners.end());
    }
    const auto parts = this->partsAround(corner, ends);
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
  std::vector<std::uint32_t> partsAround(std::uint32_t corner, const std::vector<std::uint32_t>& among)
  {
    Neighbourhood labels;
    std::array<std::ptrdiff_t, 27> around;
    for (int n = 0; n < 27; ++n)
    {
      const LatticePoint p = neighbourOf(fromMorton(this->Labels.shell().corners[corner]), n);
      around[n] = this->Shell.find(mortonCode(p));
      labels[n] = n != 13 && (around[n] >= 0 ? this->Taken[around[n]] != 0 : this->Beyond.insideAt(p));
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
  CodeCursor Shell;
  LabelCache Beyond; ///< of points that are no corners of the shell
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
  for (std::size_t n = 0; n < corners.size(); ++n)
  {
    if (n % 4096 == 0)
    {
      execution.checkpoint(double(n) / double(corners.size()));
    }
    if (labels.support()[corners[n]] > least)
    {
      joining.grow(corners[n]);
    }
    else
    {
      joining.join(corners[n]);
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
