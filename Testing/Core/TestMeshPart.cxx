// SPDX-License-Identifier: BSD-3-Clause
#include "MeshPart.h"

#include "CodeCursor.h"
#include "IndicesWhere.h"
#include "MeshComponents.h"

#include <gtest/gtest.h>

using namespace silhouette;

TEST(MeshPart, HasItsTrianglesWhereverTheirPointsAre)
{
  const Mesh square{ { { 0, 0, 0 }, { 1, 0, 0 }, { 1, 1, 0 }, { 0, 1, 0 }, { 2, 0, 0 } }, { { 0, 1, 2 }, { 0, 2, 3 }, { 1, 4, 2 } } };
  const MeshPart part(square, { 2, 0 });
  Mesh moved = square;
  moved.points[4] = { 3, 0, 1 };
  for (const Mesh* whole : { &square, static_cast<const Mesh*>(&moved) })
  {
    const Mesh own = part.of(*whole);
    ASSERT_EQ(own.triangles.size(), 2u);
    EXPECT_EQ(own.points.size(), 4u) << "one point is of neither triangle";
    for (std::size_t n = 0; n < 2; ++n)
    {
      for (int c = 0; c < 3; ++c)
      {
        const std::int32_t expected = whole->triangles[std::size_t(part.triangle(n))][c];
        EXPECT_EQ(own.points[std::size_t(own.triangles[n][c])], whole->points[std::size_t(expected)]);
      }
    }
  }
  EXPECT_TRUE(MeshPart().of(square).points.empty());
}

TEST(MeshComponents, AreConnectedThroughTriangles)
{
  Execution execution;
  Mesh mesh;
  mesh.points.resize(8);
  mesh.triangles = { { 6, 1, 2 }, { 2, 3, 6 }, { 4, 0, 5 } };
  ConcurrentUnionFind sets = connectPoints(mesh.triangles, mesh.points.size(), execution);
  const std::vector<std::uint32_t> expected = { 0, 1, 1, 1, 0, 0, 1, 7 };
  for (std::uint32_t p = 0; p < 8; ++p)
  {
    EXPECT_EQ(sets.find(p), expected[p]);
  }
  EXPECT_EQ(countComponents(mesh, execution), 3u) << "the last point is alone";
  EXPECT_EQ(countComponents(Mesh(), execution), 0u);
}

TEST(IndicesWhere, AreAscending)
{
  Execution execution;
  const auto odd = [](std::size_t n) { return n % 2 == 1; };
  EXPECT_EQ(indicesWhere(7, 1, execution, odd), (std::vector<std::int32_t>{ 1, 3, 5 }));
  EXPECT_TRUE(indicesWhere(0, 1, execution, odd).empty());
}

TEST(CodeCursor, FindsWhatIsThereAndNothingElse)
{
  std::vector<std::uint64_t> codes;
  for (std::uint64_t n = 0; n < 4000; n += 1 + n % 7)
  {
    codes.push_back(n * n / 3 + n);
  }
  CodeCursor all(codes), middle(codes.data() + 100, codes.data() + 300);
  std::size_t found = 0;
  for (std::uint64_t code = 0; code < codes.back() + 100; code += 1 + code % 3)
  {
    const auto at = std::lower_bound(codes.begin(), codes.end(), code);
    const std::ptrdiff_t expected = at != codes.end() && *at == code ? at - codes.begin() : -1;
    ASSERT_EQ(all.find(code), expected);
    ASSERT_EQ(middle.find(code), expected >= 100 && expected < 300 ? expected - 100 : -1);
    found += expected >= 0;
  }
  EXPECT_GT(found, 300u);
}
