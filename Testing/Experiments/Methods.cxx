// SPDX-License-Identifier: BSD-3-Clause
#include "Methods.h"

#include "ConvexHull.h"
#include "Error.h"
#include "LocalHullSurface.h"
#include "VotingMarchingCubes.h"
#include "VtkMeshes.h"

#include "vtkContourFilter.h"
#include "vtkDelaunay3D.h"
#include "vtkGeometryFilter.h"
#include "vtkNew.h"
#include "vtkSurfaceReconstructionFilter.h"
#include "vtkUnstructuredGrid.h"

#include <string>

namespace silhouette::experiments
{
namespace
{

/**
 * Points that the slow methods are given at most, and at least: VTK's filters divide by zero on a handful.
 */
constexpr std::size_t MostPoints = 10000;
constexpr std::size_t LeastPoints = 100;

Mesh cubes(Trial& trial, EdgePlacement edges)
{
  VotingOptions options;
  options.edges = edges;
  return votingMarchingCubes(trial.octree(0), trial.prepared(), options, trial.execution()).mesh;
}

/** Voting that allows k background votes. */
Mesh voting(Trial& trial, VotingMode mode, int k)
{
  VotingOptions options;
  options.mode = mode;
  options.share = 1.0 - double(k) / trial.prepared().size();
  const Octree& octree = trial.octree(mode == VotingMode::Faithful ? 0 : k);
  return votingMarchingCubes(octree, trial.prepared(), options, trial.execution()).mesh;
}

std::vector<Eigen::Vector3d> thinnedPoints(Trial& trial)
{
  const std::vector<Eigen::Vector3d>& all = trial.imperfect().points;
  if (all.size() < LeastPoints)
  {
    throw InvalidInput("fewer than " + std::to_string(LeastPoints) + " points");
  }
  const std::size_t step = (all.size() + MostPoints - 1) / MostPoints;
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i < all.size(); i += step)
  {
    points.push_back(all[i]);
  }
  if (step > 1)
  {
    trial.note = std::to_string(points.size()) + " of " + std::to_string(all.size()) + " points";
  }
  return points;
}

Mesh delaunay(Trial& trial)
{
  vtkNew<vtkDelaunay3D> tetrahedra;
  tetrahedra->SetInputData(pointSet(thinnedPoints(trial)));
  vtkNew<vtkGeometryFilter> surface;
  surface->SetInputConnection(tetrahedra->GetOutputPort());
  surface->Update();
  return outwards(meshOf(surface->GetOutput()));
}

Mesh reconstruction(Trial& trial)
{
  vtkNew<vtkSurfaceReconstructionFilter> distances;
  distances->SetInputData(pointSet(thinnedPoints(trial)));
  vtkNew<vtkContourFilter> surface;
  surface->SetInputConnection(distances->GetOutputPort());
  surface->SetValue(0, 0.0);
  surface->Update();
  return outwards(meshOf(surface->GetOutput()));
}

Mesh globalHull(Trial& trial)
{
  return convexHull(trial.imperfect().points).value_or(Mesh());
}

Mesh localHulls(Trial& trial, const LocalHullOptions& options)
{
  LocalHullSurface surface =
      localHullSurface(trial.imperfect(), trial.octree(0), &trial.prepared(), options, trial.execution());
  trial.dropped = std::move(surface.dropped);
  return std::move(surface.mesh);
}

std::vector<Method> makeTable()
{
  std::vector<Method> table = {{"cubes-middle", "marching cubes, mid-edge", Family::Cubes, 0, true,
                                [](Trial& t) { return cubes(t, EdgePlacement::Middle); }},
                               {"cubes-exact", "marching cubes, exact", Family::Cubes, 0, false,
                                [](Trial& t) { return cubes(t, EdgePlacement::Exact); }}};
  for (const int k : {1, 2, 3})
  {
    const std::string votes = std::to_string(k);
    table.push_back({"faithful-" + votes, "faithful voting, " + votes, Family::Faithful, 0, true,
                     [k](Trial& t) { return voting(t, VotingMode::Faithful, k); }});
    table.push_back({"consistent-" + votes, "consistent voting, " + votes, Family::Consistent, k, k > 2,
                     [k](Trial& t) { return voting(t, VotingMode::Consistent, k); }});
  }
  table.push_back({"delaunay", "3D Delaunay", Family::Known, 0, true, delaunay});
  table.push_back({"convex-hull", "3D convex hull", Family::Known, 0, true, globalHull});
  table.push_back({"reconstruction", "surface reconstruction", Family::Known, 0, true, reconstruction});
  table.push_back({"hulls-thesis", "local hulls, Thesis", Family::Hulls, 0, false,
                   [](Trial& t)
                   {
                     LocalHullOptions options;
                     options.mode = LocalHullMode::Thesis;
                     return localHulls(t, options);
                   }});
  table.push_back({"hulls-robust", "local hulls, Robust", Family::Hulls, 0, false,
                   [](Trial& t) { return localHulls(t, LocalHullOptions()); }});
  return table;
}

/** A stage that is switched off. */
struct Stage
{
  const char* name;
  const char* label;
  void (*leaveOut)(LocalHullOptions& options);
};

constexpr double SmallIslands = 0.05; // of the largest component, as the program's --drop-islands

const Stage Stages[] = {
    {"no-repair", "without the silhouettes' repair",
     [](LocalHullOptions& o) { o.repairSilhouettes = false; }},
    {"no-alignment", "without the views' alignment",
     [](LocalHullOptions& o) { o.correction.alignViews = false; }},
    {"no-correction", "without the corrected field",
     [](LocalHullOptions& o) { o.correction.moveSurface = false; }},
    {"no-hull-base", "without the hull as base of a near-convex field",
     [](LocalHullOptions& o) { o.correction.hullConvexity = 1.0; }},
    {"no-raising", "without the field's raising to survivors",
     [](LocalHullOptions& o) { o.correction.raiseWidth = 0.0; }},
    {"no-noise-stages", "without all three: labels by votes, covered",
     [](LocalHullOptions& o)
     { o.repairSilhouettes = o.correction.alignViews = o.correction.moveSurface = false; }},
    {"no-tunnels", "without the filling of tunnels",
     [](LocalHullOptions& o) { o.tunnels.fillTunnels = false; }},
    {"no-thin-hulls", "without thin hulls", [](LocalHullOptions& o) { o.thinHulls = false; }},
    {"no-bridges", "without bridges", [](LocalHullOptions& o) { o.bridgeGap = 0; }},
    {"no-cavities", "without the filling of cavities", [](LocalHullOptions& o) { o.fillCavities = false; }},
    {WithoutIslands, "without islands: small ones and debris dropped",
     [](LocalHullOptions& o) { o.islandShare = SmallIslands; }}};

std::vector<Method> makeAblations()
{
  std::vector<Method> table;
  for (const Stage& stage : Stages)
  {
    LocalHullOptions options;
    stage.leaveOut(options);
    table.push_back({stage.name, stage.label, Family::Ablation, 0, false,
                     [options](Trial& t) { return localHulls(t, options); }});
  }
  return table;
}

} // namespace

const std::vector<Method>& methods()
{
  static const std::vector<Method> table = makeTable();
  return table;
}

const std::vector<Method>& ablations()
{
  static const std::vector<Method> table = makeAblations();
  return table;
}

const Method& methodNamed(const std::string& name)
{
  std::string known;
  for (const std::vector<Method>* table : {&methods(), &ablations()})
  {
    for (const Method& method : *table)
    {
      if (method.name == name)
      {
        return method;
      }
      known += (known.empty() ? "" : ", ") + method.name;
    }
  }
  throw InvalidInput("there is no method '" + name + "'; there are " + known);
}

} // namespace silhouette::experiments
