// SPDX-License-Identifier: BSD-3-Clause
/**
 * The views as every filter uses them: silhouettes, their tiles, projections and policies. This is
 * the one place where a pixel is looked up; whoever asks about a corner or a polygon asks here, so that no two
 * answers can disagree.
 */
#pragma once

#include "Execution.h"
#include "Lattice.h"
#include "Octree.h"
#include "PixelTiles.h"
#include "View.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace silhouette
{

/** What one view says of one point. */
enum class Vote : std::uint8_t
{
  Background = 0,
  Abstain = 1, ///< behind the camera, or beyond a side of the image of which nothing is known
  Object = 2
};

/** What a set of pixels holds, as flags. */
struct PixelContent
{
  bool object = false;
  bool background = false;
  bool abstain = false;
};

struct ViewOptions
{
  OutsidePolicy outside = OutsidePolicy::Border;
};

/** A homogeneous image point: u = U / W, v = V / W; in front of the camera where W > minimumDepth of the view. */
struct HomogeneousPixel
{
  double U = 0.0;
  double V = 0.0;
  double W = 0.0;
};

/** One silhouette, made ready. */
struct PreparedView
{
  std::string name;
  Projection projection;
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> object;    ///< 0 or 1, top row first
  PixelTiles tiles;                    ///< the same, a bit a pixel, for all questions
  std::array<bool, 4> open{};          ///< abstains beyond: left, right, top, bottom
  std::array<int, 4> objectBox{};      ///< least and greatest column, least and greatest row of the object

  /** The silhouette as a whole, top row first, for maps that are made of it; single pixels are asked below. */
  const std::uint8_t* silhouette() const { return this->object.data(); }
  /** The vote of pixel (column, row), which may lie outside the image. */
  Vote pixelVote(int column, int row) const
  {
    if (this->inImage(column, column, row, row))
    {
      return this->tiles.object(column, row) ? Vote::Object : Vote::Background;
    }
    return this->abstainsAt(column, row) ? Vote::Abstain : Vote::Background;
  }
  /** Does a pixel outside the image lie beyond a side of which nothing is known? */
  bool abstainsAt(int column, int row) const
  {
    return (column < 0 && this->open[0]) || (column >= this->width && this->open[1]) ||
      (row < 0 && this->open[2]) || (row >= this->height && this->open[3]);
  }
  /** What the pixels of the given inclusive ranges hold; ranges may reach outside. An empty range holds nothing. */
  PixelContent content(int firstColumn, int lastColumn, int firstRow, int lastRow) const;
  /** Number of object pixels in [c0, c1) x [r0, r1), which lies within the image. */
  std::int64_t objectPixels(int c0, int c1, int r0, int r1) const { return this->tiles.count(c0, c1, r0, r1); }
  /** Do the inclusive ranges lie in the image? */
  bool inImage(int firstColumn, int lastColumn, int firstRow, int lastRow) const
  {
    return firstColumn >= 0 && firstRow >= 0 && lastColumn < this->width && lastRow < this->height;
  }
  /** The same as content() where the ranges lie in the image and are not empty; nothing abstains there. */
  TileContent contentInImage(int firstColumn, int lastColumn, int firstRow, int lastRow) const
  {
    return this->tiles.content(firstColumn, lastColumn, firstRow, lastRow);
  }
  /** Is a pixel of the image object? */
  bool objectInImage(int column, int row) const { return this->tiles.object(column, row); }
  /** The object pixels among 8 x 8 from a pixel of the image on: PixelTiles::window. */
  std::uint64_t window(int column, int row) const { return this->tiles.window(column, row); }
  /** Nearest pixel column or row of an image coordinate; everything outside the image is -1 or `size`. */
  static int nearestPixel(double coordinate, int size)
  {
    // Cutting off is floor for what is not negative, and costs no call.
    const double shifted = coordinate + 0.5;
    return shifted < 0.0 ? -1 : (shifted >= size ? size : int(shifted));
  }
};

/** Rank of a projection, each row taken at unit length; 3 is what a camera needs. */
int projectionRank(const Projection& projection);

class PreparedViews
{
public:
  PreparedViews() = default;
  /**
   * Check the views and make them ready. Throws InvalidInput, naming the view: no views, an empty silhouette
   * image, a pixel array of the wrong length, a projection that is not finite or of rank below 3.
   * Cost: one pass over the pixels, 1.2 bytes of memory a pixel. Views that are moved in are not copied.
   */
  PreparedViews(const std::vector<View>& views, const ViewOptions& options, Execution& execution);
  PreparedViews(std::vector<View>&& views, const ViewOptions& options, Execution& execution);

  int size() const { return int(this->Views.size()); }
  const PreparedView& operator[](int view) const { return this->Views[view]; }
  const ViewOptions& options() const { return this->Options; }
  /** A hash of silhouettes, projections and policies; names do not count. */
  std::uint64_t fingerprint() const { return this->Fingerprint; }

private:
  void prepare(const std::vector<View>& views, std::vector<View>* movable, Execution& execution);

  std::vector<PreparedView> Views;
  ViewOptions Options;
  std::uint64_t Fingerprint = 0;
};

/** A view's projection of a lattice: the one function that projects lattice points. */
struct LatticeProjection
{
  std::array<double, 3> constant{};            ///< U, V, W of lattice point (0, 0, 0)
  std::array<std::array<double, 3>, 3> step{}; ///< step[axis]: change of U, V, W for one lattice step
  double minimumDepth = 0.0;                   ///< points of W at most this are behind the camera

  LatticeProjection() = default;
  LatticeProjection(const Projection& projection, const Lattice& lattice);

  HomogeneousPixel operator()(const LatticePoint& p) const
  {
    HomogeneousPixel h;
    h.U = ((this->constant[0] + this->step[0][0] * p.i) + this->step[1][0] * p.j) + this->step[2][0] * p.k;
    h.V = ((this->constant[1] + this->step[0][1] * p.i) + this->step[1][1] * p.j) + this->step[2][1] * p.k;
    h.W = ((this->constant[2] + this->step[0][2] * p.i) + this->step[1][2] * p.j) + this->step[2][2] * p.k;
    return h;
  }
};

/** Pixels, u and v, that a step of one octant along each axis moves a lattice point; 0 where it is behind the camera. */
Eigen::Matrix<double, 2, 3> pixelSteps(const LatticeProjection& projection, const LatticePoint& p);
/** Pixels that an octant at a lattice point measures across the line of sight; 0 where it is behind the camera. */
double pixelsPerOctant(const LatticeProjection& projection, const LatticePoint& p);

/** The prepared views together with their projections of one lattice. */
class LatticeViews
{
public:
  LatticeViews(const PreparedViews& views, const Lattice& lattice);

  int size() const { return this->Views->size(); }
  const PreparedView& view(int i) const { return (*this->Views)[i]; }
  const LatticeProjection& projection(int i) const { return this->Projections[i]; }
  const Lattice& lattice() const { return this->TheLattice; }
  const PreparedViews& prepared() const { return *this->Views; }

  /** What view `i` says of a lattice point: is this corner background in this view? */
  Vote vote(int i, const LatticePoint& p) const
  {
    const LatticeProjection& projection = this->Projections[std::size_t(i)];
    const auto h = projection(p);
    if (!(h.W > projection.minimumDepth))
    {
      return Vote::Abstain;
    }
    const PreparedView& view = this->view(i);
    return view.pixelVote(
      PreparedView::nearestPixel(h.U / h.W, view.width), PreparedView::nearestPixel(h.V / h.W, view.height));
  }
  /** Inside votes of a lattice point: the views that do not call it background; 0 where no view sees it. */
  int insideVotes(const LatticePoint& p) const;
  /** The same for a point of an octant of which `ask` says whom to ask. */
  int insideVotes(const LatticePoint& p, const ViewsToAsk& ask) const;

private:
  const PreparedViews* Views;
  Lattice TheLattice;
  std::vector<LatticeProjection> Projections;
};

} // namespace silhouette
