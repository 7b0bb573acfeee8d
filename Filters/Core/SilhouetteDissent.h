// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a view says against all others: shared by the repairs of silhouettes.
 */
#pragma once

#include "CornerShell.h"
#include "PreparedViews.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace silhouette
{

constexpr int FinestRefinement = 4; ///< halvings of an octant when pixels are filled

/** The box of the survivors, as lattice points. */
struct SurvivorBox
{
  LatticePoint centre;
  double extent = 0.0; ///< octants along its longest side
};

/** The shell must have corners. */
inline SurvivorBox boxOfSurvivors(const CornerShell& shell)
{
  // A code's bits of one coordinate are in the coordinates' order.
  std::array<std::uint64_t, 3> along{spreadBits(~std::uint64_t(0)), 0, 0}, least, most;
  along[1] = along[0] << 1;
  along[2] = along[0] << 2;
  least = along;
  most = {0, 0, 0};
  for (const std::uint64_t corner : shell.corners)
  {
    for (std::size_t axis = 0; axis < 3; ++axis)
    {
      least[axis] = std::min(least[axis], corner & along[axis]);
      most[axis] = std::max(most[axis], corner & along[axis]);
    }
  }
  const LatticePoint low = fromMorton(least[0] | least[1] | least[2]), high = fromMorton(most[0] | most[1] | most[2]);
  SurvivorBox box;
  box.centre = {(low.i + high.i) / 2, (low.j + high.j) / 2, (low.k + high.k) / 2};
  box.extent = std::max({high.i - low.i, high.j - low.j, high.k - low.k});
  return box;
}

/** The views as they came. */
inline std::vector<View> copyViews(const PreparedViews& views)
{
  std::vector<View> copies(views.size());
  for (int i = 0; i < views.size(); ++i)
  {
    copies[i].name = views[i].name;
    copies[i].projection = views[i].projection;
    copies[i].silhouette = {views[i].width, views[i].height, views[i].object};
  }
  return copies;
}

/** Which views call a lattice point background, as far as need be known. */
struct Dissent
{
  int only = -1;  ///< the only one, or -1
  int last = -1;  ///< the last one that was asked
  int first = -1; ///< the first one
};

/**
 * Half of the views must call a point object for one to be the only dissenter: what hardly any view sees, one
 * may well carve alone.
 */
inline Dissent dissentAt(const LatticeViews& views, const LatticePoint& p)
{
  Dissent dissent;
  int object = 0;
  for (int i = 0; i < views.size(); ++i)
  {
    const Vote vote = views.vote(i, p);
    object += vote == Vote::Object;
    if (vote == Vote::Background)
    {
      if (dissent.last >= 0)
      {
        return {-1, i, dissent.first};
      }
      dissent.first = dissent.last = i;
    }
  }
  dissent.only = 2 * object >= views.size() ? dissent.last : -1;
  return dissent;
}

/** Dissent::only of points near one another: two views that have called the last one background are asked first. */
class OnlyDissenter
{
public:
  explicit OnlyDissenter(const LatticeViews& views)
    : Views(views)
  {
  }

  int at(const LatticePoint& p)
  {
    const auto rejects = [&](int view) { return this->Views.vote(view, p) == Vote::Background; };
    if (this->Last.first >= 0 && rejects(this->Last.first) && rejects(this->Last.last))
    {
      return -1;
    }
    const Dissent dissent = dissentAt(this->Views, p);
    this->Last = dissent.first != dissent.last ? dissent : this->Last;
    return dissent.only;
  }

private:
  const LatticeViews& Views;
  Dissent Last; ///< of the last point that two views rejected
};

/** The lattice refined until an octant in the middle of the survivors is a pixel or two. */
inline Lattice pixelLattice(const LatticeViews& views, const SurvivorBox& box)
{
  double pixels = 1.0;
  for (int i = 0; i < views.size(); ++i)
  {
    pixels = std::max(pixels, pixelsPerOctant(views.projection(i), box.centre));
  }
  Lattice fine = views.lattice();
  fine.depth += std::min({int(std::log2(pixels)), FinestRefinement, MaximumDepth - fine.depth});
  return fine;
}

} // namespace silhouette
