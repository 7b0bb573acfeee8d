// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteComparison.h"

#include "Error.h"
#include "EvaluationTestMeshes.h"
#include "SilhouetteRendering.h"

#include <gtest/gtest.h>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** u = x, v = y: a view along z without perspective. */
View view(const std::string& name, const Mesh& mesh, int width, int height)
{
  View result;
  result.name = name;
  result.projection(0, 0) = result.projection(1, 1) = result.projection(2, 3) = 1.0;
  result.silhouette = renderSilhouette(mesh, result.projection, width, height);
  return result;
}

} // namespace

TEST(SilhouetteComparison, CountsPixels)
{
  // Pixels 2 to 11 against 7 to 16 in both directions: 100 each, 25 in both.
  Execution serial;
  const std::vector<View> views{ view("a", boxMesh(2, 11), 30, 20), view("b", boxMesh(7, 16), 30, 20) };
  const std::vector<ViewAgreement> result = compareSilhouettes(boxMesh(7, 16), views, serial);
  ASSERT_EQ(result.size(), 2u);
  EXPECT_EQ(result[0].name, "a");
  EXPECT_EQ(result[0].silhouettePixels, 100u);
  EXPECT_EQ(result[0].meshPixels, 100u);
  EXPECT_EQ(result[0].falseObject, 75u);
  EXPECT_EQ(result[0].falseBackground, 75u);
  EXPECT_DOUBLE_EQ(result[0].iou, 25.0 / 175.0);
  EXPECT_DOUBLE_EQ(result[0].xorShare, 1.5);
  EXPECT_EQ(result[1].iou, 1.0);
  EXPECT_EQ(result[1].xorShare, 0.0);
  const ViewAgreement total = totalAgreement(result);
  EXPECT_DOUBLE_EQ(total.iou, 125.0 / 275.0);
  EXPECT_DOUBLE_EQ(total.xorShare, 150.0 / 200.0);
}

TEST(SilhouetteComparison, EmptySilhouettes)
{
  Execution serial;
  const std::vector<View> views{ view("empty", Mesh(), 30, 20), view("full", boxMesh(2, 3), 30, 20) };
  const auto mesh = compareSilhouettes(boxMesh(2, 3), views, serial);
  EXPECT_EQ(mesh[0].iou, 0.0);
  EXPECT_EQ(mesh[0].xorShare, 1.0);
  const auto nothing = compareSilhouettes(Mesh(), views, serial);
  EXPECT_EQ(nothing[0].iou, 1.0);
  EXPECT_EQ(nothing[0].xorShare, 0.0);
  EXPECT_EQ(nothing[1].iou, 0.0);
  EXPECT_EQ(nothing[1].xorShare, 1.0);
  EXPECT_EQ(nothing[1].falseBackground, 4u);
  EXPECT_TRUE(compareSilhouettes(boxMesh(2, 3), {}, serial).empty());
  EXPECT_EQ(totalAgreement({}).iou, 1.0);
}

TEST(SilhouetteComparison, AnyNumberOfThreads)
{
  std::vector<View> views;
  for (int v = 0; v < 37; ++v)
  {
    views.push_back(view("view " + std::to_string(v), boxMesh(v, v + 5), 50, 50));
  }
  Execution serial;
  ThreadedExecution threads(4);
  const auto a = compareSilhouettes(boxMesh(10, 30), views, serial);
  const auto b = compareSilhouettes(boxMesh(10, 30), views, threads);
  for (int v = 0; v < 37; ++v)
  {
    EXPECT_EQ(a[v].name, views[v].name);
    EXPECT_EQ(a[v].name, b[v].name);
    EXPECT_EQ(a[v].falseObject, b[v].falseObject);
    EXPECT_EQ(a[v].falseBackground, b[v].falseBackground);
  }
}

TEST(SilhouetteComparison, RejectsAndCancels)
{
  std::vector<View> views{ view("good", Mesh(), 5, 5), view("bad", Mesh(), 5, 5) };
  CancelledExecution cancelled;
  EXPECT_THROW(compareSilhouettes(boxMesh(0, 1), views, cancelled), Cancelled);
  Execution serial;
  views[1].silhouette.pixels.pop_back();
  try
  {
    compareSilhouettes(boxMesh(0, 1), views, serial);
    FAIL();
  }
  catch (const InvalidInput& error)
  {
    EXPECT_STREQ(error.what(), "view bad: 24 pixels in an image of 5 x 5");
  }
  views[1] = view("bad", Mesh(), 5, 5);
  views[1].projection(0, 0) = std::nan("");
  views.push_back(views[1]);
  views[2].name = "worse";
  ThreadedExecution threads(4);
  for (Execution* execution : { &serial, static_cast<Execution*>(&threads) })
  {
    try
    {
      compareSilhouettes(boxMesh(0, 1), views, *execution);
      FAIL();
    }
    catch (const InvalidInput& error)
    {
      EXPECT_STREQ(error.what(), "view bad: point 0 does not project to finite numbers");
    }
  }
  ProgressExecution progress;
  views.resize(1);
  compareSilhouettes(boxMesh(0, 1), views, progress);
  EXPECT_TRUE(progress.Monotone);
  EXPECT_EQ(progress.Last, 1.0);
}
