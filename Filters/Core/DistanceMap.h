// SPDX-License-Identifier: BSD-3-Clause
/**
 * Signed distances from a silhouette's contour, near the contour.
 */
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <memory>
#include <vector>

namespace silhouette
{

/**
 * Which part of an image distances are kept of, the object's surroundings alone, and at which of its pixels: samples
 * are `spacing` columns and rows apart. The last ones may lie beyond the image by less than that; there the border's
 * pixels go on.
 */
struct DistanceFrame
{
  int width = 0; ///< of the image
  int height = 0;
  int left = 0; ///< first column that is kept
  int top = 0;
  int lastColumn = 0; ///< counted from `left`
  int lastRow = 0;
  int spacing = 1; ///< px
  double samplesPerPixel = 1.0;
  int columns = 0; ///< of samples
  int rows = 0;
  float reach = 0; ///< px: where distances are cut off

  /**
   * Between the samples, bilinearly; beyond the image as far less as the image is away. `sample(row, column)` is the
   * value of a sample; there is one.
   */
  template <typename Sample>
  float interpolate(double u, double v, const Sample& sample) const
  {
    // Beyond the part that is kept there is only background.
    const double column = std::clamp(u - this->left, 0.0, double(this->lastColumn));
    const double row = std::clamp(v - this->top, 0.0, double(this->lastRow));
    const double x = column * this->samplesPerPixel, y = row * this->samplesPerPixel;
    const int c = std::min(int(x), std::max(this->columns - 2, 0));
    const int r = std::min(int(y), std::max(this->rows - 2, 0));
    const int right = this->columns > 1 ? c + 1 : c, below = this->rows > 1 ? r + 1 : r;
    const float s = float(x - c), t = float(y - r);
    const float inner = (sample(r, c) * (1 - s) + sample(r, right) * s) * (1 - t) +
      (sample(below, c) * (1 - s) + sample(below, right) * s) * t;
    const double dx = u - this->left - column, dy = v - this->top - row;
    return dx == 0.0 && dy == 0.0 ? inner : std::max(-this->reach, inner - float(std::sqrt(dx * dx + dy * dy)));
  }
};

/**
 * Distances in pixels, positive inside, exact up to `reach` and cut off there. Only what is near the contour is kept: a row of samples is a row of pieces, and all pieces
 * that are wholly at the reach on one side are one.
 */
struct DistanceMap : DistanceFrame
{
  static constexpr int PieceSize = 16; ///< samples; after them comes the first one of the next piece, so that neighbours lie side by side

  int across = 0;                    ///< pieces of a row
  std::vector<std::uint32_t> pieces; ///< rows * across: where each one's samples begin
  std::vector<float> values;         ///< of the pieces: at the samples' centres
  /** For each block of 8 x 8 samples and those before it in both directions, how many are not wholly at the reach. */
  std::vector<std::int32_t> blocksNear;

  /** Is there no object, and nothing kept? */
  bool empty() const { return this->pieces.empty(); }
  /** A sample, and after it the next one of the row, if there is one. */
  const float* sample(int row, int column) const
  {
    return &this->values[this->pieces[std::size_t(row) * std::size_t(this->across) + std::size_t(column / PieceSize)] + std::size_t(column % PieceSize)];
  }

  /** The distance at a place; of an image without object the whole reach outside. */
  float at(double u, double v) const
  {
    return this->empty() ? -this->reach : this->interpolate(u, v, [this](int row, int column) { return *this->sample(row, column); });
  }

  /** Is the value, but for rounding, the whole reach everywhere between these places, px? May say no where it is. Cost: four look-ups. */
  bool farInside(double firstU, double lastU, double firstV, double lastV) const;
};

class DistanceTransform;

/**
 * Makes maps, one after another, in memory that it keeps. The contour runs between pixels: a pixel's distance is that to the nearest pixel of the other
 * kind, less half a pixel. With a `spacing` of 1, the least, all pixels are sampled; of more, at most the reach, each sample is as
 * exact, and what lies between them is as straight as bilinear interpolation makes it. Cost: two passes over the image, and about
 * `reach` steps for each sample that near to the contour; memory: two bytes a pixel meanwhile, and in the map 4 a sample near the contour and 1/4 a sample elsewhere.
 */
class DistanceMapper
{
public:
  DistanceMapper();
  ~DistanceMapper();
  DistanceMapper(DistanceMapper&&) noexcept;
  DistanceMapper& operator=(DistanceMapper&&) noexcept;

  /** The map of an image of 0 and 1. */
  DistanceMap map(const std::uint8_t* object, int width, int height, double reach, int spacing = 1);

private:
  std::unique_ptr<DistanceTransform> Transform;
};

/** One map. */
inline DistanceMap distanceMap(const std::uint8_t* object, int width, int height, double reach, int spacing = 1)
{
  return DistanceMapper().map(object, width, height, reach, spacing);
}

/**
 * distanceMap() of all pixels for whoever asks about few places: what at() says is the same, and only the pixels around the places are
 * measured. For one thread at a time. The image has to outlive it. Cost: two passes over the columns, and about the distance
 * itself for each sixteen pixels of a row that are asked for.
 */
class DistancesOnDemand
{
public:
  DistancesOnDemand(const std::uint8_t* object, int width, int height, double reach);
  ~DistancesOnDemand();
  DistancesOnDemand(const DistancesOnDemand&) = delete;
  DistancesOnDemand& operator=(const DistancesOnDemand&) = delete;

  float at(double u, double v);

private:
  float pixel(int row, int column);

  DistanceFrame Frame;
  std::unique_ptr<DistanceTransform> Transform; ///< none where there is no object
  std::vector<std::int32_t> Known;              ///< for each piece of a row where its pixels are, or -1
  std::vector<float> Values;
};

/**
 * The same, not remembered, so that any number of threads may ask. What at() says is the same again. The image has to outlive it.
 * Cost: two passes over the columns, and up to eight times the distance itself for each place.
 */
class DistanceProbe
{
public:
  DistanceProbe(const std::uint8_t* object, int width, int height, double reach);
  ~DistanceProbe();
  DistanceProbe(const DistanceProbe&) = delete;
  DistanceProbe& operator=(const DistanceProbe&) = delete;

  float at(double u, double v) const;

private:
  DistanceFrame Frame;
  std::unique_ptr<const DistanceTransform> Transform; ///< none where there is no object
};

} // namespace silhouette
