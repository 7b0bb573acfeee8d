// SPDX-License-Identifier: BSD-3-Clause
/**
 * The corrected field (Documentation/method.md, section 4). The least of many noisy distances is too small; so
 * the surface is moved to where the views whose contours pass a point agree on average, after shifting the
 * views against each other's camera errors.
 *
 * With g_i(x) the signed distance of a point in view i's observed silhouette and d_i(x) that in the silhouette
 * of a model, the field is min_i d_i + sum_i w_i (g_i - d_i) / sum_i w_i with w_i = exp(-(d_i - min d)^2 / 2
 * h^2). A model whose silhouettes are the observed ones is left as it is, whatever its shape; and parts that no
 * silhouette shows come from min_i d_i. The model is the n-th least g_i, n a share of the views, no further than twice the deficit
 * outside of the least, smoothed; where it is near-convex, its hull. Where noise is so strong that smoothing is wide, all this is done on a coarser
 * lattice (FieldRefinement.h).
 */
#pragma once

#include "BrickField.h"
#include "HullBase.h"
#include "PreparedViews.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace silhouette
{

struct FieldCorrectionOptions
{
  bool alignViews = true; ///< shift views against the camera's error, as far as the contours show it
  bool moveSurface = true; ///< correct the field for the noise's bias; without it the views' shifts alone count
  /**
   * Octants, 0 or more: silhouettes whose deficit is at most this, and whose shift is small too, are taken as
   * they are; larger corrects less.
   */
  double smallestDeficit = 0.035;
  /**
   * Octants, 0 or more: the same for the mean shift between the surface's contours and the silhouettes', which
   * cameras' errors raise first. It counts from half the smallest deficit on; a shift of a tenth of a pixel or less
   * is the pixels' own, and never does.
   */
  double smallestShift = 0.025;
  /**
   * Share of the shifts' squares, 0 or more: where chance explains more of them (noiseShare()) contours are noisy, not cameras wrong, and no view is shifted. Larger
   * shifts more readily.
   */
  double shiftNoise = 0.2;
  int alignments = 3; ///< rounds of shifting, 1 or more; larger comes closer and costs in proportion
  /**
   * Share of the views, 0 to 1: the model's value at a point is the n-th least of the views' distances, n being this share of them, at least 2; larger
   * keeps more of what is nearly as thin as the noise. Beyond depth 7 in inverse proportion to 2^depth, since fewer views compete within an octant.
   */
  double modelDissent = 0.11;
  /**
   * Octants for each octant of deficit, 0 or more: standard deviation of the field's smoothing; larger is
   * smoother.
   */
  double smoothing = 10.0;
  /** Octants at depth 7, in proportion to 2^depth, 0 or more: the largest standard deviation of the smoothing. */
  double greatestSmoothing = 3.0;
  /**
   * Octants for each octant of deficit, 0 or more: the most that smoothing changes a value, so that thin parts
   * stay; larger smooths more.
   */
  double gentleness = 0.7;
  /**
   * Octants at depth 7, in proportion to 2^depth, above 0: h, how far from a view's contour it is heard; larger
   * averages more views.
   */
  double contourReach = 0.6;
  /**
   * Share of its convex hull, 0 or more: a model that fills more of it is given the hull for its base
   * (applyHullBase()); 1 or more gives none.
   */
  double hullConvexity = 0.97;
  /** Octants, 0 or more: how far around survivors that the field leaves outside it is raised towards them (FieldRaising.h); 0 raises nothing, larger blends in more widely. */
  double raiseWidth = 1.5;
};

/** A field, and what was found on the way. */
struct FieldCorrection
{
  std::optional<BrickField> field; ///< positive inside; nothing where the silhouettes need no correction
  double deficit = 0.0;            ///< octants: how far the observed contours lie outside the surface's
  double shift = 0.0;              ///< octants: how far they are shifted against the surface's, the mean over the views
  double remainingDeficit = 0.0;   ///< the same after the views were shifted
  double alignment = 0.0;          ///< px: the mean length of the views' shifts
  HullBase hull;                   ///< of the model that the views are compared with
};

/**
 * Correct `surface`, marching cubes' of the views. `survivors`: leaf cells (Morton codes, ascending) of an octree of these views, or of such with more background, with so many
 * background votes, below the number of views; the surface will have to cross them. Throws InvalidInput for an option out of range, Cancelled.
 * Cost: the deficit renders every third view, or every sixth where there is none to speak of; a correction renders every view two times or more and looks up
 * each one's distance at the points of a band.
 */
FieldCorrection correctField(const Mesh& surface, const Lattice& lattice, const PreparedViews& views,
  const FieldCorrectionOptions& options, const std::vector<std::uint64_t>& survivors, int backgroundVotes, Execution& execution);

} // namespace silhouette
