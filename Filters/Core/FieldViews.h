// SPDX-License-Identifier: BSD-3-Clause
/**
 * The views as a field over space: how far, in octants, does a lattice point lie inside a view's silhouette?
 */
#pragma once

#include "BlockGroups.h"
#include "DistanceMap.h"
#include "OutlineRendering.h"
#include "PreparedViews.h"

#include <vector>

namespace silhouette
{

class FieldViews
{
public:
  /**
   * Distances will be exact up to `reach` octants and cut off there. `samples`, 0 or more: so many an octant, at least, are
   * taken of them; 0 takes all pixels'. `views` is not copied and has to outlive this.
   */
  FieldViews(const PreparedViews& views, const Lattice& lattice, double reach, double samples = 0.0);

  /** Make the observed silhouettes' distances of these views, where they are not made yet. Cost: distanceMap() of each. */
  void observe(const std::vector<int>& views, Execution& execution);

  /**
   * From now on see the points of this lattice, with no view shifted. What has been observed stays, so `reach`, in the lattice's octants, should be no longer than
   * before.
   */
  void look(const Lattice& lattice, double reach);

  int size() const { return this->Views->size(); }
  const Lattice& lattice() const { return this->TheLattice; }
  double reach() const { return this->Reach; }
  /** The observed silhouette's distances; observe() has made them. */
  const DistanceMap& observed(int view) const { return this->Observed[view]; }
  bool isObserved(int view) const { return this->Observed[view].width > 0; }
  /** The same distances, of all pixels, for whoever asks about few places; of any view. */
  DistancesOnDemand observedOnDemand(int view) const;

  /** Cameras of some views (shifted), for the silhouettes of a mesh as they would see it. */
  std::vector<ImageCamera> cameras(const std::vector<int>& views) const;
  /** The distances in the silhouettes of a mesh as all views (shifted) would see it. Cost: OutlineRenderer, and distanceMap() of each. */
  std::vector<DistanceMap> distances(const Mesh& mesh, Execution& execution) const;

  /** px: what is added to every projected point of a view. */
  const Vector2& shift(int view) const { return this->Shifts[view]; }
  void addShift(int view, const Vector2& shift);
  /** Pixels for an octant at the lattice's centre of interest. */
  double pixelsPerOctant(int view) const { return this->CentreScale[view]; }

  /** Pixels, u and v, for a step of one octant along each axis there; 0 for a view that has it behind it. */
  Eigen::Matrix<double, 2, 3> pixelSteps(int view) const;

  /** Where a lattice point falls. */
  struct Place
  {
    double u = 0.0;
    double v = 0.0;
    double octantsPerPixel = 0.0; ///< 0 where the view abstains
  };
  Place place(int view, const LatticePoint& p) const;
  /** Octants inside the silhouette, cut off at the reach; the whole reach where the view abstains. */
  float inside(const DistanceMap& map, const Place& place) const
  {
    return place.octantsPerPixel > 0.0
      ? std::clamp(float(map.at(place.u, place.v) * place.octantsPerPixel), -float(this->Reach), float(this->Reach))
      : float(this->Reach);
  }

  static constexpr int BlockSize = 4;             ///< points a side of a block
  static constexpr std::size_t BlockPoints = 64; ///< consecutive in Morton order

  /** A box of pixels around a cube of lattice points, and the least octantsPerPixel in it; 0 where it is not all seen. */
  struct Region
  {
    double firstU, lastU, firstV, lastV, octantsPerPixel;
  };
  Region region(int view, const LatticePoint& lowest, int size) const;
  /**
   * inside() of the places of the points of some groups of a block, to 1e-4 octants, in a map of the view: one group's after another's. `region` is that of the block.
   */
  void insideBlock(int view, const LatticePoint& lowest, const Region& region, const BlockGroups& groups, const DistanceMap& map, float* inside) const;
  /** insideBlock() of this region and map comes soon: what it reads may be fetched meanwhile. */
  void fetch(const DistanceMap& map, const Region& region) const;
  /** Is inside() the whole reach for all points of a region? May say no where it is. */
  bool wholeReach(const DistanceMap& map, const Region& region) const
  {
    return float(map.reach * region.octantsPerPixel) >= float(this->Reach) &&
      map.farInside(region.firstU, region.lastU, region.firstV, region.lastV);
  }

private:
  void project(int view);
  /** px: observed distances are exact up to here. */
  double reachInPixels(int view) const;
  DistanceMap distances(int view, const std::uint8_t* object, DistanceMapper& mapper) const;

  const PreparedViews* Views;
  Lattice TheLattice;
  double Reach;
  double Samples; ///< of distances for an octant, or 0
  std::vector<Vector2> Shifts;
  std::vector<Projection> Projections; ///< shifted
  std::vector<LatticeProjection> OnLattice; ///< shifted
  std::vector<double> CentreScale;
  std::vector<double> DepthScale; ///< octants a pixel for each unit of W, as at the lattice's middle
  std::vector<DistanceMap> Observed;
};

} // namespace silhouette
