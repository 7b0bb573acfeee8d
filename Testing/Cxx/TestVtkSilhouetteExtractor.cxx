// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSilhouetteExtractor.h"

#include "ModelingTesting.h"

using namespace silhouette::testing;

namespace
{

/** A red square of `side` pixels on blue, from (10, 20) counted from the bottom. */
vtkSmartPointer<vtkImageData> squareOnBlue(int side = 20)
{
  auto image = plainImage(64, 48, 0, 3);
  for (int y = 0; y < 48; ++y)
  {
    for (int x = 0; x < 64; ++x)
    {
      const bool object = x >= 10 && x < 10 + side && y >= 20 && y < 20 + side;
      static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0))[object ? 0 : 2] = 200;
    }
  }
  setProjection(image, ringCamera(0.5, CameraDistance, 64, Focal));
  return image;
}

vtkSmartPointer<vtkPartitionedDataSetCollection> photographs(int count = 3)
{
  auto views = vtkSmartPointer<vtkPartitionedDataSetCollection>::New();
  for (int i = 0; i < count; ++i)
  {
    appendView(views, squareOnBlue(), "photo" + std::to_string(i) + ".png");
  }
  return views;
}

vtkImageData* output(vtkSilhouetteExtractor* filter, unsigned int view)
{
  return vtkImageData::SafeDownCast(filter->GetOutput()->GetPartition(view, 0));
}

int objectPixels(vtkImageData* image)
{
  const auto* pixels = static_cast<unsigned char*>(image->GetScalarPointer());
  return int(std::count(pixels, pixels + image->GetNumberOfPoints(), 255));
}

} // namespace

TEST(VtkSilhouetteExtractor, CutsOutByKey)
{
  vtkNew<vtkSilhouetteExtractor> filter;
  filter->SetInputDataObject(photographs());
  filter->SetKeyChannelToBlue();
  const Listener listener(filter);
  filter->Update();
  EXPECT_TRUE(listener.silent());
  ASSERT_EQ(filter->GetOutput()->GetNumberOfPartitionedDataSets(), 3u);
  EXPECT_STREQ(filter->GetOutput()->GetMetaData(1u)->Get(vtkCompositeDataSet::NAME()), "photo1.png");
  vtkImageData* silhouette = output(filter, 1);
  EXPECT_EQ(silhouette->GetNumberOfScalarComponents(), 1);
  EXPECT_EQ(silhouette->GetScalarType(), VTK_UNSIGNED_CHAR);
  EXPECT_EQ(objectPixels(silhouette), 400);
  EXPECT_EQ(*static_cast<unsigned char*>(silhouette->GetScalarPointer(10, 20, 0)), 255)
      << "rows keep their order";
  EXPECT_EQ(*static_cast<unsigned char*>(silhouette->GetScalarPointer(10, 19, 0)), 0);
  EXPECT_EQ(bytes(silhouette->GetFieldData()->GetArray("Projection")),
            bytes(squareOnBlue()->GetFieldData()->GetArray("Projection")));
}

TEST(VtkSilhouetteExtractor, TakesEverySetting)
{
  vtkNew<vtkSilhouetteExtractor> filter;
  filter->SetInputDataObject(photographs(1));
  const auto count = [&]
  {
    filter->Update();
    return objectPixels(output(filter, 0));
  };
  filter->UseBackgroundColorOn();
  filter->SetBackgroundColor(0.0, 0.0, 200.0 / 255.0);
  EXPECT_EQ(count(), 400);
  filter->SetTolerance(3.0);
  EXPECT_EQ(count(), 0);
  filter->UseBackgroundColorOff();
  filter->UseThresholdOn();
  filter->SetThreshold(0.5);
  EXPECT_EQ(count(), 64 * 48);
  filter->SetThreshold(0.9);
  EXPECT_EQ(count(), 0);
  filter->InvertPolarityOn();
  EXPECT_EQ(count(), 64 * 48);
  filter->InvertPolarityOff();
  filter->UseThresholdOff();
  filter->SetKeyChannelToBlue();
  filter->AddOperation(vtkSilhouetteExtractor::ERODE, 1);
  EXPECT_EQ(count(), 18 * 18);
  filter->AddOperation(vtkSilhouetteExtractor::DILATE, 1);
  EXPECT_EQ(count(), 400);
  EXPECT_EQ(filter->GetNumberOfOperations(), 2);
  filter->ClearOperations();
  filter->AddOperation(vtkSilhouetteExtractor::DILATE, 1);
  EXPECT_EQ(count(), 22 * 22);
  filter->ClearOperations();
  filter->InvertPolarityOn();
  EXPECT_EQ(count(), 64 * 48 - 400);
  filter->SetFillHoles(401);
  EXPECT_EQ(count(), 64 * 48);
}

TEST(VtkSilhouetteExtractor, KeepsMasksAndTheLargestRegion)
{
  auto views = vtkSmartPointer<vtkPartitionedDataSetCollection>::New();
  auto mask = discImage(32, 10.0);
  *static_cast<unsigned char*>(mask->GetScalarPointer(0, 0, 0)) = 255;
  setProjection(mask, ringCamera(0.0, CameraDistance, 32, Focal));
  appendView(views, mask, "mask");
  vtkNew<vtkSilhouetteExtractor> filter;
  filter->SetInputDataObject(views);
  filter->Update();
  const int all = objectPixels(output(filter, 0));
  filter->LargestRegionOn();
  filter->Update();
  EXPECT_EQ(objectPixels(output(filter, 0)), all - 1);
}

TEST(VtkSilhouetteExtractor, IsAProperFilter)
{
  vtkNew<vtkSilhouetteExtractor> filter;
  filter->SetInputDataObject(photographs(20));
  filter->SetKeyChannelToBlue();
  expectPrints(filter, {"KeyChannel", "KeyExcess", "UseBackgroundColor", "BackgroundColor", "Tolerance",
                        "UseThreshold", "Threshold", "UseAlpha", "InvertPolarity", "Operations",
                        "LargestRegion", "FillHoles"});
  expectModifies(filter, [&] { filter->SetKeyExcess(0.1); });
  expectModifies(filter, [&] { filter->AddOperation(vtkSilhouetteExtractor::OPENING, 1); });
  EXPECT_NE(printed(filter).find("Opening 1"), std::string::npos);
  expectModifies(filter, [&] { filter->ClearOperations(); });
  expectModifies(filter, [&] { filter->UseAlphaOn(); });
  filter->UseAlphaOff();
  expectProgress(filter);
  expectAbort(filter, 0.3);
}

TEST(VtkSilhouetteExtractor, SameForAnyNumberOfThreads)
{
  expectSameForThreads(
      []
      {
        vtkNew<vtkSilhouetteExtractor> filter;
        filter->SetInputDataObject(photographs(9));
        filter->SetKeyChannelToBlue();
        filter->AddOperation(vtkSilhouetteExtractor::CLOSING, 3);
        filter->Update();
        std::string all;
        for (unsigned int i = 0; i < 9; ++i)
        {
          all += bytes(output(filter, i)->GetPointData()->GetScalars());
        }
        return all;
      });
}

TEST(VtkSilhouetteExtractor, RefusesWhatIsNoSilhouette)
{
  vtkNew<vtkSilhouetteExtractor> filter;
  auto views = photographs();
  auto grey = plainImage(16, 16, 9);
  setProjection(grey, ringCamera(0.0, CameraDistance, 16, Focal));
  filter->SetInputDataObject(views);
  expectError(filter, {"photo0.png"}); // two colours, neither light
  filter->SetKeyChannelToBlue();
  filter->SetKeyExcess(2.0);
  expectError(filter, {"2"});
  filter->SetKeyExcess(0.1);
  views->SetPartition(1, 0, grey);
  expectError(filter, {"photo1.png"}); // a key on grey
  filter->UseAlphaOn();
  expectError(filter, {"photo0.png", "alpha"});
  filter->UseAlphaOff();
  filter->AddOperation(vtkSilhouetteExtractor::DILATE, -1);
  expectError(filter, {"-1"});
  filter->ClearOperations();
  views->SetPartition(1, 0, nullptr);
  expectError(filter, {"view 1 (photo1.png)", "one vtkImageData is needed"});

  const Listener listener(filter);
  filter->AddOperation(7, 1);
  ASSERT_EQ(listener.Errors.size(), 1u);
  EXPECT_NE(listener.Errors[0].find("operation 7"), std::string::npos);
  EXPECT_EQ(filter->GetNumberOfOperations(), 0);
}
