// SPDX-License-Identifier: BSD-3-Clause
#include "Markdown.h"

#include <cmath>
#include <cstdio>

namespace silhouette::experiments
{

std::string format(const char* pattern, double value)
{
  char text[160];
  std::snprintf(text, sizeof text, pattern, value);
  return text;
}

std::string length(double value)
{
  return format(std::abs(value) < 1.0 ? "%.3f" : "%.2f", value);
}

std::string line(const std::vector<std::string>& cells)
{
  std::string text = "|";
  for (const std::string& cell : cells)
  {
    text += " " + cell + " |";
  }
  return text + "\n";
}

std::string head(const std::vector<std::string>& cells)
{
  std::vector<std::string> rule(cells.size(), "---:");
  rule[0] = "---";
  return line(cells) + line(rule);
}

} // namespace silhouette::experiments
