// SPDX-License-Identifier: BSD-3-Clause
/**
 * `vtksilhouette reconstruct`: from a capture to a mesh.
 */
#pragma once

#include "CaptureOptions.h"
#include "Commands.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace silhouette::program
{

struct ReconstructOptions
{
  std::string capture;
  CaptureOptions silhouettes;
  std::string mesh;
  std::optional<int> depth;
  std::optional<double> leafEdge;
  std::string boundsText;
  std::optional<std::array<double, 6>> bounds;
  std::string outside = "border";
  std::string surface = "local-hull";
  std::optional<double> voteShare;
  std::optional<int> backgroundVotes;
  std::string votes = "consistent";
  std::string edges = "exact";
  std::string carving = "tolerant";
  std::string mode = "robust";
  double islandShare = 0.0;
  bool repair = true;
  bool alignment = true;
  bool correction = true;
  bool thinHulls = true;
  bool handles = true;
  bool tunnels = true;
  bool largest = false;
  std::string truth;
  std::string metrics;
  std::string image;
  std::string octree;
  int pieces = 1;
  int threads = 0;
  bool quiet = false;

  /** The option that leaves no tolerance of the carving to be found, as on the command line; empty where none does. */
  std::string carvingSettledBy() const;
};

class Reconstruct : public Command
{
public:
  explicit Reconstruct(CLI::App& program);
  void finish() override;
  void run() override;

private:
  void addOutputs();
  void addOctree();
  void addSurface();
  void addLocalHulls();
  void addRest();
  /** Options that mean nothing together. */
  void checkMeaning() const;

  ReconstructOptions Options;
  std::vector<CLI::Option*> Switches; ///< of the robust mode's corrections
};

} // namespace silhouette::program
