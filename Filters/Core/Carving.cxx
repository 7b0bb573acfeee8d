// SPDX-License-Identifier: BSD-3-Clause
#include "Carving.h"

#include "Bits.h"
#include "ChildNumbering.h"
#include "FirstTouch.h"
#include "LargePages.h"
#include "LoneCarvers.h"
#include "OctantTest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace silhouette
{
namespace
{

using ViewList = std::vector<std::uint16_t>;

/** What the descendants of an octant inherit. */
struct Inheritance
{
  std::uint16_t backgroundVotes = 0; ///< views that call all of the octant background
  bool seen = false;                 ///< some view sees all of the octant
};

/** The octants of one generation that are to be subdivided. */
struct Front
{
  std::vector<std::uint64_t> code;
  std::vector<Inheritance> inheritance;
  std::vector<std::size_t> viewEnd; ///< where its views that are still undecided end
  ViewList views;

  std::size_t size() const { return this->code.size(); }
  std::size_t viewBegin(std::size_t i) const { return i == 0 ? 0 : this->viewEnd[i - 1]; }
};

/** What one range of tests adds to the front, and counts. */
struct Part
{
  Front front;
  std::uint64_t viewTests = 0;
  std::vector<std::uint64_t> carvedByView;
};

/** An octant in the making: what the views have said of it so far. */
struct Trial
{
  Inheritance own;
  int mixed = 0;
  std::size_t viewCount = 0;
  bool carved = false;
  std::uint16_t among = 0; ///< which of the first 16 views that it was asked of are undecided
};

/** Tests octants; holds nothing that changes. */
class OctantTester
{
public:
  OctantTester(const LatticeViews& views, int backgroundVotes, int generation)
    : Views(views)
    , BackgroundVotes(backgroundVotes)
    , Generation(generation)
    , Size(std::int32_t(1) << (views.lattice().depth - generation))
  {
  }

  /** Test the root of a tree. */
  OctantState root(std::uint64_t code, const ViewList& views, Part& part) const
  {
    Trial trial;
    std::vector<std::uint16_t> undecided(views.size());
    const OctantBox octant{ this->lowest(code, this->Size), this->Size };
    for (std::size_t n = 0; n < views.size() && !trial.carved; ++n)
    {
      ++part.viewTests;
      this->hear(views[n], relate(this->Views.view(views[n]), this->Views.projection(views[n]), octant), trial,
        undecided.data(), part);
    }
    return this->settle(code, trial, undecided.data(), part);
  }

  /**
   * Test the eight children of an octant, given what they inherit and the views that are undecided about it. `among`,
   * where it is given, learns which of these are undecided about each child.
   */
  void children(std::uint64_t parent, const Inheritance& inherited, const std::uint16_t* views, std::size_t viewCount,
    OctantState* states, std::uint16_t* among, Part& part) const
  {
    std::array<Trial, 8> trials;
    trials.fill({ inherited, 0, 0, false, 0 });
    thread_local std::vector<std::uint16_t> kept;
    kept.resize(std::max(kept.size(), 8 * viewCount));
    std::uint16_t* undecided = kept.data();
    const OctantBox box{ this->lowest(parent, 2 * this->Size), 2 * this->Size };
    std::array<ViewRelation, 8> relations;
    unsigned left = 0xffu;
    for (std::size_t n = 0; n < viewCount && left != 0; ++n)
    {
      const std::uint16_t view = views[n];
      relateChildren(this->Views.view(view), this->Views.projection(view), box, left, relations);
      part.viewTests += std::uint64_t(countBits(left));
      for (unsigned children = left; children != 0; children &= children - 1)
      {
        const int c = lowestBit(children);
        const bool open = this->hear(view, relations[c], trials[c], undecided + c * viewCount, part);
        trials[c].among |= std::uint16_t(n < ViewsToAsk::Chosen ? unsigned(open) << n : 0u);
        left &= ~(unsigned(trials[c].carved) << c);
      }
    }
    for (unsigned c = 0; c < 8; ++c)
    {
      states[c] = this->settle(parent << 3 | c, trials[c], undecided + c * viewCount, part);
      if (among)
      {
        among[c] = trials[c].among;
      }
    }
  }

private:
  LatticePoint lowest(std::uint64_t code, std::int32_t size) const
  {
    const LatticePoint p = fromMorton(code);
    return { p.i * size, p.j * size, p.k * size };
  }

  /** One more view has spoken: is it undecided? */
  bool hear(std::uint16_t view, ViewRelation relation, Trial& trial, std::uint16_t* undecided, Part& part) const
  {
    trial.own.seen |= relation == ViewRelation::Inside || relation == ViewRelation::Background;
    if (relation == ViewRelation::Background && ++trial.own.backgroundVotes > this->BackgroundVotes)
    {
      ++part.carvedByView[view];
      trial.carved = true;
      return false;
    }
    if (relation == ViewRelation::Mixed || relation == ViewRelation::Partial)
    {
      trial.mixed += relation == ViewRelation::Mixed;
      undecided[trial.viewCount++] = view;
      return true;
    }
    return false;
  }

  /** All have: the octant's state, and its place in the front where it is to be subdivided. */
  OctantState settle(std::uint64_t code, const Trial& trial, const std::uint16_t* undecided, Part& part) const
  {
    const OctantState state = this->judge(code, trial);
    if (state == OctantState::Intersection && this->Generation < this->Views.lattice().depth)
    {
      Front& front = part.front;
      front.code.push_back(code);
      front.inheritance.push_back(trial.own);
      front.views.insert(front.views.end(), undecided, undecided + trial.viewCount);
      front.viewEnd.push_back(front.views.size());
    }
    return state;
  }

  OctantState judge(std::uint64_t code, const Trial& trial) const
  {
    if (trial.carved || (!trial.own.seen && trial.viewCount == 0))
    {
      return OctantState::Background; // a point that no view sees is outside
    }
    const bool few = trial.mixed + trial.own.backgroundVotes <= this->BackgroundVotes;
    return trial.own.seen && few && !this->onBorder(fromMorton(code)) ? OctantState::Inside
                                                                      : OctantState::Intersection;
  }

  bool onBorder(const LatticePoint& p) const
  {
    const std::int32_t last = (std::int32_t(1) << this->Generation) - 1;
    return p.i == 0 || p.j == 0 || p.k == 0 || p.i == last || p.j == last || p.k == last;
  }

  const LatticeViews& Views;
  int BackgroundVotes;
  int Generation;
  std::int32_t Size;
};

/** Put the fronts of the parts together, in order: count, then copy side by side. */
Front gather(std::vector<Part>& parts, Execution& execution)
{
  std::vector<std::size_t> octants(parts.size() + 1, 0), views(parts.size() + 1, 0);
  for (std::size_t p = 0; p < parts.size(); ++p)
  {
    octants[p + 1] = octants[p] + parts[p].front.size();
    views[p + 1] = views[p] + parts[p].front.views.size();
  }
  Front front;
  resizeLarge(front.code, octants.back());
  resizeLarge(front.inheritance, octants.back());
  resizeLarge(front.viewEnd, octants.back());
  resizeLarge(front.views, views.back());
  execution.forRanges(parts.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t p = first; p < last; ++p)
      {
        const Front from = std::move(parts[p].front);
        std::copy(from.code.begin(), from.code.end(), front.code.begin() + octants[p]);
        std::copy(from.inheritance.begin(), from.inheritance.end(), front.inheritance.begin() + octants[p]);
        std::copy(from.views.begin(), from.views.end(), front.views.begin() + views[p]);
        std::transform(from.viewEnd.begin(), from.viewEnd.end(), front.viewEnd.begin() + octants[p],
          [&](std::size_t end) { return end + views[p]; });
      }
    });
  return front;
}

/** What the last front knew, kept for those who ask about corners. */
UndecidedViews keep(Front& front, Execution& execution)
{
  UndecidedViews kept;
  kept.views = std::move(front.views);
  resizeSideBySide(kept.first, front.size() + 1, execution);
  resizeSideBySide(kept.backgroundVotes, front.size(), execution);
  resizeSideBySide(kept.seen, front.size(), execution);
  execution.forRanges(front.size(), 4096,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t n = first; n < last; ++n)
      {
        kept.first[n + 1] = front.viewEnd[n];
        kept.backgroundVotes[n] = front.inheritance[n].backgroundVotes;
        kept.seen[n] = front.inheritance[n].seen;
      }
    });
  return kept;
}

/** Grows an octree; `views` may leave some views of the capture out. */
class Carver
{
public:
  Carver(const LatticeViews& views, const ViewList& used, int backgroundVotes, Execution& execution)
    : Views(views)
    , Used(used)
    , BackgroundVotes(backgroundVotes)
    , Exec(execution)
    , Carved(views.size(), 0.0)
  {
  }

  void grow(const std::vector<std::uint64_t>& trees, Octree& octree)
  {
    const int depth = octree.lattice.depth;
    octree.generations.resize(std::size_t(depth) + 1);
    Generation& roots = octree.generations[octree.treeGeneration];
    roots.code = trees;
    roots.state.resize(trees.size());
    Front front = this->test(octree, octree.treeGeneration, trees.size(),
      [&](std::size_t i, const OctantTester& tester, Part& part)
      { roots.state[i] = tester.root(trees[i], this->Used, part); });
    for (int g = octree.treeGeneration + 1; g <= depth; ++g)
    {
      Front parents = std::move(front);
      Generation& generation = octree.generations[g];
      resizeSideBySide(generation.code, 8 * parents.size(), this->Exec);
      resizeSideBySide(generation.state, 8 * parents.size(), this->Exec);
      std::vector<std::uint16_t> among;
      resizeSideBySide(among, g == depth ? 8 * parents.size() : 0, this->Exec);
      front = this->test(octree, g, parents.size(),
        [&](std::size_t i, const OctantTester& tester, Part& part)
        {
          for (unsigned c = 0; c < 8; ++c)
          {
            generation.code[8 * i + c] = parents.code[i] << 3 | c;
          }
          const std::size_t begin = parents.viewBegin(i);
          tester.children(parents.code[i], parents.inheritance[i], parents.views.data() + begin,
            parents.viewEnd[i] - begin, &generation.state[8 * i], among.empty() ? nullptr : &among[8 * i], part);
        });
      if (g == depth)
      {
        octree.undecided = keep(parents, this->Exec);
        octree.undecided.among = std::move(among);
      }
    }
    octree.statistics.carvedByView = this->Carved;
  }

private:
  /** Run `testOne` for the roots, or the parents, of generation g; the front that comes of it. */
  template <typename TestOne>
  Front test(Octree& octree, int g, std::size_t count, const TestOne& testOne)
  {
    // Enough parts for all threads in the upper generations too. The bytes depend neither on the parts nor on the threads.
    const std::size_t size = std::clamp<std::size_t>(count / 64, 4, 256);
    const OctantTester tester(this->Views, this->BackgroundVotes, g);
    std::vector<Part> parts((count + size - 1) / size);
    const std::size_t batch = std::size_t(std::max(1, this->Exec.threads())) * 64;
    const double weight = std::ldexp(1.0, 2 * (g - octree.lattice.depth));
    for (std::size_t done = 0; done < parts.size(); done += batch)
    {
      const std::size_t n = std::min(batch, parts.size() - done);
      this->Exec.forRanges(n, 1,
        [&](std::size_t first, std::size_t last)
        {
          for (std::size_t p = done + first; p < done + last; ++p)
          {
            parts[p].carvedByView.assign(std::size_t(this->Views.size()), 0);
            for (std::size_t i = p * size; i < std::min(count, (p + 1) * size); ++i)
            {
              testOne(i, tester, parts[p]);
            }
          }
        });
      this->Exec.checkpoint(weight * (0.25 + 0.75 * double(done + n) / double(parts.size())));
    }
    this->countParts(parts, g, octree);
    numberChildren(octree.generations[g], this->Exec);
    return gather(parts, this->Exec);
  }

  void countParts(const std::vector<Part>& parts, int g, Octree& octree)
  {
    octree.statistics.octantsTested += octree.generations[g].size();
    for (const auto& part : parts)
    {
      octree.statistics.viewTests += part.viewTests;
      for (int view = 0; view < this->Views.size(); ++view)
      {
        this->Carved[view] += std::ldexp(double(part.carvedByView[view]), -3 * g); // exact: a count times 2^-3g
      }
    }
  }

  const LatticeViews& Views;
  const ViewList& Used;
  int BackgroundVotes;
  Execution& Exec;
  std::vector<double> Carved;
};

ViewList allViews(int count)
{
  ViewList list(static_cast<std::size_t>(count));
  std::iota(list.begin(), list.end(), std::uint16_t(0));
  return list;
}

std::vector<std::uint64_t> allTrees(int generation)
{
  std::vector<std::uint64_t> trees(std::size_t(1) << 3 * generation);
  std::iota(trees.begin(), trees.end(), std::uint64_t(0));
  return trees;
}

/** Which view emptied it: an empty silhouette, else the views without any one of which something would be left. */
[[noreturn]] void throwNothingSurvives(
  const LatticeViews& views, const Octree& octree, Execution& execution)
{
  for (int i = 0; i < views.size(); ++i)
  {
    if (views.view(i).objectBox[1] < 0 && octree.backgroundVotes == 0)
    {
      throw NothingSurvives("nothing survives the carving: the silhouette of " + describeView(std::size_t(i), views.view(i).name) + " is empty");
    }
  }
  std::string culprits;
  const std::vector<bool> lone = loneCarvers(views.prepared(), views.lattice(), octree.backgroundVotes, execution);
  for (int i = 0; i < views.size(); ++i)
  {
    if (lone[std::size_t(i)])
    {
      culprits += (culprits.empty() ? "" : ", ") + describeView(std::size_t(i), views.view(i).name);
    }
  }
  const auto& carved = octree.statistics.carvedByView;
  const int most = int(std::max_element(carved.begin(), carved.end()) - carved.begin());
  throw NothingSurvives("nothing survives the carving: " +
    (culprits.empty() ? "no single view is at fault; " + describeView(std::size_t(most), views.view(most).name) + " carves most, " +
          std::to_string(100.0 * carved[most]) + " % of the cube"
                      : "something would be left without " + culprits) +
    ". Check the bounds, the projection matrices and the silhouettes' polarity");
}

void check(const LatticeViews& views, const CarveOptions& options)
{
  const int depth = views.lattice().depth;
  if (depth < 1 || depth > MaximumDepth)
  {
    throw InvalidInput("depth " + std::to_string(depth) + " is outside 1 to " + std::to_string(MaximumDepth));
  }
  const double edge = views.lattice().root.edge;
  if (!(edge > 0.0) || !std::isfinite(edge) || !views.lattice().root.origin.allFinite())
  {
    throw InvalidInput("the root cube's edge is " + std::to_string(edge) + ", a positive number is needed");
  }
  if (options.backgroundVotes < 0 || options.backgroundVotes >= views.size())
  {
    throw InvalidInput("background votes " + std::to_string(options.backgroundVotes) + " are outside 0 to " +
      std::to_string(views.size() - 1) + " (the number of views less one)");
  }
}

} // namespace

bool anySurvivor(const Octree& octree)
{
  for (int g = octree.treeGeneration; g <= octree.lattice.depth; ++g)
  {
    if (octree.count(OctantState::Inside, g) > 0)
    {
      return true;
    }
  }
  return octree.count(OctantState::Intersection, octree.lattice.depth) > 0;
}

int treeGeneration(int depth)
{
  return std::min(3, depth - 1);
}

Octree carve(const LatticeViews& views, const CarveOptions& options, Execution& execution)
{
  check(views, options);
  Octree octree;
  octree.lattice = views.lattice();
  octree.treeGeneration = treeGeneration(octree.lattice.depth);
  octree.viewCount = views.size();
  octree.backgroundVotes = options.backgroundVotes;
  octree.outside = views.prepared().options().outside;
  octree.fingerprint = views.prepared().fingerprint();
  const ViewList used = allViews(views.size());
  Carver(views, used, options.backgroundVotes, execution)
    .grow(options.trees.empty() ? allTrees(octree.treeGeneration) : options.trees, octree);
  if (options.trees.empty() && !anySurvivor(octree))
  {
    throwNothingSurvives(views, octree, execution);
  }
  execution.checkpoint(1.0);
  return octree;
}

OctantState leafState(const LatticeViews& views, int backgroundVotes, const LatticePoint& cell)
{
  Part part;
  part.carvedByView.resize(std::size_t(views.size()));
  const OctantTester tester(views, backgroundVotes, views.lattice().depth);
  return tester.root(mortonCode(cell), allViews(views.size()), part);
}

} // namespace silhouette
