// SPDX-License-Identifier: BSD-3-Clause
#include "OutlineRendering.h"

#include "Bits.h"
#include "BoxTree.h"
#include "EdgePairing.h"
#include "Error.h"
#include "MeshCheck.h"
#include "SilhouetteRendering.h"
#include "Vectorised.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <mutex>
#include <utility>

namespace silhouette
{
namespace
{

constexpr std::size_t MostKept = std::size_t(1) << 24; ///< pixels: memory for larger images is given back
constexpr std::size_t Grain = 8192; ///< triangles worth a thread
constexpr double NearShare = 1e-6; ///< of the greatest w: nearer points are renderSilhouette()'s to cut off

/** The least whole number that is not below x, but 0 at least and `most` at most. Cutting off, and looking whether anything was: ceil would be a call. */
int ceiling(double x, int most)
{
  const double kept = std::clamp(x, 0.0, double(most));
  const int whole = int(kept);
  return whole + (kept > whole);
}

/** Where outlines enter and leave the covered part of each row. */
class Windings
{
public:
  Windings(int width, int height)
    : Width(width)
    , Height(height)
    , Stride(std::size_t(width) + 1)
    , Steps(kept())
  {
    this->Steps.resize(std::max(this->Steps.size(), this->Stride * std::size_t(height)), 0);
  }

  /** The row's middle is crossed from the lower row's end (in v) on, up to but not including the upper's. */
  void add(Vector2 p, Vector2 q, int sign)
  {
    if (q[1] < p[1])
    {
      std::swap(p, q);
      sign = -sign;
    }
    if (!(p[1] < q[1]))
    {
      return;
    }
    const int first = ceiling(p[1], this->Height), last = ceiling(q[1], this->Height) - 1;
    if (first > last)
    {
      return;
    }
    this->First = std::min(this->First, first);
    this->Last = std::max(this->Last, last);
    const double slope = (q[0] - p[0]) / (q[1] - p[1]);
    for (int row = first; row <= last; ++row)
    {
      const int column = ceiling(p[0] + (row - p[1]) * slope, this->Width);
      this->Steps[std::size_t(row) * this->Stride + std::size_t(column)] += sign;
      this->FirstColumn = std::min(this->FirstColumn, column);
      this->LastColumn = std::max(this->LastColumn, column);
    }
  }

  /** Once, and last. */
  void fill(BinaryImage& image)
  {
    for (int row = this->First; row <= this->Last; ++row)
    {
      std::int16_t* steps = &this->Steps[std::size_t(row) * this->Stride];
      std::uint8_t* pixels = &image.pixels[std::size_t(row) * std::size_t(this->Width)];
      std::int16_t count = 0;
      const int end = std::min(this->LastColumn + 1, this->Width);
      for (int column = this->FirstColumn; column < end; ++column)
      {
        std::uint64_t ahead[2];
        while (column + 8 < end && (std::memcpy(ahead, steps + column, 16), (ahead[0] | ahead[1]) == 0))
        {
          std::memset(pixels + column, count != 0, 8); // no outline here
          column += 8;
        }
        count = std::int16_t(count + steps[column]);
        pixels[column] = count != 0;
      }
      std::fill(pixels + end, pixels + this->Width, std::uint8_t(count != 0)); // of an outline that is not closed
      std::fill(steps + this->FirstColumn, steps + this->LastColumn + 1, std::int16_t(0));
    }
    if (this->Steps.size() > MostKept)
    {
      std::vector<std::int16_t>().swap(this->Steps);
    }
  }

private:
  /** The memory, which serves the thread's next image. */
  static std::vector<std::int16_t>& kept()
  {
    thread_local std::vector<std::int16_t> steps;
    return steps;
  }

  int Width;
  int Height;
  std::size_t Stride;
  int First = 1 << 30;
  int Last = -1;
  int FirstColumn = 1 << 30;
  int LastColumn = -1;
  std::vector<std::int16_t>& Steps; ///< all 0 before and after
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
  std::vector<std::uint64_t> faced(mesh.triangles.size() + 1, 0);
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
  using Segments = std::vector<std::vector<OutlineSegment>>; ///< for each camera

  const std::vector<std::uint64_t>& faced; ///< by triangles
  Segments ofCameras;
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
          auto& all = this->All->ofCameras[camera];
          all.insert(all.end(), this->Own[camera].begin(), this->Own[camera].end());
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
    Segments Own;
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

BinaryImage OutlineRenderer::render(std::size_t n) const
{
  const ImageCamera& camera = this->Cameras[n];
  if (this->InFront[n] == 0)
  {
    return renderSilhouette(this->TheMesh, camera.projection, camera.width, camera.height);
  }
  const auto pixelOf = [&](std::int32_t point)
  {
    const Vector3 h = homogeneousPixel(camera.projection, this->TheMesh.points[std::size_t(point)]);
    return Vector2(h[0] / h[2], h[1] / h[2]);
  };
  BinaryImage image{ camera.width, camera.height, std::vector<std::uint8_t>(std::size_t(camera.width) * camera.height, 0) };
  Windings windings(camera.width, camera.height);
  for (const OutlineSegment& segment : this->Outlines[n])
  {
    windings.add(pixelOf(segment.from), pixelOf(segment.to), segment.sign);
  }
  windings.fill(image);
  return image;
}

} // namespace silhouette
