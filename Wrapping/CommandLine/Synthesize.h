// SPDX-License-Identifier: BSD-3-Clause
/**
 * `vtksilhouette synthesize`: a capture whose truth is known.
 */
#pragma once

#include "Commands.h"

#include <cstdint>
#include <optional>
#include <string>

class vtkSyntheticCaptureSource;

namespace silhouette::program
{

class Synthesize : public Command
{
public:
  explicit Synthesize(CLI::App& program);
  void finish() override;
  void run() override;

private:
  void addShape();
  void addNoise();
  void configure(vtkSyntheticCaptureSource* source) const;

  std::string Folder;
  std::optional<std::string> Shape;
  std::string Mesh;
  int Views = 36;
  std::string SizeText = "1024x1024";
  int Width = 0;
  int Height = 0;
  std::uint64_t Seed = 0;
  double NoiseContour = 0.0;
  int NoiseBlobs = 0;
  double NoisePixels = 0.0;
  double NoiseCamera = 0.0;
  double NoiseRotation = 0.0;
  bool Force = false;
  int Threads = 0;
  bool Quiet = false;
};

} // namespace silhouette::program
