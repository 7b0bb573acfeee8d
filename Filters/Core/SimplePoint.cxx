// SPDX-License-Identifier: BSD-3-Clause
#include "SimplePoint.h"

#include "Bits.h"
#include "Lattice.h"
#include "MarchingCubesTable.h"


namespace silhouette
{
namespace
{

constexpr int Centre = 13;

/** Sets of the 27 points, a bit each. */
using Members = std::uint32_t;

constexpr Members All = (Members(1) << 27) - 1;

/** The points whose coordinate on an axis is `value`, 0 to 2. */
constexpr Members layer(int stride, int value)
{
  Members points = 0;
  for (int n = 0; n < 27; ++n)
  {
    points |= Members(n / stride % 3 == value) << n;
  }
  return points;
}

/** Points and those one step before and behind on an axis; the points of an axis follow one another by a stride of 1, 3 or 9. */
template <int Stride> constexpr Members spread(Members points)
{
  return points | (points & ~layer(Stride, 2)) << Stride | (points & ~layer(Stride, 0)) >> Stride;
}

/** Points that differ from one of `from` in at most `step` coordinates, each by one. */
constexpr Members reach(Members from, int step)
{
  const Members alongX = spread<1>(from), alongY = spread<3>(from);
  return step == 1 ? alongX | alongY | spread<9>(from)
    : step == 2    ? spread<3>(alongX) | spread<9>(alongX | alongY)
                   : spread<9>(spread<3>(alongX));
}

/** Points of `from` and those of `among` that are within `step` of one of them. */
Members grow(Members from, Members among, int step)
{
  return from | (among & reach(from, step));
}

/** Those of `members`, the centre left out, that are within `step` of the centre. */
Members around(Members members, int step)
{
  return members & reach(Members(1) << Centre, step) & ~(Members(1) << Centre);
}

/** Number the components of `members`, points within `step` of each other being joined, from the first point on. */
template <typename Name>
int components(Members members, int step, const Name& name)
{
  int count = 0;
  for (; members != 0; ++count)
  {
    Members part = members & (0 - members), wave = part;
    while (wave != 0)
    {
      wave = reach(wave, step) & members & ~part;
      part |= wave;
    }
    members &= ~part;
    name(part, count);
  }
  return count;
}

} // namespace

int solidParts(const Neighbourhood& labels, std::array<std::uint32_t, 26>& parts)
{
  // The geodesic 18-neighbourhood of order 2.
  const auto solid = Members(labels.to_ulong());
  return components(grow(around(solid, 2), around(solid, 3), 2), 2, [&](Members part, int number) { parts[std::size_t(number)] = part; });
}

TopologicalNumbers topologicalNumbers(const Neighbourhood& labels)
{
  TopologicalNumbers numbers;
  std::array<std::uint32_t, 26> parts;
  numbers.inside = solidParts(labels, parts);
  numbers.insideComponent.fill(-1);
  for (int number = 0; number < numbers.inside; ++number)
  {
    for (Members part = parts[std::size_t(number)]; part != 0; part &= part - 1)
    {
      numbers.insideComponent[lowestBit(part)] = std::int8_t(number);
    }
  }
  const Members hollow = ~Members(labels.to_ulong()) & All;
  // Outside: the geodesic 6-neighbourhood of order 3, the first two orders within the 18-neighbourhood.
  const Members second = grow(around(hollow, 1), around(hollow, 2), 1);
  numbers.outside = components(grow(second, around(hollow, 3), 1), 1, [](Members, int) {});
  return numbers;
}

namespace
{

/** Points less segments plus loops of the surface in the eight cells around the centre; what does not touch it stays, whatever its label. */
int doubleEuler(const Neighbourhood& labels)
{
  int points = 0, segments = 0, loops = 0;
  for (const int n : EdgeNeighbours)
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
