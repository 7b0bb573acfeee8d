// SPDX-License-Identifier: BSD-3-Clause
#include "HandleJoining.h"

#include "CarvingTestCaptures.h"
#include "LabelledSolids.h"
#include "SimplePoint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <vector>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** A ring around the lattice's middle with a cut of `gap` corners, whose field is `depth` below 0 there. */
double cutRing(const LatticePoint& p, int gap, double depth)
{
  const double x = p.i - 16, y = p.j - 16, z = p.k - 16;
  const double ring = 1.6 - std::hypot(std::hypot(x, y) - 10.0, z);
  return x > 0 && p.j >= 16 && p.j < 16 + gap ? std::min(ring, -depth) : ring;
}

std::int64_t genusAfter(LabelledSolid& solid, double deficit, const HandleJoiningOptions& options)
{
  solid.fill(handleJoints(*solid.labels, deficit, options, solid.execution));
  const MeshSoundness surface = solid.surface();
  EXPECT_EQ(surface.components, 1u);
  return surface.genus.value_or(-1);
}

/** Noise of a few octants' length, not much of it inside. */
double roughField(std::vector<double>& noise, const LatticePoint& p)
{
  double sum = 0.0;
  for (int n = 0; n < 8; ++n)
  {
    const LatticePoint q = p + cornerOffset(n);
    sum += noise[std::size_t((q.i / 2 * 9 + q.j / 2) * 9 + q.k / 2)];
  }
  return sum / 8.0;
}

/** What handleJoints() does, as its description says it: one corner after another, and every way walked. */
class OneByOne
{
public:
  OneByOne(const LatticeLabels& labels, int loop)
    : Labels(labels)
    , Loop(loop)
    , Taken(labels.inside())
  {
  }

  std::vector<std::uint64_t> operator()(float least)
  {
    const auto& shell = this->Labels.shell().corners;
    const auto& support = this->Labels.support();
    std::vector<std::uint32_t> order;
    for (std::uint32_t c = 0; c < shell.size(); ++c)
    {
      if (!this->Taken[c] && !this->Labels.octree().lattice.onBorder(fromMorton(shell[c])))
      {
        order.push_back(c);
      }
    }
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return support[a] > support[b]; });
    std::set<std::uint32_t> joints;
    for (const std::uint32_t c : order)
    {
      const bool isAllowed = support[c] > least;
      const auto parts = this->parts(c, isAllowed ? nullptr : &this->survivorsAround(c));
      if (parts.size() < (isAllowed ? 1u : 2u) || this->anyMeet(parts))
      {
        continue;
      }
      this->Taken[c] = 1;
      this->From[c] = parts[0];
      if (parts.size() > 1)
      {
        joints.insert(c);
        for (std::uint32_t part : parts)
        {
          for (; !this->Labels.inside()[part]; part = this->From.at(part))
          {
            joints.insert(part);
          }
        }
        ++(isAllowed ? this->Grown : this->Joined);
      }
    }
    std::vector<std::uint64_t> codes;
    for (const std::uint32_t c : joints)
    {
      codes.push_back(shell[c]);
    }
    return codes;
  }

  int Grown = 0;  ///< joints that the field allows
  int Joined = 0; ///< further ones

private:
  std::ptrdiff_t around(std::uint32_t corner, int n) const
  {
    return this->Labels.shell().find(mortonCode(neighbourOf(fromMorton(this->Labels.shell().corners[corner]), n)));
  }

  /** Corners of the surviving cells around, but none where there are fewer than two such cells. */
  const std::set<std::uint32_t>& survivorsAround(std::uint32_t corner)
  {
    this->Survivors.clear();
    std::array<std::uint32_t, 8> cells;
    const int count = this->Labels.cellsAround(fromMorton(this->Labels.shell().corners[corner]), cells);
    for (int n = 0; n < count && count > 1; ++n)
    {
      const auto& corners = this->Labels.shell().cellCorners[cells[std::size_t(n)]];
      this->Survivors.insert(corners.begin(), corners.end());
    }
    return this->Survivors;
  }

  std::vector<std::uint32_t> parts(std::uint32_t corner, const std::set<std::uint32_t>* among) const
  {
    Neighbourhood labels;
    for (int n = 0; n < 27; ++n)
    {
      const std::ptrdiff_t other = this->around(corner, n);
      labels[std::size_t(n)] = n != 13 &&
        (other >= 0 ? this->Taken[std::size_t(other)] != 0
                    : this->Labels.insideAt(neighbourOf(fromMorton(this->Labels.shell().corners[corner]), n)));
    }
    const TopologicalNumbers numbers = topologicalNumbers(labels);
    std::map<int, std::uint32_t> found;
    for (const int n : SolidNeighbours)
    {
      const std::ptrdiff_t other = this->around(corner, n);
      if (numbers.insideComponent[std::size_t(n)] >= 0 && other >= 0 && (!among || among->count(std::uint32_t(other)) > 0))
      {
        found.emplace(numbers.insideComponent[std::size_t(n)], std::uint32_t(other));
      }
    }
    std::vector<std::uint32_t> parts;
    for (const auto& [part, first] : found)
    {
      parts.push_back(first);
    }
    return int(parts.size()) == numbers.inside ? parts : std::vector<std::uint32_t>();
  }

  bool anyMeet(const std::vector<std::uint32_t>& parts) const
  {
    for (const std::uint32_t a : parts)
    {
      std::set<std::uint32_t> reached = { a }, wave = reached;
      for (int step = 0; step < this->Loop; ++step)
      {
        std::set<std::uint32_t> next;
        for (const std::uint32_t corner : wave)
        {
          for (const int n : SolidNeighbours)
          {
            const std::ptrdiff_t other = this->around(corner, n);
            if (other >= 0 && this->Taken[std::size_t(other)] && reached.insert(std::uint32_t(other)).second)
            {
              next.insert(std::uint32_t(other));
            }
          }
        }
        wave = next;
      }
      if (std::count_if(parts.begin(), parts.end(), [&](std::uint32_t b) { return reached.count(b) > 0; }) > 1)
      {
        return true;
      }
    }
    return false;
  }

  const LatticeLabels& Labels;
  int Loop;
  std::vector<std::uint8_t> Taken;
  std::map<std::uint32_t, std::uint32_t> From;
  std::set<std::uint32_t> Survivors;
};

} // namespace

TEST(HandleJoining, DoesWhatOneCornerAfterAnotherDoes)
{
  Random random(11);
  int grown = 0, joined = 0;
  for (int trial = 0; trial < 8; ++trial)
  {
    std::vector<double> noise(9 * 9 * 9);
    for (double& value : noise)
    {
      value = 6.0 * random.uniform() - 3.6;
    }
    LabelledSolid solid(4, [&](const LatticePoint& p) { return std::max({ p.i, p.j, p.k }) < 16 ? roughField(noise, p) : -3.0; });
    // A shell of what is near the surface: what is deep inside is no corner of it.
    std::vector<std::uint64_t> cells, survivors;
    for (const std::uint64_t cell : solid.labels->shell().cells)
    {
      double nearest = 100.0;
      for (int n = 0; n < 8; ++n)
      {
        const LatticePoint corner = fromMorton(cell) + cornerOffset(n);
        nearest = std::min(nearest, std::abs(double(solid.field.values()[std::size_t(solid.field.find(mortonCode(corner)))])));
      }
      if (nearest < 0.6)
      {
        cells.push_back(cell);
        if (random.uniform() < 0.6)
        {
          survivors.push_back(cell);
        }
      }
    }
    LatticeLabels labels(solid.octree, makeCornerShell(cells, solid.execution), solid.field, solid.execution);
    labels.setSurvivors(survivors, solid.execution);
    for (const double deficit : { 0.0, 0.15, 0.5 })
    {
      HandleJoiningOptions options;
      options.loop = 0.5;
      OneByOne expected(labels, loopSteps(solid.octree.lattice, options));
      EXPECT_TRUE(handleJoints(labels, deficit, options, solid.execution) == expected(float(-deficit))) << "trial " << trial << ", deficit " << deficit;
      grown += expected.Grown;
      joined += expected.Joined;
    }
  }
  EXPECT_GT(grown, 100);
  EXPECT_GT(joined, 20);
}

TEST(HandleJoining, JoinsTheEndsOfACutRing)
{
  for (const int gap : { 1, 2, 3 })
  {
    LabelledSolid solid(5, [&](const LatticePoint& p) { return cutRing(p, gap, 0.3); });
    solid.labels->setSurvivors({}, solid.execution); // the field alone tells
    ASSERT_EQ(solid.surface().genus, 0);
    EXPECT_EQ(genusAfter(solid, 0.5, {}), 1) << gap << " corners";
  }
}

TEST(HandleJoining, LeavesApartWhatTheFieldPartsClearly)
{
  LabelledSolid solid(5, [](const LatticePoint& p) { return cutRing(p, 2, 0.8); });
  solid.labels->setSurvivors({}, solid.execution);
  EXPECT_EQ(genusAfter(solid, 0.5, {}), 0);
  EXPECT_EQ(genusAfter(solid, 1.0, {}), 1) << "a larger deficit reaches further";
}

/** Deep outside by the field, but the octants on both sides survived and touch. */
TEST(HandleJoining, JoinsSurvivorsThatTouch)
{
  LabelledSolid solid(5, [](const LatticePoint& p) { return cutRing(p, 1, 3.0); });
  EXPECT_EQ(genusAfter(solid, 0.1, {}), 1);
}

TEST(HandleJoining, MakesNoShortLoopAndCanBeSwitchedOff)
{
  LabelledSolid solid(5, [](const LatticePoint& p) { return cutRing(p, 1, 0.3); });
  HandleJoiningOptions options;
  options.loop = 3.0; // longer than the way around the ring
  EXPECT_EQ(genusAfter(solid, 0.5, options), 0);
  options = {};
  options.joinHandles = false;
  EXPECT_EQ(genusAfter(solid, 0.5, options), 0);
  options.joinHandles = true;
  options.reach = -1.0;
  EXPECT_THROW(handleJoints(*solid.labels, 0.5, options, solid.execution), InvalidInput);
  options.reach = 1.0;
  options.loop = -1.0;
  EXPECT_THROW(handleJoints(*solid.labels, 0.5, options, solid.execution), InvalidInput);
}
