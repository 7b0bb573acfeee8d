// SPDX-License-Identifier: BSD-3-Clause
#include "FieldContour.h"

#include "Error.h"
#include "SelfIntersections.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

using namespace silhouette;

namespace
{

constexpr double Pi = 3.14159265358979323846;

/** Two balls, their distance field made `steep` times as steep as it need be. */
class Balls : public DistanceField
{
public:
  explicit Balls(double steep) : Steep(steep) {}
  double operator()(const Eigen::Vector3d& p) const override
  {
    const double first = (p - Eigen::Vector3d(0.4, 0.3, 0.35)).norm() - 0.3;
    const double second = (p - Eigen::Vector3d(-0.5, -0.45, -0.4)).norm() - 0.25;
    return this->Steep * std::min(first, second);
  }
  double steepness() const override { return this->Steep; }

private:
  double Steep;
};

double volume(const Mesh& mesh)
{
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles)
  {
    sum += mesh.points[t[0]].dot(mesh.points[t[1]].cross(mesh.points[t[2]])) / 6.0;
  }
  return sum;
}

TEST(FieldContour, closedAndOutwardsWithTheVerticesOnTheSurface)
{
  const Balls balls(1.0);
  const Mesh mesh = contourField(balls, 0.02);
  std::set<std::pair<int, int>> halfEdges;
  for (const Triangle& t : mesh.triangles)
  {
    for (int c = 0; c < 3; ++c)
    {
      EXPECT_TRUE(halfEdges.insert({t[c], t[(c + 1) % 3]}).second);
    }
  }
  for (const auto& edge : halfEdges)
  {
    EXPECT_EQ(halfEdges.count({edge.second, edge.first}), 1u);
  }
  EXPECT_EQ(long(mesh.points.size()) - long(halfEdges.size() / 2) + long(mesh.triangles.size()), 4);
  for (const Eigen::Vector3d& p : mesh.points)
  {
    EXPECT_LT(std::abs(balls(p)), 0.011 * 0.02); // a vertex keeps 0.01 of an edge from the lattice points
  }
  Execution execution;
  EXPECT_TRUE(selfIntersections(mesh, execution).empty());
}

TEST(FieldContour, volumeConvergesWithTheSquareOfTheCell)
{
  const double exact = 4.0 / 3.0 * Pi * (0.3 * 0.3 * 0.3 + 0.25 * 0.25 * 0.25);
  const double coarse = exact - volume(contourField(Balls(1.0), 0.04));
  const double fine = exact - volume(contourField(Balls(1.0), 0.02));
  EXPECT_GT(fine, 0.0); // chords lie inside
  EXPECT_LT(fine, 0.01 * exact);
  EXPECT_NEAR(coarse / fine, 4.0, 0.5);
}

TEST(FieldContour, aSteeperFieldHasTheSameSurface)
{
  const Mesh one = contourField(Balls(1.0), 0.03);
  const Mesh two = contourField(Balls(2.0), 0.03);
  ASSERT_EQ(one.triangles.size(), two.triangles.size());
  EXPECT_NEAR(volume(one), volume(two), 1e-9);
}

TEST(FieldContour, refusesCellsOutOfRange)
{
  for (const double edge : {0.0, -1.0, 0.3, std::numeric_limits<double>::quiet_NaN()})
  {
    try
    {
      contourField(Balls(1.0), edge);
      FAIL() << edge;
    }
    catch (const InvalidInput& error)
    {
      EXPECT_NE(std::string(error.what()).find("cell edge " + std::to_string(edge)), std::string::npos);
    }
  }
}

} // namespace
