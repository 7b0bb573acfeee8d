// SPDX-License-Identifier: BSD-3-Clause
#include "vtkVotingMarchingCubes.h"

#include "ModelingTesting.h"
#include "vtkSilhouetteOctreeSource.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkFeatureEdges.h"
#include "vtkHyperTreeGrid.h"
#include "vtkPartitionedDataSet.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"

#include <limits>
#include <utility>

using namespace silhouette::testing;

namespace
{

/** Octree of a ring of eight, and its surface. */
struct Pipeline
{
  vtkNew<vtkSilhouetteOctreeSource> octree;
  vtkNew<vtkVotingMarchingCubes> surface;

  explicit Pipeline(int depth = 5)
  {
    this->octree->SetInputData(ringViews());
    this->octree->SetDepth(depth);
    this->surface->SetInputConnection(0, this->octree->GetOutputPort(0));
    this->surface->SetViewsConnection(this->octree->GetOutputPort(1));
  }
};

vtkIdType openEdges(vtkPolyData* surface)
{
  vtkNew<vtkFeatureEdges> edges;
  edges->SetInputData(surface);
  edges->BoundaryEdgesOn();
  edges->NonManifoldEdgesOn();
  edges->FeatureEdgesOff();
  edges->ManifoldEdgesOff();
  edges->Update();
  return edges->GetOutput()->GetNumberOfCells();
}

} // namespace

TEST(VtkVotingMarchingCubes, ContoursAClosedSurface)
{
  Pipeline pipeline(6);
  const Listener listener(pipeline.surface);
  pipeline.surface->Update();
  EXPECT_TRUE(listener.silent());
  vtkPolyData* surface = pipeline.surface->GetOutput();
  ASSERT_GT(surface->GetNumberOfPolys(), 0);
  EXPECT_EQ(openEdges(surface), 0);
  const double sphere = 4.0 / 3.0 * 3.14159265358979;
  EXPECT_GT(volume(surface), 0.97 * sphere);
  EXPECT_LT(volume(surface), 1.15 * sphere);

  EXPECT_EQ(surface->GetPoints()->GetDataType(), VTK_DOUBLE);
  auto* votes = vtkUnsignedShortArray::SafeDownCast(surface->GetPointData()->GetArray("InsideVotes"));
  ASSERT_NE(votes, nullptr);
  EXPECT_EQ(votes->GetNumberOfComponents(), 2);
  EXPECT_EQ(votes->GetNumberOfTuples(), surface->GetNumberOfPoints());
  for (vtkIdType i = 0; i < votes->GetNumberOfTuples(); ++i)
  {
    ASSERT_EQ(votes->GetTypedComponent(i, 0), 8);
    ASSERT_LT(votes->GetTypedComponent(i, 1), 8);
  }
  EXPECT_EQ(field(surface, "Vertices"), surface->GetNumberOfPoints());
  EXPECT_EQ(field(surface, "Faces"), surface->GetNumberOfPolys());
  EXPECT_EQ(field(surface, "IntersectionOctants"),
            field(pipeline.octree->GetOutput(), "IntersectionOctants"));
  EXPECT_GE(field(surface, "LostNoCorner"), 0);
  EXPECT_GE(field(surface, "LostAllCorners"), 0);
}

TEST(VtkVotingMarchingCubes, PlacesGivesNormalsAndPrecision)
{
  Pipeline pipeline;
  pipeline.surface->SetEdgePlacementToMiddle();
  pipeline.surface->GenerateNormalsOn();
  pipeline.surface->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  pipeline.surface->Update();
  vtkPolyData* surface = pipeline.surface->GetOutput();
  EXPECT_EQ(surface->GetPoints()->GetDataType(), VTK_FLOAT);
  vtkDataArray* normals = surface->GetPointData()->GetNormals();
  ASSERT_NE(normals, nullptr);
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    double p[3], n[3];
    surface->GetPoint(i, p);
    normals->GetTuple(i, n);
    ASSERT_NEAR(std::hypot(n[0], n[1], n[2]), 1.0, 1e-5);
    ASSERT_GT(p[0] * n[0] + p[1] * n[1] + p[2] * n[2], 0.0) << "outwards";
  }
  pipeline.surface->SetOutputPointsPrecision(vtkAlgorithm::DEFAULT_PRECISION);
  pipeline.surface->Update();
  EXPECT_EQ(surface->GetPoints()->GetDataType(), VTK_DOUBLE);
}

TEST(VtkVotingMarchingCubes, VotesInBothModes)
{
  Pipeline pipeline;
  pipeline.octree->SetBackgroundVotes(2);
  pipeline.surface->SetShare(0.75);
  pipeline.surface->Update();
  EXPECT_EQ(openEdges(pipeline.surface->GetOutput()), 0);
  const double voted = volume(pipeline.surface->GetOutput());

  pipeline.octree->SetBackgroundVotes(0);
  expectError(pipeline.surface, {"0 background votes", "needs exactly 2"});
  pipeline.surface->SetModeToFaithful();
  pipeline.surface->Update();
  EXPECT_GT(openEdges(pipeline.surface->GetOutput()), 0) << "the faithful mode opens below share 1";

  pipeline.surface->SetShare(1.0);
  pipeline.surface->Update();
  EXPECT_EQ(openEdges(pipeline.surface->GetOutput()), 0);
  EXPECT_LT(volume(pipeline.surface->GetOutput()), voted);
}

TEST(VtkVotingMarchingCubes, IsAProperFilter)
{
  Pipeline pipeline;
  vtkVotingMarchingCubes* filter = pipeline.surface;
  expectPrints(filter, {"Share", "EdgePlacement", "Mode", "GenerateNormals", "OutputPointsPrecision"});
  expectModifies(filter, [&] { filter->SetShare(0.5); });
  expectModifies(filter, [&] { filter->SetModeToFaithful(); });
  expectModifies(filter, [&] { filter->SetEdgePlacementToMiddle(); });
  expectModifies(filter, [&] { filter->SetEdgePlacementToSubPixel(); });
  EXPECT_NE(printed(filter).find("EdgePlacement: SubPixel"), std::string::npos);
  expectModifies(filter, [&] { filter->SetOutputPointsPrecision(0); });
  filter->SetShare(1.0);
  expectProgress(filter);
  expectAbort(filter, 0.03);
  expectAbort(filter, 0.5);
}

TEST(VtkVotingMarchingCubes, SameForAnyNumberOfThreads)
{
  expectSameForThreads(
      []
      {
        Pipeline pipeline(6);
        pipeline.surface->GenerateNormalsOn();
        pipeline.surface->Update();
        vtkPolyData* surface = pipeline.surface->GetOutput();
        return bytes(surface->GetPoints()->GetData()) + bytes(surface->GetPolys()->GetConnectivityArray()) +
               bytes(surface->GetPointData()->GetArray("InsideVotes")) +
               bytes(surface->GetPointData()->GetNormals());
      });
}

TEST(VtkVotingMarchingCubes, PreparesViewsThatCameAnotherWay)
{
  Pipeline pipeline;
  pipeline.surface->Update();
  const std::string expected = bytes(pipeline.surface->GetOutput()->GetPoints()->GetData());
  vtkNew<vtkPartitionedDataSetCollection> copy;
  copy->DeepCopy(pipeline.octree->GetViewsOutput());
  pipeline.surface->SetViewsData(copy);
  pipeline.surface->Update();
  EXPECT_EQ(bytes(pipeline.surface->GetOutput()->GetPoints()->GetData()), expected);

  // Prepared views are taken as they are; an image that says that it changed is looked at again.
  vtkNew<vtkVotingMarchingCubes> other;
  other->SetInputDataObject(0, pipeline.octree->GetOutput());
  other->SetViewsData(pipeline.octree->GetViewsOutput());
  auto* image = vtkImageData::SafeDownCast(pipeline.octree->GetViewsOutput()->GetPartition(0, 0));
  std::fill_n(static_cast<unsigned char*>(image->GetScalarPointer()), ImageSize * ImageSize, 255);
  other->Update();
  EXPECT_EQ(bytes(other->GetOutput()->GetPoints()->GetData()), expected);
  image->Modified();
  expectError(other, {"carved from other views"});
}

TEST(VtkVotingMarchingCubes, LooksAtImagesThatOthersWerePutInPlaceOf)
{
  // Made before the views were prepared, so that none of them says that it changed since.
  const double radius = 0.5 * Focal / std::sqrt(CameraDistance * CameraDistance - 1.0);
  auto smaller = discImage(ImageSize, radius);
  Pipeline pipeline;
  pipeline.octree->Update();
  vtkPartitionedDataSetCollection* views = pipeline.octree->GetViewsOutput();
  vtkNew<vtkVotingMarchingCubes> other;
  other->SetInputDataObject(0, pipeline.octree->GetOutput());
  other->SetViewsData(views);
  other->Update();
  EXPECT_GT(other->GetOutput()->GetNumberOfPolys(), 0);

  vtkSmartPointer<vtkDataObject> first = views->GetPartitionAsDataObject(0, 0);
  smaller->GetFieldData()->PassData(first->GetFieldData());
  views->GetPartitionedDataSet(0)->SetPartition(0, smaller);
  other->Modified();
  expectError(other, {"carved from other views"});

  // The same images in another order.
  vtkSmartPointer<vtkDataObject> second = views->GetPartitionAsDataObject(1, 0);
  views->GetPartitionedDataSet(0)->SetPartition(0, second);
  views->GetPartitionedDataSet(1)->SetPartition(0, first);
  other->Modified();
  expectError(other, {"carved from other views"});
  views->GetPartitionedDataSet(0)->SetPartition(0, first);
  views->GetPartitionedDataSet(1)->SetPartition(0, second);
  other->Modified();
  other->Update();
  EXPECT_GT(other->GetOutput()->GetNumberOfPolys(), 0);
}

/** The octree that travels with the grid, and the one that is read from its arrays: the same surface. */
TEST(VtkVotingMarchingCubes, ReadsAGridThatWasCopiedOrChanged)
{
  Pipeline pipeline;
  pipeline.surface->Update();
  vtkPolyData* first = pipeline.surface->GetOutput();
  const std::string expected =
      bytes(first->GetPoints()->GetData()) + bytes(first->GetPointData()->GetArray("InsideVotes"));
  const double octants = field(first, "IntersectionOctants");

  vtkHyperTreeGrid* grid = pipeline.octree->GetOutput();
  vtkNew<vtkHyperTreeGrid> copy;
  copy->DeepCopy(grid);
  vtkNew<vtkVotingMarchingCubes> other;
  other->SetInputDataObject(0, copy);
  other->SetViewsData(pipeline.octree->GetViewsOutput());
  other->Update();
  vtkPolyData* surface = other->GetOutput();
  EXPECT_EQ(bytes(surface->GetPoints()->GetData()) + bytes(surface->GetPointData()->GetArray("InsideVotes")),
            expected);

  // One octant of the last generation less: whoever says that the grid changed is believed.
  auto* states = vtkUnsignedCharArray::SafeDownCast(grid->GetCellData()->GetArray("State"));
  auto* generations = vtkUnsignedCharArray::SafeDownCast(grid->GetCellData()->GetArray("Generation"));
  vtkIdType cell = 0;
  while (generations->GetValue(cell) != 5 || states->GetValue(cell) != 1)
  {
    ++cell;
  }
  states->SetValue(cell, 0);
  states->Modified();
  other->SetInputDataObject(0, grid);
  other->Update();
  EXPECT_EQ(field(other->GetOutput(), "IntersectionOctants"), octants - 1);
}

TEST(VtkVotingMarchingCubes, RefusesWhatDoesNotBelongTogether)
{
  Pipeline pipeline;
  pipeline.surface->SetViewsData(ringViews(7));
  expectError(pipeline.surface, {"carved from other views"});
  pipeline.surface->SetViewsData(vtkNew<vtkPartitionedDataSetCollection>());
  expectError(pipeline.surface, {"no views"});
  pipeline.surface->SetViewsConnection(pipeline.octree->GetOutputPort(1));
  pipeline.surface->SetShare(0.0);
  expectError(pipeline.surface, {"vote share 0: above 0 and at most 1 is needed"});
  pipeline.surface->SetShare(1.5);
  expectError(pipeline.surface, {"vote share 1.5: above 0 and at most 1 is needed"});
  pipeline.surface->SetShare(1.0);

  pipeline.octree->Update();
  vtkNew<vtkHyperTreeGrid> nameless;
  nameless->DeepCopy(pipeline.octree->GetOutput());
  nameless->SetFieldData(vtkNew<vtkFieldData>());
  pipeline.surface->SetInputDataObject(0, nameless);
  expectError(pipeline.surface, {"the octree has no field array"});
  const double infinite = std::numeric_limits<double>::infinity();
  for (const auto& [component, value] : {std::pair(3, 0.0), {3, -1.0}, {3, std::nan("")}, {3, infinite}, {0, infinite}, {2, std::nan("")}})
  {
    vtkNew<vtkHyperTreeGrid> shapeless;
    shapeless->DeepCopy(pipeline.octree->GetOutput());
    shapeless->GetFieldData()->GetArray("RootCube")->SetComponent(0, component, value);
    pipeline.surface->SetInputDataObject(0, shapeless);
    expectError(pipeline.surface, {"the octree's field array RootCube holds", "an edge above 0"});
  }
  vtkNew<vtkHyperTreeGrid> hopeless;
  hopeless->DeepCopy(pipeline.octree->GetOutput());
  hopeless->GetFieldData()->GetArray("BackgroundVotes")->SetComponent(0, 0, 8);
  pipeline.surface->SetInputDataObject(0, hopeless);
  expectError(pipeline.surface, {"BackgroundVotes holds 8", "0 to 7 is possible"});

  // Float cannot tell the points of a small object far away apart.
  Pipeline far;
  auto views = vtkSmartPointer<vtkPartitionedDataSetCollection>::New();
  for (unsigned int i = 0; i < 8; ++i)
  {
    auto image = discImage(ImageSize, 36.0);
    Matrix p = ringCamera(0.7854 * i, CameraDistance, ImageSize, Focal);
    for (int row = 0; row < 3; ++row)
    {
      p[4 * row + 3] -= 1e5 * (p[4 * row] + p[4 * row + 1] + p[4 * row + 2]);
    }
    setProjection(image, p);
    appendView(views, image, "far");
  }
  far.octree->SetInputData(views);
  far.surface->SetOutputPointsPrecision(vtkAlgorithm::SINGLE_PRECISION);
  expectError(far.surface, {"single precision is too coarse"});
  far.surface->SetOutputPointsPrecision(vtkAlgorithm::DOUBLE_PRECISION);
  far.surface->Update();
  EXPECT_GT(far.surface->GetOutput()->GetNumberOfPolys(), 0);
}

TEST(VtkVotingMarchingCubes, EmptyOctreeGivesAnEmptySurfaceSilently)
{
  vtkNew<vtkVotingMarchingCubes> filter;
  filter->SetInputDataObject(0, vtkNew<vtkHyperTreeGrid>());
  filter->SetViewsData(vtkNew<vtkPartitionedDataSetCollection>());
  const Listener listener(filter);
  filter->Update();
  EXPECT_TRUE(listener.silent());
  EXPECT_EQ(filter->GetOutput()->GetNumberOfPoints(), 0);
}
