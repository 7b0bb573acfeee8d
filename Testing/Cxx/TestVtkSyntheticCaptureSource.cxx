// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSyntheticCaptureSource.h"

#include "ModelingTesting.h"
#include "vtkSilhouetteEvaluator.h"

#include "vtkSphereSource.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <limits>

using namespace silhouette::testing;

namespace
{

vtkSmartPointer<vtkSyntheticCaptureSource> smallSource()
{
  auto source = vtkSmartPointer<vtkSyntheticCaptureSource>::New();
  source->SetShapeToSphere();
  source->SetRefinement(0.5);
  source->SetNumberOfViews(6);
  source->SetWidth(80);
  source->SetHeight(60);
  return source;
}

vtkImageData* view(vtkPartitionedDataSetCollection* views, unsigned int index)
{
  return vtkImageData::SafeDownCast(views->GetPartition(index, 0));
}

} // namespace

TEST(VtkSyntheticCaptureSource, PhotographsASphere)
{
  auto source = smallSource();
  const Listener listener(source);
  source->Update();
  EXPECT_TRUE(listener.silent());
  vtkPartitionedDataSetCollection* masks = source->GetOutput();
  vtkPartitionedDataSetCollection* photographs = source->GetPhotographsOutput();
  ASSERT_EQ(masks->GetNumberOfPartitionedDataSets(), 6u);
  ASSERT_EQ(photographs->GetNumberOfPartitionedDataSets(), 6u);
  EXPECT_EQ(view(masks, 0)->GetDimensions()[0], 80);
  EXPECT_EQ(view(masks, 0)->GetDimensions()[1], 60);
  EXPECT_EQ(view(masks, 0)->GetNumberOfScalarComponents(), 1);
  EXPECT_EQ(view(photographs, 0)->GetNumberOfScalarComponents(), 3);
  EXPECT_EQ(field(view(masks, 0), "IsMask"), 1);
  EXPECT_EQ(bytes(view(masks, 5)->GetFieldData()->GetArray("Projection")),
            bytes(view(photographs, 5)->GetFieldData()->GetArray("Projection")));
  EXPECT_NEAR(volume(source->GetTruthOutput()), 4.0 / 3.0 * 3.14159265 * std::pow(0.9, 3), 0.01);

  // The masks are the truth's silhouettes, rows and matrices included.
  vtkNew<vtkSilhouetteEvaluator> evaluator;
  evaluator->SetInputConnection(0, source->GetOutputPort(1));
  evaluator->SetViewsConnection(source->GetOutputPort(0));
  evaluator->Update();
  EXPECT_EQ(field(evaluator->GetOutput(), "MeanIoU"), 1.0);
}

TEST(VtkSyntheticCaptureSource, PhotographsAGivenMesh)
{
  vtkNew<vtkSphereSource> given;
  given->SetRadius(3.0);
  auto source = smallSource();
  source->SetInputConnection(given->GetOutputPort());
  source->Update();
  EXPECT_EQ(source->GetTruthOutput()->GetNumberOfPoints(), given->GetOutput()->GetNumberOfPoints());
  EXPECT_EQ(source->GetOutput()->GetNumberOfPartitionedDataSets(), 6u);
}

TEST(VtkSyntheticCaptureSource, EachNoiseChangesSomething)
{
  auto source = smallSource();
  const auto masks = [&]
  {
    source->Update();
    std::string all;
    for (unsigned int i = 0; i < 6; ++i)
    {
      all += bytes(view(source->GetOutput(), i)->GetPointData()->GetScalars());
    }
    return all;
  };
  const auto projection = [&]
  {
    source->Update();
    return bytes(view(source->GetOutput(), 0)->GetFieldData()->GetArray("Projection"));
  };
  const std::string clean = masks(), camera = projection();
  source->SetNoiseContour(2.0);
  EXPECT_NE(masks(), clean);
  source->SetNoiseContour(0.0);
  source->SetNoiseBlobs(2);
  EXPECT_NE(masks(), clean);
  source->SetNoiseBlobs(0);
  source->SetNoisePixels(0.02);
  const std::string first = masks();
  EXPECT_NE(first, clean);
  source->SetSeed(7);
  EXPECT_NE(masks(), first);
  source->SetNoisePixels(0.0);
  EXPECT_EQ(masks(), clean);
  source->SetNoiseCamera(1.0);
  EXPECT_NE(projection(), camera);
  source->SetNoiseCamera(0.0);
  source->SetNoiseRotation(1.0);
  EXPECT_NE(projection(), camera);
  EXPECT_EQ(masks(), clean);
}

TEST(VtkSyntheticCaptureSource, GivesAllViewsToEveryPiece)
{
  auto source = smallSource();
  source->UpdatePiece(1, 2, 0);
  EXPECT_EQ(source->GetOutput()->GetNumberOfPartitionedDataSets(), 6u);
}

TEST(VtkSyntheticCaptureSource, IsAProperFilter)
{
  auto source = smallSource();
  expectPrints(source, {"Shape", "Refinement", "NumberOfViews", "Width", "Height", "Seed", "NoiseContour",
                        "NoiseBlobs", "NoisePixels", "NoiseCamera", "NoiseRotation"});
  expectModifies(source, [&] { source->SetSeed(3); });
  expectModifies(source, [&] { source->SetShapeToTorus(); });
  expectModifies(source, [&] { source->SetNoiseContour(1.0); });
  expectProgress(source);
  expectAbort(source, 0.15);
  expectAbort(source, 0.5);
  expectAbort(source, 0.5, 1);
}

TEST(VtkSyntheticCaptureSource, SameForAnyNumberOfThreads)
{
  expectSameForThreads(
      []
      {
        auto source = smallSource();
        source->SetNoiseContour(1.0);
        source->SetNoisePixels(0.01);
        source->Update();
        std::string all;
        for (unsigned int i = 0; i < 6; ++i)
        {
          all += bytes(view(source->GetOutput(), i)->GetPointData()->GetScalars());
          all += bytes(view(source->GetPhotographsOutput(), i)->GetPointData()->GetScalars());
        }
        return all;
      });
}

TEST(VtkSyntheticCaptureSource, RefusesSettingsOutOfRange)
{
  auto source = smallSource();
  source->SetNumberOfViews(0);
  expectError(source, {"views", "0"});
  source->SetNumberOfViews(6);
  source->SetWidth(0);
  expectError(source, {"width", "0"});
  source->SetWidth(80);
  source->SetNoisePixels(1.5);
  expectError(source, {"1.5"});
  source->SetNoisePixels(0.0);
  source->SetNoiseContour(std::numeric_limits<double>::quiet_NaN());
  expectError(source, {"nan"});
  source->SetNoiseContour(0.0);
  source->SetRefinement(100.0);
  expectError(source, {"100"});
  source->SetRefinement(0.5);
  source->SetInputData(vtkNew<vtkPolyData>());
  expectError(source, {"no triangles"});
}
