// SPDX-License-Identifier: BSD-3-Clause
#include "StlFileCheck.h"

#include <cstdint>
#include <fstream>
#include <iterator>

namespace silhouette::program
{
namespace
{

constexpr std::size_t HeaderBytes = 84, TriangleBytes = 50; ///< of a binary file

/** Triangles that a binary file says it has. */
std::size_t triangles(const std::string& content)
{
  std::size_t count = 0;
  for (std::size_t at = HeaderBytes; at-- > HeaderBytes - 4;)
  {
    count = count << 8 | static_cast<unsigned char>(content[at]);
  }
  return count;
}

} // namespace

std::string stlFault(const std::filesystem::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  const std::string content{ std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
  const std::string endsTooSoon = "it ends too soon";
  // Binary files may begin with "solid", too; their length tells.
  const bool hasHeader = content.size() >= HeaderBytes;
  if (hasHeader && content.size() >= HeaderBytes + TriangleBytes * triangles(content))
  {
    return {};
  }
  const bool isText = content.compare(0, 5, "solid") == 0 && content.find("facet") != std::string::npos;
  if (isText)
  {
    return content.find("endsolid") != std::string::npos ? "" : endsTooSoon;
  }
  return hasHeader ? endsTooSoon + ": it says that it has " + std::to_string(triangles(content)) + " triangles" : endsTooSoon;
}

} // namespace silhouette::program
