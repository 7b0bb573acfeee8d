// SPDX-License-Identifier: BSD-3-Clause
/**
 * A silhouette as the runs of object pixels in its rows: what is asked about contours costs as much as the contours are long, not as the image is large.
 */
#pragma once

#include "View.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace silhouette
{

/** Object pixels of a row from column `begin` up to, but not including, `end`. */
struct PixelRun
{
  std::int32_t begin, end;
};

struct SilhouetteRuns
{
  int width = 0; ///< px
  int height = 0;
  std::vector<PixelRun> runs;            ///< row by row, ascending; no run touches the next
  std::vector<std::size_t> firstOfRow; ///< height + 1: index of each row's first run, and the number of all

  const PixelRun* begin(int row) const { return this->runs.data() + this->firstOfRow[std::size_t(row)]; }
  const PixelRun* end(int row) const { return this->runs.data() + this->firstOfRow[std::size_t(row) + 1]; }

  /** Is a pixel of the image object? Cost: the logarithm of the row's runs. */
  bool at(int column, int row) const
  {
    const PixelRun* after = std::upper_bound(
      this->begin(row), this->end(row), column, [](int c, const PixelRun& run) { return c < run.begin; });
    return after != this->begin(row) && column < after[-1].end;
  }
};

/** An image's runs. Cost: a pass over the pixels. */
SilhouetteRuns runsOf(const BinaryImage& image);

/** The image of runs, in an image's memory. Cost: a pass over the pixels. */
void drawRuns(const SilhouetteRuns& runs, BinaryImage& image);

/** The same, in memory of its own. */
inline BinaryImage imageOf(const SilhouetteRuns& runs)
{
  BinaryImage image;
  drawRuns(runs, image);
  return image;
}

/** Where two pixels that lie beside or below one another differ: the columns' first one and the row's first one, and which of both. */
struct ContourPlace
{
  std::int32_t column, row;
  bool isBelow; ///< the other is below, else to the right
};

/** All contour places within the image, row by row by ascending column; to the right before below. Cost: linear in the runs and the places. */
std::vector<ContourPlace> contourPlaces(const SilhouetteRuns& runs);

} // namespace silhouette
