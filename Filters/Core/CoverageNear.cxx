// SPDX-License-Identifier: BSD-3-Clause
#include "CoverageNear.h"

#include "SurvivorCoverage.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace silhouette
{
namespace
{

/** The leaf cells that a box meets, and one around them for rounding. */
struct CellBox
{
  std::array<std::int32_t, 3> first{}, last{};

  CellBox(const Lattice& lattice, const Box& box)
  {
    const double greatest = lattice.cells() - 1;
    for (int axis = 0; axis < 3; ++axis)
    {
      const auto cellOf = [&](double x) { return std::floor((x - lattice.root.origin[axis]) / lattice.leafEdge()); };
      this->first[axis] = std::int32_t(std::clamp(cellOf(box.min()[axis]) - 1.0, 0.0, greatest));
      this->last[axis] = std::int32_t(std::clamp(cellOf(box.max()[axis]) + 1.0, 0.0, greatest));
    }
  }
};

} // namespace

CoverageNear::CoverageNear(const Octree& octree, const Mesh& mesh, const std::vector<Box>& swept)
{
  this->Part.lattice = octree.lattice;
  this->Part.generations.resize(octree.generations.size());
  this->findSurvivors(octree, swept);
  this->findTriangles(mesh, swept);
}

void CoverageNear::findSurvivors(const Octree& octree, const std::vector<Box>& swept)
{
  std::vector<std::uint64_t> cells;
  for (const Box& box : swept)
  {
    const CellBox range(octree.lattice, box);
    for (std::int32_t k = range.first[2]; k <= range.last[2]; ++k)
    {
      for (std::int32_t j = range.first[1]; j <= range.last[1]; ++j)
      {
        for (std::int32_t i = range.first[0]; i <= range.last[0]; ++i)
        {
          cells.push_back(mortonCode({ i, j, k }));
        }
      }
    }
  }
  std::sort(cells.begin(), cells.end());
  cells.erase(std::unique(cells.begin(), cells.end()), cells.end());
  const Generation& last = octree.last();
  Generation& part = this->Part.generations.back();
  for (const std::uint64_t cell : cells)
  {
    const auto at = std::lower_bound(last.code.begin(), last.code.end(), cell);
    const std::size_t index = std::size_t(at - last.code.begin());
    if (at != last.code.end() && *at == cell && last.state[index] != OctantState::Background)
    {
      part.code.push_back(cell);
      part.state.push_back(last.state[index]);
    }
  }
}

void CoverageNear::findTriangles(const Mesh& mesh, const std::vector<Box>& swept)
{
  const std::size_t n = std::size_t(this->Part.lattice.cells());
  std::vector<std::uint8_t> rows(n * n, 0); // along x, in which there are such survivors
  for (const std::uint64_t cell : this->Part.last().code)
  {
    const LatticePoint p = fromMorton(cell);
    rows[std::size_t(p.k) * n + std::size_t(p.j)] = 1;
  }
  const BoxTree moving(swept);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
  {
    const Box box = triangleBox(mesh.points, mesh.triangles[t]);
    const CellBox range(this->Part.lattice, box);
    bool met = false;
    for (std::int32_t k = range.first[2]; k <= range.last[2] && !met; ++k)
    {
      const std::uint8_t* row = &rows[std::size_t(k) * n];
      met = std::find(row + range.first[1], row + range.last[1] + 1, std::uint8_t(1)) != row + range.last[1] + 1;
    }
    if (!met) // it may move into such a row
    {
      moving.overlapping(box, [&](std::int32_t) { met = true; });
    }
    if (met)
    {
      this->Triangles.push_back(std::int32_t(t));
    }
  }
}

std::vector<std::uint64_t> CoverageNear::lost(const Mesh& mesh, Execution& execution) const
{
  Mesh part;
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  for (const std::int32_t t : this->Triangles)
  {
    Triangle triangle = mesh.triangles[t];
    for (std::int32_t& p : triangle)
    {
      if (number[p] < 0)
      {
        number[p] = std::int32_t(part.points.size());
        part.points.push_back(mesh.points[p]);
      }
      p = number[p];
    }
    part.triangles.push_back(triangle);
  }
  const auto coverage = survivorCoverage(this->Part, part, execution);
  std::vector<std::uint64_t> codes;
  for (std::size_t o = 0; o < coverage.size(); ++o)
  {
    if (coverage[o] == Coverage::Lost)
    {
      codes.push_back(this->Part.last().code[o]);
    }
  }
  return codes;
}

} // namespace silhouette
