// SPDX-License-Identifier: BSD-3-Clause
#include "Report.h"

#include "Error.h"
#include "Prose.h"
#include "Study.h"
#include "Tables.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <set>
#include <tuple>

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

bool isBefore(const Settings& a, const Settings& b)
{
  return std::tie(a.depth, a.size, a.views) < std::tie(b.depth, b.size, b.views);
}

/** The rows of each of the settings, the coarsest first. */
std::vector<std::vector<Row>> bySettings(const std::vector<Row>& rows)
{
  std::map<Settings, std::vector<Row>, decltype(&isBefore)> groups(&isBefore);
  for (const Row& row : rows)
  {
    groups[row.settings].push_back(row);
  }
  std::vector<std::vector<Row>> result;
  for (auto& group : groups)
  {
    result.push_back(std::move(group.second));
  }
  return result;
}

/** What stands above a table: what its rows are of. */
std::string settingsOf(const std::vector<Row>& rows)
{
  const Settings& s = rows.front().settings;
  std::set<std::uint64_t> seeds;
  for (const Row& row : rows)
  {
    seeds.insert(row.at.seed);
  }
  seeds.erase(0); // of the clean cases, which have none
  return "\n*Depth " + std::to_string(s.depth) + ", " + std::to_string(s.views) + " views of " +
         std::to_string(s.size) + " x " + std::to_string(s.size) + " pixels" +
         (seeds.empty() ? "" : ", seeds " + joined(seeds)) + "*\n\n";
}

/** The same table of each of the settings. */
std::string ofEach(const std::vector<std::vector<Row>>& groups, std::string (*table)(const std::vector<Row>&))
{
  std::string text;
  for (const std::vector<Row>& rows : groups)
  {
    text += settingsOf(rows) + table(rows);
  }
  return text;
}

std::vector<Row> rowsOf(const std::vector<Row>& rows, const std::string& object)
{
  std::vector<Row> found;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(found),
               [&](const Row& row) { return row.at.object == object; });
  return found;
}

std::string objectSection(const std::vector<std::vector<Row>>& groups, const Object& object,
                          const std::filesystem::path& figures)
{
  const std::string name = object.name;
  const std::string title = std::string(1, char(name[0] - 'a' + 'A')) + name.substr(1);
  std::string errors;
  std::string shapes;
  for (const std::vector<Row>& group : groups)
  {
    const std::vector<Row> rows = rowsOf(group, name);
    if (rows.empty())
    {
      continue;
    }
    const std::string others = errorTable(rows, name, true);
    errors += settingsOf(rows) + errorTable(rows, name, false) + (others.empty() ? "" : "\n") + others;
    shapes += settingsOf(rows) + shapeTable(rows, name);
  }
  if (errors.empty())
  {
    return "";
  }
  return "\n## " + title + ": " + (object.convex ? "convex" : "concave") + ", genus " +
         std::to_string(object.genus) + "\n" +
         figure(figures, name,
                "Rows: kinds of noise. Columns: exact marching cubes, the best voting, the convex "
                "hull, local hulls. Red is the inner side") +
         prose::Errors + errors + prose::Shapes + shapes;
}

} // namespace

std::string pageOf(const Results& results, const std::filesystem::path& figures)
{
  const std::vector<std::vector<Row>> groups = bySettings(results.cases);
  std::string page = std::string(prose::Opening) + prose::Setting + prose::Measures;
  page += prose::Promises + ofEach(groups, promiseTable);
  page += prose::Targets + ofEach(groups, targetTable);
  for (const Object& object : objects())
  {
    page += objectSection(groups, object, figures);
  }
  page += prose::Times + ofEach(groups, timeTable) + prose::Failures + noteTable(results.cases);
  if (!results.ablation.empty())
  {
    page += prose::Stages + ofEach(bySettings(results.ablation), ablationTable);
  }
  if (!results.scaling.empty())
  {
    page += prose::Scaling + std::string("\n") + scalingTable(results.scaling);
  }
  if (!results.islands.empty())
  {
    page += prose::Islands + ofEach(bySettings(results.islands), islandTable);
  }
  if (!results.votes.empty())
  {
    page += prose::Votes + std::string("\n") + voteCountTable(results.votes);
    page += figure(figures, "figure-6-3", "The four surfaces of the nearest table; red is the inner side");
    page += prose::Generations + std::string("\n") + generationTable(results.votes);
  }
  page += prose::Hulls + figure(figures, "figure-6-4", "Tetrahedra, their boundary and the convex hull");
  return page;
}

void writeReport(const std::filesystem::path& output, const std::filesystem::path& folder)
{
  const Results results{readRows(resultsFile(output)), readRows(ablationFile(output)),
                        readRows(scalingFile(output)), readRows(islandsFile(output)),
                        readVoteTables(votesFile(output))};
  if (results.cases.empty())
  {
    throw InvalidInput("there are no results in " + output.string());
  }
  const std::filesystem::path file = folder / "experiments.md";
  std::ofstream stream(file);
  stream << pageOf(results, folder / "Figures");
  if (!stream)
  {
    throw InvalidInput("cannot write " + file.string());
  }
}

} // namespace silhouette::experiments
