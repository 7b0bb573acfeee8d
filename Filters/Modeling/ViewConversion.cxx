// SPDX-License-Identifier: BSD-3-Clause
#include "ViewConversion.h"

#include "Error.h"

#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include <algorithm>

namespace silhouette::modeling
{
namespace
{

constexpr const char* ProjectionName = "Projection";

Projection projectionOf(vtkImageData* image, const std::string& view)
{
  vtkDataArray* array = image->GetFieldData() ? image->GetFieldData()->GetArray(ProjectionName) : nullptr;
  if (!array)
  {
    throw InvalidInput(view + ": the image has no field array Projection, its 3 x 4 matrix row by row");
  }
  if (array->GetNumberOfValues() != 12)
  {
    throw InvalidInput(view + ": the field array Projection has " +
                       std::to_string(array->GetNumberOfValues()) + " values, 12 are needed");
  }
  Projection projection;
  const int components = array->GetNumberOfComponents();
  for (int i = 0; i < 12; ++i)
  {
    projection.data()[i] = array->GetComponent(i / components, i % components);
  }
  return projection;
}

/** Copy rows, the last one first: VTK's images begin at the bottom, the core's at the top. */
void copyRowsReversed(const unsigned char* from, unsigned char* to, int height, std::size_t rowBytes)
{
  for (int row = 0; row < height; ++row)
  {
    std::copy_n(from + std::size_t(height - 1 - row) * rowBytes, rowBytes, to + std::size_t(row) * rowBytes);
  }
}

void checkTwoDimensional(vtkImageData* image, const std::string& view)
{
  int size[3];
  image->GetDimensions(size);
  if (size[0] < 1 || size[1] < 1 || size[2] != 1)
  {
    throw InvalidInput(view + ": an image of " + std::to_string(size[0]) + " x " + std::to_string(size[1]) +
                       " x " + std::to_string(size[2]) + " pixels; a view is one two-dimensional image");
  }
}

} // namespace

std::vector<ImageView> imageViews(vtkPartitionedDataSetCollection* collection)
{
  std::vector<ImageView> views;
  const unsigned int count = collection ? collection->GetNumberOfPartitionedDataSets() : 0;
  for (unsigned int i = 0; i < count; ++i)
  {
    ImageView view;
    if (collection->HasMetaData(i) && collection->GetMetaData(i)->Has(vtkCompositeDataSet::NAME()))
    {
      view.name = collection->GetMetaData(i)->Get(vtkCompositeDataSet::NAME());
    }
    const std::string what = describeView(i, view.name);
    const unsigned int partitions = collection->GetNumberOfPartitions(i);
    view.image =
        partitions == 1 ? vtkImageData::SafeDownCast(collection->GetPartitionAsDataObject(i, 0)) : nullptr;
    if (!view.image)
    {
      throw InvalidInput(
          what + ": one vtkImageData is needed, the collection has " +
          (partitions == 1 ? std::string("something else") : std::to_string(partitions) + " partitions") +
          " there");
    }
    checkTwoDimensional(view.image, what);
    view.projection = projectionOf(view.image, what);
    views.push_back(std::move(view));
  }
  return views;
}

void storeViews(const std::vector<ImageView>& views, vtkPartitionedDataSetCollection* collection)
{
  collection->Initialize();
  collection->SetNumberOfPartitionedDataSets(static_cast<unsigned int>(views.size()));
  for (unsigned int i = 0; i < views.size(); ++i)
  {
    const ImageView& view = views[i];
    vtkNew<vtkImageData> image;
    image->ShallowCopy(view.image);
    // A field data object of its own: a shallow copy shares it, and the input must not gain an array.
    vtkNew<vtkFieldData> fields;
    fields->ShallowCopy(view.image->GetFieldData());
    vtkNew<vtkDoubleArray> projection;
    projection->SetName(ProjectionName);
    projection->SetNumberOfComponents(12);
    projection->InsertNextTuple(view.projection.data());
    fields->AddArray(projection);
    image->SetFieldData(fields);
    collection->SetPartition(i, 0, image);
    collection->GetMetaData(i)->Set(vtkCompositeDataSet::NAME(), view.name.c_str());
  }
}

PixelRows pixelRows(const ImageView& view, std::size_t index)
{
  const std::string what = describeView(index, view.name);
  checkTwoDimensional(view.image, what);
  vtkDataArray* scalars = view.image->GetPointData()->GetScalars();
  auto* bytes = vtkUnsignedCharArray::SafeDownCast(scalars);
  if (!scalars)
  {
    throw InvalidInput(what + ": the image has no scalars");
  }
  if (!bytes)
  {
    throw InvalidInput(what + ": the image's scalars are of type " + scalars->GetDataTypeAsString() +
                       ", unsigned char is needed");
  }
  int size[3];
  view.image->GetDimensions(size);
  PixelRows pixels;
  pixels.width = size[0];
  pixels.height = size[1];
  pixels.channels = bytes->GetNumberOfComponents();
  const std::size_t count = std::size_t(size[0]) * size[1] * pixels.channels;
  if (bytes->GetNumberOfValues() != static_cast<vtkIdType>(count))
  {
    throw InvalidInput(what + ": " + std::to_string(bytes->GetNumberOfTuples()) + " pixel values for " +
                       std::to_string(size[0]) + " x " + std::to_string(size[1]) + " pixels");
  }
  pixels.values.resize(count);
  copyRowsReversed(bytes->GetPointer(0), pixels.values.data(), size[1],
                   std::size_t(size[0]) * pixels.channels);
  return pixels;
}

vtkSmartPointer<vtkImageData> makeImage(const PixelRows& pixels)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(pixels.width, pixels.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, pixels.channels);
  copyRowsReversed(pixels.values.data(), static_cast<unsigned char*>(image->GetScalarPointer()),
                   pixels.height, std::size_t(pixels.width) * pixels.channels);
  return image;
}

std::vector<View> silhouetteViews(const std::vector<ImageView>& views)
{
  std::vector<View> silhouettes(views.size());
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    PixelRows pixels = pixelRows(views[i], i);
    if (pixels.channels != 1)
    {
      throw InvalidInput(
          describeView(i, views[i].name) + ": the image has " + std::to_string(pixels.channels) +
          " components, a silhouette has 1; vtkSilhouetteExtractor makes silhouettes of photographs");
    }
    const bool zeroAndOne = *std::max_element(pixels.values.begin(), pixels.values.end()) == 1;
    const std::uint8_t highestBackground = zeroAndOne ? 0 : 127;
    for (std::uint8_t& value : pixels.values)
    {
      value = value > highestBackground;
    }
    silhouettes[i].name = views[i].name;
    silhouettes[i].projection = views[i].projection;
    silhouettes[i].silhouette = {pixels.width, pixels.height, std::move(pixels.values)};
  }
  return silhouettes;
}

ImageView imageOf(const View& view)
{
  PixelRows pixels{view.silhouette.width, view.silhouette.height, 1, view.silhouette.pixels};
  for (std::uint8_t& value : pixels.values)
  {
    value = value ? 255 : 0;
  }
  return {makeImage(pixels), view.name, view.projection};
}

} // namespace silhouette::modeling
