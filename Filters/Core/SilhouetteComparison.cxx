// SPDX-License-Identifier: BSD-3-Clause
#include "SilhouetteComparison.h"

#include "ItemWork.h"
#include "MeshCheck.h"
#include "SilhouetteRendering.h"

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

/** What a view sees of the mesh; of a point that does not project to finite numbers the message names the view. */
const BinaryImage& rendering(const Mesh& mesh, const View& view, SilhouetteRenderer& renderer)
{
  try
  {
    return renderer.render(mesh, view.projection, view.silhouette.width, view.silhouette.height);
  }
  catch (const InvalidInput& error)
  {
    throw InvalidInput("view " + view.name + ": " + error.what());
  }
}

ViewAgreement compareView(const Mesh& mesh, const View& view, SilhouetteRenderer& renderer)
{
  const BinaryImage& silhouette = view.silhouette;
  const BinaryImage& rendered = rendering(mesh, view, renderer);
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

} // namespace

std::vector<ViewAgreement> compareSilhouettes(
  const Mesh& mesh, const std::vector<View>& views, Execution& execution)
{
  checkMesh(mesh);
  for (const View& view : views)
  {
    checkView(view);
  }
  std::vector<ViewAgreement> result(views.size());
  std::vector<SilhouetteRenderer> renderers(itemsAtATime(execution));
  forItems(views.size(), execution, [&](std::size_t v) { result[v] = compareView(mesh, views[v], renderers[v % renderers.size()]); });
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
