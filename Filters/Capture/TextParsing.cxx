// SPDX-License-Identifier: BSD-3-Clause
#include "TextParsing.h"

#include "Error.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <fstream>

namespace silhouette
{

namespace
{

constexpr std::uintmax_t LargestTextFile = std::uintmax_t(64) << 20;

bool isBlank(char c)
{
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

/** The tokens of one line; `where` names file and line. */
std::vector<std::string> tokensOf(std::string_view line, const std::string& where)
{
  std::vector<std::string> tokens;
  std::size_t at = 0;
  while (true)
  {
    while (at < line.size() && isBlank(line[at]))
    {
      ++at;
    }
    if (at == line.size() || line[at] == '#')
    {
      return tokens;
    }
    const std::size_t first = at;
    if (line[at] == '"')
    {
      at = line.find('"', first + 1);
      if (at == std::string_view::npos)
      {
        throw InvalidInput(where + ": the quote before " + inQuotes(line.substr(first + 1)) +
                           " is not closed");
      }
      tokens.emplace_back(line.substr(first + 1, at - first - 1));
      ++at;
      continue;
    }
    while (at < line.size() && !isBlank(line[at]))
    {
      ++at;
    }
    tokens.emplace_back(line.substr(first, at - first));
  }
}

} // namespace

std::string readBytes(const std::filesystem::path& file)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
  {
    throw InvalidInput(file.string() + ": there is no such file");
  }
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error)
  {
    throw InvalidInput(file.string() + ": cannot be read (" + error.message() + ")");
  }
  if (size > LargestTextFile)
  {
    throw InvalidInput(file.string() + ": " + std::to_string(size) +
                       " bytes are too many for a camera file (at most 64 MiB)");
  }
  std::ifstream stream(file, std::ios::binary);
  std::string bytes(std::size_t(size), '\0');
  if (!stream || !stream.read(bytes.data(), std::streamsize(size)))
  {
    throw InvalidInput(file.string() + ": cannot be read");
  }
  return bytes;
}

std::vector<TextLine> readTextLines(const std::filesystem::path& file)
{
  const std::string bytes = readBytes(file);
  if (bytes.find('\0') != std::string::npos)
  {
    throw InvalidInput(file.string() + ": not a text file (it holds a zero byte)");
  }
  std::string_view rest = bytes;
  if (rest.substr(0, 3) == "\xEF\xBB\xBF")
  {
    rest.remove_prefix(3);
  }
  std::vector<TextLine> lines;
  for (int number = 1; !rest.empty(); ++number)
  {
    const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
    TextLine line;
    line.number = number;
    line.tokens = tokensOf(rest.substr(0, end), file.string() + " line " + std::to_string(number));
    if (!line.tokens.empty())
    {
      lines.push_back(std::move(line));
    }
    const bool windows = rest.substr(end, 2) == "\r\n";
    rest.remove_prefix(std::min(end + (windows ? 2 : 1), rest.size()));
  }
  return lines;
}

std::optional<double> parseFinite(std::string_view text)
{
  if (text.size() > 1 && text[0] == '+' && text[1] != '-')
  {
    text.remove_prefix(1);
  }
  double value = 0.0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size() || !std::isfinite(value))
  {
    return std::nullopt;
  }
  return value;
}

std::optional<int> parseCount(std::string_view text)
{
  int value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size() || text[0] == '-')
  {
    return std::nullopt;
  }
  return value;
}

std::vector<std::string> splitText(std::string_view text, char separator)
{
  std::vector<std::string> pieces;
  while (true)
  {
    const std::size_t end = std::min(text.find(separator), text.size());
    std::string_view piece = text.substr(0, end);
    while (!piece.empty() && isBlank(piece.front()))
    {
      piece.remove_prefix(1);
    }
    while (!piece.empty() && isBlank(piece.back()))
    {
      piece.remove_suffix(1);
    }
    pieces.emplace_back(piece);
    if (end == text.size())
    {
      return pieces;
    }
    text.remove_prefix(end + 1);
  }
}

std::string inQuotes(std::string_view text)
{
  constexpr std::size_t longest = 60;
  std::string out(text.substr(0, longest));
  for (char& c : out)
  {
    const auto code = static_cast<unsigned char>(c);
    c = code < 0x20 || code == 0x7F ? '?' : c;
  }
  return "'" + out + (text.size() > longest ? "...'" : "'");
}

std::string formatNumber(double value)
{
  if (std::isnan(value))
  {
    return "nan";
  }
  std::array<char, 64> buffer;
  const auto result = std::to_chars(buffer.data(), buffer.data() + buffer.size(), value);
  return std::string(buffer.data(), result.ptr);
}

bool endsWith(std::string_view text, std::string_view ending)
{
  return text.size() >= ending.size() && text.substr(text.size() - ending.size()) == ending;
}

std::string lowerCase(std::string text)
{
  for (char& c : text)
  {
    c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  }
  return text;
}

} // namespace silhouette
