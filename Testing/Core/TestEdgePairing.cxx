// SPDX-License-Identifier: BSD-3-Clause
#include "EdgePairing.h"

#include "CarvingTestCaptures.h"
#include "EvaluationTestMeshes.h"

#include <gtest/gtest.h>

#include <map>

using namespace silhouette;
using namespace silhouette::test;

namespace
{

/** For each edge what was told of its uses: forwards and backwards by triangle, and how often one had a partner. */
struct Told
{
  std::multimap<std::pair<std::int32_t, std::int32_t>, std::pair<std::uint32_t, bool>> uses;
  std::size_t partners = 0;

  bool operator==(const Told& other) const { return this->sorted() == other.sorted() && this->partners == other.partners; }
  std::vector<std::tuple<std::int32_t, std::int32_t, std::uint32_t, bool>> sorted() const
  {
    std::vector<std::tuple<std::int32_t, std::int32_t, std::uint32_t, bool>> all;
    for (const auto& [edge, use] : this->uses)
    {
      all.emplace_back(edge.first, edge.second, use.first, use.second);
    }
    std::sort(all.begin(), all.end());
    return all;
  }
};

Told toldOf(const Mesh& mesh, Execution& execution)
{
  Told told;
  const auto none = std::uint32_t(mesh.triangles.size());
  std::mutex telling;
  forEdges(mesh, execution,
    [&]
    {
      return [&](std::int32_t from, std::int32_t to, std::uint32_t forwards, std::uint32_t backwards)
      {
        const std::lock_guard<std::mutex> lock(telling);
        for (const bool way : { true, false })
        {
          if ((way ? forwards : backwards) != none)
          {
            told.uses.emplace(std::make_pair(from, to), std::make_pair(way ? forwards : backwards, way));
          }
        }
        told.partners += forwards != none && backwards != none;
      };
    });
  return told;
}

/** By a map of all. */
Told expectedOf(const Mesh& mesh)
{
  Told told;
  std::map<std::pair<std::int32_t, std::int32_t>, std::array<std::size_t, 2>> counts;
  for (std::uint32_t n = 0; n < mesh.triangles.size(); ++n)
  {
    for (int c = 0; c < 3; ++c)
    {
      const std::int32_t a = mesh.triangles[n][c], b = mesh.triangles[n][(c + 1) % 3];
      told.uses.emplace(std::minmax(a, b), std::make_pair(n, a < b));
      ++counts[std::minmax(a, b)][a < b];
    }
  }
  for (const auto& one : counts)
  {
    told.partners += std::min(one.second[0], one.second[1]);
  }
  return told;
}

} // namespace

TEST(EdgePairing, TellsOfEveryUseOnceAndFindsPartners)
{
  Random random(3);
  Mesh mesh = torusMesh(160, 90, 0.7, 0.3);
  for (int kind = 0; kind < 3; ++kind)
  {
    for (const int threads : { 1, 3 })
    {
      ThreadedExecution execution(threads);
      EXPECT_TRUE(toldOf(mesh, execution) == expectedOf(mesh)) << kind;
    }
    for (std::size_t n = mesh.triangles.size(); kind == 0 && n > 1; --n)
    {
      std::swap(mesh.triangles[n - 1], mesh.triangles[std::size_t(random.below(int(n)))]); // then in no order at all
    }
    for (int n = 0; kind == 1 && n < 500; ++n)
    {
      // Holes, triangles twice, and some the other way round.
      Triangle& t = mesh.triangles[std::size_t(random.below(int(mesh.triangles.size())))];
      t = mesh.triangles[std::size_t(random.below(int(mesh.triangles.size())))];
      std::swap(t[1], t[n % 2 + 1]);
    }
  }
  Execution execution;
  EXPECT_TRUE(toldOf(Mesh(), execution).uses.empty());
}
