// SPDX-License-Identifier: BSD-3-Clause
#include "SyntheticShapes.h"

#include "Error.h"
#include "FieldContour.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

namespace silhouette
{
namespace
{

constexpr double Pi = 3.14159265358979323846;

/** 0 up to `from`, 1 beyond `to`, smooth between. */
double smoothStep(double from, double to, double x)
{
  const double t = std::clamp((x - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/** The smaller of two distances, with a fillet where they differ by less than `width`. */
double smoothMinimum(double a, double b, double width)
{
  const double h = std::max(width - std::abs(a - b), 0.0) / width;
  return std::min(a, b) - 0.25 * width * h * h;
}

/** A polyline of segments of about equal length: what the jug's profile, its handle and each twig are drawn
 * with. */
class Curve
{
public:
  struct Nearest
  {
    double distance = std::numeric_limits<double>::infinity();
    double along = 0.0; ///< 0 at the curve's start, 1 at its end
    std::size_t segment = 0;
  };

  /** The uniform cubic B-spline of the control points, its ends clamped, cut into `segments`. */
  Curve(const std::vector<Eigen::Vector3d>& controls, int segments)
  {
    std::vector<Eigen::Vector3d> c(2, controls.front());
    c.insert(c.end(), controls.begin(), controls.end());
    c.insert(c.end(), 2, controls.back());
    const int fine = 4 * segments;
    const double spans = double(c.size()) - 3.0;
    std::vector<Eigen::Vector3d> samples;
    for (int i = 0; i <= fine; ++i)
    {
      const double x = spans * i / fine;
      const std::size_t s = std::min(std::size_t(x), c.size() - 4);
      const double t = x - double(s);
      const double u = 1.0 - t;
      samples.push_back((u * u * u * c[s] + (3 * t * t * t - 6 * t * t + 4) * c[s + 1] +
                         (3 * u * u * u - 6 * u * u + 4) * c[s + 2] + t * t * t * c[s + 3]) /
                        6.0);
    }
    this->resample(samples, segments);
  }

  /** The curve's point nearest to p, among those nearer than `within`. */
  Nearest nearest(const Eigen::Vector3d& p, double within) const
  {
    Nearest best;
    best.distance = within;
    const std::size_t segments = this->segments();
    for (std::size_t i = 0; i < segments; i += 16) // a first guess, for longer leaps
    {
      const double distance = (p - this->Points[i]).norm();
      if (distance < best.distance)
      {
        best = {distance, double(i) / double(segments), i};
      }
    }
    for (std::size_t i = 0; i < segments;)
    {
      const Eigen::Vector3d& a = this->Points[i];
      // Going along the curve brings it nearer by at most the length gone, so that far stretches are leapt
      // over.
      const double surplus = (p - a).norm() - best.distance;
      if (surplus >= this->LongestSegment)
      {
        i += std::size_t(std::min(surplus / this->LongestSegment, double(segments)));
        continue;
      }
      const Eigen::Vector3d ab = this->Points[i + 1] - a;
      const double t = std::clamp((p - a).dot(ab) / ab.squaredNorm(), 0.0, 1.0);
      const double distance = (p - (a + t * ab)).norm();
      if (distance < best.distance)
      {
        best = {distance, (double(i) + t) / double(segments), i};
      }
      ++i;
    }
    return best;
  }

  const Eigen::Vector3d& point(std::size_t i) const { return this->Points[i]; }
  std::size_t segments() const { return this->Points.size() - 1; }

private:
  void resample(const std::vector<Eigen::Vector3d>& samples, int segments)
  {
    std::vector<double> length(1, 0.0);
    for (std::size_t i = 1; i < samples.size(); ++i)
    {
      length.push_back(length.back() + (samples[i] - samples[i - 1]).norm());
    }
    std::size_t j = 0;
    for (int i = 0; i <= segments; ++i)
    {
      const double wanted = length.back() * i / segments;
      while (j + 2 < samples.size() && length[j + 1] < wanted)
      {
        ++j;
      }
      const double t = std::min((wanted - length[j]) / (length[j + 1] - length[j]), 1.0);
      this->Points.push_back(samples[j] + t * (samples[j + 1] - samples[j]));
    }
    // Chords are never longer than the stretch of curve between their ends; the rest is for rounding.
    this->LongestSegment = length.back() / segments * (1.0 + 1e-9);
  }

  std::vector<Eigen::Vector3d> Points;
  double LongestSegment = 0.0;
};

/** A wall about a profile turned around the z axis, pulled out to a spout at +x, and a strap handle at -x. */
class JugField : public DistanceField
{
public:
  JugField()
      : Profile({{0, 0, -0.82},
                 {0.22, 0, -0.82},
                 {0.40, 0, -0.89},
                 {0.49, 0, -0.80},
                 {0.38, 0, -0.70},
                 {0.56, 0, -0.57},
                 {0.72, 0, -0.22},
                 {0.62, 0, 0.14},
                 {0.36, 0, 0.34},
                 {0.24, 0, 0.54},
                 {0.27, 0, 0.72},
                 {0.35, 0, 0.85}},
                192),
        Handle({{-0.26, 0, 0.60},
                {-0.44, 0, 0.80},
                {-0.80, 0, 0.82},
                {-0.92, 0, 0.46},
                {-0.82, 0, 0.16},
                {-0.60, 0, 0.00}},
               96)
  {
  }

  double operator()(const Eigen::Vector3d& p) const override
  {
    constexpr double halfWall = 0.036;
    constexpr double fillet = 0.1;
    const double wall = this->profileDistance(p);
    const double jug = std::abs(wall) - halfWall;
    // The handle ends at the middle of the wall, so steeply that its fillet cannot bulge into the inside.
    const double handle = std::max(this->handleDistance(p, jug + fillet), -fillet / halfWall * wall);
    return smoothMinimum(jug, handle, fillet);
  }

  double steepness() const override { return 1.9; }

private:
  /** Distance from the turned profile, negative on its inner side. */
  double profileDistance(const Eigen::Vector3d& p) const
  {
    const double radius = std::hypot(p.x(), p.y());
    const double cosine = radius > 0.0 ? p.x() / radius : 0.0;
    const double half = 0.125 * (1.0 + cosine) * (1.0 + cosine) * (1.0 + cosine);
    const double spout = half * half * smoothStep(0.05, 0.25, radius) * smoothStep(0.40, 0.95, p.z());
    const Eigen::Vector3d q(radius - 0.19 * spout, 0.0, p.z() - 0.05 * spout);
    const Curve::Nearest near = this->Profile.nearest(q, 10.0);
    const Eigen::Vector3d& a = this->Profile.point(near.segment);
    const Eigen::Vector3d along = this->Profile.point(near.segment + 1) - a;
    const bool inner = along.x() * (q.z() - a.z()) - along.z() * (q.x() - a.x()) > 0.0;
    return inner ? -near.distance : near.distance;
  }

  /** Distance from the handle, which is a strap wider than thick; `within` where it is not less. */
  double handleDistance(const Eigen::Vector3d& p, double within) const
  {
    constexpr double halfThickness = 0.038;
    const Eigen::Vector3d q(p.x(), 0.65 * p.y(), p.z());
    return this->Handle.nearest(q, within + halfThickness).distance - halfThickness;
  }

  Curve Profile;
  Curve Handle;
};

/** Bent, tapering tubes: a stem, branches on it and twigs on these, each turned from the last by the golden
 * angle. */
class TwigField : public DistanceField
{
public:
  TwigField()
  {
    const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
    this->grow({-0.04, 0.02, -0.92}, up, {0.05, -0.03, 0.0}, 1.80, 0.0070, 0.0060);
    const double golden = Pi * (3.0 - std::sqrt(5.0));
    for (int i = 0; i < 9; ++i)
    {
      const double turn = 0.7 + golden * i;
      const Eigen::Vector3d outward(std::cos(turn), std::sin(turn), 0.0);
      const double length = 0.80 - 0.055 * i;
      const std::size_t branch = this->Tubes.size();
      this->grow(this->at(0, 0.22 + 0.08 * i), outward + 0.75 * up, 0.12 * up, length, 0.0060, 0.0055);
      for (int j = 0; j < 3; ++j)
      {
        const Eigen::Vector3d sideways = up.cross(outward) * (j % 2 == 0 ? 1.0 : -1.0);
        const Eigen::Vector3d heading = sideways + 0.6 * outward + (0.7 - 0.5 * j) * up;
        this->grow(this->at(branch, 0.36 + 0.19 * j), heading, 0.05 * up, 0.36 * length - 0.04 * j, 0.0055,
                   0.0050);
      }
    }
  }

  double operator()(const Eigen::Vector3d& p) const override
  {
    constexpr double fillet = 0.004;
    double field = 1.0;
    for (const Tube& tube : this->Tubes)
    {
      // Beyond this distance a tube changes nothing: not even its fillet reaches the point.
      const double within = field + fillet + tube.startRadius;
      if ((p - tube.centre).norm() - tube.reach < within)
      {
        const Curve::Nearest near = tube.axis.nearest(p, within);
        const double radius = tube.startRadius + near.along * (tube.endRadius - tube.startRadius);
        field = smoothMinimum(field, near.distance - radius, fillet);
      }
    }
    return field;
  }

  double steepness() const override { return 1.1; }

private:
  struct Tube
  {
    Curve axis;
    double startRadius; ///< not less than endRadius
    double endRadius;
    Eigen::Vector3d centre; ///< of a ball that holds the axis
    double reach;           ///< that ball's radius
  };

  /** A tube that sets out from `start` along `heading`, at its end bent aside by `bend` (a world length). */
  void grow(const Eigen::Vector3d& start, const Eigen::Vector3d& heading, const Eigen::Vector3d& bend,
            double length, double startRadius, double endRadius)
  {
    const Eigen::Vector3d step = length / 3.0 * heading.normalized();
    const Curve axis({start, start + step - 0.4 * bend, start + 2.0 * step, start + 3.0 * step + bend},
                     std::max(12, int(length / 0.015)));
    const Eigen::Vector3d centre = axis.point(axis.segments() / 2);
    double reach = 0.0;
    for (std::size_t i = 0; i <= axis.segments(); ++i)
    {
      reach = std::max(reach, (axis.point(i) - centre).norm());
    }
    this->Tubes.push_back({axis, startRadius, endRadius, centre, reach});
  }

  Eigen::Vector3d at(std::size_t tube, double along) const
  {
    const Curve& axis = this->Tubes[tube].axis;
    return axis.point(std::size_t(along * double(axis.segments()) + 0.5));
  }

  std::vector<Tube> Tubes;
};

/** Ellipsoids side by side around an axis, melted together, and a tapering stalk that bends away from it. */
class PumpkinField : public DistanceField
{
public:
  double operator()(const Eigen::Vector3d& p) const override
  {
    const Eigen::Vector3d q = this->Upright * (p - Eigen::Vector3d(0.0, 0.0, -0.16));
    double field = 1.0;
    for (int i = 0; i < Lobes; ++i)
    {
      const double turn = 2.0 * Pi * i / Lobes;
      const double larger = 1.0 + 0.05 * std::cos(turn) + 0.03 * std::sin(2.0 * turn);
      const Eigen::Vector3d outward(std::cos(turn), std::sin(turn), 0.0);
      const Eigen::Vector3d across(-outward.y(), outward.x(), 0.0);
      const Eigen::Vector3d lobe((q.dot(outward) - 0.40) / 0.46, q.dot(across) / 0.25, q.z() / 0.56);
      // Not the distance, but never more than it, and of its sign.
      field = smoothMinimum(field, 0.25 * (lobe.norm() - larger), 0.03);
    }
    const Curve::Nearest near = this->Stalk.nearest(q, field + 0.3);
    return smoothMinimum(field, near.distance - (0.10 - 0.03 * near.along), 0.05);
  }

  double steepness() const override { return 1.1; }

private:
  static constexpr int Lobes = 9;
  /** Tilted, so that no ring of cameras around z sees the lobes alike. */
  Eigen::Matrix3d Upright =
      Eigen::AngleAxisd(0.3, Eigen::Vector3d(0.8, -0.6, 0.0)).toRotationMatrix();
  Curve Stalk{{{0, 0, 0.2}, {0, 0, 0.45}, {0.02, 0.01, 0.75}, {0.16, 0.08, 0.98}, {0.36, 0.14, 1.04}}, 64};
};

/** Twelve points and twenty faces, the faces counter-clockwise seen from outside. */
Mesh icosahedron()
{
  const double g = 0.5 * (1.0 + std::sqrt(5.0));
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
  {
    for (int signs = 0; signs < 4; ++signs)
    {
      Eigen::Vector3d p = Eigen::Vector3d::Zero();
      p[(axis + 1) % 3] = signs & 1 ? 1.0 : -1.0;
      p[(axis + 2) % 3] = signs & 2 ? g : -g;
      mesh.points.push_back(p);
    }
  }
  const auto adjacent = [&](int a, int b) { return (mesh.points[a] - mesh.points[b]).squaredNorm() < 4.5; };
  for (int a = 0; a < 12; ++a)
  {
    for (int b = a + 1; b < 12; ++b)
    {
      for (int c = b + 1; c < 12; ++c)
      {
        if (adjacent(a, b) && adjacent(b, c) && adjacent(c, a))
        {
          const bool outwards = mesh.points[a].dot(mesh.points[b].cross(mesh.points[c])) > 0.0;
          mesh.triangles.push_back(outwards ? Triangle{a, b, c} : Triangle{a, c, b});
        }
      }
    }
  }
  return mesh;
}

/** A geodesic sphere: the points of a lattice on each face of the icosahedron, pushed out. */
class GeodesicSphere
{
public:
  Mesh operator()(int parts)
  {
    for (const Triangle& face : this->Base.triangles)
    {
      const auto point = [&](int b, int c) { return this->point(face, {parts - b - c, b, c}); };
      for (int b = 0; b < parts; ++b)
      {
        for (int c = 0; b + c < parts; ++c)
        {
          this->Result.triangles.push_back({point(b, c), point(b + 1, c), point(b, c + 1)});
          if (b + c + 1 < parts)
          {
            this->Result.triangles.push_back({point(b + 1, c), point(b + 1, c + 1), point(b, c + 1)});
          }
        }
      }
    }
    return std::move(this->Result);
  }

private:
  /** The point with these weights of the face's corners; both faces of an edge name its points alike. */
  std::int32_t point(const Triangle& face, const std::array<int, 3>& weights)
  {
    std::array<std::array<int, 2>, 3> name; // base point, weight
    for (int c = 0; c < 3; ++c)
    {
      name[c] = {weights[c] > 0 ? face[c] : -1, weights[c]};
    }
    std::sort(name.begin(), name.end());
    const auto [found, isNew] = this->Names.emplace(name, std::int32_t(this->Result.points.size()));
    if (isNew)
    {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      for (const auto& [corner, weight] : name)
      {
        sum += weight > 0 ? Eigen::Vector3d(weight * this->Base.points[corner]) : Eigen::Vector3d::Zero();
      }
      this->Result.points.push_back(sphereRadius * sum.normalized());
    }
    return found->second;
  }

  Mesh Base = icosahedron();
  std::map<std::array<std::array<int, 2>, 3>, std::int32_t> Names;
  Mesh Result;
};

/** Each point moved along its ray from the origin to the pebble's surface. */
Mesh pebble(Mesh mesh)
{
  for (Eigen::Vector3d& p : mesh.points)
  {
    p /= pebbleLevel(p);
  }
  return mesh;
}

/** `around` quadrangles around the axis, `across` around the tube, each cut in two. */
Mesh torus(int around, int across)
{
  const Eigen::Vector3d axis = torusAxis();
  const Eigen::Vector3d first = axis.cross(Eigen::Vector3d::UnitX()).normalized();
  const Eigen::Vector3d second = axis.cross(first);
  Mesh mesh;
  for (int i = 0; i < around; ++i)
  {
    const double a = 2.0 * Pi * i / around;
    const Eigen::Vector3d outward = std::cos(a) * first + std::sin(a) * second;
    for (int j = 0; j < across; ++j)
    {
      const double b = 2.0 * Pi * j / across;
      mesh.points.push_back((torusRingRadius + torusTubeRadius * std::cos(b)) * outward +
                            torusTubeRadius * std::sin(b) * axis);
      const std::int32_t j1 = (j + 1) % across;
      const std::int32_t i0 = i * across;
      const std::int32_t i1 = (i + 1) % around * across;
      mesh.triangles.push_back({i0 + j, i1 + j, i1 + j1});
      mesh.triangles.push_back({i0 + j, i1 + j1, i0 + j1});
    }
  }
  return mesh;
}

} // namespace

Eigen::Vector3d torusAxis()
{
  return Eigen::Vector3d(0.48, -0.36, 0.8); // of length 1
}

double pebbleLevel(const Eigen::Vector3d& p)
{
  static const Eigen::Matrix3d axes = (Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitX()) *
                                       Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitY()) *
                                       Eigen::AngleAxisd(0.9, Eigen::Vector3d::UnitZ()))
                                          .toRotationMatrix();
  constexpr double exponent = 2.5; // rounder than a box, squarer than an ellipsoid
  const double behind[] = {0.84, 0.70, 0.44};
  const double ahead[] = {0.98, 0.62, 0.56};
  const Eigen::Vector3d q = axes.transpose() * p;
  double sum = 0.0;
  for (int axis = 0; axis < 3; ++axis)
  {
    sum += std::pow(std::abs(q[axis]) / (q[axis] < 0.0 ? behind : ahead)[axis], exponent);
  }
  return std::pow(sum, 1.0 / exponent);
}

Mesh syntheticShape(SyntheticShape shape, const SyntheticShapeOptions& options)
{
  const double finer = options.refinement;
  if (!(finer >= 0.5 && finer <= 4.0))
  {
    throw InvalidInput("refinement " + std::to_string(finer) + " is outside 0.5 to 4");
  }
  const auto scaled = [&](int count) { return int(std::lround(count * finer)); };
  switch (shape)
  {
  case SyntheticShape::Jug:
    return contourField(JugField(), 2.0 / scaled(180));
  case SyntheticShape::Sphere:
    return GeodesicSphere()(scaled(64));
  case SyntheticShape::Torus:
    return torus(scaled(360), scaled(160));
  case SyntheticShape::Twig:
    return contourField(TwigField(), 2.0 / scaled(800));
  case SyntheticShape::Pebble:
    return pebble(GeodesicSphere()(scaled(64)));
  case SyntheticShape::Pumpkin:
    return contourField(PumpkinField(), 2.0 / scaled(180));
  }
  throw InvalidInput("synthetic shape " + std::to_string(int(shape)) + " is unknown");
}

} // namespace silhouette
