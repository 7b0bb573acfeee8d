// SPDX-License-Identifier: BSD-3-Clause
/**
 * Pictures compared with baselines.
 *
 * VTK's usual comparison forgives a lot: it looks for the best match among the neighbours of a pixel,
 * averages over 3 x 3 pixels, and compares a sum with a threshold of 10 to 15 whole pixels. A 3 x 3 hole in a
 * surface and 413 scattered pixels of 40000 pass it. The comparison here forgives only what software
 * rasterisers of different processors do differ in, which is a pixel here and there along an edge, and shades
 * by a few steps of 255:
 *
 * - no clump may differ, three pixels or more of a block of 2 x 2: an edge that falls to the other side of a
 *   pixel's centre makes single pixels or a row, a hole, a missing cell or a speck makes clumps;
 * - scattered pixels that differ are counted, and their share is limited;
 * - the mean difference over the picture is limited: a change of light or colour everywhere.
 *
 * A picture test stands beside a test of the geometry; it never replaces it.
 *
 * Baselines are Testing/Data/Baseline/NAME.png. SILHOUETTE_WRITE_BASELINES=1 in the environment writes them
 * instead of comparing: look at each before it is committed. On failure NAME.png and NAME.difference.png
 * (white where a pixel differs) are left in the build tree's Testing/Temporary.
 */
#pragma once

#include "vtkImageData.h"
#include "vtkImageDifference.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPNGWriter.h"
#include "vtkRenderWindow.h"
#include "vtkSmartPointer.h"
#include "vtkWindowToImageFilter.h"

#include <gtest/gtest.h>
#include <vtksys/SystemTools.hxx>

#include <algorithm>
#include <cstdlib>
#include <string>

namespace silhouette::testing
{

/** What a comparison forgives. The defaults hold for flat and smooth shading without multisampling. */
struct ImageTolerance
{
  /** A pixel differs where one of its channels does by more than this, of 255. Larger forgives more shading.
   */
  int channel = 24;

  /** The largest share of pixels that may differ, one by one: 8 of 200 x 200. Larger forgives more edge
   * pixels. */
  double share = 2e-4;

  /** The largest mean difference of all channels, of 255. Larger forgives more of a change everywhere. */
  double mean = 0.5;
};

/** How two pictures of one size differ. */
struct ImageComparison
{
  bool sameSize = false;
  int pixels = 0;                           ///< of each picture
  int differing = 0;                        ///< pixels that differ by more than the tolerance
  int clumps = 0;                           ///< blocks of 2 x 2 pixels, three or four of which differ
  double mean = 0.0;                        ///< mean absolute difference of all channels, of 255
  vtkSmartPointer<vtkImageData> difference; ///< one channel: 255 where a pixel differs, else 0

  bool matches(const ImageTolerance& tolerance) const
  {
    return this->sameSize && this->clumps == 0 && this->differing <= tolerance.share * this->pixels &&
           this->mean <= tolerance.mean;
  }

  std::string describe(const ImageTolerance& tolerance) const
  {
    if (!this->sameSize)
    {
      return "the pictures have different sizes or channels";
    }
    return std::to_string(this->clumps) + " clumps of pixels differ (0 allowed), " +
           std::to_string(this->differing) + " pixels (" +
           std::to_string(int(tolerance.share * this->pixels)) + " allowed), the mean by " +
           std::to_string(this->mean) + " (" + std::to_string(tolerance.mean) + " allowed)";
  }
};

/** Compare two unsigned char pictures with three channels. */
inline ImageComparison compareImages(vtkImageData* first, vtkImageData* second,
                                     const ImageTolerance& tolerance = {})
{
  ImageComparison result;
  const int* size = first->GetDimensions();
  const int* otherSize = second->GetDimensions();
  const int channels = first->GetNumberOfScalarComponents();
  result.sameSize =
      std::equal(size, size + 3, otherSize) && channels == second->GetNumberOfScalarComponents() &&
      first->GetScalarType() == VTK_UNSIGNED_CHAR && second->GetScalarType() == VTK_UNSIGNED_CHAR;
  if (!result.sameSize)
  {
    return result;
  }
  const int width = size[0];
  const int height = size[1];
  result.pixels = width * height;
  result.difference = vtkSmartPointer<vtkImageData>::New();
  result.difference->SetDimensions(width, height, 1);
  result.difference->AllocateScalars(VTK_UNSIGNED_CHAR, 1);
  const auto* a = static_cast<const unsigned char*>(first->GetScalarPointer());
  const auto* b = static_cast<const unsigned char*>(second->GetScalarPointer());
  auto* marks = static_cast<unsigned char*>(result.difference->GetScalarPointer());
  for (int pixel = 0; pixel < result.pixels; ++pixel)
  {
    int largest = 0;
    for (int channel = 0; channel < channels; ++channel)
    {
      largest = std::max(largest, std::abs(a[pixel * channels + channel] - b[pixel * channels + channel]));
    }
    marks[pixel] = largest > tolerance.channel ? 255 : 0;
    result.differing += marks[pixel] ? 1 : 0;
  }
  for (int row = 0; row + 1 < height; ++row)
  {
    for (int column = 0; column + 1 < width; ++column)
    {
      const unsigned char* corner = marks + row * width + column;
      const int marked = (corner[0] + corner[1] + corner[width] + corner[width + 1]) / 255;
      result.clumps += marked >= 3 ? 1 : 0;
    }
  }

  // VTK's own difference gives the mean, with all that it forgives switched off.
  vtkNew<vtkImageDifference> vtkDifference;
  vtkDifference->AllowShiftOff();
  vtkDifference->AveragingOff();
  vtkDifference->SetThreshold(0);
  vtkDifference->SetInputData(first);
  vtkDifference->SetImageData(second);
  vtkDifference->Update();
  result.mean = 255.0 * vtkDifference->GetThresholdedError() / result.pixels; // the error is in whole pixels
  return result;
}

/** The window's picture: rendered, then read without an alpha channel. */
inline vtkSmartPointer<vtkImageData> pictureOf(vtkRenderWindow* window)
{
  window->Render();
  vtkNew<vtkWindowToImageFilter> grab;
  grab->SetInput(window);
  grab->SetInputBufferTypeToRGB();
  grab->ReadFrontBufferOff();
  grab->ShouldRerenderOff();
  grab->Update();
  vtkSmartPointer<vtkImageData> picture = vtkSmartPointer<vtkImageData>::New();
  picture->DeepCopy(grab->GetOutput());
  return picture;
}

/** Write a picture as PNG; `path` with its ending. */
inline void writePicture(vtkImageData* picture, const std::string& path)
{
  vtksys::SystemTools::MakeDirectory(vtksys::SystemTools::GetFilenamePath(path));
  vtkNew<vtkPNGWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(picture);
  writer->Write();
}

/**
 * Whether the picture is the baseline `name`; for EXPECT_TRUE, which prints why it is not and where to look.
 * A baseline that is missing is a failure.
 */
inline ::testing::AssertionResult matchesBaseline(vtkImageData* picture, const std::string& name,
                                                  const ImageTolerance& tolerance = {})
{
  const std::string baseline = std::string(SILHOUETTE_BASELINE_DIR) + "/" + name + ".png";
  const std::string written = std::string(SILHOUETTE_TEMPORARY_DIR) + "/" + name;
  const char* write = std::getenv("SILHOUETTE_WRITE_BASELINES");
  if (write && std::string(write) == "1")
  {
    writePicture(picture, baseline);
    return ::testing::AssertionSuccess() << "baseline written: " << baseline;
  }
  if (!vtksys::SystemTools::FileExists(baseline, true))
  {
    writePicture(picture, written + ".png");
    return ::testing::AssertionFailure() << "no baseline " << baseline << "; the picture is " << written
                                         << ".png, SILHOUETTE_WRITE_BASELINES=1 writes baselines";
  }
  vtkNew<vtkPNGReader> reader;
  reader->SetFileName(baseline.c_str());
  reader->Update();
  const ImageComparison comparison = compareImages(picture, reader->GetOutput(), tolerance);
  if (comparison.matches(tolerance))
  {
    return ::testing::AssertionSuccess();
  }
  writePicture(picture, written + ".png");
  if (comparison.difference)
  {
    writePicture(comparison.difference, written + ".difference.png");
  }
  return ::testing::AssertionFailure()
         << "picture " << written << ".png is not " << baseline << ": " << comparison.describe(tolerance);
}

/** The same for what a window shows. */
inline ::testing::AssertionResult matchesBaseline(vtkRenderWindow* window, const std::string& name,
                                                  const ImageTolerance& tolerance = {})
{
  return matchesBaseline(pictureOf(window).Get(), name, tolerance);
}

} // namespace silhouette::testing
