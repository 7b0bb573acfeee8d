// SPDX-License-Identifier: BSD-3-Clause
/** Every algorithm that takes time, cancelled before, during and after it runs. */
#include "Execution.h"

#include "CarvingTestCaptures.h"
#include "LocalHullSurface.h"

#include <gtest/gtest.h>

#include <functional>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** Wants to stop once it has been asked `patience` times. */
class ImpatientExecution : public ProgressExecution
{
public:
  explicit ImpatientExecution(int patience)
    : Patience(patience)
  {
  }
  bool cancelled() const override { return this->Asked++ >= this->Patience; }
  mutable int Asked = 0;

private:
  int Patience;
};

/** Each cancelled run throws, whenever it was cancelled, and leaves nothing behind that changes the next one. */
void expectCancels(const std::function<Mesh(Execution&)>& run, const std::string& what)
{
  ImpatientExecution patient(1 << 30);
  const Mesh whole = run(patient);
  ASSERT_GE(patient.Asked, 3) << what << " asks too seldom";
  EXPECT_TRUE(patient.Monotone) << what;
  EXPECT_EQ(patient.Last, 1.0) << what;
  for (const int patience : { 0, 1, patient.Asked / 2, patient.Asked - 1 })
  {
    ImpatientExecution impatient(patience);
    EXPECT_THROW(run(impatient), Cancelled) << what << " after " << patience << " of " << patient.Asked;
    EXPECT_EQ(impatient.Asked, patience + 1) << what << " went on though it was cancelled";
  }
  ImpatientExecution after(patient.Asked);
  const Mesh again = run(after);
  EXPECT_TRUE(after.cancelled()) << "cancelled after the end, which changes nothing";
  EXPECT_EQ(again.points, whole.points) << what;
  EXPECT_EQ(again.triangles, whole.triangles) << what;
}

} // namespace

TEST(Execution, EveryAlgorithmCanBeCancelledBeforeDuringAndAfter)
{
  const PreparedViews views = prepareViews(viewsOf(torusMesh(48, 24, 0.7, 0.3), swayingRing(10, 120), 120));
  const LatticeViews lattice(views, { unitCube(), 5 });
  const Octree octree = carveViews(views, unitCube(), 5);
  Execution serial;
  const Mesh surface = votingMarchingCubes(octree, views, VotingOptions(), serial).mesh;

  expectCancels(
    [&](Execution& execution)
    {
      const RootCube cube = automaticBounds(views, AutomaticBoundsOptions(), execution);
      Mesh corners;
      corners.points = { cube.origin, cube.origin + Vector3::Constant(cube.edge) };
      return corners;
    },
    "automaticBounds");
  expectCancels(
    [&](Execution& execution)
    {
      const Octree carved = carve(lattice, CarveOptions(), execution);
      EXPECT_TRUE(sameOctants(carved, octree));
      return Mesh();
    },
    "carve");
  expectCancels([&](Execution& execution)
    { return votingMarchingCubes(octree, views, VotingOptions(), execution).mesh; },
    "votingMarchingCubes");
  expectCancels([&](Execution& execution)
    { return localHullSurface(surface, octree, &views, LocalHullOptions(), execution).mesh; },
    "localHullSurface");
  expectCancels(
    [&](Execution& execution)
    {
      Mesh all;
      for (const auto& hull : classifyLocalHulls(surface, octree, &views, LocalHullOptions(), execution))
      {
        all = joined(all, hull.mesh);
      }
      return all;
    },
    "classifyLocalHulls");
}

TEST(Execution, UnannouncedIsTheSameWithoutItsProgress)
{
  class Whole : public Execution
  {
  public:
    void forRanges(std::size_t count, std::size_t, const Range& work) override
    {
      work(0, count / 2);
      work(count / 2, count);
    }
    int threads() const override { return 7; }
    bool cancelled() const override { return this->Stop; }
    void progress(double) override { ++this->Told; }
    bool Stop = false;
    int Told = 0;
  } whole;
  Unannounced quiet(whole);
  std::vector<int> seen(10, 0);
  int ranges = 0;
  quiet.forRanges(seen.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      ++ranges;
      for (; first < last; ++first)
      {
        ++seen[first];
      }
    });
  EXPECT_EQ(ranges, 2);
  EXPECT_EQ(seen, std::vector<int>(10, 1));
  EXPECT_EQ(quiet.threads(), 7);
  quiet.checkpoint(0.5);
  EXPECT_EQ(whole.Told, 0);
  whole.Stop = true;
  EXPECT_THROW(quiet.checkpoint(0.6), Cancelled);
}
