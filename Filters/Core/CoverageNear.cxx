// SPDX-License-Identifier: BSD-3-Clause
#include "CoverageNear.h"

#include "CellBoxes.h"
#include "IndicesWhere.h"
#include "SurvivorCoverage.h"

#include <algorithm>

namespace silhouette
{
CoverageNear::CoverageNear(
  const Octree& octree, const Mesh& mesh, const std::vector<Box>& swept, const std::vector<std::uint64_t>& cells, Execution& execution)
{
  this->Part.lattice = octree.lattice;
  this->Part.generations.resize(octree.generations.size());
  this->findSurvivors(octree, cells);
  this->findTriangles(mesh, swept, execution);
}

void CoverageNear::findSurvivors(const Octree& octree, const std::vector<std::uint64_t>& cells)
{
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
  enum : std::uint8_t
  {
    HasSurvivors = 1,
    IsSwept = 2
  };
  std::vector<std::uint8_t> rows(n * n, 0); // along x
  for (const std::uint64_t cell : this->Part.last().code)
  {
    const LatticePoint p = fromMorton(cell);
    rows[std::size_t(p.k) * n + std::size_t(p.j)] |= HasSurvivors;
  }
  const auto forRows = [&](const CellBox& range, const auto& work)
  {
    for (std::int32_t k = range.first[2]; k <= range.last[2]; ++k)
    {
      for (std::int32_t j = range.first[1]; j <= range.last[1]; ++j)
      {
        work(rows[std::size_t(k) * n + std::size_t(j)]);
      }
    }
  };
  for (const Box& box : swept)
  {
    forRows(CellBox(this->Part.lattice, box), [](std::uint8_t& row) { row |= IsSwept; });
  }
  const BoxTree moving(swept, execution);
  const auto concerns = [&](std::size_t t)
  {
    const Box box = triangleBox(mesh.points, mesh.triangles[t]);
    std::uint8_t met = 0;
    forRows(CellBox(this->Part.lattice, box), [&](std::uint8_t row) { met |= row; });
    bool may = (met & HasSurvivors) != 0;
    if (met == IsSwept) // it may move into such a row
    {
      moving.overlapping(box, [&](std::int32_t) { may = true; });
    }
    return may;
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

std::vector<std::uint64_t> CoverageNear::lostWithin(const std::vector<Box>& boxes, const Mesh& mesh, Execution& execution) const
{
  const Mesh part = this->Triangles.of(mesh);
  return CoverageNear(this->Part, part, boxes, cellsMet(this->Part.lattice, boxes), execution).lost(part, execution);
}

} // namespace silhouette
