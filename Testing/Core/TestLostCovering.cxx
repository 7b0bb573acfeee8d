// SPDX-License-Identifier: BSD-3-Clause
#include "LostCovering.h"

#include "CarvingTestCaptures.h"
#include "CornerEffects.h"
#include "LatticeRegions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <tuple>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** One octant after another, everything looked at anew each time. */
class OneByOne
{
public:
  OneByOne(LatticeLabels& labels, const std::vector<std::uint32_t>& lost, const CornerDepth* depth, Execution& execution)
    : Labels(labels)
    , Lost(lost)
    , Depth(depth)
    , Run(execution)
  {
  }

  LostCovering run()
  {
    std::deque<std::uint32_t> list(this->Lost.begin(), this->Lost.end());
    LostCovering result;
    for (std::size_t next = 0; !list.empty() || next < this->Lost.size();)
    {
      const bool isGrowing = !list.empty();
      const std::uint32_t cell = isGrowing ? list.front() : this->Lost[next++];
      if (isGrowing)
      {
        list.pop_front();
      }
      if (this->covered(cell))
      {
        continue;
      }
      const Candidate best = this->best(cell);
      if (isGrowing && std::get<0>(best) > int(CornerEffect::Joins))
      {
        continue;
      }
      const std::uint32_t corner = std::get<3>(best);
      this->Labels.setInside(corner);
      this->Solid.reset();
      result.corners.push_back(corner);
      result.mayEnclose = result.mayEnclose || std::get<0>(best) == int(CornerEffect::Otherwise);
      const LatticePoint p = fromMorton(this->Labels.shell().corners[corner]);
      for (int n = 0; n < 64; ++n)
      {
        const std::ptrdiff_t other = this->Labels.shell().findCell({ p.i + n % 4 - 2, p.j + n / 4 % 4 - 2, p.k + n / 16 - 2 });
        if (other >= 0 && this->isLost(std::uint32_t(other)) && !this->covered(std::uint32_t(other)))
        {
          list.push_back(std::uint32_t(other));
        }
      }
    }
    return result;
  }

  std::size_t components = 0; ///< how often these were asked for

private:
  using Candidate = std::tuple<int, float, int, std::uint32_t>; ///< effect, support and covered octants negative, corner: the least is best

  bool isLost(std::uint32_t cell) const { return std::binary_search(this->Lost.begin(), this->Lost.end(), cell); }

  bool covered(std::uint32_t cell) const
  {
    const auto& corners = this->Labels.shell().cellCorners[cell];
    return std::any_of(corners.begin(), corners.end(), [&](std::uint32_t corner) { return this->Labels.inside()[corner] != 0; });
  }

  CornerEffect effect(const LatticePoint& p)
  {
    Neighbourhood labels;
    for (int n = 0; n < 27; ++n)
    {
      labels[std::size_t(n)] = n != 13 && this->Labels.insideAt(neighbourOf(p, n));
    }
    const auto numbers = topologicalNumbers(labels);
    if (numbers.inside <= 1 || numbers.outside != 1)
    {
      return isSimple(numbers) ? CornerEffect::Nothing : numbers.inside == 0 ? CornerEffect::Founds : CornerEffect::Otherwise;
    }
    ++this->components;
    if (!this->Solid)
    {
      this->Solid.emplace(this->Labels, this->Run);
    }
    CodeCursor corners(this->Labels.shell().corners);
    return joinsComponents(p, numbers, corners, *this->Solid) ? CornerEffect::Joins : CornerEffect::Otherwise;
  }

  Candidate best(std::uint32_t cell)
  {
    Candidate best{ 99, 0.0f, 0, 0 };
    OctantCursor octants(this->Labels.octree());
    for (const std::uint32_t corner : this->Labels.shell().cellCorners[cell])
    {
      const LatticePoint p = fromMorton(this->Labels.shell().corners[corner]);
      if (this->Labels.octree().lattice.onBorder(p))
      {
        continue;
      }
      int covers = 0;
      for (int n = 0; n < 8; ++n)
      {
        const LatticePoint o = cornerOffset(n);
        const std::ptrdiff_t other = this->Labels.shell().findCell({ p.i - o.i, p.j - o.j, p.k - o.k });
        covers += other >= 0 && this->isLost(std::uint32_t(other)) && !this->covered(std::uint32_t(other));
      }
      const float support = this->Depth ? float((*this->Depth)(p, octants)) : this->Labels.support()[corner];
      best = std::min(best, Candidate{ int(this->effect(p)), -support, -covers, corner });
    }
    return best;
  }

  LatticeLabels& Labels;
  const std::vector<std::uint32_t>& Lost;
  const CornerDepth* Depth;
  Execution& Run;
  std::optional<SolidComponents> Solid; ///< of the labels now; nothing until it is asked for
};

std::vector<std::uint32_t> lostCells(const LatticeLabels& labels)
{
  std::vector<std::uint32_t> lost;
  for (std::uint32_t cell = 0; cell < labels.shell().cells.size(); ++cell)
  {
    const auto& corners = labels.shell().cellCorners[cell];
    if (labels.isSurvivor(cell) && std::none_of(corners.begin(), corners.end(), [&](std::uint32_t c) { return labels.inside()[c] != 0; }))
    {
      lost.push_back(cell);
    }
  }
  return lost;
}

} // namespace

TEST(LostCovering, IsThatOfOneOctantAfterAnother)
{
  std::size_t covered = 0, components = 0;
  for (int scene = 0; scene < 12; ++scene)
  {
    ThreadedExecution execution(1 + scene % 3);
    Random random(scene);
    auto captured = viewsOf(torusMesh(48, 24, 0.75, random.uniform(0.05, 0.3)), swayingRing(6 + scene % 4, 100), 100);
    disturb(captured, scene % 5, random);
    const PreparedViews views = prepareViews(captured);
    const Octree octree = carveViews(views, unitCube(), 5);
    const LatticeViews lattice(views, octree.lattice);
    const CornerDepth depth(octree, lattice, 3.0);
    const CornerDepth* const asked = scene % 2 == 0 ? &depth : nullptr;
    LatticeLabels together(octree, makeCornerShell(leafCells(octree, OctantState::Intersection), execution), views, execution);
    LatticeLabels single = together;
    const auto lost = lostCells(together);
    LostCovering result = coverLost(together, lost, asked, execution);
    OneByOne other(single, lost, asked, execution);
    LostCovering expected = other.run();
    EXPECT_EQ(together.inside(), single.inside()) << scene;
    EXPECT_EQ(result.mayEnclose, expected.mayEnclose) << scene;
    std::sort(result.corners.begin(), result.corners.end());
    std::sort(expected.corners.begin(), expected.corners.end());
    EXPECT_EQ(result.corners, expected.corners) << scene;
    covered += lost.size();
    components += other.components;
  }
  EXPECT_GT(covered, 500u);
  EXPECT_GT(components, 50u);
}

TEST(LostCovering, OfNoneLabelsNothing)
{
  Execution execution;
  const PreparedViews views = prepareViews(viewsOf(torusMesh(48, 24, 0.75, 0.3), swayingRing(8, 100), 100));
  const Octree octree = carveViews(views, unitCube(), 4);
  LatticeLabels labels(octree, makeCornerShell(leafCells(octree, OctantState::Intersection), execution), views, execution);
  const auto before = labels.inside();
  EXPECT_TRUE(coverLost(labels, {}, nullptr, execution).corners.empty());
  EXPECT_EQ(labels.inside(), before);
}

TEST(LostCovering, CanBeCancelledAtAnyTime)
{
  Execution execution;
  const PreparedViews views = disturbedTorus(3);
  const Octree octree = carveViews(views, unitCube(), 5);
  const LatticeLabels labels(octree, makeCornerShell(leafCells(octree, OctantState::Intersection), execution), views, execution);
  const auto lost = lostCells(labels);
  LatticeLabels covered = labels;
  StoppedAt never(1 << 30);
  coverLost(covered, lost, nullptr, never);
  EXPECT_GE(never.asked(), int(lost.size() / 64));
  for (int last = 0; last < never.asked(); last += 1 + never.asked() / 8)
  {
    LatticeLabels own = labels;
    StoppedAt stopped(last);
    EXPECT_THROW(coverLost(own, lost, nullptr, stopped), Cancelled) << last;
  }
}
