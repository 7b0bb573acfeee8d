// SPDX-License-Identifier: BSD-3-Clause
#include "CoverageNear.h"

#include "IndicesWhere.h"
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

CoverageNear::CoverageNear(const Octree& octree, const Mesh& mesh, const std::vector<Box>& swept, Execution& execution)
{
  this->Part.lattice = octree.lattice;
  this->Part.generations.resize(octree.generations.size());
  this->findSurvivors(octree, swept);
  this->findTriangles(mesh, swept, execution);
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

void CoverageNear::findTriangles(const Mesh& mesh, const std::vector<Box>& swept, Execution& execution)
{
  const std::size_t n = std::size_t(this->Part.lattice.cells());
  std::vector<std::uint8_t> rows(n * n, 0); // along x, in which there are such survivors
  for (const std::uint64_t cell : this->Part.last().code)
  {
    const LatticePoint p = fromMorton(cell);
    rows[std::size_t(p.k) * n + std::size_t(p.j)] = 1;
  }
  const BoxTree moving(swept);
  const auto concerns = [&](std::size_t t)
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
    return met;
  };
  this->Triangles = MeshPart(mesh, indicesWhere(mesh.triangles.size(), 1024, execution, concerns));
}

std::vector<std::uint64_t> CoverageNear::lost(const Mesh& mesh, Execution& execution) const
{
  const Mesh part = this->Triangles.of(mesh);
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
