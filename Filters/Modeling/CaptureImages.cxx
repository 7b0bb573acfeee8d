// SPDX-License-Identifier: BSD-3-Clause
#include "CaptureImages.h"

#include "AutomaticBounds.h"
#include "FieldValues.h"
#include "ImageFiles.h"
#include "ItemWork.h"
#include "LensDistortion.h"
#include "ProjectiveCameras.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <Eigen/LU>

#include <algorithm>

namespace silhouette::modeling
{
namespace
{

constexpr const char* IsMaskName = "IsMask";
constexpr const char* SignIsFreeName = "SignIsFree"; ///< of the view's matrix

std::string sizeText(const std::array<int, 2>& size)
{
  return std::to_string(size[0]) + " x " + std::to_string(size[1]);
}

bool takesMask(const CaptureEntry& entry, std::size_t index, CaptureImageChoice choice)
{
  const bool mask = choice == CaptureImageChoice::Masks ||
                    (choice == CaptureImageChoice::MasksWherePresent && !entry.mask.empty());
  if (mask ? entry.mask.empty() : entry.photograph.empty())
  {
    throw InvalidInput(describeView(index, entry.name) + ": there is no " + (mask ? "mask" : "photograph") +
                       " of this view");
  }
  return mask;
}

void checkSameSize(const CaptureEntry& entry)
{
  if (entry.mask.empty() || entry.photograph.empty())
  {
    return;
  }
  const auto mask = readImageSize(entry.mask);
  const auto photograph = readImageSize(entry.photograph);
  if (mask != photograph)
  {
    throw InvalidInput("mask " + entry.mask.string() + " has " + sizeText(mask) + " pixels, its photograph " +
                       entry.photograph.string() + " has " + sizeText(photograph));
  }
}

void checkStatedSize(const CaptureEntry& entry, const std::filesystem::path& file, vtkImageData* image)
{
  int size[3];
  image->GetDimensions(size);
  if ((entry.width > 0 && size[0] != entry.width) || (entry.height > 0 && size[1] != entry.height))
  {
    const auto side = [](int length) { return length > 0 ? std::to_string(length) : std::string("any"); };
    throw InvalidInput("image " + file.string() + " has " + sizeText({size[0], size[1]}) + " pixels, its camera is for " + side(entry.width) + " x " +
                       side(entry.height));
  }
}

/** The image as a lens without distortion would have made it. */
vtkSmartPointer<vtkImageData> withoutDistortion(const ImageView& view, std::size_t index, const LensDistortion& lens)
{
  PixelRows rows = pixelRows(view, index);
  try
  {
    rows.values = undistorted(rows.values.data(), rows.width, rows.height, rows.channels, lens);
  }
  catch (const InvalidInput& error)
  {
    throw InvalidInput(describeView(index, view.name) + ": " + error.what());
  }
  return makeImage(rows);
}

/** One view's image, ready for its matrix. */
ImageView readView(const CaptureEntry& entry, std::size_t index, CaptureImageChoice choice, std::vector<std::string>& warnings)
{
  const bool mask = takesMask(entry, index, choice);
  checkSameSize(entry);
  const std::filesystem::path& file = mask ? entry.mask : entry.photograph;
  ImageView view = {readImage(file, warnings), entry.name, entry.projection};
  checkStatedSize(entry, file, view.image);
  if (entry.lens)
  {
    view.image = withoutDistortion(view, index, *entry.lens);
  }
  setField(view.image, IsMaskName, int(mask));
  return view;
}

Vector2 objectPixel(const ImageView& view, std::size_t index)
{
  const ColourImage image = colourImage(view, index);
  try
  {
    return silhouetteCentroid(extractSilhouette(image, ExtractionOptions(), isMask(view), view.name));
  }
  catch (const InvalidInput&)
  {
    return {0.5 * (image.width - 1), 0.5 * (image.height - 1)}; // a photograph: its object is not known yet
  }
}

void orient(std::vector<ImageView>& views, std::vector<Vector2> pixels)
{
  std::vector<Projection> projections;
  for (const ImageView& view : views)
  {
    projections.push_back(view.projection);
  }
  orientProjections(projections, pixels);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    views[i].projection = projections[i];
  }
}

Vector2 imageCentre(const ImageView& view)
{
  int size[3];
  view.image->GetDimensions(size);
  return {0.5 * (size[0] - 1), 0.5 * (size[1] - 1)};
}

/** Adds one camera's lines. */
void addFrustum(const ImageView& view, int index, const Vector3* target, vtkPolyData* lines, vtkIntArray* ids)
{
  const Eigen::FullPivLU<Eigen::Matrix3d> left(view.projection.leftCols<3>());
  if (!left.isInvertible())
  {
    return;
  }
  const Vector3 centre = left.solve(-view.projection.col(3));
  const auto direction = [&left](double u, double v) -> Vector3 { return left.solve(Vector3(u, v, 1.0)); };
  const Vector2 middle = imageCentre(view);
  const double length = target ? 0.2 * (*target - centre).norm() : 1.0;
  const double step = length / direction(middle[0], middle[1]).norm();
  vtkPoints* points = lines->GetPoints();
  const vtkIdType apex = points->InsertNextPoint(centre.data());
  const double u[2] = {-0.5, 2.0 * middle[0] + 0.5}, v[2] = {-0.5, 2.0 * middle[1] + 0.5};
  const int around[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  for (const auto& corner : around)
  {
    const Vector3 point = centre + step * direction(u[corner[0]], v[corner[1]]);
    const vtkIdType ray[2] = {apex, points->InsertNextPoint(point.data())};
    lines->GetLines()->InsertNextCell(2, ray);
    ids->InsertNextValue(index);
  }
  const vtkIdType border[5] = {apex + 1, apex + 2, apex + 3, apex + 4, apex + 1};
  lines->GetLines()->InsertNextCell(5, border);
  ids->InsertNextValue(index);
}

} // namespace

std::vector<ImageView> readCapture(const CaptureDescription& capture, CaptureImageChoice choice,
                                   std::vector<std::string>& warnings, Execution& execution)
{
  const std::size_t count = capture.entries.size();
  std::vector<ImageView> views(count);
  std::vector<Vector2> pixels(count);
  std::vector<std::vector<std::string>> heard(count);
  forItems(count, execution,
           [&](std::size_t i)
           {
             views[i] = readView(capture.entries[i], i, choice, heard[i]);
             setField(views[i].image, SignIsFreeName, int(capture.freeSign));
             if (capture.freeSign)
             {
               pixels[i] = objectPixel(views[i], i);
             }
           });
  for (const std::vector<std::string>& some : heard)
  {
    warnings.insert(warnings.end(), some.begin(), some.end());
  }
  if (capture.freeSign)
  {
    orient(views, std::move(pixels));
  }
  return views;
}

void orientBySilhouettes(const std::vector<ImageView>& views, std::vector<View>& silhouettes)
{
  std::vector<Projection> projections;
  std::vector<Vector2> pixels;
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    if (getIntegerField(views[i].image, SignIsFreeName, 0) == 0)
    {
      return;
    }
    const BinaryImage& image = silhouettes[i].silhouette;
    const bool isEmpty = std::find(image.pixels.begin(), image.pixels.end(), std::uint8_t(1)) == image.pixels.end();
    pixels.push_back(isEmpty ? imageCentre(views[i]) : silhouetteCentroid(image));
    projections.push_back(silhouettes[i].projection);
  }
  orientProjections(projections, pixels);
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    silhouettes[i].projection = projections[i];
  }
}

bool isMask(const ImageView& view)
{
  return getIntegerField(view.image, IsMaskName, 0) != 0;
}

ColourImage colourImage(const ImageView& view, std::size_t index)
{
  PixelRows rows = pixelRows(view, index);
  return {rows.width, rows.height, rows.channels, std::move(rows.values)};
}

void storeFrustums(const std::vector<ImageView>& views, vtkPolyData* lines)
{
  std::vector<Projection> projections;
  std::vector<Vector2> centres;
  for (const ImageView& view : views)
  {
    projections.push_back(view.projection);
    centres.push_back(imageCentre(view));
  }
  Vector3 target = Vector3::Zero();
  const bool known = views.size() > 1;
  if (known)
  {
    target = nearestPointToRays(projections, centres);
  }
  lines->Initialize();
  lines->SetPoints(vtkNew<vtkPoints>());
  lines->GetPoints()->SetDataTypeToDouble();
  lines->SetLines(vtkNew<vtkCellArray>());
  vtkNew<vtkIntArray> ids;
  ids->SetName("View");
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    addFrustum(views[i], int(i), known && target.allFinite() ? &target : nullptr, lines, ids);
  }
  lines->GetCellData()->SetScalars(ids);
}

} // namespace silhouette::modeling
