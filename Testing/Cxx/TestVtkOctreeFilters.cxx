// SPDX-License-Identifier: BSD-3-Clause
/**
 * Which of VTK's filters for hyper tree grids work on the octree: geometry, cell centers, conversion to an
 * unstructured grid, threshold, contour, axis cut, plane cutter, depth limiter and the XML files, each held
 * against the octree's own numbers.
 */
#include "ModelingTesting.h"
#include "vtkSilhouetteOctreeSource.h"
#include "vtkVotingMarchingCubes.h"

#include "vtkCellData.h"
#include "vtkHyperTreeGrid.h"
#include "vtkHyperTreeGridAxisCut.h"
#include "vtkHyperTreeGridCellCenters.h"
#include "vtkHyperTreeGridContour.h"
#include "vtkHyperTreeGridDepthLimiter.h"
#include "vtkHyperTreeGridGeometry.h"
#include "vtkHyperTreeGridPlaneCutter.h"
#include "vtkHyperTreeGridThreshold.h"
#include "vtkHyperTreeGridToUnstructuredGrid.h"
#include "vtkUnstructuredGrid.h"
#include "vtkXMLHyperTreeGridReader.h"
#include "vtkXMLHyperTreeGridWriter.h"

#include <map>

using namespace silhouette::testing;

namespace
{

constexpr int Depth = 5;

/** The octree of a ring of eight, and counts made from its arrays alone. */
class VtkOctreeFilters : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Source->SetInputData(ringViews());
    this->Source->SetDepth(Depth);
    this->Source->Update();
    this->Grid = this->Source->GetOutput();
    const double edge = this->Grid->GetFieldData()->GetArray("RootCube")->GetTuple1(3);
    this->LeafEdge = std::ldexp(edge, -Depth);
    vtkDataArray* states = this->Grid->GetCellData()->GetArray("State");
    vtkDataArray* generations = this->Grid->GetCellData()->GetArray("Generation");
    for (vtkIdType i = 0; i < states->GetNumberOfTuples(); ++i)
    {
      const int state = int(states->GetTuple1(i)), generation = int(generations->GetTuple1(i));
      const double volume = std::pow(std::ldexp(edge, -generation), 3);
      if (state == 2 || (state == 1 && generation == Depth))
      {
        ++this->Leaves;
        this->Volume += volume;
        this->InsideLeaves += state == 2;
      }
    }
  }

  vtkNew<vtkSilhouetteOctreeSource> Source;
  vtkHyperTreeGrid* Grid = nullptr;
  double LeafEdge = 0.0;
  vtkIdType Leaves = 0; ///< survivors that are not subdivided
  vtkIdType InsideLeaves = 0;
  double Volume = 0.0;
};

double cellVolume(vtkDataSet* data)
{
  double sum = 0.0;
  for (vtkIdType i = 0; i < data->GetNumberOfCells(); ++i)
  {
    double b[6];
    data->GetCellBounds(i, b);
    sum += (b[1] - b[0]) * (b[3] - b[2]) * (b[5] - b[4]);
  }
  return sum;
}

} // namespace

TEST_F(VtkOctreeFilters, ToUnstructuredGridGivesTheSurvivors)
{
  vtkNew<vtkHyperTreeGridToUnstructuredGrid> filter;
  filter->SetInputData(this->Grid);
  filter->Update();
  vtkUnstructuredGrid* cells = filter->GetUnstructuredGridOutput();
  EXPECT_EQ(cells->GetNumberOfCells(), this->Leaves);
  EXPECT_NEAR(cellVolume(cells), this->Volume, 1e-6 * this->Volume);
  // Each cell lies where its lattice code says, to the float precision of VTK's points.
  vtkDataArray* codes = cells->GetCellData()->GetArray("LatticeCode");
  vtkDataArray* generations = cells->GetCellData()->GetArray("Generation");
  vtkDataArray* root = this->Grid->GetFieldData()->GetArray("RootCube");
  ASSERT_NE(codes, nullptr);
  for (vtkIdType i = 0; i < cells->GetNumberOfCells(); ++i)
  {
    double b[6];
    cells->GetCellBounds(i, b);
    const auto code = static_cast<unsigned long long>(codes->GetTuple1(i));
    const int generation = int(generations->GetTuple1(i));
    for (int axis = 0; axis < 3; ++axis)
    {
      int coordinate = 0;
      for (int bit = 0; bit < generation; ++bit)
      {
        coordinate |= int(code >> (3 * bit + axis) & 1) << bit;
      }
      const double edge = std::ldexp(root->GetTuple1(3), -generation);
      ASSERT_NEAR(b[2 * axis], root->GetTuple1(axis) + edge * coordinate, 1e-6);
      ASSERT_NEAR(b[2 * axis + 1] - b[2 * axis], edge, 1e-6);
    }
  }
}

TEST_F(VtkOctreeFilters, CellCentersGivesTheSurvivors)
{
  vtkNew<vtkHyperTreeGridCellCenters> filter;
  filter->SetInputData(this->Grid);
  filter->Update();
  auto* points = vtkPolyData::SafeDownCast(filter->GetOutputDataObject(0));
  EXPECT_EQ(points->GetNumberOfPoints(), this->Leaves);
}

TEST_F(VtkOctreeFilters, GeometryBoundsTheSurvivors)
{
  vtkNew<vtkHyperTreeGridGeometry> filter;
  filter->SetInputData(this->Grid);
  filter->Update();
  vtkPolyData* faces = filter->GetPolyDataOutput();
  ASSERT_GT(faces->GetNumberOfCells(), 0);
  // The faces of the masked octants' border: every point is within a leaf of the sphere's hull.
  for (vtkIdType i = 0; i < faces->GetNumberOfPoints(); ++i)
  {
    double p[3];
    faces->GetPoint(i, p);
    ASSERT_LT(std::hypot(p[0], p[1], p[2]), 1.2 + 2.0 * this->LeafEdge);
  }
}

TEST_F(VtkOctreeFilters, ThresholdPicksStates)
{
  vtkNew<vtkHyperTreeGridThreshold> filter;
  filter->SetInputData(this->Grid);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "State");
  filter->ThresholdBetween(2.0, 2.0);
  vtkNew<vtkHyperTreeGridToUnstructuredGrid> cells;
  cells->SetInputConnection(filter->GetOutputPort());
  cells->Update();
  EXPECT_EQ(cells->GetUnstructuredGridOutput()->GetNumberOfCells(), this->InsideLeaves);
}

TEST_F(VtkOctreeFilters, ContourFindsTheSurface)
{
  vtkNew<vtkHyperTreeGridContour> filter;
  filter->SetInputData(this->Grid);
  filter->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, "State");
  filter->SetValue(0, 1.5);
  filter->Update();
  vtkPolyData* surface = filter->GetPolyDataOutput();
  ASSERT_GT(surface->GetNumberOfCells(), 0);
  for (vtkIdType i = 0; i < surface->GetNumberOfPoints(); ++i)
  {
    double p[3];
    surface->GetPoint(i, p);
    const double radius = std::hypot(p[0], p[1], p[2]);
    ASSERT_GT(radius, 1.0 - 4.0 * this->LeafEdge);
    ASSERT_LT(radius, 1.2 + 2.0 * this->LeafEdge);
  }
}

TEST_F(VtkOctreeFilters, CutsGiveAreas)
{
  vtkNew<vtkHyperTreeGridAxisCut> axis;
  axis->SetInputData(this->Grid);
  axis->SetPlaneNormalAxis(2);
  axis->SetPlanePosition(0.01 * this->LeafEdge);
  axis->Update();
  auto* slice = vtkHyperTreeGrid::SafeDownCast(axis->GetOutputDataObject(0));
  ASSERT_NE(slice, nullptr);
  EXPECT_GT(slice->GetNumberOfLeaves(), 0);

  vtkNew<vtkHyperTreeGridPlaneCutter> plane;
  plane->SetInputData(this->Grid);
  plane->SetPlane(0.0, 0.0, 1.0, 0.01 * this->LeafEdge);
  plane->Update();
  vtkPolyData* cut = plane->GetPolyDataOutput();
  double area = 0.0;
  for (vtkIdType i = 0; i < cut->GetNumberOfCells(); ++i)
  {
    double b[6];
    cut->GetCellBounds(i, b);
    area += (b[1] - b[0]) * (b[3] - b[2]);
  }
  EXPECT_GT(area, 3.14);
  EXPECT_LT(area, 3.14 * 1.5);
}

TEST_F(VtkOctreeFilters, DepthLimiterGivesACoarserTree)
{
  vtkNew<vtkHyperTreeGridDepthLimiter> limiter;
  limiter->SetInputData(this->Grid);
  limiter->SetDepth(1);
  limiter->SetJustCreateNewMask(false);
  limiter->Update();
  auto* coarse = vtkHyperTreeGrid::SafeDownCast(limiter->GetOutputDataObject(0));
  ASSERT_NE(coarse, nullptr);
  EXPECT_GT(coarse->GetNumberOfVertices(), 0);
  EXPECT_LT(coarse->GetNumberOfVertices(), this->Grid->GetNumberOfVertices());
}

TEST_F(VtkOctreeFilters, XmlFilesKeepTheOctantsButNotTheFieldData)
{
  const std::string file = std::string(SILHOUETTE_TEMPORARY_DIR) + "/octree.htg";
  vtkNew<vtkXMLHyperTreeGridWriter> writer;
  writer->SetInputData(this->Grid);
  writer->SetFileName(file.c_str());
  writer->SetDataModeToBinary();
  ASSERT_EQ(writer->Write(), 1);
  vtkNew<vtkXMLHyperTreeGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  auto* grid = vtkHyperTreeGrid::SafeDownCast(reader->GetOutputDataObject(0));
  ASSERT_NE(grid, nullptr);
  vtkNew<vtkHyperTreeGridToUnstructuredGrid> cells;
  cells->SetInputData(grid);
  cells->Update();
  vtkUnstructuredGrid* leaves = cells->GetUnstructuredGridOutput();
  EXPECT_EQ(leaves->GetNumberOfCells(), this->Leaves);
  EXPECT_NEAR(cellVolume(leaves), this->Volume, 1e-6 * this->Volume);
  vtkDataArray* states = leaves->GetCellData()->GetArray("State");
  ASSERT_NE(states, nullptr);
  vtkIdType inside = 0;
  for (vtkIdType i = 0; i < states->GetNumberOfTuples(); ++i)
  {
    inside += states->GetTuple1(i) == 2.0;
  }
  EXPECT_EQ(inside, this->InsideLeaves);

  // Without field data the surface filters say so.
  vtkNew<vtkVotingMarchingCubes> surface;
  surface->SetInputDataObject(0, grid);
  surface->SetViewsConnection(this->Source->GetOutputPort(1));
  expectError(surface, {"the octree has no field array"});
}

TEST_F(VtkOctreeFilters, TheOrderOfTheCellsDoesNotMatter)
{
  vtkNew<vtkVotingMarchingCubes> surface;
  surface->SetInputConnection(0, this->Source->GetOutputPort(0));
  surface->SetViewsConnection(this->Source->GetOutputPort(1));
  surface->Update();
  const std::string expected = bytes(surface->GetOutput()->GetPoints()->GetData());

  vtkNew<vtkHyperTreeGrid> shuffled;
  shuffled->DeepCopy(this->Grid);
  vtkCellData* cells = shuffled->GetCellData();
  const vtkIdType count = shuffled->GetNumberOfVertices();
  for (const char* name : {"State", "Generation", "LatticeCode"})
  {
    vtkDataArray* array = cells->GetArray(name);
    for (vtkIdType i = 0; i < count / 2; ++i)
    {
      auto copy = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
      copy->InsertNextTuple(i, array);
      array->SetTuple(i, count - 1 - i, array);
      array->SetTuple(count - 1 - i, 0, copy);
    }
  }
  surface->SetInputDataObject(0, shuffled);
  surface->Update();
  EXPECT_EQ(bytes(surface->GetOutput()->GetPoints()->GetData()), expected);

  // Octants that are missing are noticed, and so are others.
  vtkDataArray* states = cells->GetArray("State");
  vtkDataArray* generations = cells->GetArray("Generation");
  vtkIdType parent = 0;
  while (!(states->GetTuple1(parent) == 0.0 && generations->GetTuple1(parent) == Depth - 1))
  {
    ++parent;
  }
  states->SetTuple1(parent, 1.0);
  expectError(surface, {"the octree is incomplete", "generation 5"});
  states->SetTuple1(parent, 9.0);
  expectError(surface, {"state 9"});
}
