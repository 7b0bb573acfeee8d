// SPDX-License-Identifier: BSD-3-Clause
/**
 * One side of Testing/Benchmarks/compare.sh, in a process of its own so that the operating system's account of memory is that
 * side's: either ours, or a dense volume with VTK's filters. Writes the mesh, and one JSON object to standard output.
 */
#include "BenchmarkCapture.h"
#include "DistanceMap.h"
#include "LocalHullSurface.h"

#include <Eigen/Geometry>

#include "vtkCellArray.h"
#include "vtkFloatArray.h"
#include "vtkFlyingEdges3D.h"
#include "vtkImageData.h"
#include "vtkMarchingCubes.h"
#include "vtkNew.h"
#include "vtkPLYWriter.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <nlohmann/json.hpp>

#include <chrono>
#include <cmath>
#include <ctime>
#include <cstdio>
#include <exception>
#include <map>

#include <sys/resource.h>

using namespace silhouette;
using namespace silhouette::benchmarks;

namespace
{

struct Options
{
  std::string side;
  std::string shape = "jug";
  int depth = 7;
  int views = 36;
  int size = 1024;
  int threads = 0;
  int repeats = 3;
  double noiseContour = 0.0;
  std::string mesh;
};

using Result = nlohmann::ordered_json;

double memoryMiB()
{
  struct rusage usage = {};
  getrusage(RUSAGE_SELF, &usage);
  return double(usage.ru_maxrss) / 1024.0;
}

/** The least wall time of several runs, and the processors' time of that run. `prepare` is called before each, and not timed. */
template <typename Before, typename Work>
void timed(const char* name, int repeats, Result& result, const Before& prepare, const Work& work)
{
  double least = 1e300, processors = 0.0;
  for (int run = 0; run < repeats; ++run)
  {
    prepare();
    const auto start = std::chrono::steady_clock::now();
    const std::clock_t before = std::clock();
    work();
    const double taken = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (taken < least)
    {
      least = taken;
      processors = double(std::clock() - before) / CLOCKS_PER_SEC;
    }
  }
  result["seconds"][name] = least;
  result["cpu_seconds"][name] = processors;
}

template <typename Work>
void timed(const char* name, int repeats, Result& result, const Work& work)
{
  timed(name, repeats, result, [] {}, work);
}

void write(vtkPolyData* surface, const std::string& file)
{
  vtkNew<vtkPLYWriter> writer;
  writer->SetInputData(surface);
  writer->SetFileName(file.c_str());
  if (!file.empty() && !writer->Write())
  {
    throw InvalidInput("cannot write " + file);
  }
}

vtkSmartPointer<vtkPolyData> polyData(const Mesh& mesh)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& p : mesh.points)
  {
    points->InsertNextPoint(p.data());
  }
  vtkNew<vtkCellArray> triangles;
  for (const Triangle& t : mesh.triangles)
  {
    const vtkIdType ids[3] = { t[0], t[1], t[2] };
    triangles->InsertNextCell(3, ids);
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(triangles);
  return surface;
}

/** Ours: sums, carve, exact or sub-pixel surface, and with `hulls` the local hull surface. */
void runOurs(const Options& options, const std::vector<View>& views, Result& result)
{
  const bool hulls = options.side == "hulls";
  VotingOptions voting;
  voting.edges = options.side == "subpixel" ? EdgePlacement::SubPixel : EdgePlacement::Exact;
  SmpExecution execution;
  PreparedViews prepared;
  Octree octree;
  VotingSurface surface;
  // As a pipeline has it: the views' memory is handed on, not copied.
  std::vector<View> own;
  timed("sums", options.repeats, result,
    [&]
    {
      prepared = PreparedViews();
      own = views;
    },
    [&] { prepared = PreparedViews(std::move(own), ViewOptions(), execution); });
  const Lattice lattice{ benchmarkCube(), options.depth };
  timed("carve", options.repeats, result,
    [&] { octree = carve(LatticeViews(prepared, lattice), CarveOptions(), execution); });
  timed("surface", options.repeats, result, [&] { octree.votes.set(nullptr); }, // the last run's
    [&] { surface = votingMarchingCubes(octree, prepared, voting, execution); });
  result["octants_tested"] = octree.statistics.octantsTested;
  result["view_tests"] = octree.statistics.viewTests;
  result["intersection"] = octree.count(OctantState::Intersection, options.depth);
  Mesh mesh = std::move(surface.mesh);
  if (hulls)
  {
    LocalHullSurface whole;
    timed("local_hulls", options.repeats, result,
      [&] { whole = localHullSurface(mesh, octree, &prepared, LocalHullOptions(), execution); });
    mesh = std::move(whole.mesh);
  }
  result["memory_mib"] = memoryMiB();
  result["faces"] = mesh.triangles.size();
  if (!options.mesh.empty())
  {
    write(polyData(mesh), options.mesh);
  }
}

/** At each lattice corner the least, over the views, of the bilinear signed pixel distance; outside on the cube's border. */
void fillVolume(const std::vector<View>& views, const Lattice& lattice, vtkImageData* volume, Execution& execution)
{
  // Beyond the reach a value says no more than its sign; no edge is longer than that in the images.
  const double reach = 4.0 + 2.0 * 1024.0 / lattice.cells() * views.front().silhouette.width / 1024.0;
  std::vector<DistanceMap> maps(views.size());
  execution.forRanges(views.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t v = first; v < last; ++v)
      {
        const BinaryImage& image = views[v].silhouette;
        maps[v] = distanceMap(image.pixels.data(), image.width, image.height, reach);
      }
    });
  const int n = lattice.cells() + 1;
  volume->SetDimensions(n, n, n);
  volume->SetOrigin(lattice.root.origin.data());
  volume->SetSpacing(lattice.leafEdge(), lattice.leafEdge(), lattice.leafEdge());
  volume->AllocateScalars(VTK_FLOAT, 1);
  auto* values = static_cast<float*>(volume->GetScalarPointer());
  execution.forRanges(std::size_t(n), 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t k = first; k < last; ++k)
      {
        for (int j = 0; j < n; ++j)
        {
          for (int i = 0; i < n; ++i)
          {
            const LatticePoint p{ i, j, int(k) };
            const Eigen::Vector4d at = lattice.position(p).homogeneous();
            float least = lattice.onBorder(p) ? -float(reach) : float(reach);
            for (std::size_t v = 0; v < views.size() && least > -float(reach); ++v)
            {
              const Eigen::Vector3d pixel = views[v].projection * at;
              least = std::min(least, maps[v].at(pixel[0] / pixel[2], pixel[1] / pixel[2]));
            }
            values[(k * std::size_t(n) + std::size_t(j)) * std::size_t(n) + std::size_t(i)] = least;
          }
        }
      }
    });
}

/** The dense exact reference, contoured by both of VTK's filters. */
void runDense(const Options& options, const std::vector<View>& views, Result& result)
{
  SmpExecution execution;
  vtkNew<vtkImageData> volume;
  const Lattice lattice{ benchmarkCube(), options.depth };
  timed("fill", 1, result, [&] { fillVolume(views, lattice, volume, execution); });
  vtkNew<vtkFlyingEdges3D> edges;
  edges->SetInputData(volume);
  edges->SetValue(0, 0.0);
  edges->ComputeNormalsOff();
  edges->ComputeScalarsOff();
  timed("flying_edges", options.repeats, result,
    [&]
    {
      edges->Modified();
      edges->Update();
    });
  vtkNew<vtkMarchingCubes> cubes;
  cubes->SetInputData(volume);
  cubes->SetValue(0, 0.0);
  cubes->ComputeNormalsOff();
  cubes->ComputeScalarsOff();
  timed("marching_cubes", 1, result, [&] { cubes->Update(); });
  result["memory_mib"] = memoryMiB();
  result["faces"] = edges->GetOutput()->GetNumberOfPolys();
  result["faces_marching_cubes"] = cubes->GetOutput()->GetNumberOfPolys();
  write(edges->GetOutput(), options.mesh);
}

void run(const Options& options)
{
  if (options.threads > 0)
  {
    vtkSMPTools::Initialize(options.threads);
  }
  SyntheticCaptureOptions capture;
  capture.views = options.views;
  capture.width = capture.height = options.size;
  capture.noiseContour = options.noiseContour;
  SmpExecution execution;
  const std::vector<View> views = capturedViews(shapeNamed(options.shape), capture, execution);
  Result result;
  result["side"] = options.side;
  result["cells"] = 1 << options.depth;
  result["threads"] = execution.threads();
  result["memory_before_mib"] = memoryMiB();
  options.side == "dense" ? runDense(options, views, result) : runOurs(options, views, result);
  std::printf("%s\n", result.dump().c_str());
}

} // namespace

int main(int argc, char** argv)
{
  Options options;
  CLI::App program("One side of the comparison: its stages' times, memory and mesh", "silhouette-stages");
  program.add_option("side", options.side, "ours, subpixel (ours with sub-pixel edges), hulls (ours with local hulls) or dense")
    ->required()
    ->check(CLI::IsMember({ "ours", "subpixel", "hulls", "dense" }));
  program.add_option("--shape", options.shape, "The solid")->capture_default_str();
  program.add_option("--depth", options.depth, "2^depth cells a side")->check(CLI::Range(3, 12))->capture_default_str();
  program.add_option("--views", options.views, "Views")->check(CLI::Range(2, 1000))->capture_default_str();
  program.add_option("--size", options.size, "Pixels of an image's sides")->check(CLI::Range(16, 8192))->capture_default_str();
  program.add_option("--threads", options.threads, "0: all processors")->check(CLI::Range(0, 256))->capture_default_str();
  program.add_option("--repeats", options.repeats, "Runs of each stage; the fastest counts")
    ->check(CLI::Range(1, 100))
    ->capture_default_str();
  program.add_option("--noise-contour", options.noiseContour, "Contour noise, pixels")->capture_default_str();
  program.add_option("--mesh", options.mesh, "Where the mesh goes (.ply)");
  CLI11_PARSE(program, argc, argv);
  try
  {
    run(options);
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "silhouette-stages: %s\n", error.what());
    return 1;
  }
  return 0;
}
