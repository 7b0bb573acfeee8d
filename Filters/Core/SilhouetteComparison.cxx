// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteComparison.h"

#include "MeshCheck.h"
#include "SilhouetteRendering.h"

#include <Eigen/Geometry>

#include <algorithm>

namespace silhouette
{

namespace
{

/** The shares, from the counts. */
void computeShares(ViewAgreement& a)
{
  const std::uint64_t different = a.falseObject + a.falseBackground;
  const std::uint64_t unionPixels = a.silhouettePixels + a.falseObject;
  a.iou = unionPixels == 0 ? 1.0 : double(a.silhouettePixels - a.falseBackground) / double(unionPixels);
  if (a.silhouettePixels == 0)
  {
    a.xorShare = different == 0 ? 0.0 : 1.0;
  }
  else
  {
    a.xorShare = double(different) / double(a.silhouettePixels);
  }
}

ViewAgreement compareView(const Mesh& mesh, const View& view)
{
  const BinaryImage& silhouette = view.silhouette;
  const BinaryImage rendered = renderSilhouette(mesh, view.projection, silhouette.width, silhouette.height);
  ViewAgreement result;
  result.name = view.name;
  for (std::size_t i = 0; i < silhouette.pixels.size(); ++i)
  {
    const bool object = silhouette.pixels[i] != 0;
    const bool meshObject = rendered.pixels[i] != 0;
    result.silhouettePixels += object;
    result.meshPixels += meshObject;
    result.falseObject += meshObject && !object;
    result.falseBackground += object && !meshObject;
  }
  computeShares(result);
  return result;
}

void checkView(const Mesh& mesh, const View& view)
{
  const BinaryImage& image = view.silhouette;
  if (image.width < 1 || image.height < 1 ||
    image.pixels.size() != std::size_t(image.width) * std::size_t(image.height))
  {
    throw InvalidInput("view " + view.name + ": " + std::to_string(image.pixels.size()) +
      " pixels in an image of " + std::to_string(image.width) + " x " + std::to_string(image.height));
  }
  // Rendering throws where a point does not project to finite numbers, and loops must not throw.
  for (const Vector3& p : mesh.points)
  {
    if (!(view.projection * p.homogeneous()).allFinite())
    {
      throw InvalidInput("view " + view.name + ": the mesh does not project to finite numbers");
    }
  }
}

} // namespace

std::vector<ViewAgreement> compareSilhouettes(
  const Mesh& mesh, const std::vector<View>& views, Execution& execution)
{
  checkMesh(mesh);
  for (const View& view : views)
  {
    checkView(mesh, view);
  }
  std::vector<ViewAgreement> result(views.size());
  // A few views at a time, so that a caller who wants to stop need not wait for all.
  const std::size_t step = 4 * std::size_t(std::max(execution.threads(), 1));
  for (std::size_t begin = 0; begin < views.size(); begin += step)
  {
    execution.checkpoint(double(begin) / double(views.size()));
    execution.forRanges(std::min(step, views.size() - begin), 1,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t v = begin + first; v < begin + last; ++v)
        {
          result[v] = compareView(mesh, views[v]);
        }
      });
  }
  execution.checkpoint(1.0);
  return result;
}

ViewAgreement totalAgreement(const std::vector<ViewAgreement>& views)
{
  ViewAgreement total;
  for (const ViewAgreement& view : views)
  {
    total.silhouettePixels += view.silhouettePixels;
    total.meshPixels += view.meshPixels;
    total.falseObject += view.falseObject;
    total.falseBackground += view.falseBackground;
  }
  computeShares(total);
  return total;
}

} // namespace silhouette
