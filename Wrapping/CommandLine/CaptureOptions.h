// SPDX-License-Identifier: BSD-3-Clause
/**
 * The options that say what is read of a capture and how its photographs become silhouettes.
 */
#pragma once

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace CLI
{
class App;
class Option;
}
class vtkSilhouetteCaptureReader;
class vtkSilhouetteExtractor;

namespace silhouette::program
{

class CaptureOptions
{
public:
  /** Adds the options to a command. This object has to outlive the parsing. */
  void addTo(CLI::App& command);

  /** Reads what the parser leaves as text. Throws CLI::ValidationError. To be called once all is parsed. */
  void finish();

  /** Does the user dilate silhouettes? */
  bool dilates() const;

  /** Throws CLI::ValidationError where the views asked for are not the capture's. */
  void configure(const std::string& capture, vtkSilhouetteCaptureReader* reader) const;
  void configure(vtkSilhouetteExtractor* extractor) const;

private:
  void addCriteria(CLI::App& command);
  void addClean(CLI::App& command);
  void checkReach() const;
  void checkCapture(const std::string& capture) const;
  bool hasCriteria() const;

  CLI::App* Command = nullptr;
  std::string Views;
  std::string PixelFamily = "integer";
  std::string KeyText;
  std::string BackgroundText;
  int KeyChannel = -1; ///< of red, green, blue; -1 for none
  std::optional<double> KeyExcess;
  std::optional<std::array<double, 3>> Background;
  std::optional<double> Tolerance;
  std::optional<double> Threshold;
  bool Alpha = false;
  bool Invert = false;
  bool LargestRegion = false;
  int FillHoles = 0;
  std::array<std::vector<int>, 4> Radii; ///< by operation
  std::array<CLI::Option*, 4> Operations{};
  std::vector<std::pair<int, int>> Morphology; ///< operation and radius, as on the command line
};

} // namespace silhouette::program
