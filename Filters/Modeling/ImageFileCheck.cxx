// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFileCheck.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <fstream>
#include <iterator>

namespace silhouette::modeling
{
namespace
{

using Bytes = std::string;

std::uint32_t byteAt(const Bytes& bytes, std::size_t at)
{
  return static_cast<unsigned char>(bytes[at]);
}

std::uint32_t bigEndian(const Bytes& bytes, std::size_t at)
{
  return byteAt(bytes, at) << 24 | byteAt(bytes, at + 1) << 16 | byteAt(bytes, at + 2) << 8 |
         byteAt(bytes, at + 3);
}

/** The checksum of PNG's chunks: CRC-32 with the reflected polynomial 0xedb88320. */
std::uint32_t checksum(const Bytes& bytes, std::size_t first, std::size_t last)
{
  static const std::array<std::uint32_t, 256> table = []
  {
    std::array<std::uint32_t, 256> values{};
    for (std::uint32_t n = 0; n < 256; ++n)
    {
      values[n] = n;
      for (int bit = 0; bit < 8; ++bit)
      {
        values[n] = values[n] & 1 ? values[n] >> 1 ^ 0xedb88320u : values[n] >> 1;
      }
    }
    return values;
  }();
  std::uint32_t sum = 0xffffffffu;
  for (std::size_t i = first; i < last; ++i)
  {
    sum = table[(sum ^ byteAt(bytes, i)) & 0xff] ^ sum >> 8;
  }
  return ~sum;
}

/** Width, height, bit depth and colour type of a header chunk that starts at `at`. */
std::string headerFault(const Bytes& bytes, std::size_t at, std::size_t length)
{
  if (length != 13)
  {
    return "its header has a wrong length";
  }
  const std::uint32_t depth = byteAt(bytes, at + 8), colour = byteAt(bytes, at + 9);
  const bool grey = colour == 0 && (depth == 1 || depth == 2 || depth == 4 || depth == 8 || depth == 16);
  const bool palette = colour == 3 && (depth == 1 || depth == 2 || depth == 4 || depth == 8);
  const bool others = (colour == 2 || colour == 4 || colour == 6) && (depth == 8 || depth == 16);
  const std::uint32_t largest = 1u << 20;
  const bool size = bigEndian(bytes, at) - 1 < largest && bigEndian(bytes, at + 4) - 1 < largest;
  const bool methods =
      byteAt(bytes, at + 10) == 0 && byteAt(bytes, at + 11) == 0 && byteAt(bytes, at + 12) <= 1;
  return size && methods && (grey || palette || others) ? "" : "its header makes no sense";
}

std::string pngFault(const Bytes& bytes)
{
  bool palette = false, pixels = false;
  std::uint32_t colour = 0;
  for (std::size_t at = 8; bytes.size() - at >= 12;)
  {
    const std::size_t length = bigEndian(bytes, at);
    const Bytes type = bytes.substr(at + 4, 4);
    if (bytes.size() - at - 12 < length)
    {
      return "it ends within a chunk";
    }
    if (checksum(bytes, at + 4, at + 8 + length) != bigEndian(bytes, at + 8 + length))
    {
      return "the checksum of its chunk " + type + " is wrong";
    }
    if ((at == 8) != (type == "IHDR"))
    {
      return "its header is not at its start";
    }
    if (type == "IHDR")
    {
      const std::string fault = headerFault(bytes, at + 8, length);
      if (!fault.empty())
      {
        return fault;
      }
      colour = byteAt(bytes, at + 17);
    }
    palette |= type == "PLTE";
    pixels |= type == "IDAT";
    if (type == "IEND")
    {
      return pixels && (palette || colour != 3) ? "" : "it has no pixels or no palette";
    }
    at += 12 + length;
  }
  return "it ends too soon";
}

std::string jpegFault(const Bytes& bytes)
{
  // Segments up to the scan; in the scan 0xff is followed by 0, or by a marker.
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && byteAt(bytes, at) == 0xff && byteAt(bytes, at + 1) != 0xda)
  {
    const bool fill = byteAt(bytes, at + 1) == 0xff;
    at += fill ? 1 : 2 + (byteAt(bytes, at + 2) << 8 | byteAt(bytes, at + 3));
  }
  return at < bytes.size() && bytes.find("\xff\xd9", at) != Bytes::npos ? "" : "it ends too soon";
}

std::string pnmFault(const Bytes& bytes)
{
  if (bytes[1] != '5' && bytes[1] != '6')
  {
    return "PNM of kind P" + bytes.substr(1, 1) + "; P5 and P6 are understood";
  }
  std::array<std::size_t, 3> header{}; // width, height, greatest value
  std::size_t at = 2;
  for (std::size_t& number : header)
  {
    while (at < bytes.size() && (std::isspace(static_cast<unsigned char>(bytes[at])) || bytes[at] == '#'))
    {
      at = bytes[at] == '#' ? std::min(bytes.find('\n', at), bytes.size()) : at + 1;
    }
    for (; at < bytes.size() && bytes[at] >= '0' && bytes[at] <= '9' && number < 100000000; ++at)
    {
      number = 10 * number + std::size_t(bytes[at] - '0');
    }
    if (number == 0)
    {
      return "its header is broken";
    }
  }
  if (header[2] > 255)
  {
    return "PNM of more than 8 bits";
  }
  const std::size_t pixels = header[0] * header[1] * (bytes[1] == '6' ? 3 : 1);
  return bytes.size() - at > pixels ? "" : "it ends too soon";
}

} // namespace

std::string imageFileFault(const std::filesystem::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  const Bytes bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (bytes.compare(0, 8, "\x89PNG\r\n\x1a\n", 8) == 0)
  {
    return pngFault(bytes);
  }
  if (bytes.compare(0, 3, "\xff\xd8\xff") == 0)
  {
    return jpegFault(bytes);
  }
  if (bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6')
  {
    return pnmFault(bytes);
  }
  return {};
}

} // namespace silhouette::modeling
