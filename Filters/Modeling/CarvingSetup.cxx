// SPDX-License-Identifier: BSD-3-Clause
#include "CarvingSetup.h"

#include "AutomaticBounds.h"
#include "Carving.h"
#include "CarvingTolerance.h"
#include "Error.h"
#include "ProjectiveCameras.h"
#include "ViewConversion.h"
#include "ViewingCones.h"

#include <Eigen/LU>

#include <cmath>
#include <sstream>

namespace silhouette::modeling
{
namespace
{

void checkDepth(int depth)
{
  if (depth < 1 || depth > MaximumDepth)
  {
    throw InvalidInput("depth " + std::to_string(depth) + " is out of range: 1 to " +
                       std::to_string(MaximumDepth) + " are possible");
  }
}

RootCube givenCube(const std::array<double, 6>& bounds)
{
  Eigen::Vector3d lowest, highest;
  for (int axis = 0; axis < 3; ++axis)
  {
    lowest[axis] = bounds[2 * axis];
    highest[axis] = bounds[2 * axis + 1];
    if (!std::isfinite(lowest[axis]) || !std::isfinite(highest[axis]) || !(lowest[axis] < highest[axis]))
    {
      std::ostringstream text;
      text << "bounds " << lowest[axis] << " to " << highest[axis] << " on axis "
           << "xyz"[axis] << " are not a box: two finite numbers, the smaller first, are needed";
      throw InvalidInput(text.str());
    }
  }
  return enclosingCube(lowest, highest);
}

int depthFor(double leafEdge, double edge)
{
  int depth = 1;
  while (depth <= MaximumDepth && std::ldexp(edge, -depth) > leafEdge)
  {
    ++depth;
  }
  if (depth > MaximumDepth)
  {
    std::ostringstream text;
    text << "octants of edge " << leafEdge << " in a cube of edge " << edge << " need a depth above "
         << MaximumDepth;
    throw InvalidInput(text.str());
  }
  return depth;
}

/** Empty silhouettes, more than the votes forgive: the cones would not say whose fault it is. */
void checkEmptySilhouettes(const PreparedViews& views, int backgroundVotes)
{
  std::vector<int> empty;
  for (int i = 0; i < views.size(); ++i)
  {
    if (views[i].objectPixels(0, views[i].width, 0, views[i].height) == 0)
    {
      empty.push_back(i);
    }
  }
  if (int(empty.size()) > backgroundVotes)
  {
    throw NothingSurvives("nothing survives: " + std::to_string(empty.size()) + " of " +
                          std::to_string(views.size()) + " silhouettes are empty, the first is that of " +
                          describeView(std::size_t(empty.front()), views[empty.front()].name));
  }
}

bool cameraInside(const Projection& projection, const RootCube& root)
{
  const Eigen::Matrix3d left = projection.leftCols<3>();
  const Eigen::FullPivLU<Eigen::Matrix3d> lu(left);
  if (!lu.isInvertible())
  {
    return false; // a camera at infinity
  }
  const Eigen::Vector3d centre = lu.solve(-projection.col(3));
  const Eigen::Array3d inRoot = (centre - root.origin).array();
  return (inRoot >= 0.0).all() && (inRoot <= root.edge).all();
}

/** The sides of its image that a silhouette touches, in words. */
std::string touchedSides(const PreparedView& view)
{
  const std::array<bool, 4> touched = {view.objectBox[0] == 0, view.objectBox[1] == view.width - 1,
                                       view.objectBox[2] == 0, view.objectBox[3] == view.height - 1};
  const char* const names[4] = {"left", "right", "top", "bottom"};
  std::string text;
  for (int side = 0; side < 4; ++side)
  {
    if (touched[side])
    {
      text += (text.empty() ? "" : ", ") + std::string(names[side]);
    }
  }
  return text;
}

std::string silhouetteWarning(const PreparedView& view, const std::string& name)
{
  const std::int64_t objects = view.objectPixels(0, view.width, 0, view.height);
  if (objects == std::int64_t(view.width) * view.height)
  {
    return name + ": the silhouette is all object; it carves nothing within its image";
  }
  const std::string sides = objects > 0 ? touchedSides(view) : std::string();
  return sides.empty() ? sides : name + ": the silhouette is cut by the image's border (" + sides + ")";
}

/** Views that have the object behind them: where the rays through the silhouettes' middles meet, their w is negative. */
std::string lookingAwayWarning(const PreparedViews& views)
{
  std::vector<Projection> projections;
  std::vector<Vector2> middles;
  std::vector<int> seen;
  for (int i = 0; i < views.size(); ++i)
  {
    const auto& box = views[i].objectBox;
    if (box[1] >= box[0])
    {
      projections.push_back(views[i].projection);
      middles.emplace_back(0.5 * (box[0] + box[1]), 0.5 * (box[2] + box[3]));
      seen.push_back(i);
    }
  }
  if (seen.size() < 2)
  {
    return {};
  }
  const Vector3 object = nearestPointToRays(projections, middles);
  int away = 0, first = -1;
  for (std::size_t n = 0; n < seen.size() && object.allFinite(); ++n)
  {
    const bool isAway = projections[n].row(2).dot(object.homogeneous()) < 0.0;
    away += isAway;
    first = isAway && first < 0 ? seen[n] : first;
  }
  if (away == 0)
  {
    return {};
  }
  return std::to_string(away) + " of " + std::to_string(views.size()) +
         " cameras have behind them what their silhouettes show (w < 0 where their rays meet), the first is that of " +
         describeView(std::size_t(first), views[first].name) +
         "; a camera's axes are right, down and forward, and a matrix is taken with its sign";
}

/** Few warnings apart, many as one: a line for each of hundreds of views would hide all others. */
void appendJoined(std::vector<std::string>& some, std::vector<std::string>& warnings)
{
  constexpr std::size_t MostApart = 8;
  if (some.size() <= MostApart)
  {
    warnings.insert(warnings.end(), some.begin(), some.end());
    return;
  }
  std::string text = std::to_string(some.size()) + " silhouettes are doubtful";
  for (const std::string& one : some)
  {
    text += "; " + one;
  }
  warnings.push_back(std::move(text));
}

bool hasInsideBorderCorner(const LatticePoint& cell, const Octree& octree, const LatticeViews& views)
{
  for (int c = 0; c < 8; ++c)
  {
    const LatticePoint corner = cell + cornerOffset(c);
    if (octree.lattice.onBorder(corner) &&
        views.insideVotes(corner) >= octree.viewCount - octree.backgroundVotes)
    {
      return true;
    }
  }
  return false;
}

CarveStatistics noStatistics(const LatticeViews& views)
{
  CarveStatistics statistics;
  statistics.carvedByView.assign(std::size_t(views.size()), 0.0);
  return statistics;
}

Octree carveWhole(const LatticeViews& views, int backgroundVotes, Execution& execution)
{
  CarveOptions options;
  options.backgroundVotes = backgroundVotes;
  return carve(views, options, execution);
}

/** The trees of a piece. */
Octree carvePiece(const FoundWhole& whole, const Piece& piece, Execution& execution)
{
  const LatticeViews views(*whole.used.views, whole.lattice);
  CarveOptions options;
  options.backgroundVotes = whole.backgroundVotes;
  options.trees = treesOfPiece(whole.weights, piece);
  if (!options.trees.empty())
  {
    return carve(views, options, execution);
  }
  options.trees = {0}; // more pieces than work: an octree with everything but octants
  Octree empty = selectTrees(carve(views, options, execution), {});
  empty.statistics = noStatistics(views);
  return empty;
}

/** With more votes, or dilated silhouettes, where silhouettes are not covered. */
CarvedViews carveWithTolerance(const SharedViews& views, const LatticeSettings& settings, const Carve& carveOnce,
                               const std::function<void(const std::string&)>& warn, Execution& execution)
{
  CarvingToleranceOptions options;
  options.backgroundVotes = settings.backgroundVotes;
  TolerantCarving found = carveTolerantly(views, carveOnce, options, execution);
  CarvedViews carved;
  carved.octree = std::move(found.octree);
  carved.views = std::move(found.views);
  carved.dilatedViews = std::move(found.dilatedViews);
  carved.dilation = found.dilation;
  carved.uncovered = found.uncovered;
  carved.strictUncovered = found.strictUncovered;
  constexpr double Doubtful = 0.05; // more than noise leaves
  if (found.uncovered > Doubtful)
  {
    std::ostringstream text;
    text.precision(3);
    text << "the octree leaves " << 100.0 * found.uncovered
         << " % of the silhouettes uncovered, more than noise does: a camera, " << (settings.automaticBounds ? "" : "the given box, ")
         << "or a silhouette, is probably wrong; "
         << describeView(std::size_t(found.leastCoveredView), (*views)[found.leastCoveredView].name) << " has the most uncovered, "
         << 100.0 * found.greatestUncovered << " %";
    warn(text.str());
  }
  return carved;
}

} // namespace

Lattice makeLattice(const PreparedViews& views, const LatticeSettings& settings, Execution& execution)
{
  if (!(settings.leafEdge >= 0.0) || std::isinf(settings.leafEdge))
  {
    throw InvalidInput("leaf edge " + std::to_string(settings.leafEdge) + " is not a length");
  }
  if (settings.leafEdge == 0.0)
  {
    checkDepth(settings.depth);
  }
  if (settings.backgroundVotes < 0 || settings.backgroundVotes >= views.size())
  {
    throw InvalidInput(std::to_string(settings.backgroundVotes) + " background votes of " +
                       std::to_string(views.size()) + " views are out of range: 0 to " +
                       std::to_string(views.size() - 1) + " are possible");
  }
  checkEmptySilhouettes(views, settings.backgroundVotes);
  const bool findDepth = settings.leafEdge > 0.0;
  if (!settings.automaticBounds)
  {
    const RootCube cube = givenCube(settings.bounds);
    return {cube, findDepth ? depthFor(settings.leafEdge, cube.edge) : settings.depth};
  }
  AutomaticBoundsOptions options;
  options.backgroundVotes = settings.backgroundVotes;
  if (findDepth)
  {
    // The cube depends a little on the depth that it is meant for: find the depth in a first one.
    Phase first(execution, 0.0, 0.5);
    options.depth = depthFor(settings.leafEdge, automaticBounds(views, options, first).edge);
    Phase second(execution, 0.5, 1.0);
    const RootCube cube = automaticBounds(views, options, second);
    return {cube, depthFor(settings.leafEdge, cube.edge)};
  }
  options.depth = settings.depth;
  return {automaticBounds(views, options, execution), settings.depth};
}

std::vector<std::string> viewWarnings(const PreparedViews& views)
{
  std::vector<std::string> warnings;
  std::vector<Projection> projections;
  std::vector<std::string> names;
  std::vector<std::string> silhouettes;
  for (int i = 0; i < views.size(); ++i)
  {
    const PreparedView& view = views[i];
    std::string warning = silhouetteWarning(view, describeView(std::size_t(i), view.name));
    if (!warning.empty())
    {
      silhouettes.push_back(std::move(warning));
    }
    projections.push_back(view.projection);
    names.push_back(view.name);
  }
  appendJoined(silhouettes, warnings);
  std::string away = lookingAwayWarning(views);
  if (!away.empty())
  {
    warnings.push_back(std::move(away));
  }
  std::string projective = projectiveWarning(projections, names);
  if (!projective.empty())
  {
    warnings.push_back(std::move(projective));
  }
  return warnings;
}

std::vector<std::string> latticeWarnings(const PreparedViews& views, const Lattice& lattice, bool automaticBounds)
{
  std::vector<std::string> warnings;
  for (int i = 0; i < views.size(); ++i)
  {
    if (cameraInside(views[i].projection, lattice.root))
    {
      warnings.push_back(describeView(std::size_t(i), views[i].name) +
                         ": the camera is inside the root cube; the view says nothing of what is behind it");
    }
  }
  if (views.size() == 1 && !automaticBounds)
  {
    warnings.push_back("only " + describeView(0, views[0].name) +
                       ": the object is bounded by the given box alone along the line of sight");
  }
  return warnings;
}

bool FoundWhole::isFor(const SharedViews& views, const LatticeSettings& others, bool tolerance) const
{
  const LatticeSettings& own = this->settings;
  return this->given && this->given == views && own.depth == others.depth && own.leafEdge == others.leafEdge &&
         own.automaticBounds == others.automaticBounds && own.bounds == others.bounds &&
         own.backgroundVotes == others.backgroundVotes && this->automaticTolerance == tolerance;
}

CarvedViews carveViews(const SharedViews& views, const LatticeSettings& settings, bool automaticTolerance,
                       FoundWhole& found, const std::function<void(const std::string&)>& warn,
                       Execution& execution)
{
  const bool isLater = settings.piece.number > 0;
  if (isLater && found.isFor(views, settings, automaticTolerance))
  {
    CarvedViews carved{found.used, carvePiece(found, settings.piece, execution)};
    if (automaticTolerance)
    {
      carved.octree.statistics = noStatistics({*carved.views, found.lattice}); // the whole's count once
    }
    return carved;
  }
  bool warned = false;
  const auto findLattice = [&](const PreparedViews& used, int backgroundVotes, Execution& bounding)
  {
    LatticeSettings own = settings;
    own.backgroundVotes = backgroundVotes;
    const auto tell = [&](const std::vector<std::string>& warnings) { std::for_each(warnings.begin(), warnings.end(), warn); };
    if (!warned)
    {
      tell(viewWarnings(used)); // before the bounds, which such views may not give
    }
    const Lattice lattice = makeLattice(used, own, bounding);
    if (!warned)
    {
      tell(latticeWarnings(used, lattice, settings.automaticBounds));
    }
    warned = true;
    return lattice;
  };
  const Carve carveOnce = [&](const PreparedViews& used, int backgroundVotes, Execution& part)
  {
    Phase bounding(part, 0.0, 0.25);
    const Lattice lattice = findLattice(used, backgroundVotes, bounding);
    Phase carving(part, 0.25, 1.0);
    return carveWhole({used, lattice}, backgroundVotes, carving);
  };
  found = FoundWhole();
  UsedViews asGiven;
  asGiven.views = views;
  if (settings.piece.count == 1)
  {
    return automaticTolerance ? carveWithTolerance(views, settings, carveOnce, warn, execution)
                              : CarvedViews{asGiven, carveOnce(*views, settings.backgroundVotes, execution)};
  }
  FoundWhole whole{views, settings, automaticTolerance, asGiven, {}, settings.backgroundVotes, {}};
  CarvedViews carved;
  const double untilFound = automaticTolerance ? 0.9 : 0.2; // of the work; a tolerance is found by carving the whole
  Phase finding(execution, 0.0, untilFound);
  if (automaticTolerance)
  {
    carved = carveWithTolerance(views, settings, carveOnce, warn, finding);
    whole.used = carved;
    whole.lattice = carved.octree.lattice;
    whole.backgroundVotes = carved.octree.backgroundVotes;
  }
  else
  {
    whole.lattice = findLattice(*views, settings.backgroundVotes, finding);
  }
  const LatticeViews latticeViews(*whole.used.views, whole.lattice);
  Phase weighing(execution, untilFound, untilFound + 0.1);
  whole.weights = weighTrees(latticeViews, whole.backgroundVotes, weighing);
  if (automaticTolerance)
  {
    carved.octree = selectTrees(carved.octree, treesOfPiece(whole.weights, settings.piece));
    carved.octree.statistics = isLater ? noStatistics(latticeViews) : carved.octree.statistics;
  }
  else
  {
    Phase carving(execution, 0.3, 1.0);
    carved = {whole.used, carvePiece(whole, settings.piece, carving)};
  }
  found = std::move(whole);
  return carved;
}

std::string cutByBoxWarning(const Octree& octree, const LatticeViews& views)
{
  const Generation& last = octree.last();
  const std::int32_t highest = octree.lattice.cells() - 1;
  for (std::size_t i = 0; i < last.size(); ++i)
  {
    const LatticePoint cell = fromMorton(last.code[i]);
    const bool atBorder = cell.i == 0 || cell.j == 0 || cell.k == 0 || cell.i == highest ||
                          cell.j == highest || cell.k == highest;
    if (last.state[i] != OctantState::Background && atBorder && hasInsideBorderCorner(cell, octree, views))
    {
      const Eigen::Vector3d at = octree.lattice.position(cell);
      std::ostringstream text;
      text << "the object is cut by the root cube's border, at " << at[0] << ", " << at[1] << ", " << at[2]
           << " for one; no view's silhouette ends there";
      return text.str();
    }
  }
  return {};
}

} // namespace silhouette::modeling
