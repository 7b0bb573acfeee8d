// SPDX-License-Identifier: BSD-3-Clause
#include "FieldSmoothing.h"

#include "Vectorised.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>
#include <vector>

namespace silhouette
{
namespace
{

constexpr int Side = BrickField::BrickSize;
constexpr std::size_t Points = BrickField::BrickPoints;

/** Half of a symmetric kernel: the weights at 0, 1, 2, ... */
using HalfKernel = std::vector<double>;

double weightAt(const HalfKernel& kernel, int i)
{
  const auto place = std::size_t(std::abs(i));
  return place < kernel.size() ? kernel[place] : 0.0;
}

double sumOf(const HalfKernel& kernel)
{
  return 2.0 * std::accumulate(kernel.begin(), kernel.end(), 0.0) - kernel.front();
}

double secondMoment(const HalfKernel& kernel)
{
  double moment = 0.0;
  for (std::size_t i = 1; i < kernel.size(); ++i)
  {
    moment += 2.0 * double(i * i) * kernel[i];
  }
  return moment;
}

/** A Gaussian, 1 in its middle, up to three standard deviations. */
HalfKernel gaussianOf(double sigma)
{
  constexpr double Reach = 3.0;
  HalfKernel gaussian(std::size_t(std::max(1.0, std::ceil(Reach * sigma))) + 1);
  gaussian[0] = 1.0; // whatever sigma
  for (std::size_t i = 1; i < gaussian.size(); ++i)
  {
    gaussian[i] = std::exp(-0.5 * double(i * i) / (sigma * sigma));
  }
  return gaussian;
}

/**
 * A Gaussian g would draw a curved surface towards its inner side, by half of sigma squared times the curvature; in a g - b g * g
 * the two draw alike. a and b: the weights add up to 1, their second moment is 0.
 */
std::vector<float> keepingKernel(double sigma)
{
  constexpr double Wide = 4.5; // standard deviations up to which the whole is taken
  const HalfKernel gaussian = gaussianOf(sigma);
  HalfKernel twice(std::size_t(std::max(2.0, std::ceil(Wide * sigma))) + 1, 0.0);
  const int radius = int(gaussian.size()) - 1;
  for (std::size_t i = 0; i < twice.size(); ++i)
  {
    for (int j = -radius; j <= radius; ++j)
    {
      twice[i] += weightAt(gaussian, j) * weightAt(gaussian, int(i) - j);
    }
  }
  const double moment = secondMoment(twice);
  const double share = moment > 0.0 ? secondMoment(gaussian) / moment : 0.0; // b / a; 0 where sigma is next to none
  const double a = 1.0 / (sumOf(gaussian) - share * sumOf(twice));
  std::vector<float> kernel(twice.size());
  for (std::size_t i = 0; i < kernel.size(); ++i)
  {
    kernel[i] = float(a * (weightAt(gaussian, int(i)) - share * twice[i]));
  }
  return kernel;
}

typedef float Row __attribute__((vector_size(Side * sizeof(float)))); ///< of values that follow one another on the first axis

/**
 * `count` rows of weighted sums of rows, the first of `rows[0]` and those around it, the next one further on; each `step` after the last. By memory alone: how
 * vectors are passed depends on the machine.
 */
SILHOUETTE_VECTORISED void sumRows(
  const float* const* rows, const float* kernel, int radius, int count, float* sums, std::size_t step)
{
  for (int n = 0; n < count; ++n, ++rows, sums += step)
  {
    Row sum, before, behind;
    std::memcpy(&sum, rows[0], sizeof(sum));
    sum *= kernel[0];
    for (int d = 1; d <= radius; ++d)
    {
      std::memcpy(&before, rows[-d], sizeof(before));
      std::memcpy(&behind, rows[d], sizeof(behind));
      sum += kernel[d] * (before + behind);
    }
    std::memcpy(sums, &sum, sizeof(sum));
  }
}

/** Where the values of a brick, row after row, are in Morton order. */
struct RowOrder
{
  std::array<std::uint16_t, Points> place;

  RowOrder()
  {
    for (std::size_t n = 0; n < Points; ++n)
    {
      const LatticePoint p = fromMorton(n);
      this->place[std::size_t(p.i + Side * (p.j + Side * p.k))] = std::uint16_t(n);
    }
  }
};

class Smoothing
{
public:
  /** `from` and `to`: memory for all values each. */
  Smoothing(BrickField& field, const std::vector<float>& kernel, float* from, float* to)
    : Field(field)
    , Kernel(kernel)
    , Radius(int(kernel.size()) - 1)
    , Reach((this->Radius + Side - 1) / Side)
    , From(from)
    , To(to)
  {
  }

  void run(float most, Execution& execution)
  {
    this->forBricks(execution,
      [this](std::size_t first, std::size_t last)
      {
        for (std::size_t n = first * Points; n < last * Points; ++n)
        {
          this->From[n] = this->Field.values()[n / Points * Points + this->Order.place[n % Points]];
        }
      });
    for (int axis = 0; axis < 3; ++axis)
    {
      this->forBricks(execution, [this, axis](std::size_t first, std::size_t last) { this->smoothAlong(axis, first, last); });
      std::swap(this->From, this->To);
    }
    this->forBricks(execution,
      [this, most](std::size_t first, std::size_t last)
      {
        for (std::size_t n = first * Points; n < last * Points; ++n)
        {
          float& value = this->Field.values()[n / Points * Points + this->Order.place[n % Points]];
          value = std::clamp(this->From[n], value - most, value + most);
        }
      });
  }

private:
  template <typename Work>
  void forBricks(Execution& execution, const Work& work)
  {
    execution.forRanges(this->Field.bricks().size(), 8, work);
  }

  void smoothAlong(int axis, std::size_t first, std::size_t last)
  {
    std::vector<const float*> beside(std::size_t(2 * this->Reach + 1)); // the values of the bricks on both sides of one
    std::vector<const float*> rows(beside.size() * Side);
    std::vector<float> line(rows.size());
    for (std::size_t brick = first; brick < last; ++brick)
    {
      this->findBeside(axis, brick, beside);
      float* const smoothed = &this->To[brick * Points];
      for (int ab = 0; ab < Side * Side && axis == 0; ++ab)
      {
        this->smoothLine(beside, std::size_t(Side * ab), line, rows, smoothed);
      }
      for (int a = 0; a < Side && axis > 0; ++a)
      {
        const std::size_t start = std::size_t(axis == 1 ? Side * Side * a : Side * a), step = axis == 1 ? Side : Side * Side;
        this->collect(beside, [&](const float* values, int t) { return values + start + std::size_t(t) * step; }, rows);
        sumRows(&rows[std::size_t(this->Reach * Side)], this->Kernel.data(), this->Radius, Side, smoothed + start, step);
      }
    }
  }

  /** Along the first axis, where a row's own values are summed. */
  void smoothLine(const std::vector<const float*>& beside, std::size_t start, std::vector<float>& line, std::vector<const float*>& rows, float* smoothed) const
  {
    this->collect(beside, [&](const float* values, int t) { return values + start + t; }, rows);
    std::transform(rows.begin(), rows.end(), line.begin(), [](const float* value) { return *value; });
    for (int d = -this->Radius; d <= this->Radius; ++d)
    {
      rows[std::size_t(this->Radius + d)] = &line[std::size_t(this->Reach * Side + d)];
    }
    sumRows(&rows[std::size_t(this->Radius)], this->Kernel.data(), this->Radius, 1, smoothed + start, Side);
  }

  /** Null where there is no brick, and beyond it. */
  void findBeside(int axis, std::size_t brick, std::vector<const float*>& beside) const
  {
    std::fill(beside.begin(), beside.end(), nullptr);
    beside[std::size_t(this->Reach)] = &this->From[brick * Points];
    for (const int side : { -1, 1 })
    {
      LatticePoint p = fromMorton(this->Field.bricks()[brick]);
      std::int32_t& x = axis == 0 ? p.i : axis == 1 ? p.j : p.k;
      for (int n = 1; n <= this->Reach && x + side >= 0; ++n)
      {
        x += side;
        const std::ptrdiff_t other = this->Field.findBrick(mortonCode(p));
        if (other < 0)
        {
          break;
        }
        beside[std::size_t(this->Reach + side * n)] = &this->From[std::size_t(other) * Points];
      }
    }
  }

  /** What bricks beside one another have at each of their steps t; where there is no brick, the last goes on. */
  template <typename At>
  void collect(const std::vector<const float*>& beside, const At& at, std::vector<const float*>& rows) const
  {
    for (int slot = this->Reach; slot < int(beside.size()); ++slot)
    {
      for (int t = 0; t < Side; ++t)
      {
        const std::size_t n = std::size_t(slot * Side + t);
        rows[n] = beside[std::size_t(slot)] ? at(beside[std::size_t(slot)], t) : rows[n - 1];
      }
    }
    for (int slot = this->Reach - 1; slot >= 0; --slot)
    {
      for (int t = Side - 1; t >= 0; --t)
      {
        const std::size_t n = std::size_t(slot * Side + t);
        rows[n] = beside[std::size_t(slot)] ? at(beside[std::size_t(slot)], t) : rows[n + 1];
      }
    }
  }

  BrickField& Field;
  const std::vector<float>& Kernel;
  int Radius;
  int Reach; ///< in bricks
  RowOrder Order;
  float* From; ///< values of all bricks, a brick's row after row
  float* To;
};

} // namespace

std::vector<float> gaussianKernel(double sigma)
{
  const HalfKernel gaussian = gaussianOf(sigma);
  const double sum = sumOf(gaussian);
  std::vector<float> kernel(gaussian.size());
  std::transform(gaussian.begin(), gaussian.end(), kernel.begin(), [sum](double weight) { return float(weight / sum); });
  return kernel;
}

void FieldSmoother::smooth(BrickField& field, double sigma, float most, Execution& execution)
{
  constexpr double least = 1e-3; // octants: what is narrower leaves every value as it is
  if (!(sigma > least) || field.size() == 0)
  {
    return;
  }
  if (this->Size < field.size())
  {
    this->Size = 0; // as long as not both are there
    this->From.reset();
    this->To.reset();
    this->From.reset(new float[field.size()]);
    this->To.reset(new float[field.size()]);
    this->Size = field.size();
  }
  const std::vector<float> kernel = keepingKernel(sigma);
  Smoothing(field, kernel, this->From.get(), this->To.get()).run(most, execution);
}

} // namespace silhouette
