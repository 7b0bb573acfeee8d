// SPDX-License-Identifier: BSD-3-Clause
#include "CaptureOptions.h"

#include "Arguments.h"
#include "CaptureFolder.h"
#include "Error.h"
#include "ExtractionOptions.h"
#include "ViewSelection.h"

#include "vtkSilhouetteCaptureReader.h"
#include "vtkSilhouetteExtractor.h"

#include <algorithm>

namespace silhouette::program
{
namespace
{

const char* const CriteriaGroup = "Silhouettes: a pixel is background where ANY of these says so";
const char* const CleanGroup = "Silhouettes: then, in this order";

/** In the order of vtkSilhouetteExtractor's operations. */
const std::array<std::string, 4> OperationNames = { "--opening", "--closing", "--dilate", "--erode" };

} // namespace

void CaptureOptions::addTo(CLI::App& command)
{
  this->Command = &command;
  command.add_option("--views", this->Views, "Views to use, by number from 0, range or image name: 0,3,5-9 "
                                             "(default: all, or those that the capture lists as good)")
    ->type_name("LIST")
    ->group("Capture");
  command.add_option("--pixels", this->PixelFamily, "Where a camera file whose format does not say it (projections.txt, "
                                                    "*_par.txt) puts the first pixel's centre: integer, at (0, 0), or "
                                                    "corner, at (0.5, 0.5)")
    ->type_name("FAMILY")
    ->check(CLI::IsMember({ "integer", "corner" }))
    ->capture_default_str()
    ->group("Capture");
  this->addCriteria(command);
  this->addClean(command);
}

void CaptureOptions::addCriteria(CLI::App& command)
{
  command.add_option("--key", this->KeyText, "Chroma key, red, green or blue and an excess: background where that "
                                             "channel exceeds the larger of the other two by this or more, 0 to 1, as "
                                             "in blue:0.08. Larger calls less background")
    ->type_name("CHANNEL:EXCESS")
    ->group(CriteriaGroup);
  CLI::Option* background =
    command.add_option("--background", this->BackgroundText, "The background's colour, 0 to 1 each, as in 0,0,0.75")
      ->type_name("R,G,B")
      ->group(CriteriaGroup);
  command.add_option("--tolerance", this->Tolerance, "How far from that colour is still background: summed absolute "
                                                     "difference, 0 to 3 (default: 0.3). Larger calls more background")
    ->type_name("T")
    ->check(inRange(0.0, 3.0))
    ->needs(background)
    ->group(CriteriaGroup);
  command.add_option("--threshold", this->Threshold, "Background where the largest channel is at most G, 0 to 1. "
                                                     "Larger calls more background")
    ->type_name("G")
    ->check(inRange(0.0, 1.0))
    ->group(CriteriaGroup);
  command.add_flag("--alpha", this->Alpha, "Background where alpha is at most 127 of 255")->group(CriteriaGroup);
}

void CaptureOptions::addClean(CLI::App& command)
{
  command.add_flag("--invert", this->Invert, "Swap object and background")->group(CleanGroup);
  const char* const meanings[4] = { "Remove specks: erode, then dilate, by a disc of R pixels (1 is 3 x 3). These four "
                                    "may be repeated, and run in the order of the command line; their radii together, "
                                    "--opening's and --closing's twice, are at most 1000",
    "Close gaps: dilate, then erode", "Grow the object by R pixels", "Shrink the object by R pixels" };
  for (int i = 0; i < 4; ++i)
  {
    this->Operations[i] = command.add_option(OperationNames[i], this->Radii[i], meanings[i])
                            ->type_name("R")
                            ->allow_extra_args(false)
                            ->check(inRange(0, LargestMorphologyReach, true))
                            ->group(CleanGroup);
  }
  command.add_flag("--largest-region", this->LargestRegion, "Keep the largest region of object only")
    ->group(CleanGroup);
  command.add_option("--fill-holes", this->FillHoles, "Fill holes of fewer pixels than this (default: 0, none)")
    ->type_name("PIXELS")
    ->check(inRange(0, 2147483647, true))
    ->group(CleanGroup);
}

void CaptureOptions::finish()
{
  if (!this->KeyText.empty())
  {
    const std::size_t colon = this->KeyText.find(':');
    this->KeyChannel = indexOf(this->KeyText.substr(0, colon), { "red", "green", "blue" });
    const std::string expected = "red, green or blue, a colon and an excess above 0 and at most 1, as in blue:0.08";
    const std::string excess = colon == std::string::npos ? "none" : this->KeyText.substr(colon + 1);
    if (this->KeyChannel > 2 || !aboveZero(1.0)(excess).empty())
    {
      throw CLI::ValidationError("--key", "expected " + expected + "; got '" + this->KeyText + "'");
    }
    this->KeyExcess = std::stod(excess);
  }
  if (!this->BackgroundText.empty())
  {
    const std::string expected = "red, green and blue, each from 0 to 1, as in 0,0,0.75";
    const std::vector<double> colour = parseNumbers("--background", this->BackgroundText, 3, expected);
    for (const double channel : colour)
    {
      if (channel < 0.0 || channel > 1.0)
      {
        throw CLI::ValidationError("--background", "expected " + expected + "; got '" + this->BackgroundText + "'");
      }
    }
    this->Background = { colour[0], colour[1], colour[2] };
  }
  std::array<std::size_t, 4> used{};
  for (const CLI::Option* option : this->Command->parse_order())
  {
    const auto found = std::find(this->Operations.begin(), this->Operations.end(), option);
    if (found != this->Operations.end())
    {
      const auto operation = static_cast<std::size_t>(found - this->Operations.begin());
      this->Morphology.emplace_back(static_cast<int>(operation), this->Radii[operation][used[operation]++]);
    }
  }
  this->checkReach();
}

void CaptureOptions::checkReach() const
{
  ExtractionOptions asked;
  for (const auto& [operation, radius] : this->Morphology)
  {
    asked.morphology.push_back({ static_cast<MorphologyKind>(operation), radius });
  }
  try
  {
    validate(asked);
  }
  catch (const InvalidInput& error)
  {
    throw CLI::ValidationError("--" + std::string(error.what()));
  }
}

bool CaptureOptions::hasCriteria() const
{
  return this->KeyExcess || this->Background || this->Threshold || this->Alpha;
}

bool CaptureOptions::dilates() const
{
  const auto dilation = std::find(OperationNames.begin(), OperationNames.end(), std::string("--dilate"));
  const int operation = static_cast<int>(dilation - OperationNames.begin());
  return std::any_of(this->Morphology.begin(), this->Morphology.end(),
    [operation](const auto& one) { return one.first == operation && one.second > 0; });
}

void CaptureOptions::checkCapture(const std::string& capture) const
{
  std::vector<std::string> names;
  std::string family;
  try
  {
    names = captureViewNames(capture);
    family = statedPixelFamily(capture);
  }
  catch (const Error&)
  {
    return; // its reader will say
  }
  if (!family.empty() && this->PixelFamily == "corner")
  {
    throw CLI::ValidationError("--pixels", "this camera file's format states its pixel family, " + family + "; it is not to be chosen");
  }
  try
  {
    selectViews(this->Views, names);
  }
  catch (const InvalidInput& error)
  {
    throw CLI::ValidationError("--" + std::string(error.what()));
  }
}

void CaptureOptions::configure(const std::string& capture, vtkSilhouetteCaptureReader* reader) const
{
  this->checkCapture(capture);
  reader->SetFileName(capture.c_str());
  reader->SetViews(this->Views.empty() ? nullptr : this->Views.c_str());
  reader->SetPixelFamily(this->PixelFamily == "corner" ? vtkSilhouetteCaptureReader::CORNER
                                                       : vtkSilhouetteCaptureReader::INTEGER);
  // Criteria are about photographs; masks are what they would make.
  reader->SetImageChoice(this->hasCriteria() ? vtkSilhouetteCaptureReader::PHOTOGRAPHS
                                             : vtkSilhouetteCaptureReader::MASKS_WHERE_PRESENT);
}

void CaptureOptions::configure(vtkSilhouetteExtractor* extractor) const
{
  if (this->KeyExcess)
  {
    extractor->SetKeyChannel(this->KeyChannel);
    extractor->SetKeyExcess(*this->KeyExcess);
  }
  if (this->Background)
  {
    extractor->UseBackgroundColorOn();
    extractor->SetBackgroundColor(this->Background->data());
  }
  if (this->Tolerance)
  {
    extractor->SetTolerance(*this->Tolerance);
  }
  if (this->Threshold)
  {
    extractor->UseThresholdOn();
    extractor->SetThreshold(*this->Threshold);
  }
  extractor->SetUseAlpha(this->Alpha);
  extractor->SetInvertPolarity(this->Invert);
  for (const auto& [operation, radius] : this->Morphology)
  {
    extractor->AddOperation(operation, radius);
  }
  extractor->SetLargestRegion(this->LargestRegion);
  extractor->SetFillHoles(this->FillHoles);
}

} // namespace silhouette::program
