// SPDX-License-Identifier: BSD-3-Clause
/**
 * Google Benchmark of the stages, each by depth: sums, carve, voting surface, local hulls on clean and on noisy silhouettes. Counters
 * say what was counted, which does not depend on the machine.
 */
#include "BenchmarkCapture.h"
#include "LocalHullSurface.h"

#include <benchmark/benchmark.h>

#include <map>

using namespace silhouette;
using namespace silhouette::benchmarks;

namespace
{

constexpr int Views = 36, Size = 512;

const std::vector<View>& views(bool noisy)
{
  static std::map<bool, std::vector<View>> made;
  const auto [found, isNew] = made.emplace(noisy, std::vector<View>());
  if (isNew)
  {
    SmpExecution execution;
    SyntheticCaptureOptions options;
    options.views = Views;
    options.width = options.height = Size;
    options.noiseContour = noisy ? 2.0 : 0.0;
    found->second = capturedViews(SyntheticShape::Jug, options, execution);
  }
  return found->second;
}

const PreparedViews& prepared(bool noisy)
{
  static std::map<bool, PreparedViews> made;
  const auto found = made.find(noisy);
  if (found != made.end())
  {
    return found->second;
  }
  SmpExecution execution;
  return made.emplace(noisy, PreparedViews(views(noisy), ViewOptions(), execution)).first->second;
}

Octree carved(int depth, bool noisy)
{
  SmpExecution execution;
  return carve(LatticeViews(prepared(noisy), { benchmarkCube(), depth }), CarveOptions(), execution);
}

void sums(benchmark::State& state)
{
  SmpExecution execution;
  for (auto _ : state)
  {
    benchmark::DoNotOptimize(PreparedViews(views(false), ViewOptions(), execution).size());
  }
  state.counters["pixels"] = double(Views) * Size * Size;
}

void carving(benchmark::State& state)
{
  Octree octree;
  for (auto _ : state)
  {
    octree = carved(int(state.range(0)), false);
  }
  state.counters["octants"] = double(octree.statistics.octantsTested);
  state.counters["view_tests"] = double(octree.statistics.viewTests);
  state.counters["intersection"] = double(octree.count(OctantState::Intersection, int(state.range(0))));
}

void votingSurface(benchmark::State& state)
{
  SmpExecution execution;
  const Octree octree = carved(int(state.range(0)), false);
  VotingSurface surface;
  for (auto _ : state)
  {
    octree.votes.set(nullptr); // the last run's
    surface = votingMarchingCubes(octree, prepared(false), VotingOptions(), execution);
  }
  state.counters["faces"] = double(surface.mesh.triangles.size());
}

void localHulls(benchmark::State& state, bool noisy)
{
  SmpExecution execution;
  const Octree octree = carved(int(state.range(0)), noisy);
  const Mesh imperfect = votingMarchingCubes(octree, prepared(noisy), VotingOptions(), execution).mesh;
  LocalHullSurface surface;
  for (auto _ : state)
  {
    surface = localHullSurface(imperfect, octree, &prepared(noisy), LocalHullOptions(), execution);
  }
  state.counters["faces"] = double(surface.mesh.triangles.size());
  state.counters["survivors"] = double(surface.survivors);
}

} // namespace

BENCHMARK(sums)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(carving)->DenseRange(5, 9)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK(votingSurface)->DenseRange(5, 9)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(localHulls, clean, false)->DenseRange(5, 8)->UseRealTime()->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(localHulls, noisy, true)->DenseRange(5, 8)->UseRealTime()->Unit(benchmark::kMillisecond);

BENCHMARK_MAIN();
