// SPDX-License-Identifier: BSD-3-Clause
// The tables of the ablation, the scaling and the islands.
#include "Markdown.h"
#include "Methods.h"
#include "Promises.h"
#include "Tables.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

namespace silhouette::experiments
{
namespace
{

const char* const Whole = "hulls-robust";
const char* const Strict = "cubes-exact";

const Row* find(const std::vector<Row>& rows, const Row& like, const std::string& method)
{
  Row wanted = like;
  wanted.method = method;
  const auto found =
      std::find_if(rows.begin(), rows.end(), [&](const Row& row) { return sameRun(row, wanted); });
  return found == rows.end() ? nullptr : &*found;
}

/** The least error of voting in the same case; not a number where there is none. */
double bestVoting(const std::vector<Row>& rows, const Row& like)
{
  double least = std::numeric_limits<double>::quiet_NaN();
  for (const char* method : {"consistent-1", "consistent-2", "consistent-3"})
  {
    const Row* row = find(rows, like, method);
    least = row ? std::fmin(least, row->value[Error]) : least; // the number, where one is none
  }
  return least;
}

std::vector<Row> thinOnes(const std::vector<Row>& rows, bool thin)
{
  std::vector<Row> found;
  std::copy_if(rows.begin(), rows.end(), std::back_inserter(found),
               [thin](const Row& row) { return objectNamed(row.at.object).thin == thin; });
  return found;
}

bool isUnder(const Row& row, const Condition& condition)
{
  return row.at.noise == condition.noise && row.at.strength == condition.strength;
}

/** The mean over objects and seeds of the error beside the whole method's; bold where it is a tenth worse. */
std::string timesTheWhole(const std::vector<Row>& rows, const std::string& method, const Condition& condition)
{
  double logarithms = 0.0;
  int count = 0;
  for (const Row& row : rows)
  {
    const Row* whole = row.method == method && isUnder(row, condition) ? find(rows, row, Whole) : nullptr;
    if (whole && row.value[Error] > 0.0 && whole->value[Error] > 0.0)
    {
      logarithms += std::log(row.value[Error] / whole->value[Error]);
      ++count;
    }
  }
  if (count == 0)
  {
    return "";
  }
  const double ratio = std::exp(logarithms / count);
  return ratio >= 1.1 ? "**" + format("%.2f", ratio) + "**" : format("%.2f", ratio);
}

/** The error itself, meant likewise. */
std::string ofTheWhole(const std::vector<Row>& rows, const Condition& condition)
{
  double sum = 0.0;
  int count = 0;
  for (const Row& row : rows)
  {
    if (row.method == Whole && isUnder(row, condition) && !std::isnan(row.value[Error]))
    {
      sum += row.value[Error];
      ++count;
    }
  }
  return count == 0 ? "" : length(sum / count);
}

/** Runs in which something holds. */
template <typename Holds>
std::string count(const std::vector<Row>& rows, const std::string& method, const Holds& holds)
{
  return std::to_string(std::count_if(rows.begin(), rows.end(), [&](const Row& row)
                                      { return row.method == method && row.failure.empty() && holds(row); }));
}

bool breaksPromise(const Row& row)
{
  return std::any_of(promises().begin(), promises().end(),
                     [&](const Promise& promise) { return !promise.kept(row); });
}

/** The ratio and both errors of a depth and a size, over the seeds. */
std::string scalingCell(const std::vector<Row>& rows, const std::string& object, int depth, int size,
                        bool clean)
{
  double ours = 0.0;
  double strict = 0.0;
  for (const Row& row : rows)
  {
    const bool isMeant = row.method == Whole && row.at.object == object && row.settings.depth == depth &&
                         row.settings.size == size && (row.at.noise == CleanName) == clean;
    const Row* other = isMeant ? find(rows, row, Strict) : nullptr;
    if (other && !std::isnan(row.value[Error]) && !std::isnan(other->value[Error]))
    {
      ours += row.value[Error];
      strict += other->value[Error];
    }
  }
  return strict > 0.0 ? format("%.2f", ours / strict) : "";
}

/** Of objects that are all solids or all thin. */
std::string tableOfKind(const std::vector<Row>& rows, const std::string& objects)
{
  const std::vector<Condition> conditions = conditionsOf(rows);
  std::vector<std::string> cells = {objects};
  for (const Condition& condition : conditions)
  {
    cells.push_back(describeNoise(condition.noise, condition.strength));
  }
  cells.insert(cells.end(), {"several pieces", "another genus", "promise broken"});
  std::string text = head(cells);
  const auto counts = [&](const std::string& method)
  {
    cells.push_back(count(rows, method, [](const Row& row) { return row.value[Pieces] > 1; }));
    cells.push_back(count(rows, method, [](const Row& row)
                          { return !(row.value[Genus] == objectNamed(row.at.object).genus); }));
    cells.push_back(count(rows, method, breaksPromise));
  };
  cells = {"all: error, octants"};
  for (const Condition& condition : conditions)
  {
    cells.push_back(ofTheWhole(rows, condition));
  }
  counts(Whole);
  text += line(cells);
  for (const Method& method : ablations())
  {
    cells = {method.label};
    for (const Condition& condition : conditions)
    {
      cells.push_back(timesTheWhole(rows, method.name, condition));
    }
    counts(method.name);
    text += line(cells);
  }
  return text;
}

} // namespace

std::string ablationTable(const std::vector<Row>& rows)
{
  std::string text;
  for (const bool thin : {false, true})
  {
    const std::vector<Row> some = thinOnes(rows, thin);
    std::set<std::string> names;
    for (const Row& row : some)
    {
      names.insert(row.at.object);
    }
    std::string joined;
    for (const std::string& name : names)
    {
      joined += (joined.empty() ? "" : ", ") + name;
    }
    text += some.empty() ? "" : (text.empty() ? "" : "\n") + tableOfKind(some, joined);
  }
  return text;
}

std::string islandTable(const std::vector<Row>& rows)
{
  std::string text = head({"object", "noise", "marching cubes, exact: error", "pieces", "voting, best: error",
                           "local hulls, Robust: error", "pieces", "genus", "dropped: error", "pieces", "genus",
                           "octants given up"});
  for (const Row& row : rows)
  {
    const Row* whole = row.method == Strict ? find(rows, row, Whole) : nullptr;
    const Row* dropped = row.method == Strict ? find(rows, row, WithoutIslands) : nullptr;
    if (whole && dropped)
    {
      const auto number = [](const Row& of, Column column)
      { return std::isnan(of.value[column]) ? std::string() : format("%.0f", of.value[column]); };
      text += line({row.at.object, describeNoise(row.at.noise, row.at.strength), length(row.value[Error]),
                    number(row, Pieces), length(bestVoting(rows, row)), length(whole->value[Error]),
                    number(*whole, Pieces), number(*whole, Genus), length(dropped->value[Error]),
                    number(*dropped, Pieces), number(*dropped, Genus), number(*dropped, Dropped)});
    }
  }
  return text;
}

std::string scalingTable(const std::vector<Row>& rows)
{
  std::set<int> depths;
  std::set<int> sizes;
  for (const Row& row : rows)
  {
    depths.insert(row.settings.depth);
    sizes.insert(row.settings.size);
  }
  std::vector<std::string> cells = {"object and depth"};
  for (const char* noise : {"clean", "noisy"})
  {
    for (const int size : sizes)
    {
      cells.push_back(std::string(noise) + ", " + std::to_string(size) + " px");
    }
  }
  std::string text = head(cells);
  for (const Object& object : objects())
  {
    const bool isRun = std::any_of(rows.begin(), rows.end(),
                                   [&](const Row& row) { return row.at.object == object.name; });
    for (const int depth : isRun ? depths : std::set<int>())
    {
      cells = {std::string(object.name) + ", " + std::to_string(depth)};
      for (const bool clean : {true, false})
      {
        for (const int size : sizes)
        {
          cells.push_back(scalingCell(rows, object.name, depth, size, clean));
        }
      }
      text += line(cells);
    }
  }
  return text;
}

} // namespace silhouette::experiments
