// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteComparison.h"

#include "ItemWork.h"
#include "MeshCheck.h"
#include "SharedWork.h"
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

ViewAgreement compareView(const Mesh& mesh, const View& view, SilhouetteRenderer& renderer)
{
  const BinaryImage& silhouette = view.silhouette;
  const BinaryImage& rendered = renderer.render(mesh, view.projection, silhouette.width, silhouette.height);
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

void checkView(const View& view)
{
  const BinaryImage& image = view.silhouette;
  if (image.width < 1 || image.height < 1 ||
    image.pixels.size() != std::size_t(image.width) * std::size_t(image.height))
  {
    throw InvalidInput("view " + view.name + ": " + std::to_string(image.pixels.size()) +
      " pixels in an image of " + std::to_string(image.width) + " x " + std::to_string(image.height));
  }
}

/** Rendering throws where a point does not project to finite numbers, but does not name the view. */
void checkProjection(const Mesh& mesh, const View& view)
{
  if (!std::all_of(
        mesh.points.begin(), mesh.points.end(), [&view](const Vector3& p) { return (view.projection * p.homogeneous()).allFinite(); }))
  {
    throw InvalidInput("view " + view.name + ": the mesh does not project to finite numbers");
  }
}

} // namespace

std::vector<ViewAgreement> compareSilhouettes(
  const Mesh& mesh, const std::vector<View>& views, Execution& execution)
{
  checkMesh(mesh);
  for (const View& view : views)
  {
    checkView(view);
  }
  Phase checking(execution, 0.0, 0.1);
  forItems(views.size(), checking, [&](std::size_t v) { checkProjection(mesh, views[v]); });
  std::vector<ViewAgreement> result(views.size());
  // A few views at a time, so that a caller who wants to stop need not wait for all.
  const std::size_t step = 4 * std::size_t(std::max(execution.threads(), 1));
  for (std::size_t begin = 0; begin < views.size(); begin += step)
  {
    execution.checkpoint(0.1 + 0.9 * double(begin) / double(views.size()));
    shareWork(std::min(step, views.size() - begin), execution,
      [&]
      {
        return [&, renderer = SilhouetteRenderer()](std::size_t n) mutable
        { result[begin + n] = compareView(mesh, views[begin + n], renderer); };
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
