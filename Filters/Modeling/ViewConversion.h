// SPDX-License-Identifier: BSD-3-Clause
/**
 * Views as VTK carries them, and as the core does: a vtkPartitionedDataSetCollection of vtkImageData, each
 * with its name in the collection's metadata and its matrix in the field array `Projection`, against
 * silhouette::View. The one place that knows that VTK's images begin with the bottom row. Private to the
 * module.
 */
#pragma once

#include "Execution.h"
#include "View.h"

#include "vtkSmartPointer.h"

#include <array>
#include <string>
#include <vector>

class vtkDataObject;
class vtkImageData;
class vtkPartitionedDataSetCollection;

namespace silhouette::modeling
{

/** An image and its matrix, pixels untouched. */
struct ImageView
{
  vtkSmartPointer<vtkImageData> image; ///< two-dimensional, never null
  std::string name;
  Projection projection = Projection::Zero();
};

/** Pixel values of an image, top row first, `channels` values a pixel. */
struct PixelRows
{
  int width = 0;
  int height = 0;
  int channels = 0;
  std::vector<std::uint8_t> values;
};

/** The collection's views. Throws InvalidInput naming the view that has no image, or no `Projection` of 12
 * values. */
std::vector<ImageView> imageViews(vtkPartitionedDataSetCollection* collection);

/** Replace the content of `collection` by these views; images are shared, their field data are not. */
void storeViews(const std::vector<ImageView>& views, vtkPartitionedDataSetCollection* collection);

/** The pixels of an unsigned char image. Throws InvalidInput naming the view and what it holds instead. */
PixelRows pixelRows(const ImageView& view, std::size_t index);

/** An unsigned char image of the given pixels. */
vtkSmartPointer<vtkImageData> makeImage(const PixelRows& pixels);

/** The silhouettes: object where > 127, or where not 0 if the greatest value is 1. */
std::vector<View> silhouetteViews(const std::vector<ImageView>& views, Execution& execution);

/** The image that silhouetteViews reads back as this silhouette: 0 and 255. */
ImageView imageOf(const View& view);

} // namespace silhouette::modeling
