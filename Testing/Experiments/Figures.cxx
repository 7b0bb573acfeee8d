// SPDX-License-Identifier: BSD-3-Clause
#include "Figures.h"

#include "CaptureNoise.h"
#include "ConvexHull.h"
#include "Methods.h"
#include "Pictures.h"
#include "SilhouetteOffScreen.h"
#include "Study.h"
#include "Tables.h"
#include "VoteTable.h"
#include "VtkMeshes.h"

#include "vtkDelaunay3D.h"
#include "vtkGeometryFilter.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>
#include <cstdio>

namespace silhouette::experiments
{
namespace
{

const std::array<double, 3> Sand = {0.87, 0.84, 0.76};
const std::array<double, 3> Blue = {0.58, 0.74, 0.88};
const std::array<double, 3> Green = {0.66, 0.82, 0.62};

std::filesystem::path pictureFile(const std::filesystem::path& folder, const std::string& name)
{
  return folder / ("experiments-" + name + ".png");
}

/** Figure 6.3: the four surfaces of the nearest table. */
void makeVoteFigure(const StudyOptions& options, const std::filesystem::path& folder, Execution& execution)
{
  const std::vector<VoteTable> tables = readVoteTables(votesFile(options.output));
  const VoteTable table = tables.empty() ? VoteTable() : nearestTable(tables);
  const std::vector<Mesh> surfaces = voteSurfaces(table, execution);
  std::vector<Picture> pictures;
  for (std::size_t s = 0; s < surfaces.size(); ++s)
  {
    Look look;
    look.side = 230;
    look.below = std::string(1, char('a' + s)) + ": " + std::to_string(std::lround(100.0 * VoteShares[s])) +
                 " %, " + std::to_string(surfaces[s].triangles.size()) + " faces";
    pictures.push_back(pictureOf(polyData(surfaces[s]), look));
  }
  writePng(sideBySide(pictures), pictureFile(folder, "figure-6-3"));
}

std::vector<Eigen::Vector3d> randomPoints(std::size_t count)
{
  const std::uint64_t key = noiseKey(11, NoiseKind::Blobs, 0);
  std::vector<Eigen::Vector3d> points;
  for (std::uint64_t place = 0; points.size() < count; place += 3)
  {
    const Eigen::Vector3d p(uniformAt(key, place), uniformAt(key, place + 1), uniformAt(key, place + 2));
    points.push_back(1.3 * (p - Eigen::Vector3d::Constant(0.5)));
  }
  return points;
}

/** The tetrahedra apart from each other; those before a plane through the middle are cut away. */
Mesh apart(vtkUnstructuredGrid* grid, bool cut)
{
  constexpr int faces[4][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}};
  Mesh mesh;
  vtkNew<vtkIdList> corners;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); ++c)
  {
    grid->GetCellPoints(c, corners);
    std::array<Eigen::Vector3d, 4> p;
    for (int i = 0; i < 4 && corners->GetNumberOfIds() == 4; ++i)
    {
      p[i] = Eigen::Map<const Eigen::Vector3d>(grid->GetPoint(corners->GetId(i)));
    }
    const Eigen::Vector3d middle = 0.25 * (p[0] + p[1] + p[2] + p[3]);
    if (corners->GetNumberOfIds() != 4 || (cut && middle.y() < 0.0))
    {
      continue;
    }
    const std::int32_t first = std::int32_t(mesh.points.size());
    for (const Eigen::Vector3d& corner : p)
    {
      mesh.points.push_back(middle + 0.8 * (corner - middle));
    }
    const bool turned = (p[1] - p[0]).cross(p[2] - p[0]).dot(p[3] - p[0]) < 0.0;
    for (const auto& face : faces)
    {
      mesh.triangles.push_back({first + face[0], first + face[turned ? 2 : 1], first + face[turned ? 1 : 2]});
    }
  }
  return mesh;
}

/** A row of Figure 6.4. */
Picture hullRow(const std::vector<Eigen::Vector3d>& points, const std::string& title, bool cut)
{
  vtkNew<vtkDelaunay3D> tetrahedra;
  tetrahedra->SetInputData(pointSet(points));
  vtkNew<vtkGeometryFilter> boundary;
  boundary->SetInputConnection(tetrahedra->GetOutputPort());
  boundary->Update();
  const Mesh faces = outwards(meshOf(boundary->GetOutput()));
  const Mesh hull = convexHull(points).value_or(Mesh());
  Look look;
  look.side = 270;
  look.flat = true;
  look.colour = Sand;
  look.above = title;
  look.below =
      std::to_string(tetrahedra->GetOutput()->GetNumberOfCells()) + " tetrahedra" + (cut ? ", cut open" : "");
  std::vector<Picture> row = {pictureOf(polyData(apart(tetrahedra->GetOutput(), cut)), look)};
  look.above.clear();
  look.below = "their boundary: " + std::to_string(faces.triangles.size()) + " faces";
  row.push_back(pictureOf(polyData(faces), look));
  look.colour = Green;
  look.below = "convex hull: " + std::to_string(hull.triangles.size()) + " faces";
  row.push_back(pictureOf(polyData(hull), look));
  return sideBySide(row);
}

/** Figure 6.4: 3D Delaunay triangulation and 3D convex hull. */
void makeHullFigure(const std::filesystem::path& folder, Execution& execution)
{
  const std::vector<Eigen::Vector3d> sphere = voteSurfaces(VoteTable(), execution).front().points;
  std::vector<Eigen::Vector3d> some;
  for (std::size_t i = 0; i < sphere.size(); i += 8)
  {
    some.push_back(sphere[i]);
  }
  writePng(stacked({hullRow(randomPoints(100), "100 random points", false),
                    hullRow(some, std::to_string(some.size()) + " points of the sphere", true)}),
           pictureFile(folder, "figure-6-4"));
}

/** The noise that a row of an object's picture shows, and which of its strengths. */
struct Shown
{
  const char* noise;
  std::size_t strength;
};

constexpr Shown ShownNoises[] = {{"contour", 2}, {"camera", 2}, {"blobs", 2}, {"pixels", 1}, {"rotation", 2}};

class ObjectFigure
{
public:
  ObjectFigure(const Object& object, const StudyOptions& options, Execution& execution)
      : TheOptions(options), TheExecution(execution), Rows(readRows(resultsFile(options.output))),
        TheSubject(object, options.settings, execution)
  {
  }

  Picture make()
  {
    const bool isThin = this->TheSubject.object.thin; // more leaves nothing
    std::vector<Picture> rows;
    for (const Shown& shown : ShownNoises)
    {
      const double strength = noiseNamed(shown.noise).strengths[isThin ? 0 : shown.strength];
      rows.push_back(
          this->row({this->TheSubject.object.name, shown.noise, strength, this->TheOptions.seeds.front()}));
    }
    return stacked(rows);
  }

private:
  Picture row(const Case& at)
  {
    std::string voting = bestOf(int(Family::Consistent), this->Rows, at.object, {at.noise, at.strength});
    voting = voting.empty() ? "consistent-1" : voting;
    Trial trial(this->TheSubject, at, this->TheOptions.settings, true, this->TheExecution);
    std::vector<Picture> pictures;
    for (const std::string& name :
         {std::string("cubes-exact"), voting, std::string("convex-hull"), std::string("hulls-robust")})
    {
      pictures.push_back(this->tile(methodNamed(name), trial, at));
    }
    return sideBySide(pictures);
  }

  Picture tile(const Method& method, Trial& trial, const Case& at)
  {
    Look look;
    look.colour = method.family == Family::Hulls ? Blue : method.family == Family::Known ? Green : Sand;
    look.above = method.name == "cubes-exact" ? describeNoise(at.noise, at.strength) : "";
    look.below = method.label;
    const Summary error = summarize(this->Rows, at.object, {at.noise, at.strength}, method.name, Error);
    if (error.runs > 0)
    {
      char text[32];
      std::snprintf(text, sizeof text, ": %.2f", error.mean);
      look.below += text;
    }
    Mesh mesh;
    try
    {
      mesh = method.make(trial);
    }
    catch (const std::exception&)
    {
      look.below = method.label + ": none";
    }
    return pictureOf(polyData(mesh), look);
  }

  const StudyOptions& TheOptions;
  Execution& TheExecution;
  std::vector<experiments::Row> Rows;
  Subject TheSubject;
};

} // namespace

void makeFigures(const StudyOptions& options, const std::filesystem::path& folder, Execution& execution)
{
  if (!useOffScreenWindow())
  {
    throw InvalidInput("this program was built without off-screen rendering");
  }
  std::filesystem::create_directories(folder);
  makeVoteFigure(options, folder, execution);
  makeHullFigure(folder, execution);
  for (const Object& object : objects())
  {
    const bool chosen = options.objects.empty() || std::find(options.objects.begin(), options.objects.end(),
                                                             object.name) != options.objects.end();
    if (chosen)
    {
      writePng(ObjectFigure(object, options, execution).make(), pictureFile(folder, object.name));
    }
  }
}

} // namespace silhouette::experiments
