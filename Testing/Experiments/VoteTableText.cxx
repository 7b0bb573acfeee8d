// SPDX-License-Identifier: BSD-3-Clause
#include "Markdown.h"
#include "Tables.h"

#include <cmath>

namespace silhouette::experiments
{
namespace
{

/** A row of the table: one number for each share, of the thesis, of the first table and of the nearest. */
std::string row(const char* name, const std::vector<std::array<VoteCounts, 4>>& columns,
                double (*number)(const VoteCounts&), bool thesisToo = true)
{
  std::string text = "| " + std::string(name) + " |";
  for (std::size_t c = 0; c < columns.size(); ++c)
  {
    for (const VoteCounts& counts : columns[c])
    {
      text += c == 0 && !thesisToo ? "  |" : " " + format("%.0f", number(counts)) + " |";
    }
  }
  return text + "\n";
}

std::string nameOf(const VoteTable& table)
{
  return format("%g octants across, ", table.diameter) + format("noise %g, ", table.noise) + "seed " +
         std::to_string(table.seed);
}

} // namespace

const VoteTable& nearestTable(const std::vector<VoteTable>& tables)
{
  const VoteTable* nearest = &tables.front();
  for (const VoteTable& table : tables)
  {
    nearest = table.distance < nearest->distance ? &table : nearest;
  }
  return *nearest;
}

std::string voteCountTable(const std::vector<VoteTable>& tables)
{
  const VoteTable& nearest = nearestTable(tables);
  std::string text = "| |";
  for (const char* of : {"thesis", "first", "nearest"})
  {
    for (const double share : VoteShares)
    {
      text += " " + std::string(of) + format(", %.0f %% |", 100.0 * share);
    }
  }
  text += "\n| --- |";
  for (int column = 0; column < 12; ++column)
  {
    text += " ---: |";
  }
  const std::vector<std::array<VoteCounts, 4>> columns = {thesisVotes(), tables.front().counts,
                                                          nearest.counts};
  text += "\n" + row("vertices", columns, [](const VoteCounts& c) { return c.vertices; });
  text += row("faces", columns, [](const VoteCounts& c) { return c.faces; });
  text += row("lost octants", columns, [](const VoteCounts& c) { return c.lost(); });
  text += row(
      "of these, no inside corner", columns, [](const VoteCounts& c) { return c.lostNoCorner; }, false);
  text += row(
      "of these, eight inside corners", columns, [](const VoteCounts& c) { return c.lostAllCorners; }, false);
  text +=
      row("half the faces and lost", columns, [](const VoteCounts& c) { return 0.5 * c.faces + c.lost(); });
  return text + "\nFirst: a sphere " + nameOf(tables.front()) + ". Nearest of " +
         std::to_string(tables.size()) + " tried: " + nameOf(nearest) +
         format("; its figures are off the thesis's by a factor of %.2f on average.\n",
                std::exp(nearest.distance));
}

std::string generationTable(const std::vector<VoteTable>& tables)
{
  std::string text = "| intersection octants | 0 | 1 | 2 | 3 | 4 | 5 | 6 | all |\n| --- |";
  for (int column = 0; column < 8; ++column)
  {
    text += " ---: |";
  }
  text += "\n";
  for (const VoteTable* table : {&tables.front(), &nearestTable(tables)})
  {
    text += "| " + nameOf(*table) + " |";
    for (const double count : table->intersections)
    {
      text += format(" %.0f |", count);
    }
    text += format(" %.0f |\n", table->allIntersections());
  }
  return text;
}

} // namespace silhouette::experiments
