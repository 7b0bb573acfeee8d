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
    for (auto&& label : labels)
    {
      label = random.uniform() < share;
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

TEST(SimplePoint, KnowsTheTextbookCases)
{
  Neighbourhood labels{};
  EXPECT_EQ(topologicalNumbers(labels).inside, 0) << "isolated";
  EXPECT_FALSE(isSimple(topologicalNumbers(labels)));
  labels[12] = true; // the neighbour at -x
  EXPECT_TRUE(isSimple(topologicalNumbers(labels)));
  labels[14] = true; // and the one at +x: a bridge
  EXPECT_EQ(topologicalNumbers(labels).inside, 2);
  labels.fill(true);
  EXPECT_EQ(topologicalNumbers(labels).outside, 0) << "the last point of a cavity";
  labels = {};
  labels[0] = true; // opposite end of a cube's diagonal: not joined
  EXPECT_EQ(topologicalNumbers(labels).inside, 0);
  labels[1] = true; // opposite end of a square's diagonal: joined
  EXPECT_TRUE(isSimple(topologicalNumbers(labels)));
}
