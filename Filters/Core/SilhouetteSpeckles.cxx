// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteSpeckles.h"

#include "UnionFind.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace silhouette
{
namespace
{

constexpr int LongestChain = 8; ///< object pixels: more of them, side by side or in line, are no speckle
constexpr std::size_t SampledSpeckles = 32; ///< in each view, as evidence of noise
constexpr double LeastDisputed = 0.5;       ///< of the sampled ones

/** Pixels of one row, of one value, as many as there are side by side. */
struct Run
{
  int row = 0;
  int first = 0;
  int last = 0;
  bool object = false;
};

std::vector<Run> runsOf(const PreparedView& view)
{
  std::vector<Run> runs;
  for (int row = 0; row < view.height; ++row)
  {
    const std::uint8_t* pixels = view.silhouette() + std::size_t(row) * view.width;
    for (int first = 0; first < view.width;)
    {
      const std::uint8_t value = pixels[first];
      const void* other = std::memchr(pixels + first, 1 - value, std::size_t(view.width - first));
      const std::uint8_t* end = other ? static_cast<const std::uint8_t*>(other) : pixels + view.width;
      runs.push_back({row, first, int(end - pixels) - 1, value != 0});
      first = int(end - pixels);
    }
  }
  return runs;
}

/**
 * Background runs that share an edge are one region. Object runs are one where no more than a pixel is
 * between them, so that a thin stem that noise has broken counts as a whole.
 */
void uniteRuns(const std::vector<Run>& runs, UnionFind& regions)
{
  std::size_t before = 0; // the first run that is at most two rows above
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    const Run& run = runs[i];
    while (runs[before].row < run.row - 2)
    {
      ++before;
    }
    if (i >= 2 && runs[i - 2].row == run.row && run.object && run.first - runs[i - 2].last <= 2)
    {
      regions.unite(std::uint32_t(i), std::uint32_t(i - 2));
    }
    const int gap = run.object ? 2 : 0;
    const int rows = run.object ? 2 : 1;
    for (int row = std::max(run.row - rows, 0); row < run.row; ++row)
    {
      const auto above =
          std::partition_point(runs.begin() + before, runs.begin() + i,
                               [&](const Run& other) {
                                 return other.row < row || (other.row == row && other.last < run.first - gap);
                               });
      for (auto other = above; other->row == row && other->first <= run.last + gap; ++other)
      {
        if (other->object == run.object)
        {
          regions.unite(std::uint32_t(i), std::uint32_t(other - runs.begin()));
        }
      }
    }
  }
}

/** The runs of the view's speckles: enclosed background of at most `area` pixels, object of a few. */
std::vector<Run> specklesOf(const PreparedView& view, double area)
{
  const std::vector<Run> runs = runsOf(view);
  UnionFind regions(runs.size());
  uniteRuns(runs, regions);
  std::vector<std::int64_t> areas(runs.size(), 0);
  std::vector<std::uint8_t> open(runs.size(), 0);
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    const Run& run = runs[i];
    const std::uint32_t region = regions.find(std::uint32_t(i));
    areas[region] += run.last - run.first + 1;
    open[region] |= std::uint8_t(run.row == 0 || run.row == view.height - 1 || run.first == 0 ||
                                 run.last == view.width - 1);
  }
  std::vector<Run> speckles;
  for (std::size_t i = 0; i < runs.size(); ++i)
  {
    const std::uint32_t region = regions.find(std::uint32_t(i));
    const double limit = runs[i].object ? std::min(area, double(LongestChain)) : area;
    if (double(areas[region]) <= limit && (runs[i].object || !open[region]))
    {
      speckles.push_back(runs[i]);
    }
  }
  return speckles;
}

/** Is there, behind a background pixel of view `i`, a point that all other views call object? */
bool isDisputed(const LatticeViews& fine, int i, double u, double v)
{
  const LatticeProjection& projection = fine.projection(i);
  Eigen::Matrix<double, 2, 3> planes;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto& step = projection.step[axis];
    planes.col(axis) << step[0] - u * step[2], step[1] - v * step[2];
  }
  const auto& c = projection.constant;
  const Vector2 offset(c[0] - u * c[2], c[1] - v * c[2]);
  const Vector3 across = Vector3(planes.row(0)).cross(Vector3(planes.row(1)));
  const Vector3 direction = across / across.cwiseAbs().maxCoeff();
  const std::int32_t n = fine.lattice().cells();
  const Vector3 middle = Vector3::Constant(0.5 * n);
  const Eigen::Matrix2d normal = planes * planes.transpose();
  const Vector3 nearest = middle - planes.transpose() * (normal.inverse() * (planes * middle + offset));
  int objector = i;
  for (std::int32_t t = -n; t <= n && nearest.allFinite() && direction.allFinite(); ++t)
  {
    const Vector3 x = nearest + double(t) * direction;
    if (x.minCoeff() < 0.0 || x.maxCoeff() > n)
    {
      continue;
    }
    const LatticePoint p = {int(std::lround(x[0])), int(std::lround(x[1])), int(std::lround(x[2]))};
    if (objector != i && fine.vote(objector, p) == Vote::Background)
    {
      continue;
    }
    const Dissent dissent = dissentAt(fine, p);
    if (dissent.only == i)
    {
      return true;
    }
    objector = dissent.last >= 0 ? dissent.last : i;
  }
  return false;
}

/**
 * The share of enclosed speckles that the other views dispute, from some in each view: gaps between twigs are
 * none of the noise.
 */
double disputedShare(const LatticeViews& fine, const std::vector<std::vector<Run>>& speckles,
                     Execution& execution)
{
  std::vector<std::array<double, 2>> counts(speckles.size(), {0.0, 0.0});
  execution.forRanges(speckles.size(), 1,
                      [&](std::size_t first, std::size_t last)
                      {
                        for (std::size_t i = first; i < last; ++i)
                        {
                          const std::size_t step = speckles[i].size() / SampledSpeckles + 1;
                          for (std::size_t s = 0; s < speckles[i].size(); s += step)
                          {
                            const Run& run = speckles[i][s];
                            if (!run.object)
                            {
                              counts[i][0] +=
                                  isDisputed(fine, int(i), (run.first + run.last) / 2, run.row) ? 1.0 : 0.0;
                              counts[i][1] += 1.0;
                            }
                          }
                        }
                      });
  std::array<double, 2> sum = {0.0, 0.0};
  for (const auto& count : counts)
  {
    sum = {sum[0] + count[0], sum[1] + count[1]};
  }
  return sum[1] > 0.0 ? sum[0] / sum[1] : 0.0;
}

} // namespace

std::optional<PreparedViews> withoutSpeckles(const LatticeViews& lattice, const SurvivorBox& box,
                                             const SilhouetteRepairOptions& options,
                                             std::vector<std::uint64_t>& flipped, Execution& execution)
{
  const PreparedViews& views = lattice.prepared();
  std::vector<std::vector<Run>> speckles(views.size());
  std::vector<std::uint64_t> counts(views.size(), 0);
  execution.forRanges(views.size(), 1,
                      [&](std::size_t first, std::size_t last)
                      {
                        for (std::size_t i = first; i < last; ++i)
                        {
                          const double scale = pixelsPerOctant(lattice.projection(int(i)), box.centre);
                          speckles[i] =
                              specklesOf(views[int(i)], std::max(1.0, options.speckleArea * scale * scale));
                          for (const Run& run : speckles[i])
                          {
                            counts[i] += std::uint64_t(run.last - run.first + 1);
                          }
                        }
                      });
  double found = 0.0, object = 0.0;
  for (int i = 0; i < views.size(); ++i)
  {
    found += double(counts[i]);
    object += double(views[i].objectPixels(0, views[i].width, 0, views[i].height));
  }
  if (!(found > options.speckleShare * object))
  {
    return std::nullopt;
  }
  const double disputed = disputedShare(LatticeViews(views, pixelLattice(lattice, box)), speckles, execution);
  if (disputed < LeastDisputed || !(disputed * found > options.speckleShare * object))
  {
    return std::nullopt;
  }
  std::vector<View> cleaned = copyViews(views);
  for (int i = 0; i < views.size(); ++i)
  {
    for (const Run& run : speckles[i])
    {
      std::fill_n(&cleaned[i].silhouette.at(run.first, run.row), run.last - run.first + 1,
                  run.object ? 0 : 1);
    }
  }
  flipped = std::move(counts);
  return PreparedViews(cleaned, views.options(), execution);
}

} // namespace silhouette
