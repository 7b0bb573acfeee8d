// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSilhouetteOctreeSource.h"

#include "ModelingTesting.h"
#include "vtkPartitionedDataSet.h"

#include "vtkBitArray.h"
#include "vtkCellData.h"
#include "vtkHyperTreeGrid.h"
#include "vtkTypeUInt64Array.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace silhouette::testing;

namespace
{

vtkSmartPointer<vtkSilhouetteOctreeSource> ringSource(int depth = 5)
{
  auto source = vtkSmartPointer<vtkSilhouetteOctreeSource>::New();
  source->SetInputData(ringViews());
  source->SetDepth(depth);
  return source;
}

vtkUnsignedCharArray* states(vtkHyperTreeGrid* grid)
{
  return vtkUnsignedCharArray::SafeDownCast(grid->GetCellData()->GetAbstractArray("State"));
}

vtkUnsignedCharArray* generations(vtkHyperTreeGrid* grid)
{
  return vtkUnsignedCharArray::SafeDownCast(grid->GetCellData()->GetAbstractArray("Generation"));
}

/** Volume of the inside octants, and of inside and last-generation intersection octants together. */
std::array<double, 2> volumes(vtkHyperTreeGrid* grid)
{
  const double root = grid->GetFieldData()->GetArray("RootCube")->GetTuple1(3);
  const int depth = int(field(grid, "Depth"));
  std::array<double, 2> sum{};
  for (vtkIdType i = 0; i < states(grid)->GetNumberOfValues(); ++i)
  {
    const int state = states(grid)->GetValue(i), generation = generations(grid)->GetValue(i);
    const double cell = std::pow(std::ldexp(root, -generation), 3);
    sum[0] += state == 2 ? cell : 0.0;
    sum[1] += state == 2 || (state == 1 && generation == depth) ? cell : 0.0;
  }
  return sum;
}

} // namespace

TEST(VtkSilhouetteOctreeSource, TakesNoToleranceForCleanSilhouettes)
{
  auto source = ringSource();
  source->Update();
  const auto strict = volumes(source->GetOutput());
  EXPECT_TRUE(std::isnan(field(source->GetOutput(), "UncoveredShare"))) << "not measured unless asked for";
  source->AutomaticToleranceOn();
  source->Update();
  EXPECT_EQ(field(source->GetOutput(), "BackgroundVotes"), 0);
  EXPECT_EQ(field(source->GetOutput(), "Dilation"), 0);
  EXPECT_EQ(field(source->GetOutput(), "UncoveredShare"), 0);
  EXPECT_EQ(field(source->GetOutput(), "StrictUncoveredShare"), 0);
  EXPECT_EQ(volumes(source->GetOutput()), strict);
}

TEST(VtkSilhouetteOctreeSource, FindsTheVotesThatOutweighAWrongView)
{
  auto views = ringViews(12);
  auto* image = vtkImageData::SafeDownCast(views->GetPartition(5, 0));
  auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer());
  std::fill_n(pixel, ImageSize * ImageSize / 2, static_cast<unsigned char>(0)); // its lower half
  vtkNew<vtkSilhouetteOctreeSource> source;
  source->SetInputData(views);
  source->SetDepth(5);
  source->AutomaticToleranceOn();
  const Listener listener(source);
  source->Update();
  EXPECT_TRUE(listener.silent());
  EXPECT_EQ(source->GetBackgroundVotes(), 0) << "executing changes no setting";
  EXPECT_EQ(field(source->GetOutput(), "BackgroundVotes"), 1);
  EXPECT_EQ(field(source->GetOutput(), "Dilation"), 0);
  EXPECT_GT(field(source->GetOutput(), "StrictUncoveredShare"), 0.2);
  EXPECT_LE(field(source->GetOutput(), "UncoveredShare"), 0.001);
  expectProgress(source);
  expectAbort(source, 0.3);
  source->SetBackgroundVotes(12);
  expectError(source, {"background votes 12 are outside 0 to 11"});
}

TEST(VtkSilhouetteOctreeSource, CarvesTheViewsOfItsPort)
{
  auto source = ringSource(6);
  const Listener listener(source);
  source->Update();
  EXPECT_TRUE(listener.silent());
  vtkHyperTreeGrid* grid = source->GetOutput();
  const vtkIdType cells = grid->GetNumberOfVertices();
  ASSERT_GT(cells, 0);
  ASSERT_NE(states(grid), nullptr);
  EXPECT_EQ(states(grid)->GetNumberOfValues(), cells);
  EXPECT_EQ(generations(grid)->GetNumberOfValues(), cells);
  auto* codes = vtkTypeUInt64Array::SafeDownCast(grid->GetCellData()->GetAbstractArray("LatticeCode"));
  ASSERT_NE(codes, nullptr);
  EXPECT_EQ(codes->GetNumberOfValues(), cells);
  EXPECT_EQ(grid->GetMaxNumberOfTrees(), 512); // eight a side

  // Background, and nothing else, is masked.
  ASSERT_EQ(grid->GetMask()->GetNumberOfValues(), cells);
  for (vtkIdType i = 0; i < cells; ++i)
  {
    ASSERT_EQ(grid->GetMask()->GetValue(i), states(grid)->GetValue(i) == 0 ? 1 : 0);
  }

  // The sphere lies in the octree, and the hull of a ring of eight is little more.
  const auto volume = volumes(grid);
  const double sphere = 4.0 / 3.0 * 3.14159265358979;
  EXPECT_LT(volume[0], 1.1 * sphere);
  EXPECT_GT(volume[0], 0.7 * sphere);
  EXPECT_GT(volume[1], sphere);
  EXPECT_LT(volume[1], 1.4 * sphere);
}

TEST(VtkSilhouetteOctreeSource, DescribesItselfInFieldData)
{
  auto source = ringSource();
  source->SetBackgroundVotes(1);
  source->SetOutsidePolicyToBackground();
  source->Update();
  vtkHyperTreeGrid* grid = source->GetOutput();
  ASSERT_EQ(field(grid, "Depth"), 5);
  EXPECT_EQ(field(grid, "TreeGeneration"), 3);
  EXPECT_EQ(field(grid, "NumberOfViews"), 8);
  EXPECT_EQ(field(grid, "BackgroundVotes"), 1);
  EXPECT_EQ(field(grid, "OutsidePolicy"), vtkSilhouetteOctreeSource::BACKGROUND);
  EXPECT_GT(field(grid, "OctantsTested"), 512);
  EXPECT_GT(field(grid, "ViewTests"), field(grid, "OctantsTested"));
  EXPECT_EQ(grid->GetFieldData()->GetArray("CarvedByView")->GetNumberOfTuples(), 8);
  EXPECT_EQ(grid->GetFieldData()->GetArray("RootCube")->GetNumberOfTuples(), 4);
  vtkIdType inside = 0, intersection = 0;
  for (vtkIdType i = 0; i < grid->GetNumberOfVertices(); ++i)
  {
    inside += states(grid)->GetValue(i) == 2;
    intersection += states(grid)->GetValue(i) == 1 && generations(grid)->GetValue(i) == 5;
  }
  EXPECT_EQ(field(grid, "InsideOctants"), inside);
  EXPECT_EQ(field(grid, "IntersectionOctants"), intersection);

  vtkPartitionedDataSetCollection* views = source->GetViewsOutput();
  ASSERT_EQ(views->GetNumberOfPartitionedDataSets(), 8u);
  EXPECT_STREQ(views->GetMetaData(3u)->Get(vtkCompositeDataSet::NAME()), "disc3.png");
  EXPECT_EQ(views->GetPartition(3, 0)->GetFieldData()->GetArray("Projection")->GetNumberOfValues(), 12);
}

TEST(VtkSilhouetteOctreeSource, AddedViewsGiveTheSameOctree)
{
  auto fromPort = ringSource();
  fromPort->Update();
  vtkNew<vtkSilhouetteOctreeSource> added;
  added->SetDepth(5);
  auto views = ringViews();
  for (unsigned int i = 0; i < views->GetNumberOfPartitionedDataSets(); ++i)
  {
    vtkImageData* image = vtkImageData::SafeDownCast(views->GetPartition(i, 0));
    added->AddView(image, image->GetFieldData()->GetArray("Projection")->GetTuple(0));
  }
  EXPECT_EQ(added->GetNumberOfAddedViews(), 8);
  added->Update();
  EXPECT_EQ(bytes(states(added->GetOutput())), bytes(states(fromPort->GetOutput())));
  EXPECT_EQ(bytes(added->GetOutput()->GetFieldData()->GetArray("ViewsFingerprint")),
            bytes(fromPort->GetOutput()->GetFieldData()->GetArray("ViewsFingerprint")));
  added->RemoveAllViews();
  EXPECT_EQ(added->GetNumberOfAddedViews(), 0);
}

TEST(VtkSilhouetteOctreeSource, ZeroAndOneIsASilhouette)
{
  auto source = ringSource();
  source->Update();
  const std::string expected = bytes(states(source->GetOutput()));
  auto views = ringViews();
  for (unsigned int i = 0; i < 8; ++i)
  {
    vtkDataArray* scalars = views->GetPartition(i, 0)->GetPointData()->GetScalars();
    for (vtkIdType p = 0; p < scalars->GetNumberOfTuples(); ++p)
    {
      scalars->SetTuple1(p, scalars->GetTuple1(p) > 0.0 ? (i % 2 ? 1.0 : 128.0) : (i % 2 ? 0.0 : 127.0));
    }
  }
  source->SetInputData(views);
  source->Update();
  EXPECT_EQ(bytes(states(source->GetOutput())), expected);
}

TEST(VtkSilhouetteOctreeSource, RowsBeginAtTheBottom)
{
  // The object is in the image's upper half, y downwards in the camera's frame: world z above 0.
  vtkNew<vtkSilhouetteOctreeSource> source;
  auto image = discImage(ImageSize, 20.0);
  auto* pixels = static_cast<unsigned char*>(image->GetScalarPointer());
  std::fill_n(pixels, ImageSize * ImageSize / 2, 0); // VTK's first rows: the bottom
  for (const double angle : {0.0, 1.0, 2.0, 3.0})
  {
    source->AddView(image, ringCamera(angle, CameraDistance, ImageSize, Focal).data());
  }
  source->SetDepth(6);
  source->Update();
  vtkDataArray* root = source->GetOutput()->GetFieldData()->GetArray("RootCube");
  ASSERT_NE(root, nullptr);
  EXPECT_GT(root->GetTuple1(2) + 0.5 * root->GetTuple1(3), 0.15) << "the cube's centre";
}

TEST(VtkSilhouetteOctreeSource, LeafEdgeDecidesTheDepth)
{
  auto source = ringSource();
  source->SetAutomaticBounds(false);
  source->SetBounds(-2.0, 2.0, -2.0, 2.0, -2.0, 2.0);
  source->SetLeafEdge(0.13);
  source->Update();
  EXPECT_EQ(field(source->GetOutput(), "Depth"), 5); // 4 / 2^5 = 0.125
  EXPECT_EQ(source->GetDepth(), 5);
  source->SetLeafEdge(0.12);
  source->Update();
  EXPECT_EQ(field(source->GetOutput(), "Depth"), 6);
  EXPECT_EQ(source->GetDepth(), 5) << "executing changes no parameter";
  source->SetAutomaticBounds(true);
  source->Update();
  const double edge = source->GetOutput()->GetFieldData()->GetArray("RootCube")->GetTuple1(3);
  const double depth = field(source->GetOutput(), "Depth");
  EXPECT_LE(std::ldexp(edge, -int(depth)), 0.12);
  EXPECT_GT(std::ldexp(edge, -int(depth) + 1), 0.12);
}

TEST(VtkSilhouetteOctreeSource, IsAProperFilter)
{
  auto source = ringSource();
  expectPrints(source, {"Depth", "LeafEdge", "AutomaticBounds", "Bounds", "BackgroundVotes", "AutomaticTolerance", "OutsidePolicy",
                        "AddedViews"});
  expectModifies(source, [&] { source->SetDepth(6); });
  expectModifies(source, [&] { source->SetBounds(0, 1, 0, 1, 0, 1); });
  expectModifies(source, [&] { source->SetLeafEdge(1.0); });
  source->SetLeafEdge(0.0);
  auto image = discImage(ImageSize, 30.0);
  const Matrix camera = ringCamera(0.0, CameraDistance, ImageSize, Focal);
  expectModifies(source, [&] { source->AddView(image, camera.data(), "one"); });
  expectModifies(source, [&] { image->Modified(); });
  EXPECT_NE(printed(source).find("view 0 (one)"), std::string::npos);
  expectModifies(source, [&] { source->RemoveAllViews(); });
  expectProgress(source);
  expectAbort(source, 0.1);
  expectAbort(source, 0.6);
  EXPECT_EQ(source->GetViewsOutput()->GetNumberOfPartitionedDataSets(), 8u);
}

TEST(VtkSilhouetteOctreeSource, SameForAnyNumberOfThreads)
{
  expectSameForThreads(
      []
      {
        auto source = ringSource(6);
        source->SetBackgroundVotes(1);
        source->Update();
        vtkCellData* cells = source->GetOutput()->GetCellData();
        return bytes(cells->GetArray("State")) + bytes(cells->GetArray("Generation")) +
               bytes(cells->GetArray("LatticeCode")) +
               bytes(source->GetOutput()->GetFieldData()->GetArray("RootCube"));
      });
}

TEST(VtkSilhouetteOctreeSource, RefusesViewsThatAreNone)
{
  vtkNew<vtkSilhouetteOctreeSource> none;
  expectError(none, {"no views"});

  auto source = ringSource();
  auto views = ringViews();
  source->SetInputData(views);
  auto* image = vtkImageData::SafeDownCast(views->GetPartition(2, 0));
  const Matrix good = ringCamera(0.0, CameraDistance, ImageSize, Focal);

  image->GetFieldData()->RemoveArray("Projection");
  expectError(source, {"view 2 (disc2.png)", "no field array Projection"});
  vtkNew<vtkDoubleArray> eleven;
  eleven->SetName("Projection");
  eleven->SetNumberOfTuples(11);
  image->GetFieldData()->AddArray(eleven);
  expectError(source, {"view 2 (disc2.png)", "11 values", "12 are needed"});
  Matrix bad = good;
  bad[5] = std::numeric_limits<double>::quiet_NaN();
  setProjection(image, bad);
  expectError(source, {"view 2 (disc2.png)", "not finite"});
  bad = good;
  std::copy_n(bad.begin(), 4, bad.begin() + 4);
  setProjection(image, bad);
  expectError(source, {"view 2 (disc2.png)", "rank 2"});
  setProjection(image, good);

  auto colours = plainImage(8, 8, 255, 3);
  setProjection(colours, good);
  views->SetPartition(2, 0, colours);
  expectError(source, {"view 2 (disc2.png)", "3 components", "vtkSilhouetteExtractor"});
  vtkNew<vtkImageData> wide;
  wide->SetDimensions(8, 8, 1);
  wide->AllocateScalars(VTK_UNSIGNED_SHORT, 1);
  setProjection(wide, good);
  views->SetPartition(2, 0, wide);
  expectError(source, {"view 2 (disc2.png)", "unsigned short", "unsigned char is needed"});
  vtkNew<vtkImageData> deep;
  deep->SetDimensions(8, 8, 2);
  deep->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  setProjection(deep, good);
  views->SetPartition(2, 0, deep);
  expectError(source, {"view 2 (disc2.png)", "8 x 8 x 2"});
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(8, 8, 1);
  setProjection(bare, good);
  views->SetPartition(2, 0, bare);
  expectError(source, {"view 2 (disc2.png)", "no scalars"});
  views->SetPartition(2, 0, vtkNew<vtkPolyData>());
  expectError(source, {"view 2 (disc2.png)", "one vtkImageData is needed"});

  vtkNew<vtkSilhouetteOctreeSource> refuses;
  const Listener listener(refuses);
  refuses->AddView(nullptr, good.data());
  ASSERT_EQ(listener.Errors.size(), 1u);
  EXPECT_NE(listener.Errors[0].find("needs an image"), std::string::npos);
}

TEST(VtkSilhouetteOctreeSource, RefusesParametersOutOfRange)
{
  auto source = ringSource();
  source->SetDepth(0);
  expectError(source, {"depth 0", "1 to 16"});
  source->SetDepth(17);
  expectError(source, {"depth 17", "1 to 16"});
  EXPECT_EQ(source->GetDepth(), 17);
  source->SetDepth(4);
  source->SetBackgroundVotes(8);
  expectError(source, {"8", "background votes"});
  source->SetBackgroundVotes(-1);
  expectError(source, {"-1", "background votes"});
  source->SetBackgroundVotes(0);
  source->SetLeafEdge(-1.0);
  expectError(source, {"leaf edge -1"});
  source->SetLeafEdge(1e-9);
  expectError(source, {"depth above 16"});
  source->SetLeafEdge(0.0);
  source->SetAutomaticBounds(false);
  source->SetBounds(-1.0, 1.0, 1.0, -1.0, -1.0, 1.0);
  expectError(source, {"bounds 1 to -1 on axis y"});
  source->SetBounds(-1.0, 1.0, -1.0, 1.0, -1.0, std::numeric_limits<double>::infinity());
  expectError(source, {"axis z"});
}

TEST(VtkSilhouetteOctreeSource, SaysWhyNothingSurvives)
{
  auto source = ringSource();
  auto views = ringViews();
  auto empty = plainImage(ImageSize, ImageSize, 0);
  setProjection(empty, ringCamera(0.3, CameraDistance, ImageSize, Focal));
  views->SetPartition(5, 0, empty);
  source->SetInputData(views);
  expectError(source, {"disc5.png"});
  source->SetAutomaticBounds(false);
  expectError(source, {"disc5.png"});

  vtkNew<vtkSilhouetteOctreeSource> one;
  one->SetDepth(4);
  one->AddView(discImage(ImageSize, 30.0), ringCamera(0.0, CameraDistance, ImageSize, Focal).data(),
               "single");
  expectError(one, {"bound"});
}

TEST(VtkSilhouetteOctreeSource, WarnsAndGoesOn)
{
  const auto warned = [](vtkSilhouetteOctreeSource* source, const std::vector<std::string>& texts)
  {
    const Listener listener(source);
    source->Modified();
    source->Update();
    EXPECT_TRUE(listener.Errors.empty()) << listener.Errors[0];
    EXPECT_GT(source->GetOutput()->GetNumberOfVertices(), 0);
    for (const std::string& text : texts)
    {
      EXPECT_EQ(listener.warnings(text), 1) << text;
    }
    EXPECT_EQ(listener.Warnings.size(), texts.size());
  };
  const Matrix camera = ringCamera(0.3, CameraDistance, ImageSize, Focal);

  auto source = ringSource();
  source->AddView(plainImage(ImageSize, ImageSize, 255), camera.data(), "full.png");
  warned(source, {"view 8 (full.png): the silhouette is all object"});

  source->RemoveAllViews();
  auto touching = discImage(ImageSize, 80.0);
  static_cast<unsigned char*>(touching->GetScalarPointer())[0] = 0;
  auto half = discImage(ImageSize, 44.0);
  std::fill_n(static_cast<unsigned char*>(half->GetScalarPointer(0, ImageSize / 2, 0)), ImageSize, 255);
  source->AddView(half, camera.data(), "cut.png");
  warned(source, {"view 8 (cut.png): the silhouette is cut by the image's border (left, right)"});

  // Many views are warned of in one message, which still names each of them.
  source->RemoveAllViews();
  for (int n = 0; n < 9; ++n)
  {
    source->AddView(plainImage(ImageSize, ImageSize, 255), camera.data(), ("full" + std::to_string(n)).c_str());
  }
  {
    const Listener listener(source);
    source->Modified();
    source->Update();
    ASSERT_EQ(listener.Warnings.size(), 1u);
    EXPECT_EQ(listener.warnings("9 silhouettes are doubtful"), 1);
    for (int n = 0; n < 9; ++n)
    {
      EXPECT_EQ(listener.warnings("(full" + std::to_string(n) + "): the silhouette is all object"), 1);
    }
  }

  source->RemoveAllViews();
  source->SetAutomaticBounds(false);
  source->SetBounds(-1.0, 1.0, -0.5, 0.5, -0.5, 0.5);
  source->SetBounds(-0.7, 0.7, -0.7, 0.7, -0.7, 0.7);
  warned(source, {"cut by the root cube's border"});
  source->SetBounds(-8.0, 8.0, -8.0, 8.0, -8.0, 8.0);
  {
    const Listener listener(source);
    source->Update();
    EXPECT_EQ(listener.warnings("the camera is inside the root cube"), 8);
    EXPECT_EQ(listener.warnings("(disc4.png)"), 1);
  }

  vtkNew<vtkSilhouetteOctreeSource> one;
  one->SetDepth(4);
  one->SetAutomaticBounds(false);
  one->SetBounds(-1.5, 1.5, -1.5, 1.5, -1.5, 1.5);
  one->AddView(discImage(ImageSize, 30.0), camera.data(), "single");
  warned(one, {"only view 0 (single)", "cut by the root cube's border"});
}

TEST(VtkSilhouetteOctreeSource, WarnsOfCamerasThatLookAway)
{
  for (const auto& [count, isBoxGiven] : {std::pair(1, true), std::pair(8, true), std::pair(8, false)})
  {
    auto source = ringSource();
    auto views = ringViews();
    for (int i = 0; i < count; ++i)
    {
      auto* image = vtkImageData::SafeDownCast(views->GetPartition(unsigned(8 - count + i), 0));
      Matrix p;
      image->GetFieldData()->GetArray("Projection")->GetTuple(0, p.data());
      for (double& number : p)
      {
        number = -number;
      }
      setProjection(image, p);
    }
    source->SetInputData(views);
    source->SetAutomaticBounds(!isBoxGiven); // which there are none of where all look away: then the warning says why
    source->SetBounds(-1.5, 1.5, -1.5, 1.5, -1.5, 1.5);
    const Listener listener(source);
    source->Update();
    EXPECT_TRUE(isBoxGiven || !listener.Errors.empty());
    EXPECT_EQ(listener.warnings(std::to_string(count) + " of 8 cameras have behind them what their silhouettes show"), 1);
    EXPECT_EQ(listener.warnings(count == 1 ? "(disc7.png)" : "(disc0.png)"), 1);
  }
}

TEST(VtkSilhouetteOctreeSource, WarnsOfWhatNoToleranceExplains)
{
  auto source = ringSource();
  auto views = ringViews();
  for (const unsigned int i : {2u, 5u}) // discs a third as large as they have to be
  {
    vtkDataObject* before = views->GetPartitionAsDataObject(i, 0);
    auto image = discImage(ImageSize, 12.0);
    image->GetFieldData()->PassData(before->GetFieldData());
    views->GetPartitionedDataSet(i)->SetPartition(0, image);
  }
  source->SetInputData(views);
  source->SetAutomaticTolerance(true);
  const Listener listener(source);
  source->Update();
  EXPECT_TRUE(listener.Errors.empty());
  EXPECT_EQ(listener.warnings("% of the silhouettes uncovered, more than noise does: a camera, or a silhouette"), 1);
  EXPECT_EQ(listener.warnings("is probably wrong; view "), 1);
  EXPECT_EQ(listener.warnings(" has the most uncovered, "), 1);
  EXPECT_EQ(listener.warnings("; view 2 (disc2.png)") + listener.warnings("; view 5 (disc5.png)"), 0) << "they cut, and are covered";
  source->SetInputData(ringViews());
  const Listener silent(source);
  source->Update();
  EXPECT_TRUE(silent.Warnings.empty());
  source->SetAutomaticBounds(false);
  source->SetBounds(-0.2, 0.2, -0.2, 0.2, -0.2, 0.2);
  const Listener boxed(source);
  source->Update();
  EXPECT_EQ(boxed.warnings("more than noise does: a camera, the given box, or a silhouette"), 1);
}

TEST(VtkSilhouetteOctreeSource, WarnsOnceOfProjectiveCaptures)
{
  auto source = ringSource();
  auto views = ringViews();
  for (unsigned int i = 0; i < 8; ++i)
  {
    auto* image = vtkImageData::SafeDownCast(views->GetPartition(i, 0));
    Matrix p;
    image->GetFieldData()->GetArray("Projection")->GetTuple(0, p.data());
    for (const int entry : {1, 5, 9}) // world y reversed: a mirrored camera
    {
      p[entry] = -p[entry];
    }
    setProjection(image, p);
  }
  source->SetInputData(views);
  const Listener listener(source);
  source->Update();
  EXPECT_TRUE(listener.Errors.empty());
  EXPECT_EQ(listener.warnings("mirrored"), 1);
  EXPECT_EQ(listener.Warnings.size(), 1u);
  EXPECT_GT(source->GetOutput()->GetNumberOfVertices(), 0);
}
