// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceNesting.h"

#include "LargePages.h"
#include "MeshComponents.h"
#include "RowIntervals.h"

#include <algorithm>
#include <tuple>

namespace silhouette
{
namespace
{

std::vector<std::uint32_t> numberComponents(const LatticeSurface& surface, std::size_t& count)
{
  Execution alone;
  ConcurrentUnionFind sets = connectPoints(surface.triangles, surface.edges.size(), alone);
  auto component = largeVector<std::uint32_t>(surface.edges.size());
  count = 0;
  for (std::uint32_t e = 0; e < component.size(); ++e)
  {
    const std::uint32_t root = sets.find(e); // the set's least member
    component[e] = root == e ? std::uint32_t(count++) : component[root];
  }
  return component;
}

std::vector<SurfaceNesting::Crossing> rowCrossings(const CornerShell& shell, const LatticeSurface& surface)
{
  std::vector<SurfaceNesting::Crossing> crossings;
  for (std::uint32_t e = 0; e < surface.edges.size(); ++e)
  {
    const LatticePoint a = fromMorton(shell.corners[surface.edges[e].inside]);
    const LatticePoint b = fromMorton(shell.corners[surface.edges[e].outside]);
    if (a.i != b.i)
    {
      crossings.push_back({ rowKey(a, 0), std::min(a.i, b.i), e, a.i > b.i });
    }
  }
  std::sort(crossings.begin(), crossings.end(), [](const auto& a, const auto& b)
    { return std::tie(a.row, a.lower) < std::tie(b.row, b.lower); });
  return crossings;
}

} // namespace

std::uint32_t SurfaceNesting::solidAt(const LatticePoint& p) const
{
  const auto next = std::lower_bound(this->crossings.begin(), this->crossings.end(), std::make_pair(rowKey(p, 0), p.i),
    [](const Crossing& a, const std::pair<std::uint64_t, std::int32_t>& b)
    { return std::tie(a.row, a.lower) < std::tie(b.first, b.second); });
  return next == this->crossings.end() || next->row != rowKey(p, 0) ? NoComponent
                                                                    : this->solidOf(this->component[next->edge]);
}

SurfaceNesting nestSurface(const CornerShell& shell, const LatticeSurface& surface)
{
  SurfaceNesting nesting;
  std::size_t count = 0;
  nesting.component = numberComponents(surface, count);
  nesting.crossings = rowCrossings(shell, surface);
  nesting.parent.assign(count, NoComponent);
  nesting.cavity.assign(count, 0);
  // A component's lowest crossing sees it from outside: the one before on the row tells what it lies in.
  std::vector<std::size_t> lowest(count, nesting.crossings.size());
  for (std::size_t n = 0; n < nesting.crossings.size(); ++n)
  {
    std::size_t& at = lowest[nesting.component[nesting.crossings[n].edge]];
    at = at == nesting.crossings.size() || nesting.crossings[n].lower < nesting.crossings[at].lower ? n : at;
  }
  std::vector<std::uint32_t> order;
  for (std::uint32_t c = 0; c < count; ++c)
  {
    if (lowest[c] < nesting.crossings.size())
    {
      order.push_back(c);
      nesting.cavity[c] = !nesting.crossings[lowest[c]].entering;
    }
  }
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b)
    { return std::make_pair(nesting.crossings[lowest[a]].lower, a) < std::make_pair(nesting.crossings[lowest[b]].lower, b); });
  for (const std::uint32_t c : order)
  {
    const std::size_t at = lowest[c];
    if (at > 0 && nesting.crossings[at - 1].row == nesting.crossings[at].row)
    {
      const auto& before = nesting.crossings[at - 1];
      const std::uint32_t other = nesting.component[before.edge];
      // Beyond an outer wall that is entered, or a cavity's wall that is left, lies what it encloses.
      const bool within = before.entering != (nesting.cavity[other] != 0);
      nesting.parent[c] = within ? other : nesting.parent[other];
    }
  }
  return nesting;
}

void keepComponents(
  const SurfaceNesting& nesting, const std::vector<std::uint8_t>& keep, LatticeSurface& surface, std::vector<double>& fractions)
{
  auto number = largeVector<std::int32_t>(surface.edges.size(), -1);
  std::vector<CrossedEdge> edges;
  std::vector<double> keptFractions;
  for (std::size_t e = 0; e < surface.edges.size(); ++e)
  {
    if (keep[nesting.component[e]])
    {
      number[e] = std::int32_t(edges.size());
      edges.push_back(surface.edges[e]);
      keptFractions.push_back(fractions[e]);
    }
  }
  std::size_t kept = 0, from = 0;
  for (auto& end : surface.cellEnd)
  {
    for (; from < end; ++from)
    {
      const Triangle t = surface.triangles[from];
      if (number[t[0]] >= 0)
      {
        surface.triangles[kept++] = { number[t[0]], number[t[1]], number[t[2]] };
      }
    }
    end = std::uint32_t(kept);
  }
  surface.triangles.resize(kept);
  surface.edges = std::move(edges);
  fractions = std::move(keptFractions);
}

} // namespace silhouette
