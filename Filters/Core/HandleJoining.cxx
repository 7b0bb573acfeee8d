// SPDX-License-Identifier: BSD-3-Clause
#include "HandleJoining.h"

#include "Bits.h"
#include "CodeCursor.h"
#include "Error.h"
#include "IndicesWhere.h"
#include "LabelCache.h"
#include "ParameterRange.h"
#include "ShellPaths.h"
#include "SimplePoint.h"

#include <algorithm>
#include <array>
#include <set>
#include <string>

namespace silhouette
{
namespace
{

void check(const HandleJoiningOptions& options)
{
  requireRange("handle reach", options.reach, 0.0);
  requireRange("loop length", options.loop, 0.0);
}

/** The points of the 27 around a corner that it is connected with where both are inside, a bit each. */
constexpr std::uint32_t besideCentre()
{
  std::uint32_t points = 0;
  for (const int n : SolidNeighbours)
  {
    points |= std::uint32_t(1) << n;
  }
  return points;
}

/** The corners of the cell whose lowest corner is the first of the 27 points, a bit each. */
constexpr std::uint32_t cellPoints()
{
  std::uint32_t points = 0;
  for (int n = 0; n < 8; ++n)
  {
    points |= std::uint32_t(1) << ((n & 1) + 3 * (n >> 1 & 1) + 9 * (n >> 2));
  }
  return points;
}

/** What lies around a corner. */
struct Surroundings
{
  std::array<std::int32_t, 27> corners; ///< of the shell, or -1
  std::uint32_t inShell = 0;            ///< the points that are corners of the shell, a bit each; but for itself
  std::uint32_t beyond = 0;             ///< the others that are inside
};

/** Finds what lies around corners, fastest in the order of the lattice. Not for several threads at once. */
class SurroundingsFinder
{
public:
  explicit SurroundingsFinder(const LatticeLabels& labels)
    : Labels(labels)
    , Corners(labels.shell().corners)
    , Cells(labels.shell().cells)
    , Beyond(labels)
  {
  }

  Surroundings around(std::uint32_t corner)
  {
    Surroundings found;
    const CodesAround codes(this->point(corner));
    for (int n = 0; n < 27; ++n)
    {
      found.corners[std::size_t(n)] = n != 13 ? std::int32_t(this->Corners.find(codes[n])) : -1;
      const bool isCorner = found.corners[std::size_t(n)] >= 0;
      found.inShell |= std::uint32_t(isCorner) << n;
      found.beyond |= std::uint32_t(n != 13 && !isCorner && this->Beyond.insideAt(codes[n])) << n;
    }
    return found;
  }

  /** The points around that are corners of surviving cells around, a bit each; none where fewer than two of these survive. */
  std::uint32_t survivorsAround(std::uint32_t corner)
  {
    const CodesAround codes(this->point(corner));
    std::uint32_t points = 0;
    int cells = 0;
    for (int cell = 0; cell < 8; ++cell)
    {
      // Lowest corners of the cells around are those of the 27 that are no step ahead on any axis.
      const LatticePoint o = cornerOffset(cell);
      const int lowest = o.i + 3 * o.j + 9 * o.k;
      const std::ptrdiff_t at = this->Cells.find(codes[lowest]);
      if (at >= 0 && this->Labels.isSurvivor(std::size_t(at)))
      {
        ++cells;
        points |= cellPoints() << lowest;
      }
    }
    return cells < 2 ? 0 : points;
  }

private:
  LatticePoint point(std::uint32_t corner) const { return fromMorton(this->Labels.shell().corners[corner]); }

  const LatticeLabels& Labels;
  CodeCursor Corners;
  CodeCursor Cells;
  LabelCache Beyond;
};

/**
 * The growth comes to the corners one after another, the greatest value first. Nearly all of them touch one part of what is inside by then and are taken, and what
 * a corner touches depends on the corners that come before it and are taken; so all that may be different is found side by side, as if all were taken, and only
 * these corners, and those around one that is not taken after all, are come to in turn.
 */
class Joining
{
public:
  Joining(const LatticeLabels& labels, float least, int loop, Execution& execution)
    : Labels(labels)
    , Least(least)
    , Loop(loop)
    , States(labels.inside().size())
    , Paths(labels.shell())
    , Finder(labels)
    , Run(execution)
  {
    execution.forRanges(this->States.size(), 4096,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t c = first; c < last; ++c)
        {
          this->States[c] = this->Labels.inside()[c] ? Inside : this->isAllowed(std::uint32_t(c)) && this->mayBeTaken(std::uint32_t(c)) ? InTurn : Outside;
        }
      });
  }

  /** Take corners that the field allows, unless they join parts that meet anyway; what they join beyond that is noted. */
  void grow()
  {
    Queue queue = this->queueOf([&](std::uint32_t corner, SurroundingsFinder& finder)
      { return this->States[corner] == InTurn && this->partsAround(corner, finder).count != 1; });
    this->visitInTurn(std::move(queue), [&](std::uint32_t corner)
      {
        const Parts parts = this->partsAround(corner, this->Finder);
        if (parts.count == 0 || this->anyMeet(corner, parts))
        {
          this->States[corner] = Outside;
          return true;
        }
        if (parts.count > 1)
        {
          this->addJoint(corner, parts);
        }
        return false;
      });
  }

  /** Further outside, take corners that join survivors which touch in them and do not meet otherwise. */
  void join()
  {
    Queue queue = this->queueOf([&](std::uint32_t corner, SurroundingsFinder& finder)
      { return this->waits(corner) && this->partsAround(corner, finder).count > 1; });
    this->visitInTurn(std::move(queue), [&](std::uint32_t corner)
      {
        const Parts parts = this->partsAround(corner, this->Finder);
        if (parts.count < 2 || this->anyMeet(corner, parts))
        {
          return false;
        }
        this->States[corner] = InTurn;
        this->addJoint(corner, parts);
        return true;
      });
  }

  /** Shell corners, each once. */
  std::vector<std::uint32_t> joints()
  {
    std::sort(this->Joints.begin(), this->Joints.end());
    this->Joints.erase(std::unique(this->Joints.begin(), this->Joints.end()), this->Joints.end());
    return this->Joints;
  }

private:
  enum State : std::uint8_t
  {
    Outside,
    Inside,
    InTurn ///< taken when the growth comes to it
  };

  /** A corner of each part around one; none where a part has no corner that counts. */
  struct Parts
  {
    std::array<std::uint32_t, 26> corners;
    int count = 0;
  };

  /** Does the growth come to `a` before `b`? */
  struct Earlier
  {
    const std::vector<float>& support;

    bool operator()(std::uint32_t a, std::uint32_t b) const
    {
      return this->support[a] != this->support[b] ? this->support[a] > this->support[b] : a < b;
    }
  };
  using Queue = std::set<std::uint32_t, Earlier>;

  Earlier earlier() const { return { this->Labels.support() }; }
  bool isAllowed(std::uint32_t corner) const { return this->Labels.support()[corner] > this->Least; }
  /** May a corner that is not inside be taken at all? */
  bool mayBeTaken(std::uint32_t corner) const
  {
    return !this->Labels.octree().lattice.onBorder(fromMorton(this->Labels.shell().corners[corner]));
  }
  /** Is a corner outside, further than the field allows, and may be taken? */
  bool waits(std::uint32_t corner) const { return this->States[corner] == Outside && !this->isAllowed(corner) && this->mayBeTaken(corner); }
  /** Is a corner inside or taken when the growth comes to `now`? */
  bool isTaken(std::uint32_t corner, std::uint32_t now) const
  {
    return this->States[corner] == Inside || (this->States[corner] == InTurn && this->earlier()(corner, now));
  }

  /** The corners for which a test holds, which may be asked at the same time. */
  template <typename Test>
  Queue queueOf(const Test& test)
  {
    const auto corners = indicesWhereTests(this->States.size(), 4096, this->Run,
      [&] { return [&, finder = SurroundingsFinder(this->Labels)](std::size_t corner) mutable { return test(std::uint32_t(corner), finder); }; });
    std::vector<std::uint32_t> order(corners.begin(), corners.end());
    std::sort(order.begin(), order.end(), this->earlier());
    return Queue(order.begin(), order.end(), this->earlier());
  }

  /** Visit the corners in turn, and those around one, later in turn, that is not what it was taken for, as `visit(corner)` tells. */
  template <typename Visit>
  void visitInTurn(Queue queue, const Visit& visit)
  {
    for (std::size_t visited = 0; !queue.empty(); ++visited)
    {
      if (visited % 4096 == 0)
      {
        this->Run.checkpoint(0.5);
      }
      const std::uint32_t corner = *queue.begin();
      queue.erase(queue.begin());
      const State before = this->States[corner];
      if (!visit(corner))
      {
        continue;
      }
      for (const std::int32_t other : this->Finder.around(corner).corners)
      {
        if (other >= 0 && this->isOfKind(std::uint32_t(other), before) && this->earlier()(corner, std::uint32_t(other)))
        {
          queue.insert(std::uint32_t(other));
        }
      }
    }
  }

  /** Does the growth still have to come to a corner as it came to one that was in this state? */
  bool isOfKind(std::uint32_t corner, State state) const { return state == InTurn ? this->States[corner] == InTurn : this->waits(corner); }

  /** When the growth comes to a corner: the parts of what is inside or taken that it touches; further outside than the field allows, if survivors in it belong to them. */
  Parts partsAround(std::uint32_t corner, SurroundingsFinder& finder) const
  {
    Parts parts;
    const std::uint32_t among = this->isAllowed(corner) ? ~std::uint32_t(0) : finder.survivorsAround(corner);
    if (among == 0)
    {
      return parts;
    }
    const Surroundings around = finder.around(corner);
    std::uint32_t taken = around.beyond;
    for (std::uint32_t left = around.inShell; left != 0; left &= left - 1)
    {
      const int n = lowestBit(left);
      taken |= std::uint32_t(this->isTaken(std::uint32_t(around.corners[std::size_t(n)]), corner)) << n;
    }
    std::array<std::uint32_t, 26> members;
    const int count = solidParts(Neighbourhood(taken), members);
    for (int part = 0; part < count; ++part)
    {
      const std::uint32_t counting = members[std::size_t(part)] & around.inShell & among & besideCentre();
      if (counting == 0)
      {
        return parts; // none
      }
      parts.corners[std::size_t(part)] = std::uint32_t(around.corners[std::size_t(lowestBit(counting))]);
    }
    parts.count = count;
    return parts;
  }

  bool anyMeet(std::uint32_t corner, const Parts& parts)
  {
    for (int a = 0; a < parts.count; ++a)
    {
      for (int b = a + 1; b < parts.count; ++b)
      {
        if (this->Paths.meet(parts.corners[std::size_t(a)], parts.corners[std::size_t(b)], this->Loop,
              [&](std::uint32_t other) { return this->isTaken(other, corner); }))
        {
          return true;
        }
      }
    }
    return false;
  }

  /** Note a corner and those that lead from it to the solid: from each the first part that it touched. */
  void addJoint(std::uint32_t corner, const Parts& parts)
  {
    this->Joints.push_back(corner);
    for (int n = 0; n < parts.count; ++n)
    {
      for (std::uint32_t part = parts.corners[std::size_t(n)]; this->States[part] != Inside; part = this->partsAround(part, this->Finder).corners[0])
      {
        this->Joints.push_back(part);
      }
    }
  }

  const LatticeLabels& Labels;
  float Least;
  int Loop;
  std::vector<State> States;
  ShellPaths Paths;
  SurroundingsFinder Finder;
  Execution& Run;
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
  if (!labels.field() || !options.joinHandles)
  {
    return {};
  }
  Joining joining(labels, float(-options.reach * deficit), loopSteps(labels.octree().lattice, options), execution);
  joining.grow();
  joining.join();
  execution.checkpoint(1.0);
  std::vector<std::uint64_t> joints;
  for (const std::uint32_t corner : joining.joints())
  {
    joints.push_back(labels.shell().corners[corner]);
  }
  return joints;
}

} // namespace silhouette
