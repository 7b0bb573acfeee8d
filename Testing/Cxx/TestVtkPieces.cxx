// SPDX-License-Identifier: BSD-3-Clause
/**
 * Piece requests: pieces of a pipeline, one after another, add up to the whole, and what comes before the octree runs
 * once for all of them.
 */
#include "ModelingTesting.h"
#include "vtkLocalHullSurfacer.h"
#include "vtkSilhouetteCaptureReader.h"
#include "vtkSilhouetteEvaluator.h"
#include "vtkSilhouetteExtractor.h"
#include "vtkSilhouetteOctreeSource.h"
#include "vtkVotingMarchingCubes.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDummyController.h"
#include "vtkHyperTreeGrid.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"

#include <limits>
#include <map>
#include <set>

using namespace silhouette::testing;

namespace
{

struct Pipeline
{
  vtkNew<vtkSilhouetteExtractor> extractor;
  vtkNew<vtkSilhouetteOctreeSource> octree;
  vtkNew<vtkVotingMarchingCubes> cubes;
  vtkNew<vtkLocalHullSurfacer> hulls;
  vtkNew<vtkSilhouetteEvaluator> evaluator;

  Pipeline()
  {
    this->extractor->SetInputDataObject(ringViews());
    this->extractor->SetUseThreshold(true);
    this->extractor->SetThreshold(0.5);
    this->octree->SetInputConnection(this->extractor->GetOutputPort());
    this->octree->SetDepth(6);
    this->cubes->SetInputConnection(0, this->octree->GetOutputPort(0));
    this->cubes->SetViewsConnection(this->octree->GetOutputPort(1));
    this->hulls->SetInputConnection(0, this->cubes->GetOutputPort());
    this->hulls->SetOctreeConnection(this->octree->GetOutputPort(0));
    this->hulls->SetViewsConnection(this->octree->GetOutputPort(1));
    this->evaluator->SetInputConnection(0, this->hulls->GetOutputPort());
    this->evaluator->SetViewsConnection(this->octree->GetOutputPort(1));
    this->evaluator->SetOctreeConnection(this->octree->GetOutputPort(0));
  }
};

using Point = std::array<double, 3>;
using Corners = std::array<Point, 3>;

/** The triangles by their corners' coordinates, in order: what is left of a surface when coincident points are one. */
std::vector<Corners> triangles(vtkPolyData* surface)
{
  std::vector<Corners> all;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    surface->GetCellPoints(cell, ids);
    Corners corners;
    for (int n = 0; n < 3; ++n)
    {
      surface->GetPoint(ids->GetId(n), corners[std::size_t(n)].data());
    }
    all.push_back(corners);
  }
  return all;
}

/** The surface's points with their votes. */
std::map<Point, std::array<double, 2>> votes(vtkPolyData* surface)
{
  std::map<Point, std::array<double, 2>> all;
  vtkDataArray* array = surface->GetPointData()->GetArray("InsideVotes");
  for (vtkIdType p = 0; p < surface->GetNumberOfPoints(); ++p)
  {
    Point at;
    surface->GetPoint(p, at.data());
    all[at] = {array->GetComponent(p, 0), array->GetComponent(p, 1)};
  }
  return all;
}

int countRuns(vtkAlgorithm* filter, vtkCallbackCommand* command, int& count)
{
  command->SetClientData(&count);
  command->SetCallback([](vtkObject*, unsigned long, void* runs, void*) { ++*static_cast<int*>(runs); });
  return int(filter->AddObserver(vtkCommand::StartEvent, command));
}

/** UpdatePiece() of any output; -1: of all. */
void updatePiece(vtkAlgorithm* filter, int port, int piece, int count)
{
  vtkNew<vtkInformationVector> requests;
  requests->SetNumberOfInformationObjects(filter->GetNumberOfOutputPorts());
  for (int each = 0; each < filter->GetNumberOfOutputPorts(); ++each)
  {
    if (port < 0 || each == port)
    {
      vtkInformation* request = requests->GetInformationObject(each);
      request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), piece);
      request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), count);
      request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    }
  }
  filter->Update(port, requests);
}

/** The piece that is nothing of anything (PieceRequests.h). */
constexpr int NothingOf = std::numeric_limits<int>::max();

} // namespace

class VtkPiecesByEdges : public testing::TestWithParam<int>
{
};

INSTANTIATE_TEST_SUITE_P(Edges, VtkPiecesByEdges,
                         testing::Values(int(vtkVotingMarchingCubes::EXACT), int(vtkVotingMarchingCubes::SUB_PIXEL)));

TEST_P(VtkPiecesByEdges, OfTheOctreeAndTheVotingSurfaceAddUp)
{
  Pipeline whole;
  whole.cubes->SetEdgePlacement(this->GetParam());
  whole.cubes->Update();
  const auto expected = triangles(whole.cubes->GetOutput());
  const auto expectedVotes = votes(whole.cubes->GetOutput());
  ASSERT_GT(expected.size(), 1000u);
  for (const int count : {1, 2, 3, 8})
  {
    Pipeline parts;
    parts.cubes->SetEdgePlacement(this->GetParam());
    int runs = 0;
    vtkNew<vtkCallbackCommand> command;
    countRuns(parts.extractor, command, runs);
    const Listener octreeListener(parts.octree), cubesListener(parts.cubes);
    std::vector<Corners> found;
    std::map<Point, std::array<double, 2>> foundVotes;
    double tested = 0.0, intersections = 0.0, lost = 0.0, carved = 0.0;
    int filled = 0;
    for (int piece = 0; piece < count; ++piece)
    {
      parts.cubes->UpdatePiece(piece, count, 0);
      vtkPolyData* surface = parts.cubes->GetOutput();
      const auto some = triangles(surface);
      found.insert(found.end(), some.begin(), some.end());
      vtkHyperTreeGrid* octree = parts.octree->GetOutput();
      EXPECT_EQ(field(octree, "Piece"), piece);
      EXPECT_EQ(field(octree, "NumberOfPieces"), count);
      tested += field(octree, "OctantsTested");
      carved += octree->GetFieldData()->GetArray("CarvedByView")->GetTuple1(3);
      if (surface->GetNumberOfPoints() > 0)
      {
        const auto someVotes = votes(surface);
        foundVotes.insert(someVotes.begin(), someVotes.end());
        intersections += field(surface, "IntersectionOctants");
        lost += field(surface, "LostNoCorner");
        ++filled;
      }
    }
    EXPECT_TRUE(octreeListener.silent() && cubesListener.silent()) << count;
    EXPECT_EQ(filled, count) << "the work is divided";
    EXPECT_EQ(found, expected) << count << " pieces";
    EXPECT_EQ(foundVotes, expectedVotes);
    EXPECT_EQ(intersections, field(whole.cubes->GetOutput(), "IntersectionOctants"));
    EXPECT_EQ(lost, field(whole.cubes->GetOutput(), "LostNoCorner"));
    vtkHyperTreeGrid* octree = whole.octree->GetOutput();
    EXPECT_EQ(tested, field(octree, "OctantsTested"));
    EXPECT_NEAR(carved, octree->GetFieldData()->GetArray("CarvedByView")->GetTuple1(3), 1e-12);
    EXPECT_EQ(runs, 1) << "the silhouettes are found once for all pieces";
  }
}

TEST(VtkPieces, MoreThanThereAreTreesAddUpToo)
{
  Pipeline whole;
  whole.octree->SetDepth(2);
  whole.cubes->Update();
  const auto expected = triangles(whole.cubes->GetOutput());
  ASSERT_GE(expected.size(), 8u);
  Pipeline parts;
  parts.octree->SetDepth(2);
  std::vector<Corners> found;
  double tested = 0.0;
  for (int piece = 0; piece < 12; ++piece)
  {
    parts.cubes->UpdatePiece(piece, 12, 0);
    const auto some = triangles(parts.cubes->GetOutput());
    found.insert(found.end(), some.begin(), some.end());
    tested += field(parts.octree->GetOutput(), "OctantsTested");
  }
  EXPECT_EQ(found, expected);
  EXPECT_EQ(tested, field(whole.octree->GetOutput(), "OctantsTested"));
}

TEST(VtkPieces, OfTheLocalHullSurfaceAddUp)
{
  Pipeline whole;
  whole.hulls->Update();
  whole.hulls->Update(1);
  const auto expected = triangles(whole.hulls->GetOutput());
  const auto expectedHulls = triangles(vtkPolyData::SafeDownCast(whole.hulls->GetOutputDataObject(1)));
  ASSERT_GT(expected.size(), 1000u);
  ASSERT_GT(expectedHulls.size(), 10u);
  for (const int count : {2, 3})
  {
    Pipeline parts;
    std::vector<Corners> found, foundHulls;
    std::set<int> ids;
    for (int piece = 0; piece < count; ++piece)
    {
      parts.hulls->UpdatePiece(piece, count, 0);
      const auto some = triangles(parts.hulls->GetOutput());
      found.insert(found.end(), some.begin(), some.end());
      EXPECT_LT(some.size(), expected.size()) << "a piece is not the whole";
    }
    EXPECT_EQ(found, expected) << count << " pieces";
    for (int piece = 0; piece < count; ++piece)
    {
      updatePiece(parts.hulls, 1, piece, count);
      auto* hulls = vtkPolyData::SafeDownCast(parts.hulls->GetOutputDataObject(1));
      const auto some = triangles(hulls);
      foundHulls.insert(foundHulls.end(), some.begin(), some.end());
    }
    EXPECT_EQ(foundHulls, expectedHulls) << count << " pieces";
  }
}

TEST(VtkPieces, OfTheEvaluationTheFirstHasAll)
{
  Pipeline whole, parts;
  whole.evaluator->Update();
  ASSERT_GT(whole.evaluator->GetOutput()->GetNumberOfRows(), 0);
  parts.evaluator->UpdatePiece(0, 2, 0);
  EXPECT_EQ(parts.evaluator->GetOutput()->GetNumberOfRows(), whole.evaluator->GetOutput()->GetNumberOfRows());
  for (const char* name : {"Triangles", "LostSurface", "MeanIoU"})
  {
    EXPECT_EQ(field(parts.evaluator->GetOutput(), name), field(whole.evaluator->GetOutput(), name)) << name;
  }
  parts.evaluator->UpdatePiece(1, 2, 0);
  EXPECT_EQ(parts.evaluator->GetOutput()->GetNumberOfRows(), 0);
  EXPECT_EQ(elements(parts.hulls->GetOutput()), 0) << "the others ask for nothing";
}

TEST(VtkPieces, OfOneOutputLeaveAnotherPieceOfTheOtherAlone)
{
  Pipeline parts;
  parts.cubes->UpdatePiece(1, 2, 0);
  const double octants = field(parts.octree->GetOutput(), "IntersectionOctants");
  for (const int count : {1, 3, NothingOf})
  {
    updatePiece(parts.octree, 1, count == 1 ? 0 : 1, count);
    EXPECT_EQ(elements(parts.octree->GetOutputDataObject(1)), count == NothingOf ? 0 : 8);
    parts.octree->UpdatePiece(1, 2, 0);
    EXPECT_EQ(field(parts.octree->GetOutput(), "NumberOfPieces"), 2) << count;
    EXPECT_EQ(field(parts.octree->GetOutput(), "IntersectionOctants"), octants) << count;
  }
}

TEST(VtkPieces, OfBothOutputsAreMadeOnceForWhoAsksForTheOtherLater)
{
  Pipeline parts;
  int runs = 0;
  vtkNew<vtkCallbackCommand> command;
  countRuns(parts.octree, command, runs);
  for (int piece = 0; piece < 3; ++piece)
  {
    updatePiece(parts.octree, -1, piece, 3);
    parts.cubes->UpdatePiece(piece, 3, 0);
    EXPECT_EQ(runs, piece + 1);
    EXPECT_EQ(field(parts.octree->GetOutput(), "Piece"), piece);
  }
}

TEST(VtkPieces, OfNothingReadAndMakeNothing)
{
  Pipeline parts;
  int runs = 0;
  vtkNew<vtkCallbackCommand> command;
  countRuns(parts.octree, command, runs);
  const Listener extractor(parts.extractor), octree(parts.octree), cubes(parts.cubes), hulls(parts.hulls);
  for (const int port : {0, 1})
  {
    updatePiece(parts.hulls, port, 1, NothingOf);
    EXPECT_EQ(elements(parts.hulls->GetOutputDataObject(port)), 0);
  }
  EXPECT_EQ(elements(parts.cubes->GetOutput()), 0);
  EXPECT_EQ(elements(parts.octree->GetOutputDataObject(0)), 0);
  EXPECT_EQ(elements(parts.octree->GetOutputDataObject(1)), 0);
  EXPECT_EQ(elements(parts.extractor->GetOutputDataObject(0)), 0);
  EXPECT_EQ(runs, 1);
  EXPECT_TRUE(extractor.silent() && octree.silent() && cubes.silent() && hulls.silent());

  // Afterwards everything is there for those who ask for something.
  Pipeline whole;
  whole.hulls->Update();
  parts.hulls->UpdatePiece(0, 1, 0);
  EXPECT_EQ(triangles(parts.hulls->GetOutput()), triangles(whole.hulls->GetOutput()));
}

TEST(VtkPieces, OfNothingKeepTheViewsThatAreThere)
{
  Pipeline parts;
  int runs = 0;
  vtkNew<vtkCallbackCommand> command;
  countRuns(parts.extractor, command, runs);
  parts.cubes->UpdatePiece(1, 2, 0);
  const auto before = triangles(parts.cubes->GetOutput());
  parts.hulls->UpdatePiece(1, NothingOf, 0);
  parts.cubes->UpdatePiece(1, 2, 0);
  EXPECT_EQ(triangles(parts.cubes->GetOutput()), before);
  EXPECT_EQ(runs, 1) << "the silhouettes are found once";
}

TEST(VtkPieces, OfNothingOpenNoFile)
{
  vtkNew<vtkSilhouetteCaptureReader> reader;
  reader->SetFileName("no such capture");
  const Listener listener(reader);
  reader->UpdatePiece(1, NothingOf, 0);
  EXPECT_TRUE(listener.silent());
  reader->UpdatePiece(1, 2, 0);
  EXPECT_EQ(listener.Errors.size(), 1u);
}

TEST(VtkPieces, WithoutOtherProcessesAreMadeAlone)
{
  Pipeline whole, alone, single;
  EXPECT_EQ(whole.hulls->GetController(), vtkMultiProcessController::GetGlobalController());
  alone.hulls->SetController(nullptr);
  vtkNew<vtkDummyController> controller;
  expectModifies(single.hulls, [&] { single.hulls->SetController(controller); });
  EXPECT_EQ(single.hulls->GetController(), controller);
  whole.hulls->Update();
  const auto expected = triangles(whole.hulls->GetOutput());
  for (Pipeline* one : {&alone, &single})
  {
    std::vector<Corners> found;
    for (int piece = 0; piece < 2; ++piece)
    {
      one->hulls->UpdatePiece(piece, 2, 0);
      const auto some = triangles(one->hulls->GetOutput());
      found.insert(found.end(), some.begin(), some.end());
    }
    EXPECT_EQ(found, expected);
    one->hulls->UpdatePiece(0, 1, 0);
    EXPECT_EQ(triangles(one->hulls->GetOutput()), expected);
  }
}

TEST(VtkPieces, WithAutomaticToleranceAddUpToo)
{
  Pipeline whole;
  whole.octree->AutomaticToleranceOn();
  whole.octree->Update();
  const double octants = field(whole.octree->GetOutput(), "IntersectionOctants");
  double sum = 0.0, tested = 0.0;
  Pipeline parts;
  parts.octree->AutomaticToleranceOn();
  for (int piece = 0; piece < 3; ++piece)
  {
    parts.octree->UpdatePiece(piece, 3, 0);
    sum += field(parts.octree->GetOutput(), "IntersectionOctants");
    tested += field(parts.octree->GetOutput(), "OctantsTested");
    EXPECT_LT(field(parts.octree->GetOutput(), "IntersectionOctants"), octants);
    EXPECT_EQ(field(parts.octree->GetOutput(), "UncoveredShare"), field(whole.octree->GetOutput(), "UncoveredShare"));
  }
  EXPECT_EQ(sum, octants);
  EXPECT_EQ(tested, field(whole.octree->GetOutput(), "OctantsTested"));
}

class VtkPiecesByTolerance : public testing::TestWithParam<bool>
{
};

INSTANTIATE_TEST_SUITE_P(Tolerance, VtkPiecesByTolerance, testing::Bool());

TEST_P(VtkPiecesByTolerance, AreTheSameWhicheverComesFirst)
{
  const bool isAutomatic = this->GetParam();
  auto views = ringViews(12);
  auto* image = vtkImageData::SafeDownCast(views->GetPartition(5, 0));
  auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer());
  std::fill_n(pixel, ImageSize * ImageSize / 2, static_cast<unsigned char>(0)); // a view lacks half of the object
  const auto setUp = [&](Pipeline& pipeline, int depth)
  {
    pipeline.extractor->SetInputDataObject(views);
    pipeline.octree->SetAutomaticTolerance(isAutomatic);
    pipeline.octree->SetBackgroundVotes(isAutomatic ? 0 : 1);
    pipeline.octree->SetDepth(depth);
    pipeline.cubes->SetShare(11.0 / 12.0);
  };
  Pipeline parts;
  for (const int depth : {6, 5, 5}) // the settings change, then one view
  {
    setUp(parts, depth);
    for (int piece = 0; piece < 3; ++piece)
    {
      Pipeline alone;
      setUp(alone, depth);
      alone.octree->UpdatePiece(piece, 3, 0);
      updatePiece(parts.octree, -1, piece, 3);
      for (const char* name : {"BackgroundVotes", "Dilation", "OctantsTested", "ViewTests", "IntersectionOctants", "InsideOctants"})
      {
        EXPECT_EQ(field(parts.octree->GetOutput(), name), field(alone.octree->GetOutput(), name))
            << name << ", piece " << piece << ", depth " << depth;
      }
      for (const char* name : {"UncoveredShare", "StrictUncoveredShare"})
      {
        EXPECT_EQ(parts.octree->GetOutput()->GetFieldData()->HasArray(name), int(isAutomatic));
        EXPECT_TRUE(!isAutomatic || field(parts.octree->GetOutput(), name) == field(alone.octree->GetOutput(), name)) << name;
      }
      EXPECT_EQ(field(parts.octree->GetOutput(), "OctantsTested") > 0.0, piece == 0 || !isAutomatic);
      EXPECT_GT(field(parts.octree->GetOutput(), "BackgroundVotes"), 0.0);
      alone.cubes->UpdatePiece(piece, 3, 0);
      parts.cubes->UpdatePiece(piece, 3, 0);
      EXPECT_EQ(triangles(parts.cubes->GetOutput()), triangles(alone.cubes->GetOutput()));
    }
    std::fill_n(pixel, ImageSize * ImageSize / 3, static_cast<unsigned char>(0));
    image->Modified();
    views->Modified();
  }
}

/** Which tells, too, that what is found for the whole is not found again. */
TEST_P(VtkPiecesByTolerance, WarnOnceAndAgainForOtherSettings)
{
  auto views = ringViews(12);
  auto* image = vtkImageData::SafeDownCast(views->GetPartition(5, 0));
  std::fill_n(static_cast<unsigned char*>(image->GetScalarPointer()), ImageSize * ImageSize, static_cast<unsigned char>(255));
  Pipeline parts;
  parts.extractor->SetInputDataObject(views);
  parts.octree->SetAutomaticTolerance(this->GetParam());
  const Listener listener(parts.octree);
  int expected = 0;
  for (const double edge : {0.0, 0.1, 0.2})
  {
    parts.octree->SetLeafEdge(edge);
    for (int piece = 0; piece < 4; ++piece)
    {
      parts.octree->UpdatePiece(piece, 4, 0);
    }
    EXPECT_EQ(listener.warnings("all object"), ++expected);
  }
  parts.octree->SetBackgroundVotes(1); // and a later piece of others
  parts.octree->UpdatePiece(2, 4, 0);
  EXPECT_EQ(listener.warnings("all object"), ++expected);
}

TEST(VtkPieces, OfNothingAreAnErrorInEach)
{
  for (int piece = 0; piece < 2; ++piece)
  {
    Pipeline parts;
    vtkNew<vtkPartitionedDataSetCollection> views;
    auto ring = ringViews();
    for (unsigned int i = 0; i < ring->GetNumberOfPartitionedDataSets(); ++i)
    {
      auto* image = vtkImageData::SafeDownCast(ring->GetPartitionAsDataObject(i, 0));
      vtkNew<vtkImageData> shifted;
      shifted->DeepCopy(image);
      Matrix p;
      image->GetFieldData()->GetArray("Projection")->GetTuple(0, p.data());
      p[3] += i % 2 ? 10000.0 : 0.0;
      setProjection(shifted, p);
      appendView(views, shifted, "view" + std::to_string(i));
    }
    parts.octree->SetInputData(views);
    parts.octree->AutomaticBoundsOff();
    const Listener listener(parts.octree);
    parts.octree->UpdatePiece(piece, 2, 0);
    ASSERT_EQ(listener.Errors.size(), 1u);
    EXPECT_NE(listener.Errors[0].find("nothing survives"), std::string::npos) << listener.Errors[0];
    EXPECT_EQ(elements(parts.octree->GetOutput()), 0);
  }
}
