// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFileCheck.h"

#include "MessageListener.h"

#include "vtkNew.h"
#include "vtkZLibDataCompressor.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <optional>
#include <vector>

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

/** A number of some bytes, the lowest first; 0 beyond the end. */
std::uint32_t littleEndian(const Bytes& bytes, std::size_t at, int count)
{
  std::uint32_t number = 0;
  for (int n = count - 1; n >= 0 && at + std::size_t(count) <= bytes.size(); --n)
  {
    number = number << 8 | byteAt(bytes, at + std::size_t(n));
  }
  return number;
}

/** The orientation that Exif data tell, which begin as a TIFF file does; 1 where they tell none. */
int exifOrientation(const Bytes& data)
{
  const bool isLittle = data.compare(0, 4, Bytes("II*\0", 4)) == 0;
  if (!isLittle && data.compare(0, 4, Bytes("MM\0*", 4)) != 0)
  {
    return 1;
  }
  const auto number = [&](std::size_t at, int count) -> std::uint32_t
  {
    if (isLittle || at + std::size_t(count) > data.size())
    {
      return littleEndian(data, at, count);
    }
    return count == 4 ? bigEndian(data, at) : byteAt(data, at) << 8 | byteAt(data, at + 1);
  };
  const std::size_t first = number(4, 4);
  constexpr std::uint32_t orientationTag = 0x112;
  for (std::size_t entry = 0; entry < number(first, 2); ++entry)
  {
    const std::size_t at = first + 2 + 12 * entry;
    if (number(at, 2) == orientationTag)
    {
      const std::uint32_t orientation = number(at + 8, 2);
      return orientation >= 1 && orientation <= 8 ? int(orientation) : 1;
    }
  }
  return 1;
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

struct PngHeader
{
  std::uint32_t width = 0, height = 0;
  std::uint32_t depth = 0; ///< bits of a channel
  std::uint32_t colour = 0;
  std::uint32_t methods[3] = {}; ///< of compression, filters, interlacing

  PngHeader(const Bytes& bytes, std::size_t at)
      : width(bigEndian(bytes, at)), height(bigEndian(bytes, at + 4)), depth(byteAt(bytes, at + 8)),
        colour(byteAt(bytes, at + 9)),
        methods{byteAt(bytes, at + 10), byteAt(bytes, at + 11), byteAt(bytes, at + 12)}
  {
  }

  bool isSensible() const
  {
    const bool grey =
        this->colour == 0 && (this->depth == 1 || this->depth == 2 || this->depth == 4 || this->depth == 8 || this->depth == 16);
    const bool palette =
        this->colour == 3 && (this->depth == 1 || this->depth == 2 || this->depth == 4 || this->depth == 8);
    const bool others =
        (this->colour == 2 || this->colour == 4 || this->colour == 6) && (this->depth == 8 || this->depth == 16);
    const std::uint32_t largest = 1000000; // libpng's own limit
    return this->width - 1 < largest && this->height - 1 < largest && this->methods[0] == 0 &&
           this->methods[1] == 0 && this->methods[2] <= 1 && (grey || palette || others);
  }

  /** Bytes of a row of so many pixels, with the one that names its filter. */
  std::size_t rowBytes(std::size_t pixels) const
  {
    const std::size_t channels = this->colour == 2 ? 3 : this->colour == 4 ? 2 : this->colour == 6 ? 4 : 1;
    return 1 + (pixels * channels * this->depth + 7) / 8;
  }
};

/** Rows of the same length that follow each other: an image has one such part, an interlaced one up to seven. */
struct PngRows
{
  std::size_t count, bytes;
};

std::vector<PngRows> rowsOf(const PngHeader& header)
{
  if (header.methods[2] == 0)
  {
    return {{header.height, header.rowBytes(header.width)}};
  }
  static constexpr std::uint32_t passes[7][4] = {{0, 0, 8, 8}, {4, 0, 8, 8}, {0, 4, 4, 8}, {2, 0, 4, 4},
                                                 {0, 2, 2, 4}, {1, 0, 2, 2}, {0, 1, 1, 2}}; // Adam7: first column and row, steps
  std::vector<PngRows> rows;
  for (const auto& [column, row, across, down] : passes)
  {
    if (header.width > column && header.height > row)
    {
      rows.push_back({(header.height - row + down - 1) / down,
                      header.rowBytes((header.width - column + across - 1) / across)});
    }
  }
  return rows;
}

/** What is wrong with an image's compressed rows. */
std::string rowsFault(const PngHeader& header, const Bytes& compressed)
{
  const std::vector<PngRows> rows = rowsOf(header);
  std::size_t size = 0;
  for (const PngRows& part : rows)
  {
    size += part.count * part.bytes;
  }
  constexpr std::size_t most = 1032; // bytes that deflate makes one of
  Bytes pixels;
  if (size / most <= compressed.size())
  {
    pixels.resize(size);
    vtkNew<vtkZLibDataCompressor> zlib;
    const MessageListener quiet({zlib});
    const std::size_t found =
        zlib->Uncompress(reinterpret_cast<const unsigned char*>(compressed.data()), compressed.size(),
                         reinterpret_cast<unsigned char*>(&pixels[0]), size);
    pixels.resize(quiet.heardError() ? 0 : found);
  }
  if (pixels.size() != size)
  {
    return "its compressed pixels are damaged, or not as many as its header says";
  }
  std::size_t at = 0;
  for (const PngRows& part : rows)
  {
    for (std::size_t row = 0; row < part.count; ++row, at += part.bytes)
    {
      if (byteAt(pixels, at) > 4)
      {
        return "a row of its pixels has a filter that there is not";
      }
    }
  }
  return {};
}

/** Follows the chunks of a PNG file. */
class PngChunks
{
public:
  PngChunks(const Bytes& bytes, ImageFileScope scope) : Content(bytes), Scope(scope) {}

  int orientation() const { return this->Orientation; }

  std::string fault()
  {
    for (std::size_t at = 8; this->Content.size() - at >= 12;)
    {
      const std::size_t length = bigEndian(this->Content, at);
      if (this->Content.size() - at - 12 < length)
      {
        return "it ends within a chunk";
      }
      const Bytes type = this->Content.substr(at + 4, 4);
      if (checksum(this->Content, at + 4, at + 8 + length) != bigEndian(this->Content, at + 8 + length))
      {
        return "the checksum of its chunk " + type + " is wrong";
      }
      const std::string fault = this->chunkFault(type, at + 8, length);
      if (!fault.empty() || type == "IEND")
      {
        return fault;
      }
      this->Before = type;
      at += 12 + length;
    }
    return "it ends too soon";
  }

private:
  /** What is wrong with a chunk, whose data begin at `at`. */
  std::string chunkFault(const Bytes& type, std::size_t at, std::size_t length)
  {
    if (!std::all_of(type.begin(), type.end(), [](unsigned char c) { return std::isalpha(c) && c < 128; }))
    {
      return "one of its chunks has no name";
    }
    if (this->Header.has_value() == (type == "IHDR"))
    {
      return "its header is not at its start";
    }
    if (type == "IHDR")
    {
      if (length != 13)
      {
        return "its header has a wrong length";
      }
      this->Header.emplace(this->Content, at);
      return this->Header->isSensible() ? "" : "its header makes no sense";
    }
    if (type == "PLTE")
    {
      return this->paletteFault(length);
    }
    if (type == "IDAT")
    {
      if (this->Before != "IDAT" && !this->Pixels.empty())
      {
        return "its pixels are not in one place";
      }
      this->Pixels.append(this->Content, at, length);
      return {};
    }
    if (type == "eXIf")
    {
      this->Orientation = exifOrientation(this->Content.substr(at, length));
    }
    if (type == "IEND")
    {
      return this->imageFault();
    }
    const bool mayBeIgnored = std::islower(static_cast<unsigned char>(type[0])) != 0;
    return mayBeIgnored ? "" : "its chunk " + type + " is of no known kind";
  }

  std::string paletteFault(std::size_t length)
  {
    const std::size_t most = this->Header->colour == 3 ? std::size_t(3) << this->Header->depth : 3 * 256;
    if (this->Palette || !this->Pixels.empty() || length == 0 || length % 3 != 0 || length > most)
    {
      return "its palette makes no sense, or is not in its place";
    }
    this->Palette = true;
    return {};
  }

  std::string imageFault() const
  {
    if (this->Pixels.empty() || (this->Header->colour == 3 && !this->Palette))
    {
      return "it has no pixels or no palette";
    }
    return this->Scope == ImageFileScope::Whole ? rowsFault(*this->Header, this->Pixels) : std::string();
  }

  const Bytes& Content;
  ImageFileScope Scope;
  std::optional<PngHeader> Header;
  bool Palette = false;
  Bytes Pixels; ///< compressed
  Bytes Before; ///< type of the chunk before
  int Orientation = 1;
};

ImageFileReport inspectJpeg(const Bytes& bytes)
{
  ImageFileReport report;
  // Segments up to the scan; in the scan 0xff is followed by 0, or by a marker.
  std::size_t at = 2;
  while (at + 4 <= bytes.size() && byteAt(bytes, at) == 0xff && byteAt(bytes, at + 1) != 0xda)
  {
    const bool fill = byteAt(bytes, at + 1) == 0xff;
    if (byteAt(bytes, at + 1) == 0xe1 && bytes.compare(at + 4, 6, Bytes("Exif\0\0", 6)) == 0)
    {
      report.orientation = exifOrientation(bytes.substr(at + 10));
    }
    const std::uint32_t marker = byteAt(bytes, at + 1);
    const bool isFrame = marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (isFrame && at + 9 < bytes.size() && byteAt(bytes, at + 9) == 4)
    {
      report.fault = "JPEG of four inks (CMYK); grey and colours are understood";
      return report;
    }
    at += fill ? 1 : 2 + (byteAt(bytes, at + 2) << 8 | byteAt(bytes, at + 3));
  }
  report.fault = at < bytes.size() && bytes.find("\xff\xd9", at) != Bytes::npos ? "" : "it ends too soon";
  return report;
}

std::string bmpFault(const Bytes& bytes)
{
  const bool isOld = littleEndian(bytes, 14, 4) == 12; // a header with sizes of 16 bits
  const std::uint32_t bits = littleEndian(bytes, isOld ? 24 : 28, 2);
  if (bits != 8 && bits != 24)
  {
    return "BMP of " + std::to_string(bits) + " bits a pixel; 8 and 24 are understood";
  }
  if (!isOld && littleEndian(bytes, 30, 4) != 0)
  {
    return "BMP that is compressed";
  }
  const auto width = std::int32_t(littleEndian(bytes, 18, isOld ? 2 : 4));
  const auto height = std::int32_t(littleEndian(bytes, isOld ? 20 : 22, isOld ? 2 : 4)); // negative: the first row is the top
  constexpr std::int32_t largest = 1000000;
  if (width < 1 || width > largest || height == 0 || height < -largest || height > largest)
  {
    return "its header makes no sense";
  }
  const std::size_t row = (std::size_t(width) * bits + 31) / 32 * 4;
  const bool isWhole = littleEndian(bytes, 10, 4) + row * std::size_t(std::abs(height)) <= bytes.size();
  return isWhole ? "" : "it ends too soon";
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
  if (header[2] != 1 && header[2] != 255)
  {
    return "PNM whose white is " + std::to_string(header[2]) + "; 255 and 1 are understood";
  }
  const std::size_t pixels = header[0] * header[1] * (bytes[1] == '6' ? 3 : 1);
  return bytes.size() - at > pixels ? "" : "it ends too soon";
}

} // namespace

ImageFileReport inspectImageFile(const std::filesystem::path& file, ImageFileScope scope)
{
  std::ifstream stream(file, std::ios::binary);
  const Bytes bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  ImageFileReport report;
  if (bytes.compare(0, 8, "\x89PNG\r\n\x1a\n", 8) == 0)
  {
    PngChunks chunks(bytes, scope);
    report.fault = chunks.fault();
    report.orientation = chunks.orientation();
  }
  else if (bytes.compare(0, 3, "\xff\xd8\xff") == 0)
  {
    report = inspectJpeg(bytes);
  }
  else if (bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6')
  {
    report.fault = pnmFault(bytes);
  }
  else if (bytes.compare(0, 2, "BM") == 0)
  {
    report.fault = bmpFault(bytes);
  }
  return report;
}

} // namespace silhouette::modeling
