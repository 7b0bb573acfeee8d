// SPDX-License-Identifier: BSD-3-Clause
#include "MeshCheck.h"

#include "Error.h"
#include "EvaluationTestMeshes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

template <typename Check> std::string thrownBy(const Check& check)
{
  try
  {
    check();
  }
  catch (const InvalidInput& error)
  {
    return error.what();
  }
  return "";
}

/** On one thread, and side by side. */
std::string messageOf(const Mesh& mesh)
{
  ThreadedExecution three(3);
  const std::string message = thrownBy([&] { checkMesh(mesh); });
  EXPECT_EQ(thrownBy([&] { checkMesh(mesh, three); }), message);
  return message;
}

} // namespace

TEST(MeshCheck, AcceptsWhatIsValid)
{
  EXPECT_EQ(messageOf(Mesh()), "");
  EXPECT_EQ(messageOf(boxMesh(0, 1)), "");
}

TEST(MeshCheck, NamesTheTriangleAndThePoint)
{
  Mesh mesh = boxMesh(0, 1);
  mesh.triangles[3][1] = 8;
  EXPECT_EQ(messageOf(mesh), "triangle 3 names point 8 of a mesh of 8 points");
  mesh.triangles[3][1] = -1;
  EXPECT_EQ(messageOf(mesh), "triangle 3 names point -1 of a mesh of 8 points");
}

TEST(MeshCheck, NamesThePointThatIsNotFinite)
{
  Mesh mesh = boxMesh(0, 1);
  mesh.points[5][2] = std::nan("");
  EXPECT_EQ(messageOf(mesh), "point 5 has a coordinate that is not finite");
}
