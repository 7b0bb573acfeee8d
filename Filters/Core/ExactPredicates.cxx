// SPDX-License-Identifier: BSD-3-Clause
#include "ExactPredicates.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace silhouette
{

namespace
{

/** Bounds on the estimates' relative error: somewhat above (3 + 16 e) e and (7 + 56 e) e, e = 2^-53. */
constexpr double Bound2d = 4e-16;
constexpr double Bound3d = 9e-16;
/** Estimates below this may have lost bits to underflow, which a relative bound does not tell. */
constexpr double LeastEstimate = 1e-280;

/**
 * A number as the exact sum of at most Capacity doubles, in increasing magnitude, without overlap and zeros:
 * its sign is that of the last. Operations give exactly the sum or product.
 */
template <int Capacity>
struct Expansion
{
  std::array<double, Capacity> term;
  int size = 0;

  void append(double value)
  {
    if (value != 0.0)
    {
      this->term[this->size++] = value;
    }
  }
  int sign() const { return this->size == 0 ? 0 : (this->term[this->size - 1] > 0.0 ? 1 : -1); }
};

/** a + b = sum + error, exactly (Knuth). */
inline double sumWithError(double a, double b, double& error)
{
  const double sum = a + b;
  const double partOfB = sum - a;
  error = (a - (sum - partOfB)) + (b - partOfB);
  return sum;
}

/** a * b = product + error, exactly. */
inline double productWithError(double a, double b, double& error)
{
  const double product = a * b;
  error = std::fma(a, b, -product);
  return product;
}

Expansion<2> difference(double a, double b)
{
  Expansion<2> result;
  double error;
  const double sum = sumWithError(a, -b, error);
  result.append(error);
  result.append(sum);
  return result;
}

/** Add one double: it sinks through the terms, from the smallest to the greatest. */
template <int N>
void addDouble(Expansion<N>& e, double value)
{
  int kept = 0;
  for (int i = 0; i < e.size; ++i)
  {
    double error;
    value = sumWithError(value, e.term[i], error);
    if (error != 0.0)
    {
      e.term[kept++] = error;
    }
  }
  e.size = kept;
  e.append(value);
}

template <int N, int M>
Expansion<N + M> sum(const Expansion<N>& a, const Expansion<M>& b)
{
  Expansion<N + M> result;
  result.size = a.size;
  std::copy_n(a.term.begin(), a.size, result.term.begin());
  for (int i = 0; i < b.size; ++i)
  {
    addDouble(result, b.term[i]);
  }
  return result;
}

template <int N>
Expansion<N> negated(Expansion<N> a)
{
  for (int i = 0; i < a.size; ++i)
  {
    a.term[i] = -a.term[i];
  }
  return a;
}

template <int N, int M>
Expansion<2 * N * M> product(const Expansion<N>& a, const Expansion<M>& b)
{
  Expansion<2 * N * M> result;
  for (int i = 0; i < a.size; ++i)
  {
    for (int j = 0; j < b.size; ++j)
    {
      double error;
      const double high = productWithError(a.term[i], b.term[j], error);
      if (error != 0.0)
      {
        addDouble(result, error);
      }
      addDouble(result, high);
    }
  }
  return result;
}

using Difference2 = std::array<Expansion<2>, 2>;
using Difference3 = std::array<Expansion<2>, 3>;

Expansion<16> determinant(
  const Expansion<2>& a, const Expansion<2>& b, const Expansion<2>& c, const Expansion<2>& d)
{
  return sum(product(a, d), negated(product(b, c)));
}

int exactOrient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  const Difference2 p{ difference(b[0], a[0]), difference(b[1], a[1]) };
  const Difference2 q{ difference(c[0], a[0]), difference(c[1], a[1]) };
  return determinant(p[0], p[1], q[0], q[1]).sign();
}

Difference3 difference3(const Eigen::Vector3d& a, const Eigen::Vector3d& b)
{
  return { difference(a[0], b[0]), difference(a[1], b[1]), difference(a[2], b[2]) };
}

int exactOrient3d(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d)
{
  const Difference3 p = difference3(b, a);
  const Difference3 q = difference3(c, a);
  const Difference3 r = difference3(d, a);
  const auto x = product(determinant(p[1], p[2], q[1], q[2]), r[0]);
  const auto y = product(determinant(p[2], p[0], q[2], q[0]), r[1]);
  const auto z = product(determinant(p[0], p[1], q[0], q[1]), r[2]);
  return sum(sum(x, y), z).sign();
}

/** The sign of an estimate that is beyond its error; 0 where the estimate decides nothing. */
inline int decided(double estimate, double error)
{
  if (std::abs(estimate) > error && std::abs(estimate) > LeastEstimate)
  {
    return estimate > 0.0 ? 1 : -1;
  }
  return 0;
}

} // namespace

int orient2d(const Eigen::Vector2d& a, const Eigen::Vector2d& b, const Eigen::Vector2d& c)
{
  const double px = b[0] - a[0], py = b[1] - a[1];
  const double qx = c[0] - a[0], qy = c[1] - a[1];
  if ((px == 0.0 || qy == 0.0) && (py == 0.0 || qx == 0.0))
  {
    return 0; // a difference is 0 only where it is exactly 0: lines along an axis are frequent on a lattice
  }
  const double left = px * qy;
  const double right = py * qx;
  const int sign = decided(left - right, Bound2d * (std::abs(left) + std::abs(right)));
  return sign != 0 ? sign : exactOrient2d(a, b, c);
}

int orient3d(
  const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c, const Eigen::Vector3d& d)
{
  const double px = b[0] - a[0], py = b[1] - a[1], pz = b[2] - a[2];
  const double qx = c[0] - a[0], qy = c[1] - a[1], qz = c[2] - a[2];
  const double rx = d[0] - a[0], ry = d[1] - a[1], rz = d[2] - a[2];
  if ((px == 0.0 && qx == 0.0 && rx == 0.0) || (py == 0.0 && qy == 0.0 && ry == 0.0) ||
    (pz == 0.0 && qz == 0.0 && rz == 0.0))
  {
    return 0; // a plane across an axis
  }
  const double yz = py * qz, zy = pz * qy;
  const double zx = pz * qx, xz = px * qz;
  const double xy = px * qy, yx = py * qx;
  const double estimate = (yz - zy) * rx + (zx - xz) * ry + (xy - yx) * rz;
  const double magnitude = (std::abs(yz) + std::abs(zy)) * std::abs(rx) +
    (std::abs(zx) + std::abs(xz)) * std::abs(ry) + (std::abs(xy) + std::abs(yx)) * std::abs(rz);
  const int sign = decided(estimate, Bound3d * magnitude);
  return sign != 0 ? sign : exactOrient3d(a, b, c, d);
}

} // namespace silhouette
