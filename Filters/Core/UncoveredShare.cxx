// SPDX-License-Identifier: BSD-3-Clause
#include "UncoveredShare.h"

#include "ItemWork.h"
#include "OctantCover.h"
#include "ParameterRange.h"
#include "UncoveredRegions.h"
#include "Vectorised.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

namespace silhouette
{
namespace
{

constexpr int BlockGenerations = 3;  ///< survivors are passed over by octants of so many generations before, where all of their pixels are covered
constexpr double LeastContact = 0.5; ///< octants times lengthScale(): shorter ends and sides of a region are noise, such as a hole beside the contour

/** Is some of the pixels object and held by nothing? */
SILHOUETTE_VECTORISED bool anyUncovered(const std::int32_t* held, const std::uint8_t* object, int count)
{
  int any = 0;
  for (int n = 0; n < count; ++n)
  {
    any |= held[n] == 0 ? int(object[n]) : 0;
  }
  return any != 0;
}

/**
 * How many pixels an octant of the last generation is wide in the middle of the root cube; 0 where it is not
 * seen.
 */
double pixelsPerOctant(const LatticeProjection& projection, const Lattice& lattice)
{
  const std::int32_t middle = lattice.cells() / 2;
  Vector2 p[8];
  if (!projectOctant(projection, { middle, middle, middle }, 1, p))
  {
    return 0.0;
  }
  double longest = 0.0;
  for (const int neighbour : { 1, 2, 4 })
  {
    longest = std::max(longest, (p[neighbour] - p[0]).norm());
  }
  return longest;
}

} // namespace

double pixelsPerOctant(const PreparedViews& views, const Lattice& lattice)
{
  const LatticeViews latticeViews(views, lattice);
  double sum = 0.0;
  int seeing = 0;
  for (int view = 0; view < views.size(); ++view)
  {
    const double pixels = pixelsPerOctant(latticeViews.projection(view), lattice);
    sum += pixels;
    seeing += pixels > 0.0;
  }
  return seeing > 0 ? sum / seeing : 0.0;
}

namespace
{

/** Measures views, one after another, in memory that it keeps. */
class ShareMeasure
{
public:
  ShareMeasure(const Octree& octree, const UncoveredShareOptions& options)
    : TheOctree(&octree)
    , Options(&options)
  {
  }

  double share(const PreparedView& view, const LatticeProjection& projection)
  {
    const std::int64_t objects = view.objectPixels(0, view.width, 0, view.height);
    const double octant = pixelsPerOctant(projection, this->TheOctree->lattice);
    if (objects == 0 || octant == 0.0)
    {
      return 0.0;
    }
    const double proportion = octant * lengthScale(this->TheOctree->lattice);
    LostPartLimits limits;
    limits.area = std::max(limits.area, this->Options->speckArea * octant * octant);
    limits.contact = std::max(limits.contact, LeastContact * proportion);
    limits.distance = this->Options->bridged * proportion;
    this->Count.begin(windowOf(view, limits.distance));
    this->addSurvivors(projection, this->Options->reach * octant);
    this->findUncovered(view);
    return double(this->Uncovered.size()) < limits.area ? 0.0 : double(this->lostPixels(limits)) / double(objects);
  }

private:
  /** The object and all that is not too far to tell how far its pixels are from what is covered. */
  static ImageWindow windowOf(const PreparedView& view, double distance)
  {
    const auto margin = int(std::min(std::ceil(distance), double(std::max(view.width, view.height)))) + 2;
    const auto& box = view.objectBox;
    return { std::max(box[0] - margin, 0), std::min(box[1] + margin + 1, view.width), std::max(box[2] - margin, 0),
      std::min(box[3] + margin + 1, view.height) };
  }

  void findUncovered(const PreparedView& view)
  {
    const ImageWindow& window = this->Count.window();
    this->Uncovered.clear();
    this->Count.forRows(
      [&](int row, const std::int32_t* held)
      {
        const std::uint8_t* object = view.silhouette() + std::size_t(window.top + row) * std::size_t(view.width) + window.left;
        const bool isAny = anyUncovered(held, object, window.width());
        for (int column = 0; isAny && column < window.width(); ++column)
        {
          if (held[column] == 0 && object[column] != 0)
          {
            this->Uncovered.emplace_back(row, column);
          }
        }
      });
  }

  std::uint64_t lostPixels(const LostPartLimits& limits)
  {
    const ImageWindow& window = this->Count.window();
    this->Covered.width = window.width();
    this->Covered.height = window.height();
    this->Covered.pixels.clear();
    this->Count.forRows(
      [&](int, const std::int32_t* held)
      { std::transform(held, held + window.width(), std::back_inserter(this->Covered.pixels), [](std::int32_t count) { return std::uint8_t(count != 0); }); });
    return pixelsOfLostParts(this->Uncovered, this->Covered, limits);
  }

  void addSurvivors(const LatticeProjection& projection, double reach)
  {
    for (int g = this->TheOctree->treeGeneration; g <= this->TheOctree->lattice.depth; ++g)
    {
      this->addSurvivors(g, projection, reach);
    }
  }

  /** Those of a generation, but such as lie in an octant, a few generations before, of which all pixels are held. */
  void addSurvivors(int g, const LatticeProjection& projection, double reach)
  {
    const Generation& generation = this->TheOctree->generations[g];
    const int shift = this->TheOctree->lattice.depth - g, blockGenerations = std::min(g, BlockGenerations);
    const bool areLeaves = shift == 0;
    const auto lowestOf = [](std::uint64_t code, int halvings)
    {
      const LatticePoint at = fromMorton(code);
      return LatticePoint{ at.i << halvings, at.j << halvings, at.k << halvings };
    };
    const auto flush = [&] { areLeaves ? addLeaves(projection, reach, this->Octants, this->Count) : addOctants(projection, 1 << shift, this->Octants, this->Count); };
    std::uint64_t block = ~std::uint64_t(0); // of the last survivor
    for (std::size_t n = 0; n < generation.size(); ++n)
    {
      const OctantState state = generation.state[n];
      if (areLeaves ? state == OctantState::Background : state != OctantState::Inside)
      {
        continue;
      }
      const std::uint64_t own = generation.code[n] >> 3 * blockGenerations;
      const int size = shift + blockGenerations;
      if (own != block && isOctantHeld(projection, lowestOf(own, size), 1 << size, areLeaves ? reach : 0.0, this->Count))
      {
        const auto next = std::lower_bound(generation.code.begin() + std::ptrdiff_t(n), generation.code.end(), (own + 1) << 3 * blockGenerations);
        n = std::size_t(next - generation.code.begin()) - 1;
        continue;
      }
      block = own;
      this->Octants.add(lowestOf(generation.code[n], shift));
      if (this->Octants.count == OctantBlock::Most)
      {
        flush();
      }
    }
    flush();
  }

  const Octree* TheOctree;
  const UncoveredShareOptions* Options;
  CoverCount Count;
  OctantBlock Octants;
  std::vector<RowColumn> Uncovered;
  BinaryImage Covered;
};

void check(const Octree& octree, const PreparedViews& views, const UncoveredShareOptions& options)
{
  constexpr double most = 1e9; // octants
  requireRange("reach", options.reach, 0.0, most);
  requireRange("speck area", options.speckArea, 0.0, most);
  requireRange("bridged distance", options.bridged, 0.0, most);
  if (octree.viewCount != views.size())
  {
    throw InvalidInput("the octree was carved from " + std::to_string(octree.viewCount) +
      " views, not from " + std::to_string(views.size()));
  }
}

} // namespace

std::vector<double> uncoveredShares(const Octree& octree, const PreparedViews& views,
  const UncoveredShareOptions& options, Execution& execution)
{
  check(octree, views, options);
  std::vector<double> shares(std::size_t(views.size()), 0.0);
  if (octree.generations.empty())
  {
    return shares;
  }
  const LatticeViews latticeViews(views, octree.lattice);
  std::vector<ShareMeasure> measures(itemsAtATime(execution), ShareMeasure(octree, options));
  forItems(shares.size(), execution,
    [&](std::size_t n) { shares[n] = measures[n % measures.size()].share(views[int(n)], latticeViews.projection(int(n))); });
  return shares;
}

} // namespace silhouette
