// SPDX-License-Identifier: BSD-3-Clause
#include "SimplePoint.h"

#include "Lattice.h"
#include "MarchingCubesTable.h"

#include <cstdlib>

namespace silhouette
{
namespace
{

constexpr int Centre = 13;

/** Number of coordinates in which two of the 27 points differ, or 4 where they are no 26-neighbours. */
int distance(int a, int b)
{
  const LatticePoint p = neighbourOf({}, a), q = neighbourOf({}, b);
  const int dx = std::abs(p.i - q.i), dy = std::abs(p.j - q.j), dz = std::abs(p.k - q.k);
  return dx > 1 || dy > 1 || dz > 1 ? 4 : dx + dy + dz;
}

struct Distances
{
  std::array<std::array<std::int8_t, 27>, 27> d{};
  Distances()
  {
    for (int a = 0; a < 27; ++a)
    {
      for (int b = 0; b < 27; ++b)
      {
        this->d[a][b] = std::int8_t(distance(a, b));
      }
    }
  }
};

const Distances& distances()
{
  static const Distances table;
  return table;
}

using Members = std::array<bool, 27>;

/** Points of `from` and those of `among` that are within `step` of one of them. */
Members grow(const Members& from, const Members& among, int step)
{
  const auto& d = distances().d;
  Members grown = from;
  for (int a = 0; a < 27; ++a)
  {
    for (int b = 0; from[a] && b < 27; ++b)
    {
      grown[b] = grown[b] || (among[b] && d[a][b] <= step);
    }
  }
  return grown;
}

/** Points of the 27, the centre left out, that carry `label` and are within `step` of the centre. */
Members around(const Neighbourhood& labels, bool label, int step)
{
  Members members{};
  for (int n = 0; n < 27; ++n)
  {
    members[n] = n != Centre && labels[n] == label && distances().d[n][Centre] <= step;
  }
  return members;
}

/** Number the components of `members`, points within `step` of each other being joined. */
int components(const Members& members, int step, std::array<std::int8_t, 27>& number)
{
  number.fill(-1);
  int count = 0;
  for (int seed = 0; seed < 27; ++seed)
  {
    if (!members[seed] || number[seed] >= 0)
    {
      continue;
    }
    std::array<int, 27> stack;
    int height = 0;
    stack[height++] = seed;
    number[seed] = std::int8_t(count);
    while (height > 0)
    {
      const int a = stack[--height];
      for (int b = 0; b < 27; ++b)
      {
        if (members[b] && number[b] < 0 && distances().d[a][b] <= step)
        {
          number[b] = std::int8_t(count);
          stack[height++] = b;
        }
      }
    }
    ++count;
  }
  return count;
}

} // namespace

TopologicalNumbers topologicalNumbers(const Neighbourhood& labels)
{
  TopologicalNumbers numbers;
  // Inside: the geodesic 18-neighbourhood of order 2.
  const Members solid = grow(around(labels, true, 2), around(labels, true, 3), 2);
  numbers.inside = components(solid, 2, numbers.insideComponent);
  // Outside: the geodesic 6-neighbourhood of order 3, the first two orders within the 18-neighbourhood.
  const Members second = grow(around(labels, false, 1), around(labels, false, 2), 1);
  const Members outside = grow(second, around(labels, false, 3), 1);
  std::array<std::int8_t, 27> unused;
  numbers.outside = components(outside, 1, unused);
  return numbers;
}

namespace
{

/** Points less segments plus loops of the surface in the eight cells around the centre; what does not touch it stays, whatever its label. */
int doubleEuler(const Neighbourhood& labels)
{
  int points = 0, segments = 0, loops = 0;
  for (const int n : { 4, 10, 12, 14, 16, 22 })
  {
    points += labels[n] != labels[Centre];
  }
  for (int cell = 0; cell < 8; ++cell)
  {
    unsigned which = 0;
    for (int c = 0; c < 8; ++c)
    {
      const LatticePoint p = cornerOffset(cell) + cornerOffset(c);
      which |= unsigned(labels[p.i + 3 * p.j + 9 * p.k]) << c;
    }
    for (const auto& loop : marchingCubesTable()[which].loops)
    {
      segments += int(loop.size());
      ++loops;
    }
  }
  return 2 * points - segments + 2 * loops; // two cells share a segment
}

} // namespace

int eulerChange(const Neighbourhood& labels)
{
  Neighbourhood without = labels, with = labels;
  without[Centre] = false;
  with[Centre] = true;
  return (doubleEuler(with) - doubleEuler(without)) / 4;
}

bool isSimple(const TopologicalNumbers& numbers)
{
  return numbers.inside == 1 && numbers.outside == 1;
}

} // namespace silhouette
