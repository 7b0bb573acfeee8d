// SPDX-License-Identifier: BSD-3-Clause
#include "OutlineRendering.h"

#include "Bits.h"
#include "BoxTree.h"
#include "EdgePairing.h"
#include "Error.h"
#include "LargePages.h"
#include "MeshCheck.h"
#include "SilhouetteRendering.h"
#include "Vectorised.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <utility>

namespace silhouette
{
namespace
{

constexpr std::size_t Grain = 8192; ///< triangles worth a thread
constexpr double NearShare = 1e-6; ///< of the greatest w: nearer points are renderSilhouette()'s to cut off

constexpr std::size_t Batch = 128; ///< segments that are projected together

/** Some segments of an outline: their ends in the world, and then where each crosses the middles of rows. */
struct SegmentBatch
{
  std::size_t count = 0;
  double ends[2][3][Batch];       ///< x, y, z
  double low[2][Batch];           ///< px: the end with the lesser v, u and v
  double slope[Batch];            ///< columns for a row
  std::int32_t first[Batch], last[Batch]; ///< rows; the last one below the first where none is crossed
  std::int32_t change[Batch];     ///< of the winding, to the right of the segment
};

/** The least whole number that is not below x, but 0 at least and `most` at most. Cutting off, and looking whether anything was: ceil would be a call. */
inline std::int32_t ceiling(double x, double most)
{
  const double notNegative = x > 0.0 ? x : 0.0, kept = notNegative < most ? notNegative : most;
  const auto whole = std::int32_t(kept);
  return whole + std::int32_t(kept > whole);
}

/** A row's middle is crossed from the segment's end with the lesser v on, up to but not including the other. */
SILHOUETTE_VECTORISED void projectSegments(const double (&projection)[12], double height, SegmentBatch& batch)
{
  for (std::size_t n = 0; n < batch.count; ++n)
  {
    double u[2], v[2];
    for (int end = 0; end < 2; ++end)
    {
      const double x = batch.ends[end][0][n], y = batch.ends[end][1][n], z = batch.ends[end][2][n];
      const double* p = projection;
      const double w = ((p[8] * x + p[9] * y) + p[10] * z) + p[11];
      u[end] = (((p[0] * x + p[1] * y) + p[2] * z) + p[3]) / w;
      v[end] = (((p[4] * x + p[5] * y) + p[6] * z) + p[7]) / w;
    }
    const bool turned = v[1] < v[0];
    const double lowU = turned ? u[1] : u[0], lowV = turned ? v[1] : v[0];
    const double highU = turned ? u[0] : u[1], highV = turned ? v[0] : v[1];
    batch.low[0][n] = lowU;
    batch.low[1][n] = lowV;
    batch.slope[n] = (highU - lowU) / (highV - lowV); // the divisor is 0 for none that crosses a row
    batch.first[n] = ceiling(lowV, height);
    batch.last[n] = ceiling(highV, height) - 1;
    batch.change[n] = turned ? -batch.change[n] : batch.change[n];
  }
}

/** Where outlines enter and leave the covered part of each row. */
class Windings
{
public:
  Windings(int width, int height)
    : Width(width)
    , Height(height)
    , Starts(std::size_t(height) + 1, 0)
  {
  }

  void add(const SegmentBatch& batch)
  {
    for (std::size_t n = 0; n < batch.count; ++n)
    {
      for (std::int32_t row = batch.first[n]; row <= batch.last[n]; ++row)
      {
        const std::int32_t column = ceiling(batch.low[0][n] + (row - batch.low[1][n]) * batch.slope[n], this->Width);
        this->Crossings.push_back({ row, { column, batch.change[n] } });
        ++this->Starts[std::size_t(row)];
      }
    }
  }

  /** Once, and last. */
  SilhouetteRuns runs()
  {
    const std::vector<Turn> turns = this->byRows();
    SilhouetteRuns runs{ this->Width, this->Height, {}, { 0 } };
    // Of one row: by how much the winding changes at each column, and where it does, a bit each. All 0 before and after.
    std::vector<std::int32_t> changes(std::size_t(this->Width) + 1, 0);
    std::vector<std::uint64_t> changed(changes.size() / 64 + 1, 0);
    for (int row = 0; row < this->Height; ++row)
    {
      for (std::ptrdiff_t n = this->Starts[std::size_t(row)]; n < this->Starts[std::size_t(row) + 1]; ++n)
      {
        const Turn& turn = turns[std::size_t(n)];
        changes[std::size_t(turn.column)] += turn.change;
        changed[std::size_t(turn.column) / 64] |= std::uint64_t(1) << turn.column % 64;
      }
      std::int32_t winding = 0, begin = 0;
      for (std::size_t word = 0; word < changed.size(); ++word)
      {
        for (std::uint64_t left = std::exchange(changed[word], 0); left != 0; left &= left - 1)
        {
          const auto column = std::int32_t(64 * word) + lowestBit(left);
          const bool wasCovered = winding != 0;
          winding += std::exchange(changes[std::size_t(column)], 0);
          if (wasCovered && winding == 0)
          {
            runs.runs.push_back({ begin, column });
          }
          begin = wasCovered ? begin : column;
        }
      }
      if (winding != 0 && begin < this->Width) // an outline that is not closed
      {
        runs.runs.push_back({ begin, this->Width });
      }
      runs.firstOfRow.push_back(runs.runs.size());
    }
    return runs;
  }

private:
  struct Turn
  {
    std::int32_t column; ///< the first that is affected
    std::int32_t change;
  };
  struct Crossing
  {
    std::int32_t row;
    Turn turn;
  };

  /** The turns of each row, from its start on. */
  std::vector<Turn> byRows()
  {
    std::ptrdiff_t sum = 0;
    for (std::ptrdiff_t& start : this->Starts)
    {
      sum += std::exchange(start, sum);
    }
    std::vector<Turn> turns(this->Crossings.size());
    std::vector<std::ptrdiff_t> next = this->Starts;
    for (const Crossing& crossing : this->Crossings)
    {
      turns[std::size_t(next[std::size_t(crossing.row)]++)] = crossing.turn;
    }
    return turns;
  }

  int Width;
  int Height;
  std::vector<Crossing> Crossings;
  std::vector<std::ptrdiff_t> Starts; ///< how many each row has; then where they start
};

Vector3 homogeneousPixel(const Projection& projection, const Vector3& point)
{
  return projection.leftCols<3>() * point + projection.col(3);
}

/** Are all points in front of the camera and not near its plane? Throws for one that does not project to finite numbers. */
bool arePointsInFront(const Mesh& mesh, const Projection& projection)
{
  double least = 1.0, greatest = -1.0;
  for (std::size_t n = 0; n < mesh.points.size(); ++n)
  {
    const Vector3 h = homogeneousPixel(projection, mesh.points[n]);
    if (!h.allFinite())
    {
      throw InvalidInput("point " + std::to_string(n) + " does not project to finite numbers");
    }
    least = n == 0 ? h[2] : std::min(least, h[2]);
    greatest = n == 0 ? h[2] : std::max(greatest, h[2]);
  }
  return least > NearShare * greatest;
}

/** Do all points project to finite numbers, in front of the camera and not near its plane? As the box around them does; may say false where they do. */
bool isBoxInFront(const Box& box, const Projection& projection)
{
  double least = 0.0, greatest = 0.0;
  for (int n = 0; n < 8; ++n)
  {
    const Vector3 h = homogeneousPixel(projection, box.corner(Box::CornerType(n)));
    if (!h.allFinite())
    {
      return false;
    }
    least = n == 0 ? h[2] : std::min(least, h[2]);
    greatest = n == 0 ? h[2] : std::max(greatest, h[2]);
  }
  return least > 2.0 * NearShare * greatest; // twice: for rounding
}

constexpr std::size_t MostTogether = 64; ///< cameras, a bit each

/**
 * A triangle faces a camera as the determinant of its homogeneous corners says: linear in its plane (normal, and its product with a corner), with factors
 * that are defined for a camera at infinity too.
 */
struct Facing
{
  std::size_t count;
  double factors[4][MostTogether] = {};
  std::uint64_t bit[MostTogether] = {};

  Facing(const ImageCamera* cameras, std::size_t n)
    : count(n)
  {
    for (std::size_t c = 0; c < n; ++c)
    {
      const Projection& projection = cameras[c].projection;
      const Eigen::Matrix3d m = projection.leftCols<3>();
      const Vector3 r0 = m.row(0), r1 = m.row(1), r2 = m.row(2);
      const Vector3 q = r1.cross(r2) * projection(0, 3) + r2.cross(r0) * projection(1, 3) + r0.cross(r1) * projection(2, 3);
      for (int axis = 0; axis < 3; ++axis)
      {
        this->factors[axis][c] = q[axis];
      }
      this->factors[3][c] = r0.dot(r1.cross(r2));
      this->bit[c] = std::uint64_t(1) << c;
    }
  }
};

/** Bit c where the plane faces camera c. */
SILHOUETTE_VECTORISED std::uint64_t camerasFaced(const Facing& facing, double x, double y, double z, double offset)
{
  std::uint64_t faced = 0;
  for (std::size_t c = 0; c < facing.count; ++c)
  {
    const double side = facing.factors[0][c] * x + facing.factors[1][c] * y + facing.factors[2][c] * z + facing.factors[3][c] * offset;
    faced |= side > 0.0 ? facing.bit[c] : 0;
  }
  return faced;
}

/** The cameras that each triangle faces; after the last none. */
std::vector<std::uint64_t> facedByTriangles(const Mesh& mesh, const Facing& facing, Execution& execution)
{
  auto faced = largeVector<std::uint64_t>(mesh.triangles.size() + 1);
  execution.forRanges(mesh.triangles.size(), Grain,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t n = first; n < last; ++n)
      {
        const Triangle& t = mesh.triangles[n];
        const auto& a = mesh.points[t[0]];
        const Eigen::Vector3d normal = (mesh.points[t[1]] - a).cross(mesh.points[t[2]] - a);
        faced[n] = camerasFaced(facing, normal[0], normal[1], normal[2], normal.dot(a));
      }
    });
  return faced;
}

/** Which edges are outlines, for each of some cameras. They come in any order: windings are sums of whole numbers. */
struct OutlineCollection
{
  const std::vector<std::uint64_t>& faced; ///< by triangles
  std::vector<OutlineLists> ofCameras;
  std::size_t workers = 0;
  std::mutex adding;

  OutlineCollection(const std::vector<std::uint64_t>& cameras, std::size_t count)
    : faced(cameras)
    , ofCameras(count)
  {
  }

  /** Collects for one thread, and hands over at its end. */
  class Worker
  {
  public:
    explicit Worker(OutlineCollection& all)
      : All(&all)
      , Own(all.ofCameras.size())
    {
      const std::lock_guard<std::mutex> lock(all.adding);
      ++all.workers;
      for (OutlineLists& lists : all.ofCameras)
      {
        lists.reserve(all.workers); // handing over must not throw
      }
    }
    Worker(Worker&& other) noexcept
      : All(std::exchange(other.All, nullptr))
      , Own(std::move(other.Own))
    {
    }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;
    ~Worker()
    {
      if (this->All)
      {
        const std::lock_guard<std::mutex> lock(this->All->adding);
        for (std::size_t camera = 0; camera < this->Own.size(); ++camera)
        {
          if (!this->Own[camera].empty())
          {
            this->All->ofCameras[camera].push_back(std::move(this->Own[camera]));
          }
        }
      }
    }

    void operator()(std::int32_t from, std::int32_t to, std::uint32_t forwards, std::uint32_t backwards)
    {
      const std::uint64_t along = this->All->faced[forwards];
      for (std::uint64_t left = along ^ this->All->faced[backwards]; left != 0; left &= left - 1)
      {
        const int camera = lowestBit(left);
        this->Own[std::size_t(camera)].push_back({ from, to, (along >> camera & 1) != 0 ? 1 : -1 });
      }
    }

  private:
    OutlineCollection* All;
    OutlineLists Own; ///< a list for each camera
  };
};

} // namespace

OutlineRenderer::OutlineRenderer(const Mesh& mesh, std::vector<ImageCamera> cameras, Execution& execution)
  : TheMesh(mesh)
  , Cameras(std::move(cameras))
  , InFront(this->Cameras.size(), 1)
  , Outlines(this->Cameras.size())
{
  checkMesh(mesh, execution);
  this->requireProjectable();
  for (std::size_t first = 0; first < this->Cameras.size(); first += MostTogether)
  {
    this->findOutlines(first, std::min(first + MostTogether, this->Cameras.size()), execution);
  }
}

void OutlineRenderer::requireProjectable()
{
  Box box;
  for (const Vector3& p : this->TheMesh.points)
  {
    box.extend(p);
  }
  for (std::size_t n = 0; n < this->Cameras.size(); ++n)
  {
    const ImageCamera& camera = this->Cameras[n];
    if (camera.width < 1 || camera.height < 1)
    {
      throw InvalidInput("an image of " + std::to_string(camera.width) + " x " + std::to_string(camera.height) + " pixels");
    }
    this->InFront[n] = box.isEmpty() || isBoxInFront(box, camera.projection) || arePointsInFront(this->TheMesh, camera.projection);
  }
}

void OutlineRenderer::findOutlines(std::size_t first, std::size_t last, Execution& execution)
{
  const Facing facing(&this->Cameras[first], last - first);
  const std::vector<std::uint64_t> faced = facedByTriangles(this->TheMesh, facing, execution);
  OutlineCollection outlines(faced, last - first);
  forEdges(this->TheMesh, execution, [&] { return OutlineCollection::Worker(outlines); });
  std::move(outlines.ofCameras.begin(), outlines.ofCameras.end(), this->Outlines.begin() + std::ptrdiff_t(first));
}

SilhouetteRuns OutlineRenderer::render(std::size_t n) const
{
  const ImageCamera& camera = this->Cameras[n];
  if (this->InFront[n] == 0)
  {
    return runsOf(renderSilhouette(this->TheMesh, camera.projection, camera.width, camera.height));
  }
  double projection[12];
  for (int entry = 0; entry < 12; ++entry)
  {
    projection[entry] = camera.projection(entry / 4, entry % 4);
  }
  Windings windings(camera.width, camera.height);
  SegmentBatch batch;
  for (const auto& segments : this->Outlines[n])
  {
    for (std::size_t first = 0; first < segments.size(); first += Batch)
    {
      batch.count = std::min(Batch, segments.size() - first);
      for (std::size_t i = 0; i < batch.count; ++i)
      {
        const OutlineSegment& segment = segments[first + i];
        const Vector3 &from = this->TheMesh.points[std::size_t(segment.from)], &to = this->TheMesh.points[std::size_t(segment.to)];
        for (int axis = 0; axis < 3; ++axis)
        {
          batch.ends[0][axis][i] = from[axis];
          batch.ends[1][axis][i] = to[axis];
        }
        batch.change[i] = segment.sign;
      }
      projectSegments(projection, camera.height, batch);
      windings.add(batch);
    }
  }
  return windings.runs();
}

} // namespace silhouette
