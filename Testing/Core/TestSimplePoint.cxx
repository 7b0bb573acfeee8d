// SPDX-License-Identifier: BSD-3-Clause
#include "SimplePoint.h"

#include "CarvingTestCaptures.h"
#include "CornerShell.h"
#include "LatticeSurface.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** Components and genus of the surface of 3^3 labels with a layer of outside around. */
std::pair<std::uint64_t, std::int64_t> topology(const Neighbourhood& labels, bool centre)
{
  Execution execution;
  std::vector<std::uint64_t> cells;
  for (int c = 0; c < 64; ++c)
  {
    cells.push_back(mortonCode({ c % 4, c / 4 % 4, c / 16 }));
  }
  std::sort(cells.begin(), cells.end());
  const CornerShell shell = makeCornerShell(cells, execution);
  std::vector<std::uint8_t> inside(shell.corners.size(), 0);
  for (int n = 0; n < 27; ++n)
  {
    inside[shell.find(mortonCode({ n % 3 + 1, n / 3 % 3 + 1, n / 9 + 1 }))] = n == 13 ? centre : labels[n];
  }
  const LatticeSurface surface = contour(shell, inside, execution);
  Mesh mesh;
  mesh.triangles = surface.triangles;
  const Lattice lattice{ { Eigen::Vector3d::Zero(), 4.0 }, 2 };
  for (const auto& edge : surface.edges)
  {
    mesh.points.push_back(crossingPosition(lattice, shell, edge, 0.5));
  }
  const MeshSoundness soundness = assessMesh(mesh, execution);
  return { soundness.components, soundness.genus.value_or(0) };
}

} // namespace

/** The surface itself is the judge: a simple corner changes neither its components nor its genus. */
TEST(SimplePoint, SimpleCornersChangeNoTopologyOfTheSurface)
{
  Random random(12);
  int simple = 0, changed = 0;
  for (int trial = 0; trial < 3000; ++trial)
  {
    Neighbourhood labels{};
    const double share = random.uniform();
    for (std::size_t n = 0; n < labels.size(); ++n)
    {
      labels[n] = random.uniform() < share;
    }
    labels[13] = false;
    const bool same = topology(labels, false) == topology(labels, true);
    const auto [pieces, genus] = topology(labels, false);
    const auto [piecesThen, genusThen] = topology(labels, true);
    EXPECT_EQ(eulerChange(labels), int(piecesThen) - int(genusThen) - int(pieces) + int(genus)) << "trial " << trial;
    if (isSimple(topologicalNumbers(labels)))
    {
      ++simple;
      EXPECT_TRUE(same) << "trial " << trial;
    }
    changed += !same;
  }
  EXPECT_GT(simple, 300);
  EXPECT_GT(changed, 300);
}

namespace
{

/** Components of `members` by steps that change at most `step` coordinates, each by one; numbered from the first point on. */
int floodedComponents(const Neighbourhood& members, int step, std::array<std::int8_t, 27>& number)
{
  number.fill(-1);
  int count = 0;
  for (int seed = 0; seed < 27; ++seed)
  {
    if (!members[seed] || number[seed] >= 0)
    {
      continue;
    }
    number[seed] = std::int8_t(count);
    for (int pass = 0; pass < 27; ++pass)
    {
      for (int ab = 0; ab < 27 * 27; ++ab)
      {
        const int a = ab % 27, b = ab / 27;
        const int d[3] = { a % 3 - b % 3, a / 3 % 3 - b / 3 % 3, a / 9 - b / 9 };
        const int greatest = std::max({ std::abs(d[0]), std::abs(d[1]), std::abs(d[2]) });
        const int sum = std::abs(d[0]) + std::abs(d[1]) + std::abs(d[2]);
        if (number[a] == count && members[b] && greatest == 1 && sum <= step)
        {
          number[b] = std::int8_t(count);
        }
      }
    }
    ++count;
  }
  return count;
}

} // namespace

/**
 * By their definition: of the points of the centre's 18-neighbourhood, and of its corners that are beside one of these, the
 * components through 18-neighbours.
 */
TEST(SimplePoint, InsideComponentsAreThoseOfTheirDefinition)
{
  Random random(13);
  for (int trial = 0; trial < 3000; ++trial)
  {
    Neighbourhood labels{}, members{};
    const double share = random.uniform(0.05, 0.6);
    for (std::size_t n = 0; n < labels.size(); ++n)
    {
      labels[n] = random.uniform() < share;
    }
    const auto coordinates = [](int n) { return std::array<int, 3>{ n % 3 - 1, n / 3 % 3 - 1, n / 9 - 1 }; };
    const auto fromCentre = [&](int n)
    { const auto c = coordinates(n); return std::abs(c[0]) + std::abs(c[1]) + std::abs(c[2]); };
    for (int n = 0; n < 27; ++n)
    {
      members[n] = n != 13 && labels[n] && fromCentre(n) <= 2;
      for (int m = 0; m < 27 && fromCentre(n) == 3; ++m)
      {
        const auto a = coordinates(n), b = coordinates(m);
        const int sum = std::abs(a[0] - b[0]) + std::abs(a[1] - b[1]) + std::abs(a[2] - b[2]);
        const int greatest = std::max({ std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2]) });
        members[n] = members[n] ||
          (labels[n] && labels[m] && m != 13 && fromCentre(m) <= 2 && greatest == 1 && sum <= 2);
      }
    }
    std::array<std::int8_t, 27> number;
    const auto numbers = topologicalNumbers(labels);
    EXPECT_EQ(numbers.inside, floodedComponents(members, 2, number)) << trial;
    EXPECT_EQ(numbers.insideComponent, number) << trial;
  }
}

TEST(SimplePoint, KnowsTheTextbookCases)
{
  Neighbourhood labels{};
  EXPECT_EQ(topologicalNumbers(labels).inside, 0) << "isolated";
  EXPECT_FALSE(isSimple(topologicalNumbers(labels)));
  labels[12] = true; // the neighbour at -x
  EXPECT_TRUE(isSimple(topologicalNumbers(labels)));
  labels[14] = true; // and the one at +x: a bridge
  EXPECT_EQ(topologicalNumbers(labels).inside, 2);
  labels.set();
  EXPECT_EQ(topologicalNumbers(labels).outside, 0) << "the last point of a cavity";
  labels = {};
  labels[0] = true; // opposite end of a cube's diagonal: not joined
  EXPECT_EQ(topologicalNumbers(labels).inside, 0);
  labels[1] = true; // opposite end of a square's diagonal: joined
  EXPECT_TRUE(isSimple(topologicalNumbers(labels)));
}
