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

/** An image's values where they are: the bottom row first. */
struct PixelBytes
{
  const unsigned char* values = nullptr;
  int width = 0;
  int height = 0;
  int channels = 0;
};

/** Throws InvalidInput naming the view and what it holds instead of unsigned char values. */
PixelBytes pixelBytes(const ImageView& view, std::size_t index)
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
  const int channels = bytes->GetNumberOfComponents();
  if (bytes->GetNumberOfValues() != static_cast<vtkIdType>(std::size_t(size[0]) * size[1] * channels))
  {
    throw InvalidInput(what + ": " + std::to_string(bytes->GetNumberOfTuples()) + " pixel values for " +
                       std::to_string(size[0]) + " x " + std::to_string(size[1]) + " pixels");
  }
  return {bytes->GetPointer(0), size[0], size[1], channels};
}

/** Does a row hold a value above 1? */
bool exceedsOne(const unsigned char* row, int width)
{
  unsigned char all = 0;
  for (int column = 0; column < width; ++column)
  {
    all |= row[column];
  }
  return all > 1;
}

BinaryImage silhouetteOf(const PixelBytes& image)
{
  const auto row = [&](int r) { return image.values + std::size_t(r) * image.width; };
  bool many = false;
  for (int r = 0; r < image.height && !many; ++r)
  {
    many = exceedsOne(row(r), image.width);
  }
  const unsigned char highestBackground = many ? 127 : 0;
  BinaryImage silhouette{image.width, image.height, {}};
  silhouette.pixels.resize(std::size_t(image.width) * image.height);
  for (int r = 0; r < image.height; ++r)
  {
    std::transform(row(r), row(r) + image.width,
                   silhouette.pixels.begin() + std::size_t(image.height - 1 - r) * image.width,
                   [&](unsigned char value) { return std::uint8_t(value > highestBackground); });
  }
  return silhouette;
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
  const PixelBytes bytes = pixelBytes(view, index);
  PixelRows pixels{bytes.width, bytes.height, bytes.channels, {}};
  pixels.values.resize(std::size_t(bytes.width) * bytes.height * bytes.channels);
  copyRowsReversed(bytes.values, pixels.values.data(), bytes.height, std::size_t(bytes.width) * bytes.channels);
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

std::vector<View> silhouetteViews(const std::vector<ImageView>& views, Execution& execution)
{
  std::vector<View> silhouettes(views.size());
  std::vector<PixelBytes> images;
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    images.push_back(pixelBytes(views[i], i));
    if (images[i].channels != 1)
    {
      throw InvalidInput(
          describeView(i, views[i].name) + ": the image has " + std::to_string(images[i].channels) +
          " components, a silhouette has 1; vtkSilhouetteExtractor makes silhouettes of photographs");
    }
    silhouettes[i].name = views[i].name;
    silhouettes[i].projection = views[i].projection;
  }
  execution.forRanges(views.size(), 1,
                      [&](std::size_t first, std::size_t last)
                      {
                        for (std::size_t i = first; i < last; ++i)
                        {
                          silhouettes[i].silhouette = silhouetteOf(images[i]);
                        }
                      });
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
