// SPDX-License-Identifier: BSD-3-Clause
#include "Carving.h"

#include "OctantTest.h"

#include <algorithm>
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
  std::size_t firstView = 0;         ///< into the list of views that are still undecided about the octant
  std::uint16_t viewCount = 0;
  std::uint16_t backgroundVotes = 0; ///< views that call all of the octant background
  bool seen = false;                 ///< some view sees all of the octant
};

/** The octants of one generation that are to be subdivided. */
struct Front
{
  std::vector<std::uint64_t> code;
  std::vector<Inheritance> inheritance;
  ViewList views;
};

/** What one range of tests adds to a generation. */
struct Part
{
  std::vector<std::uint64_t> code;
  std::vector<OctantState> state;
  Front front;
  std::uint64_t viewTests = 0;
  std::vector<std::uint64_t> carvedByView;
};

/** Tests single octants; holds nothing that changes. */
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

  /** Test octant `code`, given its parent's inheritance and list of views, and add it to `part`. */
  void operator()(std::uint64_t code, const Inheritance& inherited, const std::uint16_t* views, Part& part) const
  {
    const LatticePoint p = fromMorton(code);
    const OctantBox octant{ { p.i * this->Size, p.j * this->Size, p.k * this->Size }, this->Size };
    Inheritance own = inherited;
    own.firstView = part.front.views.size();
    int mixed = 0;
    for (int n = 0; n < inherited.viewCount; ++n)
    {
      const std::uint16_t view = views[n];
      ++part.viewTests;
      const auto relation = relate(this->Views.view(view), this->Views.projection(view), octant);
      own.seen |= relation == ViewRelation::Inside || relation == ViewRelation::Background;
      if (relation == ViewRelation::Background && ++own.backgroundVotes > this->BackgroundVotes)
      {
        ++part.carvedByView[view];
        this->add(code, OctantState::Background, own, part);
        return;
      }
      if (relation == ViewRelation::Mixed || relation == ViewRelation::Partial)
      {
        mixed += relation == ViewRelation::Mixed;
        part.front.views.push_back(view);
      }
    }
    own.viewCount = std::uint16_t(part.front.views.size() - own.firstView);
    this->add(code, this->judge(octant, own, mixed), own, part);
  }

private:
  OctantState judge(const OctantBox& octant, const Inheritance& own, int mixed) const
  {
    if (!own.seen && own.viewCount == 0)
    {
      return OctantState::Background; // a point that no view sees is outside
    }
    const bool inside = own.seen && mixed + own.backgroundVotes <= this->BackgroundVotes && !this->onBorder(octant);
    return inside ? OctantState::Inside : OctantState::Intersection;
  }

  bool onBorder(const OctantBox& octant) const
  {
    const std::int32_t last = this->Views.lattice().cells() - octant.size;
    const auto& o = octant.lowest;
    return o.i == 0 || o.j == 0 || o.k == 0 || o.i == last || o.j == last || o.k == last;
  }

  void add(std::uint64_t code, OctantState state, const Inheritance& own, Part& part) const
  {
    part.code.push_back(code);
    part.state.push_back(state);
    if (state == OctantState::Intersection && this->Generation < this->Views.lattice().depth)
    {
      part.front.code.push_back(code);
      part.front.inheritance.push_back(own);
    }
    else
    {
      part.front.views.resize(own.firstView);
    }
  }

  const LatticeViews& Views;
  int BackgroundVotes;
  int Generation;
  std::int32_t Size;
};

/** Put the parts of a generation together, in order. */
void gather(const std::vector<Part>& parts, Generation& generation, Front& front)
{
  std::uint32_t blocks = 0;
  for (const auto& part : parts)
  {
    generation.code.insert(generation.code.end(), part.code.begin(), part.code.end());
    generation.state.insert(generation.state.end(), part.state.begin(), part.state.end());
    const std::size_t offset = front.views.size();
    front.code.insert(front.code.end(), part.front.code.begin(), part.front.code.end());
    front.views.insert(front.views.end(), part.front.views.begin(), part.front.views.end());
    for (auto inheritance : part.front.inheritance)
    {
      inheritance.firstView += offset;
      front.inheritance.push_back(inheritance);
    }
  }
  generation.childBlock.reserve(generation.size());
  for (const OctantState state : generation.state)
  {
    generation.childBlock.push_back(blocks);
    blocks += state == OctantState::Intersection;
  }
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
    Front front;
    this->test(octree, octree.treeGeneration, trees.size(), front,
      [&](std::size_t i, const OctantTester& test, Part& part)
      { test(trees[i], Inheritance{ 0, std::uint16_t(this->Used.size()), 0, false }, this->Used.data(), part); });
    for (int g = octree.treeGeneration + 1; g <= depth; ++g)
    {
      const Front parents = std::move(front);
      front = Front();
      this->test(octree, g, 8 * parents.code.size(), front,
        [&](std::size_t i, const OctantTester& test, Part& part)
        {
          const Inheritance& inheritance = parents.inheritance[i / 8];
          test(parents.code[i / 8] << 3 | (i & 7), inheritance, parents.views.data() + inheritance.firstView, part);
        });
    }
    octree.statistics.carvedByView = this->Carved;
  }

private:
  template <typename TestOne>
  void test(Octree& octree, int g, std::size_t count, Front& front, const TestOne& testOne)
  {
    constexpr std::size_t PartSize = 2048; // fixed: the parts, and so the bytes, do not depend on the threads
    const OctantTester tester(this->Views, this->BackgroundVotes, g);
    std::vector<Part> parts((count + PartSize - 1) / PartSize);
    const std::size_t batch = std::size_t(std::max(1, this->Exec.threads())) * 16;
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
            for (std::size_t i = p * PartSize; i < std::min(count, (p + 1) * PartSize); ++i)
            {
              testOne(i, tester, parts[p]);
            }
          }
        });
      this->Exec.checkpoint(weight * (0.25 + 0.75 * double(done + n) / double(parts.size())));
    }
    this->countParts(parts, g, octree);
    gather(parts, octree.generations[g], front);
  }

  void countParts(const std::vector<Part>& parts, int g, Octree& octree)
  {
    for (const auto& part : parts)
    {
      octree.statistics.octantsTested += part.code.size();
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

/** Would anything survive a coarse carve without view `left`? */
bool survivesWithout(const LatticeViews& views, int left, int backgroundVotes)
{
  ViewList used = allViews(views.size());
  used.erase(used.begin() + left);
  Execution serial;
  Octree octree;
  octree.lattice = views.lattice();
  octree.treeGeneration = treeGeneration(octree.lattice.depth);
  Carver(views, used, std::min(backgroundVotes, int(used.size()) - 1), serial)
    .grow(allTrees(octree.treeGeneration), octree);
  return anySurvivor(octree);
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
  if (views.size() > 1)
  {
    Lattice coarse = views.lattice();
    coarse.depth = std::min(coarse.depth, 5);
    const LatticeViews coarseViews(views.prepared(), coarse);
    for (int i = 0; i < views.size(); ++i)
    {
      execution.checkpoint(1.0);
      if (survivesWithout(coarseViews, i, octree.backgroundVotes))
      {
        culprits += (culprits.empty() ? "" : ", ") + describeView(std::size_t(i), views.view(i).name);
      }
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

Octree mergeTrees(const std::vector<Octree>& parts)
{
  if (parts.empty())
  {
    throw InvalidInput("no parts of an octree to merge");
  }
  Octree whole = parts.front();
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

} // namespace silhouette
