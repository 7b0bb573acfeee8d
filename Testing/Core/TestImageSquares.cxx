// SPDX-License-Identifier: BSD-3-Clause
#include "ImageSquares.h"

#include "CarvingTestCaptures.h"

#include <gtest/gtest.h>

#include <set>
#include <utility>

using namespace silhouette;
using namespace silhouette::test;

TEST(ImageSquares, OfCubesAreThoseOfTheirPoints)
{
  Random random(3);
  const Lattice lattice{ unitCube(), 6 };
  for (const Projection& camera : swayingRing(7, 300))
  {
    const LatticeProjection projection(camera, lattice);
    const double pixels = pixelsPerOctant(projection, { 32, 32, 32 }) * random.uniform(0.6, 1.5);
    ImageSquares squares(projection, pixels);
    std::set<std::pair<int, int>> expected;
    EXPECT_EQ(squares.count(), 0u);
    for (const std::int32_t side : { 4, 16, 8, 32, 4 })
    {
      const int n = 64 / side;
      const PointCube cube{ mortonCode({ side * random.below(n), side * random.below(n), side * random.below(n) }), side };
      squares.add(cube);
      const LatticePoint single{ random.below(65), random.below(65), random.below(65) };
      squares.add(single);
      std::vector<std::uint64_t> points{ mortonCode(single) };
      for (std::uint64_t code = cube.corner; code < cube.end(); ++code)
      {
        points.push_back(code);
      }
      for (const std::uint64_t code : points)
      {
        const auto h = projection(fromMorton(code));
        expected.emplace(int(std::floor(h.U / h.W / pixels)), int(std::floor(h.V / h.W / pixels)));
      }
      EXPECT_EQ(squares.count(), expected.size());
    }
  }
}
