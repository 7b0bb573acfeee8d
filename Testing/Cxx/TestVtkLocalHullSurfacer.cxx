// SPDX-License-Identifier: BSD-3-Clause
#include "vtkLocalHullSurfacer.h"

#include "ModelingTesting.h"
#include "vtkSilhouetteEvaluator.h"
#include "vtkSilhouetteOctreeSource.h"
#include "vtkVotingMarchingCubes.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkHyperTreeGrid.h"
#include "vtkIntArray.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <cmath>
#include <set>

using namespace silhouette::testing;

namespace
{

struct Pipeline
{
  vtkNew<vtkSilhouetteOctreeSource> octree;
  vtkNew<vtkVotingMarchingCubes> marching;
  vtkNew<vtkLocalHullSurfacer> surface;

  explicit Pipeline(bool withViews = true, int depth = 5)
  {
    this->octree->SetInputData(ringViews());
    this->octree->SetDepth(depth);
    this->marching->SetInputConnection(0, this->octree->GetOutputPort(0));
    this->marching->SetViewsConnection(this->octree->GetOutputPort(1));
    this->surface->SetInputConnection(0, this->marching->GetOutputPort());
    this->surface->SetOctreeConnection(this->octree->GetOutputPort(0));
    if (withViews)
    {
      this->surface->SetViewsConnection(this->octree->GetOutputPort(1));
    }
  }
};

} // namespace

TEST(VtkLocalHullSurfacer, KeepsItsPromise)
{
  for (const bool withViews : {true, false})
  {
    Pipeline pipeline(withViews);
    const Listener listener(pipeline.surface);
    pipeline.surface->Update();
    EXPECT_TRUE(listener.silent());
    vtkNew<vtkSilhouetteEvaluator> evaluator;
    evaluator->SetInputConnection(0, pipeline.surface->GetOutputPort(0));
    evaluator->SetViewsConnection(pipeline.octree->GetOutputPort(1));
    evaluator->SetOctreeConnection(pipeline.octree->GetOutputPort(0));
    evaluator->Update();
    vtkTable* table = evaluator->GetOutput();
    EXPECT_EQ(field(table, "Sound"), 1);
    EXPECT_EQ(field(table, "LostSurface"), 0);
    EXPECT_EQ(field(table, "Components"), 1);
    EXPECT_GT(field(table, "MeanIoU"), 0.9);
    vtkPolyData* surface = pipeline.surface->GetOutput();
    EXPECT_GT(field(surface, "Survivors"), 0);
    EXPECT_EQ(field(surface, "IgnoredPoints"), 0);
    EXPECT_EQ(field(surface, "DroppedOctants"), 0);
    for (const char* name : {"CoveredOctants", "CoveringCorners", "Bridges", "CavitiesFilled", "MovedToMiddle",
                             "Deficit", "Shift", "Alignment", "RepairedPixels"})
    {
      EXPECT_GE(field(surface, name), 0) << name;
    }
  }
}

TEST(VtkLocalHullSurfacer, MakesHullsOnlyWhenAskedFor)
{
  Pipeline pipeline;
  pipeline.surface->Update();
  vtkPolyData* surface = pipeline.surface->GetOutput();
  vtkPolyData* hulls = vtkPolyData::SafeDownCast(pipeline.surface->GetOutputDataObject(1));
  EXPECT_GT(surface->GetNumberOfPolys(), 0);
  EXPECT_EQ(hulls->GetNumberOfPolys(), 0);

  const vtkMTimeType surfaceTime = surface->GetUpdateTime();
  pipeline.surface->Update(1);
  EXPECT_GT(hulls->GetNumberOfPolys(), 0);
  EXPECT_EQ(surface->GetUpdateTime(), surfaceTime) << "the surface is not made again";
  EXPECT_GT(surface->GetNumberOfPolys(), 0);
  vtkDataArray* ids = hulls->GetCellData()->GetArray("HullId");
  ASSERT_NE(ids, nullptr);
  EXPECT_EQ(ids->GetNumberOfTuples(), hulls->GetNumberOfPolys());
  std::set<double> different;
  for (vtkIdType i = 0; i < ids->GetNumberOfTuples(); ++i)
  {
    different.insert(ids->GetTuple1(i));
  }
  EXPECT_EQ(*different.begin(), 0);
  EXPECT_EQ(*different.rbegin(), double(different.size() - 1));

  const vtkMTimeType hullTime = hulls->GetUpdateTime();
  pipeline.surface->Update(0);
  pipeline.surface->Update(1);
  EXPECT_EQ(hulls->GetUpdateTime(), hullTime) << "nor are the hulls";

  // A change makes both out of date, each is made when asked for.
  pipeline.surface->SetCoverOffset(0.1);
  pipeline.surface->Update(1);
  EXPECT_GT(hulls->GetUpdateTime(), hullTime);
  EXPECT_EQ(surface->GetUpdateTime(), surfaceTime);
  pipeline.surface->Update(0);
  EXPECT_GT(surface->GetUpdateTime(), surfaceTime);
  EXPECT_GT(surface->GetNumberOfPolys(), 0);
}

TEST(VtkLocalHullSurfacer, IsAProperFilter)
{
  Pipeline pipeline;
  vtkLocalHullSurfacer* filter = pipeline.surface;
  expectPrints(filter,
               {"FillCavities", "CoverOffset", "BridgeGap", "HullTolerance", "SeedBlock", "GenerateNormals",
                "OutputPointsPrecision", "Mode", "IslandShare", "RepairSilhouettes", "AlignViews", "CorrectField",
                "ThinHulls", "JoinHandles", "HandleReach", "FillTunnels", "TunnelWidth", "LoopLength", "SpeckleArea", "SpeckleShare", "BlobDepth", "BlobChord", "BlobCorners",
                "SmallestDeficit", "SmallestShift", "HullConvexity", "ModelDissent", "Smoothing", "GreatestSmoothing", "Gentleness", "ShiftNoise", "Alignments", "ContourReach", "RaiseWidth",
                "ThinSmallestRadius", "ThinLargestRadius", "ThinReach", "SliceAxis", "SliceTolerance",
                "ChainTolerance", "ChainOverlap", "Controller"});
  expectModifies(filter, [&] { filter->SetModeToThesis(); });
  expectModifies(filter, [&] { filter->SetModeToRobust(); });
  expectModifies(filter, [&] { filter->SetIslandShare(0.5); });
  expectModifies(filter, [&] { filter->AlignViewsOff(); });
  expectModifies(filter, [&] { filter->SetBlobCorners(9); });
  expectModifies(filter, [&] { filter->JoinHandlesOff(); });
  expectModifies(filter, [&] { filter->FillTunnelsOff(); });
  expectModifies(filter, [&] { filter->SetTunnelWidth(4); });
  expectModifies(filter, [&] { filter->SetCoverOffset(0.2); });
  expectModifies(filter, [&] { filter->FillCavitiesOff(); });
  expectModifies(filter, [&] { filter->SetSeedBlock(2); });
  expectModifies(filter, [&] { filter->SetBridgeGap(1); });
  expectModifies(filter, [&] { filter->SetHullTolerance(0.25); });
  expectProgress(filter);
  expectProgress(filter, 1);
  expectAbort(filter, 0.05);
  expectAbort(filter, 0.5);
  expectAbort(filter, 0.11, 1);
}

TEST(VtkLocalHullSurfacer, ThesisModeKeepsThePromiseWithItsHulls)
{
  Pipeline pipeline;
  pipeline.surface->SetModeToThesis();
  EXPECT_NE(printed(pipeline.surface).find("Mode: Thesis"), std::string::npos);
  const Listener listener(pipeline.surface);
  pipeline.surface->Update();
  EXPECT_TRUE(listener.silent());
  vtkNew<vtkSilhouetteEvaluator> evaluator;
  evaluator->SetInputConnection(0, pipeline.surface->GetOutputPort(0));
  evaluator->SetViewsConnection(pipeline.octree->GetOutputPort(1));
  evaluator->SetOctreeConnection(pipeline.octree->GetOutputPort(0));
  evaluator->Update();
  EXPECT_EQ(field(evaluator->GetOutput(), "Sound"), 1);
  EXPECT_EQ(field(evaluator->GetOutput(), "LostSurface"), 0);
  pipeline.surface->Update(1);
  EXPECT_GT(vtkPolyData::SafeDownCast(pipeline.surface->GetOutputDataObject(1))->GetNumberOfPolys(), 0);
  pipeline.surface->SetChainOverlap(0.0);
  expectError(pipeline.surface, {"overlap"}, 0);
}

TEST(VtkLocalHullSurfacer, GivesUpIslandsAndCountsThem)
{
  // A ball and a smaller one above it, on the axis of the ring of cameras.
  auto views = ringViews();
  for (unsigned int i = 0; i < views->GetNumberOfPartitionedDataSets(); ++i)
  {
    auto* image = vtkImageData::SafeDownCast(views->GetPartition(i, 0));
    auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer());
    for (int n = 0; n < ImageSize * ImageSize; ++n)
    {
      const double x = n % ImageSize - 0.5 * (ImageSize - 1), y = n / ImageSize - 0.5 * (ImageSize - 1);
      pixel[n] = std::hypot(x, y + 12.0) <= 24.0 || std::hypot(x, y - 30.0) <= 6.0 ? 255 : 0;
    }
  }
  Pipeline pipeline;
  pipeline.octree->SetInputData(views);
  vtkNew<vtkSilhouetteEvaluator> evaluator;
  evaluator->SetInputConnection(0, pipeline.surface->GetOutputPort(0));
  evaluator->SetViewsConnection(pipeline.octree->GetOutputPort(1));
  evaluator->SetOctreeConnection(pipeline.octree->GetOutputPort(0));
  evaluator->Update();
  EXPECT_EQ(field(evaluator->GetOutput(), "Components"), 2);
  EXPECT_EQ(field(evaluator->GetOutput(), "LostSurface"), 0);
  pipeline.surface->SetIslandShare(0.3);
  evaluator->Update();
  EXPECT_EQ(field(evaluator->GetOutput(), "Components"), 1);
  EXPECT_EQ(field(evaluator->GetOutput(), "Sound"), 1);
  const double dropped = field(pipeline.surface->GetOutput(), "DroppedOctants");
  EXPECT_GT(dropped, 0);
  EXPECT_EQ(field(evaluator->GetOutput(), "LostSurface"), 0) << "given up, not lost";
  vtkNew<vtkPolyData> silent;
  silent->DeepCopy(pipeline.surface->GetOutput());
  silent->GetFieldData()->RemoveArray("DroppedLeaves");
  evaluator->SetInputData(0, silent);
  evaluator->Update();
  EXPECT_GT(field(evaluator->GetOutput(), "LostSurface"), 0) << "all survivors are asked for";
  EXPECT_LE(field(evaluator->GetOutput(), "LostSurface"), dropped);
  vtkNew<vtkIntArray> wrong;
  wrong->SetName("DroppedLeaves");
  silent->GetFieldData()->AddArray(wrong);
  silent->Modified();
  expectError(evaluator, {"the surface", "DroppedLeaves", "type int", "unsigned 64-bit"});
}

TEST(VtkLocalHullSurfacer, GivesNormalsAndPrecision)
{
  Pipeline pipeline;
  pipeline.surface->GenerateNormalsOn();
  pipeline.surface->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  pipeline.surface->Update();
  EXPECT_EQ(pipeline.surface->GetOutput()->GetPoints()->GetDataType(), VTK_FLOAT);
  EXPECT_NE(pipeline.surface->GetOutput()->GetPointData()->GetNormals(), nullptr);
}

TEST(VtkLocalHullSurfacer, SameForAnyNumberOfThreads)
{
  expectSameForThreads(
      []
      {
        Pipeline pipeline;
        pipeline.surface->Update();
        pipeline.surface->Update(1);
        std::string all;
        for (int port = 0; port < 2; ++port)
        {
          auto* out = vtkPolyData::SafeDownCast(pipeline.surface->GetOutputDataObject(port));
          all += bytes(out->GetPoints()->GetData()) + bytes(out->GetPolys()->GetConnectivityArray());
        }
        return all;
      });
}

TEST(VtkLocalHullSurfacer, RefusesWhatDoesNotFit)
{
  Pipeline pipeline;
  pipeline.surface->SetCoverOffset(0.0);
  expectError(pipeline.surface, {"cover offset 0"});
  pipeline.surface->SetCoverOffset(0.03);
  pipeline.surface->SetSeedBlock(0);
  expectError(pipeline.surface, {"seed block 0"}, 1);
  pipeline.surface->SetSeedBlock(4);
  pipeline.surface->SetHullTolerance(-1.0);
  expectError(pipeline.surface, {"tolerance -1"}, 1);
  pipeline.surface->SetHullTolerance(0.5);
  pipeline.surface->SetBridgeGap(-1);
  expectError(pipeline.surface, {"-1"});
  pipeline.surface->SetBridgeGap(2);
  pipeline.surface->SetIslandShare(1.5);
  expectError(pipeline.surface, {"island share 1.5"});
  pipeline.surface->SetIslandShare(0.0);
  pipeline.surface->SetSmallestDeficit(-1.0);
  expectError(pipeline.surface, {"smallest deficit -1: at least 0 is needed"});
  pipeline.surface->SetSmallestDeficit(0.0);
  pipeline.surface->SetAlignments(101);
  expectError(pipeline.surface, {"alignments 101 is outside 1 to 100"});
  pipeline.surface->SetAlignments(3);
  pipeline.surface->SetBlobCorners(0);
  expectError(pipeline.surface, {"blob corners 0: at least 1 is needed"});
  pipeline.surface->SetBlobCorners(8);
  pipeline.surface->SetBlobDepth(2e9);
  expectError(pipeline.surface, {"blob depth 2000000000 is outside 0 to 1000000000"});
  pipeline.surface->SetBlobDepth(0.1);
  pipeline.surface->SetLoopLength(-0.5);
  expectError(pipeline.surface, {"loop length -0.5: at least 0 is needed"});
  pipeline.surface->SetLoopLength(1.0 / 3.0);
  pipeline.surface->SetViewsData(ringViews(7));
  expectError(pipeline.surface, {"carved from other views"});
  pipeline.surface->SetViewsConnection(pipeline.octree->GetOutputPort(1));

  vtkNew<vtkPolyData> square;
  vtkNew<vtkPoints> points;
  for (const double x : {0.0, 1.0})
  {
    points->InsertNextPoint(x, x, 0.0);
    points->InsertNextPoint(x, 1.0 - x, 0.0);
  }
  square->SetPoints(points);
  vtkNew<vtkCellArray> cells;
  const vtkIdType corners[4] = {0, 3, 2, 1};
  cells->InsertNextCell(4, corners);
  square->SetPolys(cells);
  pipeline.surface->SetInputDataObject(0, square);
  expectError(pipeline.surface, {"the surface", "has 4 corners", "vtkTriangleFilter"});
}

TEST(VtkLocalHullSurfacer, EmptyInputGivesEmptyOutputSilently)
{
  vtkNew<vtkLocalHullSurfacer> filter;
  filter->SetInputData(vtkNew<vtkPolyData>());
  filter->SetOctreeData(vtkNew<vtkHyperTreeGrid>());
  const Listener listener(filter);
  filter->Update();
  filter->Update(1);
  EXPECT_TRUE(listener.silent());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
}

TEST(VtkLocalHullSurfacer, WorksOnAnEmptySurface)
{
  Pipeline pipeline;
  pipeline.surface->SetInputDataObject(0, vtkNew<vtkPolyData>());
  pipeline.surface->Update();
  EXPECT_GT(pipeline.surface->GetOutput()->GetNumberOfPolys(), 0) << "the octree's survivors are covered";
}
