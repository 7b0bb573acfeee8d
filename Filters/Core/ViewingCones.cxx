// SPDX-License-Identifier: BSD-3-Clause
#include "ViewingCones.h"

#include <Eigen/QR>

#include <algorithm>
#include <optional>
#include <vector>

namespace silhouette
{
namespace
{

/** A point X is within a cone iff each plane's value at (X, 1) is at least 0, or it lies behind the camera. */
struct Cone
{
  std::vector<Eigen::RowVector4d> planes;
  Eigen::RowVector4d depth;
  bool empty = false; ///< the silhouette is: nothing in front of the camera is within
};

/** With `framed`, every side of the image bounds, whether its view abstains beyond it or not. */
Cone makeCone(const PreparedView& view, bool framed)
{
  Cone cone;
  const auto& P = view.projection;
  const auto& box = view.objectBox;
  cone.depth = P.row(2);
  cone.empty = box[1] < 0;
  // Half a pixel around the outermost pixel centres. An open side (left, right, top, bottom) does not bound.
  const double bounds[4] = { box[0] - 0.5, box[1] + 0.5, box[2] - 0.5, box[3] + 0.5 };
  for (int side = 0; side < 4 && !cone.empty; ++side)
  {
    if (framed || !view.open[side])
    {
      const Eigen::RowVector4d plane = P.row(side / 2) - bounds[side] * P.row(2);
      cone.planes.push_back(side % 2 == 0 ? plane : -plane);
    }
  }
  return cone;
}

/** Greatest value of a plane over a box. */
double greatest(const Eigen::RowVector4d& plane, const Box& box)
{
  double value = plane[3];
  for (int axis = 0; axis < 3; ++axis)
  {
    value += std::max(plane[axis] * box.min()[axis], plane[axis] * box.max()[axis]);
  }
  return value;
}

bool leavesOut(const Cone& cone, const Box& box)
{
  if (-greatest(-cone.depth, box) <= 0.0)
  {
    return false; // part of the box lies behind the camera
  }
  return cone.empty ||
    std::any_of(cone.planes.begin(), cone.planes.end(),
      [&](const Eigen::RowVector4d& plane) { return greatest(plane, box) < 0.0; });
}

bool survives(const std::vector<Cone>& cones, const Box& box, int backgroundVotes)
{
  int votes = 0;
  for (const auto& cone : cones)
  {
    votes += leavesOut(cone, box);
    if (votes > backgroundVotes)
    {
      return false;
    }
  }
  return true;
}

/** Extend `found` by the boxes that survive `levels` subdivisions of `box`. */
void subdivide(const std::vector<Cone>& cones, const Box& box, int backgroundVotes, int levels, Box& found)
{
  if (found.contains(box) || !survives(cones, box, backgroundVotes))
  {
    return;
  }
  if (levels == 0)
  {
    found.extend(box);
    return;
  }
  const Eigen::Vector3d middle = box.center();
  for (int c = 0; c < 8; ++c)
  {
    Box child;
    child.extend(middle);
    child.extend(box.corner(Box::CornerType(c)));
    subdivide(cones, child, backgroundVotes, levels - 1, found);
  }
}

constexpr int SearchLevels = 5;

/** Search the box again and again, until it settles; what a coarse search kept too much of may turn out to be empty. */
std::optional<Box> tightened(const std::vector<Cone>& cones, Box box, int backgroundVotes)
{
  constexpr int Rounds = 32;
  for (int round = 0; round < Rounds; ++round)
  {
    Box found;
    subdivide(cones, box, backgroundVotes, SearchLevels, found);
    if (found.isEmpty())
    {
      return std::nullopt;
    }
    const bool settled = found.volume() > 0.9 * box.volume();
    box = found;
    if (settled)
    {
      break;
    }
  }
  return box;
}

/** How large the object looks at point X, in world units: the median over the views. */
double apparentSize(const PreparedViews& views, const Vector3& X)
{
  std::vector<double> sizes;
  for (int i = 0; i < views.size(); ++i)
  {
    const auto& view = views[i];
    const Eigen::Vector3d h = view.projection * X.homogeneous();
    const auto& box = view.objectBox;
    const double pixels = std::max(box[1] - box[0], box[3] - box[2]) + 1;
    if (box[1] >= 0 && h.z() != 0.0)
    {
      // Pixels a world unit: the derivative of (u, v) along the direction that moves it most.
      const Eigen::Matrix<double, 2, 3> J =
        (view.projection.topLeftCorner<2, 3>() - (h.head<2>() / h.z()) * view.projection.row(2).head<3>()) / h.z();
      sizes.push_back(pixels / J.norm());
    }
  }
  if (sizes.empty())
  {
    return 1.0;
  }
  std::nth_element(sizes.begin(), sizes.begin() + sizes.size() / 2, sizes.end());
  return sizes[sizes.size() / 2];
}

Vector2 boxCentre(const PreparedView& view)
{
  const auto& box = view.objectBox;
  return box[1] < 0 ? Vector2(0.5 * (view.width - 1), 0.5 * (view.height - 1))
                    : Vector2(0.5 * (box[0] + box[1]), 0.5 * (box[2] + box[3]));
}

/** Does the search box, doubled until the cones close in it, hold them? Empty where they do not meet. */
struct Search
{
  std::optional<Box> box;
  bool unbounded = false;
};

Search search(const std::vector<Cone>& cones, const Vector3& centre, double half, int backgroundVotes)
{
  constexpr int Doublings = 12;
  for (int doubling = 0; doubling <= Doublings; ++doubling, half *= 2.0)
  {
    const Box box(centre - Vector3::Constant(half), centre + Vector3::Constant(half));
    Box found;
    subdivide(cones, box, backgroundVotes, SearchLevels, found);
    if (!found.isEmpty() && (found.min().array() > box.min().array()).all() &&
      (found.max().array() < box.max().array()).all())
    {
      return { tightened(cones, found, backgroundVotes), false };
    }
    // Nothing near where the rays meet: a larger search finds it if it is anywhere.
    if (found.isEmpty() && doubling >= 4)
    {
      return {};
    }
  }
  return { std::nullopt, true };
}

[[noreturn]] void throwEmpty(
  const PreparedViews& views, std::vector<Cone> cones, const Vector3& centre, double half, int backgroundVotes)
{
  std::string culprits;
  for (int i = 0; i < views.size() && views.size() > 2; ++i)
  {
    std::swap(cones[i], cones.back());
    const Cone left = cones.back();
    cones.pop_back();
    const Search without = search(cones, centre, half, std::min(backgroundVotes, views.size() - 2));
    cones.push_back(left);
    std::swap(cones[i], cones.back());
    if (without.box || without.unbounded)
    {
      culprits += (culprits.empty() ? "" : ", ") + describeView(std::size_t(i), views[i].name);
    }
  }
  throw NothingSurvives("nothing survives: the viewing cones of the silhouettes have no point in common" +
    (culprits.empty() ? std::string("; no single view is at fault")
                      : "; something would be left without " + culprits) +
    ". Check the projection matrices and the silhouettes' polarity");
}

} // namespace

Box intersectViewingCones(const PreparedViews& views, int backgroundVotes)
{
  std::vector<Projection> projections;
  std::vector<Vector2> pixels;
  for (int i = 0; i < views.size(); ++i)
  {
    if (views[i].objectBox[1] < 0 && backgroundVotes == 0)
    {
      throw NothingSurvives("nothing survives: the silhouette of " + describeView(std::size_t(i), views[i].name) + " is empty");
    }
    projections.push_back(views[i].projection);
    pixels.push_back(boxCentre(views[i]));
  }
  const Vector3 centre = nearestPointToRays(projections, pixels);
  const double half = apparentSize(views, centre);
  for (const bool framed : { false, true })
  {
    std::vector<Cone> cones;
    for (int i = 0; i < views.size(); ++i)
    {
      cones.push_back(makeCone(views[i], framed));
    }
    const Search result = search(cones, centre, half, backgroundVotes);
    if (result.box)
    {
      return *result.box;
    }
    if (!result.unbounded)
    {
      throwEmpty(views, cones, centre, half, backgroundVotes);
    }
  }
  const bool mayDissent = backgroundVotes > 0;
  throw UnboundedObject("automatic bounds: the viewing cones of the " + std::to_string(views.size()) +
    (views.size() == 1 ? " view" : " views") +
    (mayDissent ? ", of which " + std::to_string(backgroundVotes) + " may dissent (background votes)," : "") +
    " do not close around the object; give the bounds, " + (mayDissent ? "fewer background votes, " : "") +
    "or more views from other directions");
}

Vector3 nearestPointToRays(const std::vector<Projection>& projections, const std::vector<Vector2>& pixels)
{
  if (projections.empty() || projections.size() != pixels.size())
  {
    throw InvalidInput(std::to_string(pixels.size()) + " pixels for " + std::to_string(projections.size()) +
      " projection matrices: as many of each are needed, and at least one");
  }
  // Two planes through each ray; their normals made units, so that distances count in world units.
  Eigen::MatrixX3d A(2 * projections.size(), 3);
  Eigen::VectorXd b(2 * projections.size());
  for (std::size_t i = 0; i < projections.size(); ++i)
  {
    for (int axis = 0; axis < 2; ++axis)
    {
      Eigen::RowVector4d plane = projections[i].row(axis) - pixels[i][axis] * projections[i].row(2);
      const double norm = plane.head<3>().norm();
      if (norm > 0.0)
      {
        plane /= norm;
      }
      A.row(2 * i + axis) = plane.head<3>();
      b[2 * i + axis] = -plane[3];
    }
  }
  // The least solution where the rays leave it free (one view).
  return A.completeOrthogonalDecomposition().solve(b);
}

Vector2 silhouetteCentroid(const BinaryImage& silhouette)
{
  double u = 0.0, v = 0.0, count = 0.0;
  for (int row = 0; row < silhouette.height; ++row)
  {
    for (int column = 0; column < silhouette.width; ++column)
    {
      if (silhouette.at(column, row))
      {
        u += column;
        v += row;
        count += 1.0;
      }
    }
  }
  return count > 0.0 ? Vector2(u / count, v / count)
                     : Vector2(0.5 * (silhouette.width - 1), 0.5 * (silhouette.height - 1));
}

} // namespace silhouette
