// SPDX-License-Identifier: BSD-3-Clause
#include "VoteTable.h"

#include "Carving.h"
#include "SyntheticCapture.h"
#include "SyntheticShapes.h"
#include "VotingMarchingCubes.h"

#include <cmath>
#include <fstream>
#include <sstream>
#include <string>

namespace silhouette::experiments
{
namespace
{

constexpr int Depth = 6; // seven levels with the root
constexpr int Pixels = 512;
constexpr int ViewCount = 36;

RootCube cubeOf(const VoteTable& table)
{
  const double edge = std::ldexp(2.0 * sphereRadius / table.diameter, Depth);
  return {Eigen::Vector3d::Constant(-0.5 * edge), edge};
}

/**
 * Pixels that a leaf octant at the sphere's centre spans: the sphere fills 0.8 of the image, four radii away.
 */
double pixelsAnOctant(const VoteTable& table)
{
  const double focal = 0.5 * 0.8 * Pixels * std::sqrt(15.0);
  return focal / 4.0 / (0.5 * table.diameter);
}

PreparedViews viewsOf(const VoteTable& table, Execution& execution)
{
  SyntheticCaptureOptions options;
  options.views = ViewCount;
  options.width = options.height = Pixels;
  options.seed = table.seed;
  options.photographs = false;
  options.noiseCamera = table.noise * pixelsAnOctant(table);
  static const Mesh sphere = syntheticShape(SyntheticShape::Sphere);
  const SyntheticCapture capture = synthesizeCapture(sphere, options, execution);
  std::vector<View> views;
  for (const SyntheticView& view : capture.views)
  {
    views.push_back({view.name, view.projection, view.mask});
  }
  return PreparedViews(views, ViewOptions(), execution);
}

Octree carveSphere(const VoteTable& table, const PreparedViews& views, int depth, Execution& execution)
{
  return carve(LatticeViews(views, Lattice{cubeOf(table), depth}), CarveOptions(), execution);
}

VotingSurface vote(const Octree& octree, const PreparedViews& views, double share, Execution& execution)
{
  VotingOptions options;
  options.share = share;
  options.edges = EdgePlacement::Middle;
  options.mode = VotingMode::Faithful;
  return votingMarchingCubes(octree, views, options, execution);
}

double distanceToThesis(const VoteTable& table)
{
  double sum = 0.0;
  for (std::size_t s = 0; s < VoteShares.size(); ++s)
  {
    const VoteCounts& thesis = thesisVotes()[s];
    sum += std::abs(std::log(table.counts[s].vertices / thesis.vertices));
    sum += std::abs(std::log(table.counts[s].faces / thesis.faces));
    sum += std::abs(std::log(table.counts[s].lost() / thesis.lost()));
  }
  return sum / 12.0;
}

} // namespace

double VoteTable::allIntersections() const
{
  double sum = 0.0;
  for (const double count : this->intersections)
  {
    sum += count;
  }
  return sum;
}

const std::array<VoteCounts, 4>& thesisVotes()
{
  static const std::array<VoteCounts, 4> table = {
      {{10584, 21156, 275, 0}, {8701, 10651, 5674, 0}, {2761, 2177, 9586, 0}, {510, 412, 10620, 0}}};
  return table;
}

void fillVoteTable(VoteTable& table, Execution& execution)
{
  const PreparedViews views = viewsOf(table, execution);
  const Octree octree = carveSphere(table, views, Depth, execution);
  for (std::size_t s = 0; s < VoteShares.size(); ++s)
  {
    const VotingSurface surface = vote(octree, views, VoteShares[s], execution);
    table.counts[s] = {double(surface.mesh.points.size()), double(surface.mesh.triangles.size()),
                       double(surface.lostNoCorner), double(surface.lostAllCorners)};
  }
  // Trees begin below the root: the first generations are counted as the last ones of shallower octrees.
  table.intersections[0] = 1.0;
  for (int g = 1; g <= Depth; ++g)
  {
    const bool has = g >= octree.treeGeneration;
    table.intersections[std::size_t(g)] =
        double((has ? octree : carveSphere(table, views, g, execution)).count(OctantState::Intersection, g));
  }
  table.distance = distanceToThesis(table);
}

std::vector<Mesh> voteSurfaces(const VoteTable& table, Execution& execution)
{
  const PreparedViews views = viewsOf(table, execution);
  const Octree octree = carveSphere(table, views, Depth, execution);
  std::vector<Mesh> surfaces;
  for (const double share : VoteShares)
  {
    surfaces.push_back(vote(octree, views, share, execution).mesh);
  }
  return surfaces;
}

std::vector<VoteTable> searchVoteTables(Execution& execution)
{
  std::vector<VoteTable> tables(1);
  for (const double diameter : {47.0, 48.0, 49.0, 50.0})
  {
    for (const double noise : {0.5, 0.6, 0.7, 0.8})
    {
      for (const std::uint64_t seed : {11, 12, 13})
      {
        VoteTable table;
        table.diameter = diameter;
        table.noise = noise;
        table.seed = seed;
        tables.push_back(table);
      }
    }
  }
  for (VoteTable& table : tables)
  {
    fillVoteTable(table, execution);
  }
  return tables;
}

void writeVoteTables(const std::filesystem::path& file, const std::vector<VoteTable>& tables)
{
  std::ofstream stream(file);
  stream << "diameter noise seed distance, then vertices faces no-corner all-corners for each share, then "
            "intersection octants by generation\n";
  for (const VoteTable& table : tables)
  {
    stream << table.diameter << ' ' << table.noise << ' ' << table.seed << ' ' << table.distance;
    for (const VoteCounts& counts : table.counts)
    {
      stream << ' ' << counts.vertices << ' ' << counts.faces << ' ' << counts.lostNoCorner << ' '
             << counts.lostAllCorners;
    }
    for (const double count : table.intersections)
    {
      stream << ' ' << count;
    }
    stream << '\n';
  }
  if (!stream)
  {
    throw InvalidInput("cannot write " + file.string());
  }
}

std::vector<VoteTable> readVoteTables(const std::filesystem::path& file)
{
  std::vector<VoteTable> tables;
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  while (std::getline(stream, line))
  {
    std::istringstream fields(line);
    VoteTable table;
    fields >> table.diameter >> table.noise >> table.seed >> table.distance;
    for (VoteCounts& counts : table.counts)
    {
      fields >> counts.vertices >> counts.faces >> counts.lostNoCorner >> counts.lostAllCorners;
    }
    for (double& count : table.intersections)
    {
      fields >> count;
    }
    tables.push_back(table);
  }
  return tables;
}

} // namespace silhouette::experiments
