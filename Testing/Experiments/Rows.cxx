// SPDX-License-Identifier: BSD-3-Clause
#include "Rows.h"

#include "Error.h"

#include <cmath>
#include <cstdio>
#include <fstream>
#include <sstream>

namespace silhouette::experiments
{
namespace
{

const char* const Keys = "object,noise,strength,seed,method,depth,size,views,";

std::string head()
{
  std::string text = Keys;
  for (const char* name : ColumnNames)
  {
    text += std::string(name) + ",";
  }
  return text + "note,failure";
}

std::string number(double value)
{
  if (std::isnan(value))
  {
    return "";
  }
  char text[32];
  std::snprintf(text, sizeof text, "%.9g", value);
  return text;
}

/** Free text without what separates fields. */
std::string plain(std::string text)
{
  for (char& c : text)
  {
    c = c == ',' ? ';' : c == '\n' || c == '\r' || c == '"' ? ' ' : c;
  }
  return text;
}

Row parseRow(const std::string& line)
{
  std::vector<std::string> fields;
  std::istringstream stream(line + ",");
  for (std::string field; std::getline(stream, field, ',');)
  {
    fields.push_back(field);
  }
  if (fields.size() != ColumnCount + 10)
  {
    throw InvalidInput("a row of results has " + std::to_string(fields.size()) + " fields: " + line);
  }
  Row row;
  row.at = {fields[0], fields[1], std::stod(fields[2]), std::stoull(fields[3])};
  row.method = fields[4];
  row.settings.depth = std::stoi(fields[5]);
  row.settings.size = std::stoi(fields[6]);
  row.settings.views = std::stoi(fields[7]);
  for (std::size_t c = 0; c < ColumnCount; ++c)
  {
    if (!fields[8 + c].empty())
    {
      row.value[c] = std::stod(fields[8 + c]);
    }
  }
  row.note = fields[8 + ColumnCount];
  row.failure = fields[9 + ColumnCount];
  return row;
}

} // namespace

const std::array<const char*, ColumnCount> ColumnNames = {"faces",
                                                          "open_edges",
                                                          "non_manifold_edges",
                                                          "non_manifold_vertices",
                                                          "inconsistent_edges",
                                                          "self_intersections",
                                                          "pieces",
                                                          "survivor_pieces",
                                                          "genus",
                                                          "lost_octants",
                                                          "dropped_octants",
                                                          "error",
                                                          "error_to_reference",
                                                          "error_from_reference",
                                                          "largest_error",
                                                          "error_to_solid",
                                                          "xor_share",
                                                          "volume",
                                                          "seconds",
                                                          "time_ratio"};

bool sameRun(const Row& a, const Row& b)
{
  return a.at.object == b.at.object && a.at.noise == b.at.noise && a.at.strength == b.at.strength &&
         a.at.seed == b.at.seed && a.method == b.method && a.settings.depth == b.settings.depth &&
         a.settings.size == b.settings.size && a.settings.views == b.settings.views;
}

std::vector<Row> readRows(const std::filesystem::path& file)
{
  std::vector<Row> rows;
  std::ifstream stream(file);
  std::string line;
  if (std::getline(stream, line) && line != head())
  {
    throw InvalidInput(file.string() + " has not the columns of this program's results");
  }
  while (std::getline(stream, line))
  {
    rows.push_back(parseRow(line));
  }
  return rows;
}

void appendRow(const std::filesystem::path& file, const Row& row)
{
  const bool isNew = !std::filesystem::exists(file);
  std::ofstream stream(file, std::ios::app);
  if (isNew)
  {
    stream << head() << "\n";
  }
  stream << row.at.object << ',' << row.at.noise << ',' << number(row.at.strength) << ',' << row.at.seed
         << ',' << row.method << ',' << row.settings.depth << ',' << row.settings.size << ','
         << row.settings.views << ',';
  for (const double value : row.value)
  {
    stream << number(value) << ',';
  }
  stream << plain(row.note) << ',' << plain(row.failure) << "\n";
  stream.flush();
  if (!stream)
  {
    throw InvalidInput("cannot write " + file.string());
  }
}

} // namespace silhouette::experiments
