// SPDX-License-Identifier: BSD-3-Clause
#include "MarchingCubesTable.h"

#include <algorithm>

namespace silhouette
{

namespace
{

/** The corners of each face, counter-clockwise seen from outside the cell. */
constexpr std::uint8_t FaceCorners[6][4] = { { 0, 4, 6, 2 }, { 1, 3, 7, 5 }, { 0, 1, 5, 4 }, { 2, 6, 7, 3 },
  { 0, 2, 3, 1 }, { 4, 5, 7, 6 } };

using Loop = std::vector<std::uint8_t>;
using Triangles = std::vector<std::array<std::uint8_t, 3>>;

int edgeBetween(int a, int b)
{
  for (int e = 0; e < 12; ++e)
  {
    if ((edgeCorners[e][0] == a && edgeCorners[e][1] == b) || (edgeCorners[e][0] == b && edgeCorners[e][1] == a))
    {
      return e;
    }
  }
  return -1;
}

/** The two faces that an edge belongs to, as bits. */
unsigned facesOf(int edge)
{
  unsigned faces = 0;
  for (int f = 0; f < 6; ++f)
  {
    const auto* corners = FaceCorners[f];
    const bool first = std::find(corners, corners + 4, edgeCorners[edge][0]) != corners + 4;
    const bool second = std::find(corners, corners + 4, edgeCorners[edge][1]) != corners + 4;
    faces |= unsigned(first && second) << f;
  }
  return faces;
}

/** On every face, link each crossing from inside to outside with the next crossing from outside to inside. */
std::array<int, 12> linkCrossings(unsigned inside)
{
  std::array<int, 12> next;
  next.fill(-1);
  const auto in = [inside](int corner) { return (inside >> corner & 1u) != 0; };
  for (const auto& face : FaceCorners)
  {
    for (int s = 0; s < 4; ++s)
    {
      if (!in(face[s]) || in(face[(s + 1) % 4]))
      {
        continue;
      }
      int t = (s + 1) % 4;
      while (in(face[t]) || !in(face[(t + 1) % 4]))
      {
        t = (t + 1) % 4;
      }
      next[edgeBetween(face[s], face[(s + 1) % 4])] = edgeBetween(face[t], face[(t + 1) % 4]);
    }
  }
  return next;
}

std::vector<Loop> traceLoops(unsigned inside)
{
  const auto next = linkCrossings(inside);
  std::array<bool, 12> done{};
  std::vector<Loop> loops;
  for (int start = 0; start < 12; ++start)
  {
    if (next[start] < 0 || done[start])
    {
      continue;
    }
    Loop loop;
    for (int e = start; !done[e]; e = next[e])
    {
      done[e] = true;
      loop.push_back(std::uint8_t(e));
    }
    loops.push_back(loop);
  }
  return loops;
}

/** All triangulations of loop[first..last] on the side of chord (first, last), without a diagonal in a cube face. */
std::vector<Triangles> triangulations(const Loop& loop, int first, int last)
{
  if (last - first < 2)
  {
    return { {} };
  }
  const int length = int(loop.size());
  const auto allowed = [&](int a, int b)
  {
    const bool side = b - a == 1 || (a == 0 && b == length - 1);
    return side || (facesOf(loop[a]) & facesOf(loop[b])) == 0;
  };
  std::vector<Triangles> found;
  for (int apex = first + 1; apex < last; ++apex)
  {
    if (!allowed(first, apex) || !allowed(apex, last))
    {
      continue;
    }
    for (const auto& left : triangulations(loop, first, apex))
    {
      for (const auto& right : triangulations(loop, apex, last))
      {
        Triangles all = { { loop[first], loop[last], loop[apex] } }; // outwards: against the walk
        all.insert(all.end(), left.begin(), left.end());
        all.insert(all.end(), right.begin(), right.end());
        found.push_back(all);
      }
    }
  }
  return found;
}

/**
 * The first fan, else the first. Every loop has a triangulation; 12 of the 16 of a loop of seven were never seen to
 * intersect themselves, the other four do for crossings near the corners; the fans are among the twelve.
 */
const Triangles& choose(const std::vector<Triangles>& candidates)
{
  for (const auto& triangles : candidates)
  {
    for (const std::uint8_t apex : triangles.front())
    {
      const auto has = [apex](const std::array<std::uint8_t, 3>& t)
      { return std::find(t.begin(), t.end(), apex) != t.end(); };
      if (std::all_of(triangles.begin(), triangles.end(), has))
      {
        return triangles;
      }
    }
  }
  return candidates.front();
}

std::array<MarchingCubesCase, 256> makeTable()
{
  std::array<MarchingCubesCase, 256> table;
  for (unsigned inside = 0; inside < 256; ++inside)
  {
    table[inside].loops = traceLoops(inside);
    for (const auto& loop : table[inside].loops)
    {
      const auto triangles = triangulations(loop, 0, int(loop.size()) - 1);
      const auto& chosen = choose(triangles);
      table[inside].triangles.insert(table[inside].triangles.end(), chosen.begin(), chosen.end());
    }
  }
  return table;
}

} // namespace

const std::array<MarchingCubesCase, 256>& marchingCubesTable()
{
  static const auto table = makeTable();
  return table;
}

} // namespace silhouette
