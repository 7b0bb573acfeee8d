// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSilhouetteEvaluator.h"

#include "ModelingTesting.h"
#include "vtkSilhouetteOctreeSource.h"
#include "vtkVotingMarchingCubes.h"

#include "vtkCellArray.h"
#include "vtkHyperTreeGrid.h"
#include "vtkSphereSource.h"
#include "vtkTable.h"

using namespace silhouette::testing;

namespace
{

vtkSmartPointer<vtkPolyData> sphere(double radius, int resolution = 40)
{
  vtkNew<vtkSphereSource> source;
  source->SetRadius(radius);
  source->SetThetaResolution(resolution);
  source->SetPhiResolution(resolution);
  source->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  source->Update();
  return source->GetOutput();
}

vtkSmartPointer<vtkSilhouetteEvaluator> evaluatorOf(vtkPolyData* surface)
{
  auto evaluator = vtkSmartPointer<vtkSilhouetteEvaluator>::New();
  evaluator->SetInputDataObject(0, surface);
  evaluator->SetViewsData(ringViews());
  evaluator->SetSampleSpacing(0.05);
  return evaluator;
}

} // namespace

TEST(VtkSilhouetteEvaluator, JudgesASphere)
{
  auto evaluator = evaluatorOf(sphere(1.0));
  evaluator->SetTruthData(sphere(1.1));
  evaluator->SetSampleSpacing(0.0);
  const Listener listener(evaluator);
  evaluator->Update();
  EXPECT_TRUE(listener.silent());
  vtkTable* table = evaluator->GetOutput();
  ASSERT_EQ(table->GetNumberOfRows(), 8);
  EXPECT_EQ(table->GetValueByName(3, "Name").ToString(), "disc3.png");
  for (vtkIdType i = 0; i < 8; ++i)
  {
    EXPECT_GT(table->GetValueByName(i, "IoU").ToDouble(), 0.98);
    EXPECT_LT(table->GetValueByName(i, "XOR").ToDouble(), 0.02);
    const double wrong = table->GetValueByName(i, "FalseObject").ToDouble() +
                         table->GetValueByName(i, "FalseBackground").ToDouble();
    EXPECT_NEAR(wrong / table->GetValueByName(i, "SilhouettePixels").ToDouble(),
                table->GetValueByName(i, "XOR").ToDouble(), 1e-12);
    EXPECT_GT(table->GetValueByName(i, "MeshPixels").ToDouble(), 0.0);
  }
  EXPECT_EQ(field(table, "Views"), 8);
  EXPECT_GT(field(table, "MeanIoU"), 0.98);
  EXPECT_LT(field(table, "MeanXOR"), 0.02);
  EXPECT_GT(field(table, "TotalIoU"), 0.98);
  EXPECT_LT(field(table, "TotalXOR"), 0.02);
  for (const char* name : {"OpenEdges", "NonManifoldEdges", "NonManifoldVertices", "InconsistentEdges",
                           "SelfIntersections", "UnusedPoints", "Genus"})
  {
    EXPECT_EQ(field(table, name), 0) << name;
  }
  EXPECT_EQ(field(table, "Closed"), 1);
  EXPECT_EQ(field(table, "Sound"), 1);
  EXPECT_EQ(field(table, "Components"), 1);
  EXPECT_GT(field(table, "Points"), 1000);
  EXPECT_GT(field(table, "Triangles"), 1000);
  EXPECT_NEAR(field(table, "Volume"), 4.0 / 3.0 * 3.14159, 0.05);
  EXPECT_NEAR(field(table, "Area"), 4.0 * 3.14159, 0.05);
  EXPECT_NEAR(field(table, "MeshToTruthMean"), 0.1, 0.006);
  EXPECT_NEAR(field(table, "TruthToMeshMean"), 0.1, 0.006);
  EXPECT_NEAR(field(table, "TruthMean"), 0.1, 0.006);
  EXPECT_NEAR(field(table, "TruthRMS"), 0.1, 0.006);
  EXPECT_NEAR(field(table, "TruthHausdorff"), 0.1, 0.006);
  EXPECT_NEAR(field(table, "MeshToTruthMaximum"), 0.1, 0.006);
  EXPECT_NEAR(field(table, "TruthToMeshMaximum"), 0.1, 0.006);
  EXPECT_NEAR(field(table, "SampleSpacing"), 2.2 / 512.0, 1e-6);
  EXPECT_TRUE(std::isnan(field(table, "LostSurface")));
}

TEST(VtkSilhouetteEvaluator, CountsLostOctants)
{
  vtkNew<vtkSilhouetteOctreeSource> octree;
  octree->SetInputData(ringViews());
  octree->SetDepth(5);
  auto small = evaluatorOf(sphere(0.5));
  small->SetOctreeConnection(octree->GetOutputPort(0));
  small->Update();
  EXPECT_GT(field(small->GetOutput(), "LostSurface"), 100);
  EXPECT_NEAR(field(small->GetOutput(), "LeafEdge"),
              octree->GetOutput()->GetFieldData()->GetArray("RootCube")->GetTuple1(3) / 32.0, 1e-12);
  auto large = evaluatorOf(sphere(1.6));
  large->SetOctreeConnection(octree->GetOutputPort(0));
  large->SetTruthData(sphere(1.6));
  large->SetSampleSpacing(0.0);
  large->Update();
  EXPECT_EQ(field(large->GetOutput(), "LostSurface"), 0);
  EXPECT_EQ(field(large->GetOutput(), "SampleSpacing"), field(large->GetOutput(), "LeafEdge"));
}

TEST(VtkSilhouetteEvaluator, ReportsAnOpenSurface)
{
  vtkNew<vtkSphereSource> half;
  half->SetEndTheta(180.0);
  half->Update();
  auto evaluator = evaluatorOf(half->GetOutput());
  evaluator->Update();
  vtkTable* table = evaluator->GetOutput();
  EXPECT_GT(field(table, "OpenEdges"), 0);
  EXPECT_EQ(field(table, "Closed"), 0);
  EXPECT_EQ(field(table, "Sound"), 0);
  EXPECT_TRUE(std::isnan(field(table, "Genus"))) << "absent";
}

TEST(VtkSilhouetteEvaluator, IsAProperFilter)
{
  auto evaluator = evaluatorOf(sphere(1.0));
  evaluator->SetTruthData(sphere(1.1));
  expectPrints(evaluator, {"SampleSpacing"});
  expectModifies(evaluator, [&] { evaluator->SetSampleSpacing(0.04); });
  expectProgress(evaluator);
  expectAbort(evaluator, 0.1);
  expectAbort(evaluator, 0.5);
}

TEST(VtkSilhouetteEvaluator, SameForAnyNumberOfThreads)
{
  expectSameForThreads(
      []
      {
        auto evaluator = evaluatorOf(sphere(1.0));
        evaluator->SetTruthData(sphere(1.1));
        evaluator->Update();
        std::string all = bytes(vtkDataArray::SafeDownCast(evaluator->GetOutput()->GetColumnByName("IoU")));
        for (const char* name :
             {"Volume", "Area", "TruthMean", "TruthRMS", "TruthHausdorff", "SelfIntersections"})
        {
          all += bytes(evaluator->GetOutput()->GetFieldData()->GetArray(name));
        }
        return all;
      });
}

TEST(VtkSilhouetteEvaluator, RefusesWhatItCannotJudge)
{
  auto evaluator = evaluatorOf(vtkNew<vtkPolyData>());
  expectError(evaluator, {"the surface has no triangles"});
  evaluator->SetInputDataObject(0, sphere(1.0));
  evaluator->SetTruthData(vtkNew<vtkPolyData>());
  expectError(evaluator, {"the truth has no triangles"});
  evaluator->SetTruthData(sphere(1.0));
  evaluator->SetSampleSpacing(-1.0);
  expectError(evaluator, {"spacing"});
  evaluator->SetSampleSpacing(0.0);
  evaluator->SetViewsData(vtkNew<vtkPartitionedDataSetCollection>());
  expectError(evaluator, {"no views"});
  auto views = ringViews(2);
  views->GetPartition(1, 0)->GetFieldData()->RemoveArray("Projection");
  evaluator->SetViewsData(views);
  expectError(evaluator, {"view 1 (disc1.png)", "Projection"});
  evaluator->SetViewsData(ringViews());
  evaluator->SetOctreeData(vtkNew<vtkHyperTreeGrid>());
  expectError(evaluator, {"the octree has no field array"});
}
