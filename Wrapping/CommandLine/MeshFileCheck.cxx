// SPDX-License-Identifier: BSD-3-Clause
#include "MeshFileCheck.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <map>
#include <sstream>
#include <vector>

namespace silhouette::program
{
namespace
{

constexpr std::size_t MostItems = 0x7fffffff; // VTK's reader counts by int
const char* const EndsTooSoon = "it ends too soon";

std::string contentOf(const std::filesystem::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
}

/** Bytes of a PLY type, 0 for no such type. */
std::size_t sizeOfType(const std::string& type)
{
  static const std::map<std::string, std::size_t> sizes = { { "char", 1 }, { "uchar", 1 }, { "short", 2 }, { "ushort", 2 }, { "int", 4 },
    { "uint", 4 }, { "float", 4 }, { "double", 8 }, { "int8", 1 }, { "uint8", 1 }, { "int16", 2 }, { "uint16", 2 }, { "int32", 4 },
    { "uint32", 4 }, { "float32", 4 }, { "float64", 8 } };
  const auto found = sizes.find(type);
  return found != sizes.end() ? found->second : 0;
}

struct PlyProperty
{
  std::size_t size = 0;      ///< bytes of a value
  std::size_t countSize = 0; ///< bytes of a list's length; 0: no list
};

struct PlyElement
{
  std::string name;
  std::size_t count = 0;
  std::vector<PlyProperty> properties;
};

/** Follows a PLY file to its end. */
class PlyFile
{
public:
  explicit PlyFile(const std::string& content)
    : Content(content)
  {
  }

  std::string fault()
  {
    std::string fault = this->headerFault();
    for (std::size_t n = 0; fault.empty() && n < this->Elements.size(); ++n)
    {
      const PlyElement& element = this->Elements[n];
      const bool isThere = this->IsText ? this->skipText(element) : this->skipBinary(element);
      fault = isThere ? "" : std::string(EndsTooSoon) + ": there are fewer than " + std::to_string(element.count) + " of element " + element.name;
    }
    return fault;
  }

private:
  std::string line()
  {
    const std::size_t end = std::min(this->Content.find('\n', this->At), this->Content.size());
    std::string text = this->Content.substr(this->At, end - this->At);
    this->At = std::min(end + 1, this->Content.size());
    return text;
  }

  std::string headerFault()
  {
    if (this->line().compare(0, 3, "ply") != 0)
    {
      return "it does not begin with 'ply'";
    }
    while (this->At < this->Content.size())
    {
      const std::string text = this->line();
      std::istringstream words(text);
      std::string word;
      words >> word;
      if (word == "end_header")
      {
        return this->HasFormat ? "" : "its header names no format";
      }
      if (!this->understands(word, words))
      {
        return "its header is broken: '" + text.substr(0, 60) + "'";
      }
    }
    return EndsTooSoon;
  }

  bool understands(const std::string& word, std::istringstream& words)
  {
    std::string first, second;
    if (word == "format")
    {
      words >> first;
      this->IsText = first == "ascii";
      this->IsBigEndian = first == "binary_big_endian";
      this->HasFormat = this->IsText || this->IsBigEndian || first == "binary_little_endian";
      return this->HasFormat;
    }
    if (word == "element")
    {
      PlyElement element;
      long long count = -1;
      words >> element.name >> count;
      element.count = std::size_t(count);
      this->Elements.push_back(element);
      return words && count >= 0 && std::size_t(count) <= MostItems;
    }
    if (word == "property")
    {
      words >> first;
      PlyProperty property;
      if (first == "list")
      {
        words >> second >> first;
        property.countSize = sizeOfType(second);
      }
      property.size = sizeOfType(first);
      if (this->Elements.empty() || property.size == 0 || (!second.empty() && property.countSize == 0))
      {
        return false;
      }
      this->Elements.back().properties.push_back(property);
      return true;
    }
    return true; // comments, and whatever readers pass over
  }

  bool skipText(const PlyElement& element)
  {
    for (std::size_t n = 0; n < element.count; ++n)
    {
      if (this->At >= this->Content.size())
      {
        return false;
      }
      std::istringstream words(this->line());
      for (const PlyProperty& property : element.properties)
      {
        double values = 1.0;
        if (property.countSize > 0 && !(words >> values && values >= 0.0))
        {
          return false;
        }
        std::string word;
        for (double value = 0.0; value < values; ++value)
        {
          if (!(words >> word))
          {
            return false;
          }
        }
      }
    }
    return true;
  }

  bool skipBinary(const PlyElement& element)
  {
    const bool isFixed =
      std::none_of(element.properties.begin(), element.properties.end(), [](const PlyProperty& property) { return property.countSize > 0; });
    if (isFixed)
    {
      std::size_t size = 0;
      for (const PlyProperty& property : element.properties)
      {
        size += property.size;
      }
      return this->skip(element.count * size); // at most 2^31 of not many bytes
    }
    for (std::size_t n = 0; n < element.count; ++n)
    {
      for (const PlyProperty& property : element.properties)
      {
        if (property.countSize == 0 ? !this->skip(property.size) : !this->skipList(property))
        {
          return false;
        }
      }
    }
    return true;
  }

  bool skipList(const PlyProperty& property)
  {
    const std::size_t at = this->At;
    if (!this->skip(property.countSize))
    {
      return false;
    }
    std::uint64_t count = 0;
    for (std::size_t n = 0; n < property.countSize && n < sizeof count; ++n)
    {
      const std::size_t byte = this->IsBigEndian ? at + n : at + property.countSize - 1 - n;
      count = count << 8 | static_cast<unsigned char>(this->Content[byte]);
    }
    return count <= MostItems && this->skip(std::size_t(count) * property.size);
  }

  bool skip(std::size_t bytes)
  {
    const bool areThere = bytes <= this->Content.size() - this->At;
    this->At += areThere ? bytes : 0;
    return areThere;
  }

  const std::string& Content;
  std::size_t At = 0;
  bool HasFormat = false;
  bool IsText = false;
  bool IsBigEndian = false;
  std::vector<PlyElement> Elements;
};

/** Triangles that a binary STL file says it has. */
std::uint32_t binaryTriangles(const std::string& content)
{
  std::uint32_t count = 0;
  for (int n = 3; n >= 0; --n)
  {
    count = count << 8 | static_cast<unsigned char>(content[std::size_t(80 + n)]);
  }
  return count;
}

} // namespace

std::string plyFault(const std::filesystem::path& file)
{
  const std::string content = contentOf(file);
  return PlyFile(content).fault();
}

std::string stlFault(const std::filesystem::path& file)
{
  const std::string content = contentOf(file);
  // Binary files may begin with "solid", too; their length tells.
  if (content.size() >= 84 && content.size() >= 84 + std::size_t(50) * binaryTriangles(content))
  {
    return {};
  }
  const bool isText = content.compare(0, 5, "solid") == 0 && content.find("facet") != std::string::npos;
  if (!isText)
  {
    return content.size() < 84 ? EndsTooSoon : std::string(EndsTooSoon) + ": it says that it has " + std::to_string(binaryTriangles(content)) + " triangles";
  }
  return content.find("endsolid") != std::string::npos ? "" : EndsTooSoon;
}

} // namespace silhouette::program
