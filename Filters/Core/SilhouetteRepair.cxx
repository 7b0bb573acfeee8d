// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteRepair.h"

#include "PointComponents.h"
#include "RejectedCorners.h"
#include "SilhouetteDissent.h"
#include "SilhouetteSpeckles.h"

#include <algorithm>
#include <cmath>

namespace silhouette
{
namespace
{

constexpr int MostRounds = 4;          ///< where blobs cross, filling one may bare another
constexpr double FewViewsChord = 3.0;  ///< over the number of views: extents that any view may cut
constexpr double FewViewsDepth = 85.0; ///< over their square: slivers between neighbouring views are that deep
constexpr double WrongViewChord = 0.7; ///< of the chord asked for, in a view that has a blob

void requireRange(const char* what, double value, double least, double greatest)
{
  if (!(value >= least && value <= greatest))
  {
    throw InvalidInput(std::string(what) + " " + std::to_string(value) + " is outside " +
                       std::to_string(least) + " to " + std::to_string(greatest));
  }
}

void check(const SilhouetteRepairOptions& options)
{
  constexpr double largest = 1e9; // octants; whatever is not finite is beyond it
  requireRange("speckle area", options.speckleArea, 0.0, largest);
  requireRange("speckle share", options.speckleShare, 0.0, 1.0);
  requireRange("blob depth", options.blobDepth, 0.0, largest);
  requireRange("blob chord", options.blobChord, 0.0, 1.0);
  requireRange("blob corners", options.blobCorners, 1.0, largest);
}

/** Is no object within `depth` octants of the corner, in the view that rejects it? */
bool isDeep(const LatticeViews& views, const Rejected& rejected, double depth)
{
  const LatticeProjection& projection = views.projection(rejected.view);
  const LatticePoint p = fromMorton(rejected.corner);
  const auto h = projection(p);
  const PreparedView& view = views.view(rejected.view);
  const double u = h.U / h.W, v = h.V / h.W, radius = depth * pixelsPerOctant(projection, p);
  // Three rectangles whose corners lie on the circle stand for the disc: a few table look-ups.
  static const double cosines[] = {std::cos(0.3926990816987241), std::cos(0.7853981633974483), std::cos(1.1780972450961724)};
  static const double sines[] = {std::sin(0.3926990816987241), std::sin(0.7853981633974483), std::sin(1.1780972450961724)};
  for (int n = 0; n < 3; ++n)
  {
    const double a = radius * cosines[n], b = radius * sines[n];
    const auto content = view.content(
        PreparedView::nearestPixel(u - a, view.width), PreparedView::nearestPixel(u + a, view.width),
        PreparedView::nearestPixel(v - b, view.height), PreparedView::nearestPixel(v + b, view.height));
    if (content.object || content.abstain)
    {
      return false;
    }
  }
  return true;
}

/** Squares of an octant's size of a view's image that hold one of the corners. */
std::size_t imageArea(const LatticeProjection& projection, const std::vector<std::uint64_t>& corners, double pixels)
{
  std::vector<std::uint64_t> squares;
  for (const std::uint64_t corner : corners)
  {
    const auto h = projection(fromMorton(corner));
    const auto column = std::int32_t(std::floor(h.U / h.W / pixels)),
               row = std::int32_t(std::floor(h.V / h.W / pixels));
    squares.push_back(std::uint64_t(std::uint32_t(column)) << 32 | std::uint32_t(row));
  }
  sortUnique(squares);
  return squares.size();
}

/**
 * Of the corners that one view rejects, ascending, those of its blobs: of the large components, neighbours along edges and diagonals being together, that
 * are long along the view.
 */
std::vector<std::uint64_t> longAlongTheView(const LatticeViews& views, int view, const std::vector<std::uint64_t>& corners,
                                            const SurvivorBox& box, const SilhouetteRepairOptions& options)
{
  const LatticeProjection& projection = views.projection(view);
  const auto components = pointComponents(corners, Steps::Corners, std::size_t(options.blobCorners));
  std::vector<double> chords;
  for (const auto& component : components)
  {
    const double pixels = pixelsPerOctant(projection, fromMorton(component.front()));
    chords.push_back(double(component.size()) / double(imageArea(projection, component, pixels)));
  }
  const double chord = std::max(options.blobChord, FewViewsChord / views.size()) * box.extent;
  std::vector<std::uint64_t> blobs;
  // A view that is wrong elsewhere is trusted less: where a disc crosses the contour, its chord is short.
  const bool isWrong = std::any_of(chords.begin(), chords.end(), [&](double own) { return own >= chord; });
  for (std::size_t c = 0; c < components.size() && isWrong; ++c)
  {
    if (chords[c] >= WrongViewChord * chord)
    {
      blobs.insert(blobs.end(), components[c].begin(), components[c].end());
    }
  }
  return blobs;
}

/** The deep corners of blobs: of components that are long along the view, by view. */
std::vector<std::vector<std::uint64_t>> findBlobs(const Octree& octree, const LatticeViews& views, const CornerShell& shell,
                                                  const SurvivorBox& box,
                                                  const SilhouetteRepairOptions& options,
                                                  KnownVotes::Votes& votes, Execution& execution)
{
  const std::vector<Rejected> corners = findRejected(octree, views, shell, votes, execution);
  std::vector<std::uint8_t> deep(corners.size(), 0);
  const double depth = std::max(options.blobDepth, FewViewsDepth / (double(views.size()) * views.size()));
  execution.forRanges(corners.size(), 1024,
                      [&](std::size_t first, std::size_t last)
                      {
                        for (std::size_t c = first; c < last; ++c)
                        {
                          deep[c] = isDeep(views, corners[c], depth) ? 1 : 0;
                        }
                      });
  std::vector<std::vector<std::uint64_t>> ofViews(std::size_t(views.size()));
  for (std::size_t c = 0; c < corners.size(); ++c)
  {
    if (deep[c] != 0)
    {
      ofViews[std::size_t(corners[c].view)].push_back(corners[c].corner);
    }
  }
  std::vector<std::vector<std::uint64_t>> blobs(ofViews.size());
  execution.forRanges(ofViews.size(), 1,
                      [&](std::size_t first, std::size_t last)
                      {
                        for (std::size_t view = first; view < last; ++view)
                        {
                          blobs[view] = longAlongTheView(views, int(view), ofViews[view], box, options);
                        }
                      });
  return blobs;
}

/** The corners within `reach` steps of the given ones. */
std::vector<std::uint64_t> dilated(std::vector<std::uint64_t> corners, int reach, std::int32_t n)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    std::vector<std::uint64_t> wider;
    for (const std::uint64_t corner : corners)
    {
      const LatticePoint p = fromMorton(corner);
      for (int step = -reach; step <= reach; ++step)
      {
        const LatticePoint q = {p.i + (axis == 0 ? step : 0), p.j + (axis == 1 ? step : 0),
                                p.k + (axis == 2 ? step : 0)};
        if (isOfLattice(q, n))
        {
          wider.push_back(mortonCode(q));
        }
      }
    }
    sortUnique(wider);
    corners.swap(wider);
  }
  return corners;
}

/**
 * Fill the background pixels of view `i` that a point near the blob's corners falls into which every other
 * view calls object. The points are those of a lattice about as fine as the pixels, `halvings` finer than the
 * octree's, so that the contour stays where the other views have it. Returns how many.
 */
std::uint64_t fillBlobs(const LatticeViews& fine, int halvings, int i,
                        const std::vector<std::uint64_t>& corners, BinaryImage& mask)
{
  std::uint64_t filled = 0;
  const std::int32_t size = std::int32_t(1) << halvings, n = fine.lattice().cells();
  const LatticeProjection& projection = fine.projection(i);
  int objector = i; // the view that rejected the last point is likely to reject the next one
  for (const std::uint64_t corner : corners)
  {
    const LatticePoint p = fromMorton(corner);
    for (std::int32_t s = 0; s < size * size * size; ++s)
    {
      const LatticePoint q = {p.i * size + s % size - size / 2, p.j * size + s / size % size - size / 2,
                              p.k * size + s / size / size - size / 2};
      const auto h = projection(q);
      if (!isOfLattice(q, n) || !(h.W > projection.minimumDepth))
      {
        continue;
      }
      const int column = PreparedView::nearestPixel(h.U / h.W, mask.width);
      const int row = PreparedView::nearestPixel(h.V / h.W, mask.height);
      if (column < 0 || row < 0 || column >= mask.width || row >= mask.height || mask.at(column, row) != 0 ||
          (objector != i && fine.vote(objector, q) == Vote::Background))
      {
        continue;
      }
      const Dissent dissent = dissentAt(fine, q);
      if (dissent.only == i)
      {
        mask.at(column, row) = 1;
        ++filled;
      }
      objector = dissent.last >= 0 ? dissent.last : i;
    }
  }
  return filled;
}

/** The views with their blobs filled, or nothing where there are none; adds to `filled` by view. */
std::optional<PreparedViews> withoutBlobs(const Octree& octree, const LatticeViews& lattice, const CornerShell& shell,
                                          const SurvivorBox& box, const SilhouetteRepairOptions& options,
                                          std::vector<std::uint64_t>& filled, KnownVotes::Votes& votes,
                                          Execution& execution)
{
  const PreparedViews& views = lattice.prepared();
  const auto blobs = findBlobs(octree, lattice, shell, box, options, votes, execution);
  if (std::all_of(blobs.begin(), blobs.end(), [](const auto& corners) { return corners.empty(); }))
  {
    return std::nullopt;
  }
  const Lattice finer = pixelLattice(lattice, box);
  const int halvings = finer.depth - lattice.lattice().depth;
  const LatticeViews fine(views, finer);
  const int reach = 1 + int(std::ceil(std::min(options.blobDepth, double(lattice.lattice().cells()))));
  std::vector<View> repaired = copyViews(views);
  std::vector<std::uint64_t> counts(views.size(), 0);
  execution.forRanges(views.size(), 1,
                      [&](std::size_t first, std::size_t last)
                      {
                        for (std::size_t i = first; i < last; ++i)
                        {
                          const auto corners = dilated(blobs[i], reach, lattice.lattice().cells());
                          counts[i] = fillBlobs(fine, halvings, int(i), corners, repaired[i].silhouette);
                        }
                      });
  std::uint64_t total = 0;
  for (int i = 0; i < views.size(); ++i)
  {
    filled[i] += counts[i];
    total += counts[i];
  }
  return total > 0 ? std::optional<PreparedViews>(PreparedViews(repaired, views.options(), execution))
                   : std::nullopt;
}

} // namespace

SilhouetteRepair repairSilhouettes(const Octree& octree, const CornerShell& shell, const PreparedViews& views,
                                   const SilhouetteRepairOptions& options, Execution& execution)
{
  check(options);
  execution.checkpoint(0.0);
  SilhouetteRepair result;
  result.speckles.assign(views.size(), 0);
  result.blobs.assign(views.size(), 0);
  if (shell.corners.empty())
  {
    return result;
  }
  const SurvivorBox box = boxOfSurvivors(shell);
  result.views =
      withoutSpeckles(LatticeViews(views, octree.lattice), box, options, result.speckles, execution);
  for (int round = 0; round < MostRounds; ++round)
  {
    Phase phase(execution, (round + 1.0) / (MostRounds + 1), (round + 2.0) / (MostRounds + 1));
    phase.checkpoint(0.0);
    const LatticeViews now(result.views ? *result.views : views, octree.lattice);
    auto repaired = withoutBlobs(octree, now, shell, box, options, result.blobs, result.votes, phase);
    if (!repaired)
    {
      break;
    }
    result.views = std::move(repaired);
    result.votes.reset();
  }
  execution.checkpoint(1.0);
  return result;
}

} // namespace silhouette
