// SPDX-License-Identifier: BSD-3-Clause
#include "Tables.h"

#include "Markdown.h"
#include "Methods.h"
#include "Promises.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace silhouette::experiments
{
namespace
{

const char* const Ours = "hulls-robust";
const char* const Strict = "cubes-exact";

std::string meanAndSpread(const Summary& summary)
{
  if (summary.runs == 0)
  {
    return summary.failures > 0 ? "none" : "";
  }
  return length(summary.mean) + (summary.runs > 1 ? " ± " + length(summary.deviation) : "");
}

bool isOf(const Row& row, const std::string& object, const Condition& condition)
{
  return (object.empty() || row.at.object == object) && row.at.noise == condition.noise &&
         row.at.strength == condition.strength;
}

std::vector<std::string> objectsOf(const std::vector<Row>& rows)
{
  std::vector<std::string> names;
  for (const Object& object : objects())
  {
    if (std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return row.at.object == object.name; }))
    {
      names.push_back(object.name);
    }
  }
  return names;
}

/** The error of `method` beside that of strict marching cubes in the same runs. */
std::vector<double> ratios(const std::vector<Row>& rows, const std::string& object,
                           const Condition& condition, const std::string& method)
{
  std::map<std::pair<std::string, std::uint64_t>, double> strict;
  for (const Row& row : rows)
  {
    if (isOf(row, object, condition) && row.method == Strict && row.value[Error] > 0.0)
    {
      strict[{row.at.object, row.at.seed}] = row.value[Error];
    }
  }
  std::vector<double> result;
  for (const Row& row : rows)
  {
    const auto found = strict.find({row.at.object, row.at.seed});
    if (isOf(row, object, condition) && row.method == method && found != strict.end() &&
        !std::isnan(row.value[Error]))
    {
      result.push_back(row.value[Error] / found->second);
    }
  }
  return result;
}

double mean(const std::vector<double>& values)
{
  double sum = 0.0;
  for (const double value : values)
  {
    sum += value;
  }
  return values.empty() ? std::nan("") : sum / double(values.size());
}

/** What the local hulls are to reach. */
struct Target
{
  Condition condition;
  bool ofClean; ///< a ratio to the method's own clean error; else to marching cubes' of the same run
  double reach;
};

const std::vector<Target>& targets()
{
  static const std::vector<Target> table = {{{"contour", 2.0}, false, 0.63}, {{"contour", 4.0}, false, 0.48},
                                            {{"contour", 8.0}, false, 0.35}, {{"camera", 2.0}, false, 0.55},
                                            {{"camera", 4.0}, false, 0.43},  {{"blobs", 1.0}, true, 1.2},
                                            {{"blobs", 2.0}, true, 1.2},     {{"blobs", 3.0}, true, 1.2}};
  return table;
}

double reached(const Target& target, const std::vector<Row>& rows, const std::string& object)
{
  if (!target.ofClean)
  {
    return mean(ratios(rows, object, target.condition, Ours));
  }
  const Summary clean = summarize(rows, object, {CleanName, 0.0}, Ours, Error);
  const Summary noisy = summarize(rows, object, target.condition, Ours, Error);
  return clean.runs > 0 && noisy.runs > 0 ? noisy.mean / clean.mean : std::nan("");
}

std::string ratioCell(double value, double reach)
{
  return std::isnan(value) ? ""
         : value <= reach  ? "**" + format("%.2f", value) + "**"
                           : format("%.2f", value);
}

std::string integer(double value)
{
  return std::isnan(value) ? "" : format("%.0f", value);
}

std::string range(const std::vector<Row>& rows, const std::string& object, const Condition& condition,
                  const std::string& method, Column column)
{
  double least = std::numeric_limits<double>::infinity();
  double most = -least;
  for (const Row& row : rows)
  {
    if (isOf(row, object, condition) && row.method == method && !std::isnan(row.value[column]))
    {
      least = std::min(least, row.value[column]);
      most = std::max(most, row.value[column]);
    }
  }
  return most < least ? "" : least == most ? integer(least) : integer(least) + " to " + integer(most);
}

} // namespace

std::vector<Condition> conditionsOf(const std::vector<Row>& rows)
{
  std::vector<Condition> all = {{CleanName, 0.0}};
  for (const Noise& noise : noises())
  {
    for (const double strength : noise.strengths)
    {
      all.push_back({noise.name, strength});
    }
  }
  std::vector<Condition> there;
  for (const Condition& condition : all)
  {
    if (std::any_of(rows.begin(), rows.end(), [&](const Row& row) { return isOf(row, "", condition); }))
    {
      there.push_back(condition);
    }
  }
  return there;
}

Summary summarize(const std::vector<Row>& rows, const std::string& object, const Condition& condition,
                  const std::string& method, Column column)
{
  std::vector<double> values;
  Summary summary;
  for (const Row& row : rows)
  {
    if (isOf(row, object, condition) && row.method == method)
    {
      summary.failures += row.failure.empty() ? 0 : 1;
      if (!std::isnan(row.value[column]))
      {
        values.push_back(row.value[column]);
      }
    }
  }
  summary.runs = values.size();
  summary.mean = mean(values);
  double squares = 0.0;
  for (const double value : values)
  {
    squares += (value - summary.mean) * (value - summary.mean);
  }
  summary.deviation = values.size() > 1 ? std::sqrt(squares / double(values.size() - 1)) : 0.0;
  return summary;
}

std::string bestOfAll(const std::vector<Row>& rows, const std::string& object, const Condition& condition)
{
  std::string best;
  double least = std::numeric_limits<double>::infinity();
  for (const Method& method : methods())
  {
    const Summary summary = summarize(rows, object, condition, method.name, Error);
    if (summary.runs > 0 && summary.mean < least)
    {
      least = summary.mean;
      best = method.name;
    }
  }
  return best;
}

std::string bestOf(int family, const std::vector<Row>& rows, const std::string& object,
                   const Condition& condition)
{
  std::string best;
  double least = std::numeric_limits<double>::infinity();
  for (const Method& method : methods())
  {
    const Summary summary = summarize(rows, object, condition, method.name, Error);
    if (int(method.family) == family && summary.runs > 0 && summary.mean < least)
    {
      least = summary.mean;
      best = method.name;
    }
  }
  return best;
}

std::string errorTable(const std::vector<Row>& rows, const std::string& object, bool firstSeedOnly)
{
  std::vector<const Method*> shown;
  std::vector<std::string> cells = {"noise"};
  for (const Method& method : methods())
  {
    const bool isRun = std::any_of(rows.begin(), rows.end(), [&](const Row& row)
                                   { return row.at.object == object && row.method == method.name; });
    if (method.firstSeedOnly == firstSeedOnly && isRun)
    {
      shown.push_back(&method);
      cells.push_back(method.label);
    }
  }
  std::string text = shown.empty() ? "" : head(cells);
  for (const Condition& condition : shown.empty() ? std::vector<Condition>() : conditionsOf(rows))
  {
    const std::string best = bestOfAll(rows, object, condition);
    cells = {describeNoise(condition.noise, condition.strength)};
    for (const Method* method : shown)
    {
      const std::string cell = meanAndSpread(summarize(rows, object, condition, method->name, Error));
      cells.push_back(method->name == best ? "**" + cell + "**" : cell);
    }
    text += line(cells);
  }
  return text;
}

std::string shapeTable(const std::vector<Row>& rows, const std::string& object)
{
  std::string text = head({"noise", "method", "faces", "open edges", "self-intersections", "lost", "pieces",
                           "genus", "largest error", "error to the solid", "XOR, %"});
  for (const Condition& condition : conditionsOf(rows))
  {
    const std::string voting = bestOf(int(Family::Consistent), rows, object, condition);
    const std::string open = bestOf(int(Family::Faithful), rows, object, condition);
    for (const std::string& method :
         {std::string(Strict), open, voting, std::string("hulls-thesis"), std::string(Ours)})
    {
      if (method.empty() || summarize(rows, object, condition, method, Faces).runs == 0)
      {
        continue;
      }
      const auto whole = [&](Column column) { return range(rows, object, condition, method, column); };
      const auto exact = [&](Column column) { return summarize(rows, object, condition, method, column); };
      const Summary share = exact(XorShare);
      text += line({describeNoise(condition.noise, condition.strength), methodNamed(method).label,
                    whole(Faces), whole(OpenEdges), whole(SelfIntersections), whole(Lost), whole(Pieces),
                    whole(Genus), meanAndSpread(exact(Largest)), meanAndSpread(exact(SolidError)),
                    share.runs > 0 ? format("%.2f", 100.0 * share.mean) : ""});
    }
  }
  return text;
}

std::string promiseTable(const std::vector<Row>& rows)
{
  std::vector<std::string> names = {"method", "runs", "without a surface"};
  for (const Promise& promise : promises())
  {
    names.push_back(promise.broken);
  }
  std::string text = head(names);
  for (const Method& method : methods())
  {
    std::size_t runs = 0;
    std::size_t failures = 0;
    std::vector<std::size_t> broken(promises().size(), 0);
    for (const Row& row : rows)
    {
      runs += row.method == method.name ? 1 : 0;
      failures += row.method == method.name && !row.failure.empty() ? 1 : 0;
      for (std::size_t p = 0; row.method == method.name && row.failure.empty() && p < broken.size(); ++p)
      {
        broken[p] += promises()[p].kept(row) ? 0 : 1;
      }
    }
    std::vector<std::string> cells = {method.label, std::to_string(runs), std::to_string(failures)};
    for (const std::size_t count : broken)
    {
      cells.push_back(std::to_string(count));
    }
    text += runs > 0 ? line(cells) : "";
  }
  return text;
}

std::string targetTable(const std::vector<Row>& rows)
{
  const std::vector<std::string> names = objectsOf(rows);
  std::vector<std::string> cells = {"noise", "reach"};
  cells.insert(cells.end(), names.begin(), names.end());
  cells.push_back("all but the twig");
  std::string text = head(cells);
  for (const Target& target : targets())
  {
    cells = {describeNoise(target.condition.noise, target.condition.strength) +
                 (target.ofClean ? ", to its own clean error" : ""),
             format("%.2f", target.reach)};
    std::vector<double> solids;
    for (const std::string& name : names)
    {
      const double value = reached(target, rows, name);
      cells.push_back(ratioCell(value, target.reach));
      if (!objectNamed(name).thin && !std::isnan(value))
      {
        solids.push_back(value);
      }
    }
    cells.push_back(ratioCell(mean(solids), target.reach));
    text += line(cells);
  }
  cells = {"clean, minus marching cubes", "0.002"};
  for (const std::string& name : names)
  {
    const Summary ours = summarize(rows, name, {CleanName, 0.0}, Ours, Error);
    const Summary strict = summarize(rows, name, {CleanName, 0.0}, Strict, Error);
    const double value = ours.mean - strict.mean;
    const std::string number = format("%+.3f", value);
    cells.push_back(ours.runs * strict.runs == 0 ? "" : value <= 0.002 ? "**" + number + "**" : number);
  }
  cells.push_back("");
  return text + line(cells);
}

std::string timeTable(const std::vector<Row>& rows)
{
  const std::vector<std::string> names = objectsOf(rows);
  std::vector<std::string> cells = {"method"};
  cells.insert(cells.end(), names.begin(), names.end());
  std::string text = head(cells);
  for (const Method& method : methods())
  {
    cells = {method.label};
    for (const std::string& name : names)
    {
      std::vector<double> values;
      for (const Row& row : rows)
      {
        if (row.at.object == name && row.method == method.name && !std::isnan(row.value[TimeRatio]))
        {
          values.push_back(row.value[TimeRatio]);
        }
      }
      std::sort(values.begin(), values.end());
      cells.push_back(values.empty() ? "" : format("%.1f", values[values.size() / 2]));
    }
    text += line(cells);
  }
  return text;
}

std::string noteTable(const std::vector<Row>& rows)
{
  std::map<std::string, std::set<std::string>> cases;
  for (const Row& row : rows)
  {
    if (!row.failure.empty())
    {
      cases[methodNamed(row.method).label + ": " + row.failure].insert(
          row.at.object + ", " + describeNoise(row.at.noise, row.at.strength));
    }
  }
  std::string text;
  for (const auto& [failure, where] : cases)
  {
    text += "- " + failure + " (" + *where.begin() +
            (where.size() > 1 ? " and " + std::to_string(where.size() - 1) + " more" : "") + ")\n";
  }
  return text.empty() ? "Every run has a surface.\n" : text;
}

} // namespace silhouette::experiments
