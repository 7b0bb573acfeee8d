// SPDX-License-Identifier: BSD-3-Clause
/**
 * The thesis's Table 6.1: what faithful voting makes of one convex object, by the share of votes. The object
 * is a sphere on a lattice of 64^3 octants; its size, the noise of the cameras and the seed are searched for
 * what comes nearest.
 */
#pragma once

#include "Execution.h"
#include "Mesh.h"

#include <array>
#include <cstdint>
#include <filesystem>
#include <vector>

namespace silhouette::experiments
{

constexpr std::array<double, 4> VoteShares = {1.0, 0.9, 0.8, 0.7};

/** A column of the table. */
struct VoteCounts
{
  double vertices = 0;
  double faces = 0;
  double lostNoCorner = 0;   ///< intersection octants without an inside corner
  double lostAllCorners = 0; ///< with eight of them
  double lost() const { return this->lostNoCorner + this->lostAllCorners; }
};

/** A table, and what it was made of. */
struct VoteTable
{
  double diameter = 47.0; ///< of the sphere, octants
  double noise = 0.6;     ///< standard deviation of the principal points, octants at the sphere's centre
  std::uint64_t seed = 11;
  std::array<VoteCounts, 4> counts;      ///< by share
  std::array<double, 7> intersections{}; ///< intersection octants of each generation, the root's first
  double distance = 0.0;                 ///< mean of |log| of the ratios to the thesis's twelve figures

  double allIntersections() const;
};

/** The thesis's figures; it gives lost octants as one number, here among those without an inside corner. */
const std::array<VoteCounts, 4>& thesisVotes();
constexpr double ThesisIntersections = 15552;

/** Compute the counts; the diameter, noise and seed are given. */
void fillVoteTable(VoteTable& table, Execution& execution);

/** The four surfaces of a table. */
std::vector<Mesh> voteSurfaces(const VoteTable& table, Execution& execution);

/** All tables of the search, the sphere of 47 octants with a noise of 0.6 and the first seed first. */
std::vector<VoteTable> searchVoteTables(Execution& execution);

void writeVoteTables(const std::filesystem::path& file, const std::vector<VoteTable>& tables);
/** None where there is no file. */
std::vector<VoteTable> readVoteTables(const std::filesystem::path& file);

} // namespace silhouette::experiments
