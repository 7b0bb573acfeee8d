// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteRepair.h"

#include "BlobFilling.h"
#include "ImageSquares.h"
#include "ParameterRange.h"
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

void check(const SilhouetteRepairOptions& options)
{
  constexpr double most = 1e9; // octants; beyond it products may be infinite
  requireRange("speckle area", options.speckleArea, 0.0, most);
  requireRange("speckle share", options.speckleShare, 0.0, 1.0);
  requireRange("blob depth", options.blobDepth, 0.0, most);
  requireRange("blob chord", options.blobChord, 0.0, 1.0);
  requireRange("blob corners", options.blobCorners, 1);
}

/** Is no object within `depth` octants of the corner, in the view that rejects it? */
bool isDeep(const LatticeViews& views, int rejecting, const LatticePoint& p, double depth)
{
  const LatticeProjection& projection = views.projection(rejecting);
  const auto h = projection(p);
  const PreparedView& view = views.view(rejecting);
  const double u = h.U / h.W, v = h.V / h.W, radius = depth * pixelsPerOctant(projection, p);
  const auto isFree = [&](double a, double b)
  {
    const auto content = view.content(
        PreparedView::nearestPixel(u - a, view.width), PreparedView::nearestPixel(u + a, view.width),
        PreparedView::nearestPixel(v - b, view.height), PreparedView::nearestPixel(v + b, view.height));
    return !content.object && !content.abstain;
  };
  // Three rectangles whose corners lie on the circle stand for the disc, or the square around them: a few table look-ups.
  static const double cosines[] = {std::cos(0.3926990816987241), std::cos(0.7853981633974483), std::cos(1.1780972450961724)};
  static const double sines[] = {std::sin(0.3926990816987241), std::sin(0.7853981633974483), std::sin(1.1780972450961724)};
  return isFree(radius * cosines[0], radius * sines[2]) ||
         (isFree(radius * cosines[0], radius * sines[0]) && isFree(radius * cosines[1], radius * sines[1]) &&
          isFree(radius * cosines[2], radius * sines[2]));
}

/** Squares of an octant's size of a view's image that hold one of the corners. */
std::size_t imageArea(const LatticeProjection& projection, const PointComponent& component)
{
  ImageSquares squares(projection, pixelsPerOctant(projection, fromMorton(component.first())));
  for (const BlockWord& word : component.words)
  {
    forCodes(word, [&](std::uint64_t corner) { squares.add(fromMorton(corner)); });
  }
  for (const PointCube& cube : component.cubes)
  {
    squares.add(cube);
  }
  return squares.count();
}

/**
 * Of the deep corners that one view rejects those of its blobs: of the large components, neighbours along edges and diagonals
 * being together, that are long along the view.
 */
Blobs longAlongTheView(const LatticeViews& views, int view, const Blobs& deep, const SurvivorBox& box, const SilhouetteRepairOptions& options)
{
  const double chord = std::max(options.blobChord, FewViewsChord / views.size()) * box.extent;
  // A component's image is at least one square.
  const std::size_t least = std::max(std::size_t(options.blobCorners), std::size_t(WrongViewChord * chord));
  const auto components = pointComponents(deep.words, deep.cubes, Steps::Corners, least);
  std::vector<double> chords;
  for (const PointComponent& component : components)
  {
    chords.push_back(double(component.size) / double(imageArea(views.projection(view), component)));
  }
  Blobs blobs;
  // A view that is wrong elsewhere is trusted less: where a disc crosses the contour, its chord is short.
  const bool isWrong = std::any_of(chords.begin(), chords.end(), [&](double own) { return own >= chord; });
  for (std::size_t c = 0; c < components.size() && isWrong; ++c)
  {
    if (chords[c] >= WrongViewChord * chord)
    {
      blobs.words.insert(blobs.words.end(), components[c].words.begin(), components[c].words.end());
      blobs.cubes.insert(blobs.cubes.end(), components[c].cubes.begin(), components[c].cubes.end());
    }
  }
  std::sort(blobs.words.begin(), blobs.words.end(), [](const BlockWord& a, const BlockWord& b) { return a.block < b.block; });
  blobs.words = unitedWords(blobs.words, {});
  std::sort(blobs.cubes.begin(), blobs.cubes.end(), [](const PointCube& a, const PointCube& b) { return a.corner < b.corner; });
  return blobs;
}

/** The deep ones of the corners that one view alone rejects, by view. */
std::vector<Blobs> deepCorners(const Octree& octree, const LatticeViews& views, const CornerShell& shell, const SilhouetteRepairOptions& options,
                               KnownVotes::Votes& votes, Execution& execution)
{
  const double depth = std::max(options.blobDepth, FewViewsDepth / (double(views.size()) * views.size()));
  RejectedCorners rejected = findRejected(octree, views, shell, depth, votes, execution);
  std::vector<RejectedWord>& words = rejected.words;
  execution.forRanges(words.size(), 64,
                      [&](std::size_t first, std::size_t last)
                      {
                        for (std::size_t n = first; n < last; ++n)
                        {
                          const auto keepDeep = [&, view = words[n].view](std::uint64_t corner)
                          {
                            const bool deep = isDeep(views, view, fromMorton(corner), depth);
                            words[n].corners.bits &= ~(std::uint64_t(deep ? 0 : 1) << (corner & 63));
                          };
                          forCodes(BlockWord(words[n].corners), keepDeep);
                        }
                      });
  std::vector<Blobs> ofViews(std::size_t(views.size()));
  for (const RejectedWord& word : words)
  {
    if (word.corners.bits != 0)
    {
      ofViews[std::size_t(word.view)].words.push_back(word.corners);
    }
  }
  for (const RejectedCube& one : rejected.cubes)
  {
    ofViews[std::size_t(one.view)].cubes.push_back(one.cube);
  }
  return ofViews;
}

/** The deep corners of blobs: of components that are long along the view, by view. */
std::vector<Blobs> findBlobs(const Octree& octree, const LatticeViews& views, const CornerShell& shell, const SurvivorBox& box,
                             const SilhouetteRepairOptions& options, KnownVotes::Votes& votes, Execution& execution)
{
  const std::vector<Blobs> deep = deepCorners(octree, views, shell, options, votes, execution);
  execution.checkpoint(0.0);
  std::vector<Blobs> blobs(deep.size());
  execution.forRanges(deep.size(), 1,
                      [&](std::size_t first, std::size_t last)
                      {
                        for (std::size_t view = first; view < last; ++view)
                        {
                          blobs[view] = longAlongTheView(views, int(view), deep[view], box, options);
                        }
                      });
  return blobs;
}

/** The views with their blobs filled, or nothing where there are none; adds to `filled` by view. */
std::optional<PreparedViews> withoutBlobs(const Octree& octree, const LatticeViews& lattice, const CornerShell& shell,
                                          const SurvivorBox& box, const SilhouetteRepairOptions& options,
                                          std::vector<std::uint64_t>& filled, KnownVotes::Votes& votes,
                                          Execution& execution)
{
  const PreparedViews& views = lattice.prepared();
  const auto blobs = findBlobs(octree, lattice, shell, box, options, votes, execution);
  if (std::all_of(blobs.begin(), blobs.end(), [](const Blobs& ofView) { return ofView.empty(); }))
  {
    return std::nullopt;
  }
  const Lattice finer = pixelLattice(lattice, box);
  const int octants = int(std::ceil(std::min(options.blobDepth, double(lattice.lattice().cells()))));
  std::vector<View> repaired = copyViews(views);
  const BlobFilling filling = fillBlobs(
    LatticeViews(views, finer), blobs, { finer.depth - lattice.lattice().depth, 1 + octants }, repaired, execution);
  for (std::size_t i = 0; i < filled.size(); ++i)
  {
    filled[i] += filling.pixels[i];
  }
  const bool isAny = std::any_of(filling.pixels.begin(), filling.pixels.end(), [](std::uint64_t pixels) { return pixels > 0; });
  return isAny ? std::optional<PreparedViews>(PreparedViews(repaired, views.options(), execution)) : std::nullopt;
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
