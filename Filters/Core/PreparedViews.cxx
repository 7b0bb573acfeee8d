// SPDX-License-Identifier: BSD-3-Clause
#include "PreparedViews.h"

#include <Eigen/LU>

#include <cmath>
#include <cstring>

namespace silhouette
{
namespace
{

/** 64-bit FNV-1a, eight bytes at a time where there are eight. */
class Fingerprinter
{
public:
  void add(const void* data, std::size_t bytes)
  {
    const auto* at = static_cast<const unsigned char*>(data);
    for (; bytes >= 8; bytes -= 8, at += 8)
    {
      std::uint64_t word = 0;
      std::memcpy(&word, at, 8);
      this->mix(word);
    }
    for (; bytes > 0; --bytes, ++at)
    {
      this->mix(*at);
    }
  }
  std::uint64_t value() const { return this->Hash; }

private:
  void mix(std::uint64_t word)
  {
    this->Hash = (this->Hash ^ word) * 0x100000001b3ULL;
    this->Hash ^= this->Hash >> 29; // FNV on words leaves the low bits ignorant of the high ones
  }
  std::uint64_t Hash = 0xcbf29ce484222325ULL;
};

void check(const View& view, std::size_t index)
{
  const auto& image = view.silhouette;
  if (image.width < 1 || image.height < 1)
  {
    throw InvalidInput(describeView(index, view.name) + ": the silhouette is empty, " + std::to_string(image.width) + " x " +
      std::to_string(image.height) + " pixels");
  }
  if (image.pixels.size() != std::size_t(image.width) * image.height)
  {
    throw InvalidInput(describeView(index, view.name) + ": " + std::to_string(image.pixels.size()) + " pixel values for " +
      std::to_string(image.width) + " x " + std::to_string(image.height) + " pixels");
  }
  if (std::size_t(image.width) * image.height > std::size_t(0x7fffffff))
  {
    throw InvalidInput(describeView(index, view.name) + ": more than 2^31 - 1 pixels");
  }
  if (!view.projection.allFinite())
  {
    throw InvalidInput(describeView(index, view.name) + ": the projection matrix holds a value that is not finite");
  }
  const int rank = projectionRank(view.projection);
  if (rank < 3)
  {
    throw InvalidInput(
      describeView(index, view.name) + ": the projection matrix has rank " + std::to_string(rank) + ", 3 is needed");
  }
}

PreparedView prepareView(const View& view, std::vector<std::uint8_t>&& pixels, OutsidePolicy outside)
{
  PreparedView out;
  out.name = view.name;
  out.projection = view.projection;
  out.width = view.silhouette.width;
  out.height = view.silhouette.height;
  out.object = std::move(pixels);
  out.tiles = PixelTiles(out.object.data(), out.width, out.height);
  for (std::uint8_t& value : out.object)
  {
    value = value != 0;
  }
  out.objectBox = out.tiles.objectBox();
  const auto& box = out.objectBox;
  const bool any = box[1] >= 0;
  const std::array<bool, 4> touched = { any && box[0] == 0, any && box[1] == out.width - 1, any && box[2] == 0,
    any && box[3] == out.height - 1 };
  for (int side = 0; side < 4; ++side)
  {
    out.open[side] = outside == OutsidePolicy::Unknown || (outside == OutsidePolicy::Border && touched[side]);
  }
  return out;
}

} // namespace

int projectionRank(const Projection& projection)
{
  // Rows differ by orders of magnitude (pixels against depth), which says nothing about rank.
  Projection rows = Projection::Zero();
  for (int row = 0; row < 3; ++row)
  {
    const double largest = projection.row(row).cwiseAbs().maxCoeff();
    if (largest > 0.0)
    {
      rows.row(row) = (projection.row(row) / largest).normalized();
    }
  }
  // Nor does the unit of length, by which the last column differs from the others.
  const double left = rows.leftCols<3>().cwiseAbs().maxCoeff(), last = rows.col(3).cwiseAbs().maxCoeff();
  if (left > 0.0 && last > 0.0)
  {
    rows.col(3) *= left / last;
  }
  Eigen::FullPivLU<Eigen::Matrix<double, 3, 4>> decomposition(rows);
  decomposition.setThreshold(1e-12);
  return int(decomposition.rank());
}

PixelContent PreparedView::content(int firstColumn, int lastColumn, int firstRow, int lastRow) const
{
  PixelContent content;
  if (firstColumn > lastColumn || firstRow > lastRow)
  {
    return content;
  }
  const int c0 = std::max(firstColumn, 0), c1 = std::min(lastColumn, this->width - 1);
  const int r0 = std::max(firstRow, 0), r1 = std::min(lastRow, this->height - 1);
  if (c0 <= c1 && r0 <= r1)
  {
    const TileContent within = this->tiles.content(c0, c1, r0, r1);
    content.object = within.object;
    content.background = within.background;
  }
  // The nine regions of the plane: outside the image each is one answer.
  const bool columns[3] = { firstColumn < 0, c0 <= c1, lastColumn >= this->width };
  const bool rows[3] = { firstRow < 0, r0 <= r1, lastRow >= this->height };
  if (!(columns[0] || columns[2] || rows[0] || rows[2]))
  {
    return content;
  }
  for (int x = 0; x < 3; ++x)
  {
    for (int y = 0; y < 3; ++y)
    {
      if (columns[x] && rows[y] && !(x == 1 && y == 1))
      {
        const int column = x == 0 ? -1 : (x == 1 ? 0 : this->width);
        const int row = y == 0 ? -1 : (y == 1 ? 0 : this->height);
        const bool abstains = this->abstainsAt(column, row);
        content.abstain |= abstains;
        content.background |= !abstains;
      }
    }
  }
  return content;
}

PreparedViews::PreparedViews(const std::vector<View>& views, const ViewOptions& options, Execution& execution)
  : Options(options)
{
  this->prepare(views, nullptr, execution);
}

PreparedViews::PreparedViews(std::vector<View>&& views, const ViewOptions& options, Execution& execution)
  : Options(options)
{
  this->prepare(views, &views, execution);
}

void PreparedViews::prepare(const std::vector<View>& views, std::vector<View>* movable, Execution& execution)
{
  if (views.empty())
  {
    throw InvalidInput("no views: a reconstruction needs at least one silhouette with its projection matrix");
  }
  if (views.size() > 0xffff)
  {
    throw InvalidInput(std::to_string(views.size()) + " views: at most 65535 are supported");
  }
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    check(views[i], i);
  }
  this->Views.resize(views.size());
  std::vector<std::uint64_t> fingerprints(views.size());
  execution.forRanges(views.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        auto pixels = movable ? std::move((*movable)[i].silhouette.pixels) : views[i].silhouette.pixels;
        PreparedView& view = this->Views[i];
        view = prepareView(views[i], std::move(pixels), this->Options.outside);
        Fingerprinter hash;
        const std::int32_t size[3] = { view.width, view.height, int(this->Options.outside) };
        hash.add(size, sizeof(size));
        hash.add(view.projection.data(), 12 * sizeof(double));
        hash.add(view.tiles.words().data(), view.tiles.words().size() * sizeof(std::uint64_t));
        fingerprints[i] = hash.value();
      }
    });
  Fingerprinter hash;
  hash.add(fingerprints.data(), fingerprints.size() * sizeof(std::uint64_t));
  this->Fingerprint = hash.value();
}

LatticeProjection::LatticeProjection(const Projection& projection, const Lattice& lattice)
{
  const double leaf = lattice.leafEdge();
  double reach = 0.0;
  for (int row = 0; row < 3; ++row)
  {
    this->constant[row] = projection.row(row).head<3>().dot(lattice.root.origin) + projection(row, 3);
    for (int axis = 0; axis < 3; ++axis)
    {
      this->step[axis][row] = projection(row, axis) * leaf;
    }
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    reach += std::abs(this->step[axis][2]) * lattice.cells();
  }
  // Nearer to the camera's plane than this, a pixel could not be told to within the guard of the octant test.
  this->minimumDepth = 1e-4 * reach;
}

Eigen::Matrix<double, 2, 3> pixelSteps(const LatticeProjection& projection, const LatticePoint& p)
{
  Eigen::Matrix<double, 2, 3> steps = Eigen::Matrix<double, 2, 3>::Zero();
  const HomogeneousPixel h = projection(p);
  for (int axis = 0; axis < 3 && h.W > projection.minimumDepth; ++axis)
  {
    const auto& step = projection.step[std::size_t(axis)];
    steps(0, axis) = (step[0] - h.U / h.W * step[2]) / h.W;
    steps(1, axis) = (step[1] - h.V / h.W * step[2]) / h.W;
  }
  return steps;
}

double pixelsPerOctant(const LatticeProjection& projection, const LatticePoint& p)
{
  return std::sqrt(0.5 * pixelSteps(projection, p).squaredNorm()); // of the three directions that share it, two lie across
}

LatticeViews::LatticeViews(const PreparedViews& views, const Lattice& lattice)
  : Views(&views)
  , TheLattice(lattice)
{
  this->Projections.reserve(views.size());
  for (int i = 0; i < views.size(); ++i)
  {
    this->Projections.emplace_back(views[i].projection, lattice);
  }
}

int LatticeViews::insideVotes(const LatticePoint& p) const
{
  int background = 0;
  bool seen = false;
  for (int i = 0; i < this->size(); ++i)
  {
    const Vote vote = this->vote(i, p);
    background += vote == Vote::Background;
    seen |= vote != Vote::Abstain;
  }
  return seen ? this->size() - background : 0;
}

int LatticeViews::insideVotes(const LatticePoint& p, const ViewsToAsk& ask) const
{
  int background = ask.backgroundVotes;
  bool seen = ask.seen;
  ask.forEach(
    [&](int view)
    {
      const Vote vote = this->vote(view, p);
      background += vote == Vote::Background;
      seen |= vote != Vote::Abstain;
    });
  return seen ? this->size() - background : 0;
}

} // namespace silhouette
