// SPDX-License-Identifier: BSD-3-Clause
#include "Report.h"

#include "Error.h"
#include "Prose.h"
#include "Study.h"
#include "Tables.h"

#include <algorithm>
#include <fstream>
#include <set>

namespace silhouette::experiments
{
namespace
{

/** The picture, if it is there. */
std::string figure(const std::filesystem::path& folder, const std::string& name, const std::string& caption)
{
  const std::string file = "experiments-" + name + ".png";
  return std::filesystem::exists(folder / file) ? "\n![" + caption + "](Figures/" + file + ")\n" : "";
}

std::string joined(const std::set<std::uint64_t>& seeds)
{
  std::string text;
  for (const std::uint64_t seed : seeds)
  {
    text += (text.empty() ? "" : ", ") + std::to_string(seed);
  }
  return text;
}

std::string settingsOf(const std::vector<Row>& rows)
{
  const Settings& s = rows.front().settings;
  std::set<std::uint64_t> seeds;
  for (const Row& row : rows)
  {
    seeds.insert(row.at.seed);
  }
  seeds.erase(0); // of the clean cases, which have none
  return "\nHere: " + std::to_string(s.views) + " views of " + std::to_string(s.size) + " x " +
         std::to_string(s.size) + " pixels, octrees of depth " + std::to_string(s.depth) + ", seeds " +
         joined(seeds) + "; " + std::to_string(rows.size()) + " surfaces.\n";
}

std::string objectSection(const std::vector<Row>& rows, const Object& object,
                          const std::filesystem::path& figures)
{
  const std::string name = object.name;
  const std::string title = std::string(1, char(name[0] - 'a' + 'A')) + name.substr(1);
  return "\n## " + title + ": " + (object.convex ? "convex" : "concave") + ", genus " +
         std::to_string(object.genus) + "\n" +
         figure(figures, name,
                "Rows: kinds of noise. Columns: exact marching cubes, the best voting, the convex "
                "hull, local hulls. Red is the inner side") +
         prose::Errors + "\n" + errorTable(rows, name) + prose::Shapes + "\n" + shapeTable(rows, name);
}

} // namespace

std::string pageOf(const std::vector<Row>& rows, const std::vector<VoteTable>& votes,
                   const std::filesystem::path& figures)
{
  std::string page = prose::Opening;
  page += prose::Setting + settingsOf(rows) + prose::Measures;
  page += prose::Promises + std::string("\n") + promiseTable(rows);
  page += prose::Targets + std::string("\n") + targetTable(rows);
  for (const Object& object : objects())
  {
    if (std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return row.at.object == object.name; }))
    {
      page += objectSection(rows, object, figures);
    }
  }
  page += prose::Times + std::string("\n") + timeTable(rows) + prose::Failures + noteTable(rows);
  if (!votes.empty())
  {
    page += prose::Votes + std::string("\n") + voteCountTable(votes);
    page += figure(figures, "figure-6-3", "The four surfaces of the nearest table; red is the inner side");
    page += prose::Generations + std::string("\n") + generationTable(votes);
  }
  page += prose::Hulls + figure(figures, "figure-6-4", "Tetrahedra, their boundary and the convex hull");
  return page;
}

void writeReport(const std::filesystem::path& results, const std::filesystem::path& folder)
{
  const std::vector<Row> rows = readRows(resultsFile(results));
  if (rows.empty())
  {
    throw InvalidInput("there are no results in " + results.string());
  }
  const std::filesystem::path file = folder / "experiments.md";
  std::ofstream stream(file);
  stream << pageOf(rows, readVoteTables(votesFile(results)), folder / "Figures");
  if (!stream)
  {
    throw InvalidInput("cannot write " + file.string());
  }
}

} // namespace silhouette::experiments
