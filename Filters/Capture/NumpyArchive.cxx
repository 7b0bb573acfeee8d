// SPDX-License-Identifier: BSD-3-Clause
#include "NumpyArchive.h"

#include "Error.h"
#include "TextParsing.h"

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

namespace silhouette
{
namespace
{

/** A matrix for each of some cameras has 128 bytes; numpy's header has about as many. */
constexpr std::uint64_t LargestArray = std::uint64_t(64) << 10;

/** Numbers and pieces of a file, never beyond its end. */
struct Bytes
{
  std::string_view bytes;
  std::string where; ///< begins the messages

  std::string_view piece(std::uint64_t offset, std::uint64_t count) const
  {
    if (offset > this->bytes.size() || count > this->bytes.size() - offset)
    {
      throw InvalidInput(this->where + ": is cut off or damaged (" + std::to_string(count) + " bytes at " + std::to_string(offset) +
                         " of " + std::to_string(this->bytes.size()) + ")");
    }
    return this->bytes.substr(std::size_t(offset), std::size_t(count));
  }

  /** Of `count` bytes, the least significant first. */
  std::uint64_t number(std::uint64_t offset, int count) const
  {
    const std::string_view digits = this->piece(offset, std::uint64_t(count));
    std::uint64_t value = 0;
    for (int i = count - 1; i >= 0; --i)
    {
      value = value << 8 | std::uint8_t(digits[std::size_t(i)]);
    }
    return value;
  }
};

/** What the zip file's directory says of a file in it. */
struct Entry
{
  std::string name;
  std::uint64_t flags = 0;
  std::uint64_t method = 0;
  std::uint64_t checksum = 0;
  std::uint64_t packedSize = 0;
  std::uint64_t size = 0;
  std::uint64_t offset = 0;
};

/** Where the record that ends the directory begins: the last one whose comment ends with the file. */
std::uint64_t endOfDirectory(const Bytes& zip)
{
  constexpr std::uint64_t recordSize = 22, longestComment = 65535;
  const std::uint64_t size = zip.bytes.size();
  for (std::uint64_t back = recordSize; back <= size && back <= recordSize + longestComment; ++back)
  {
    const std::uint64_t at = size - back;
    if (zip.piece(at, 4) == "PK\x05\x06" && zip.number(at + 20, 2) == back - recordSize)
    {
      return at;
    }
  }
  throw InvalidInput(zip.where + ": is no zip file, or cut off");
}

std::vector<Entry> readDirectory(const Bytes& zip)
{
  const std::uint64_t end = endOfDirectory(zip);
  const std::uint64_t count = zip.number(end + 10, 2);
  std::uint64_t at = zip.number(end + 16, 4);
  if (count == 0xFFFF || at == 0xFFFFFFFF)
  {
    throw InvalidInput(zip.where + ": is a zip64 file, which is not read");
  }
  std::vector<Entry> entries;
  for (std::uint64_t i = 0; i < count; ++i)
  {
    if (zip.piece(at, 4) != "PK\x01\x02")
    {
      throw InvalidInput(zip.where + ": its directory is damaged at entry " + std::to_string(i));
    }
    Entry entry;
    entry.flags = zip.number(at + 8, 2);
    entry.method = zip.number(at + 10, 2);
    entry.checksum = zip.number(at + 16, 4);
    entry.packedSize = zip.number(at + 20, 4);
    entry.size = zip.number(at + 24, 4);
    entry.offset = zip.number(at + 42, 4);
    const std::uint64_t nameSize = zip.number(at + 28, 2);
    entry.name = zip.piece(at + 46, nameSize);
    at += 46 + nameSize + zip.number(at + 30, 2) + zip.number(at + 32, 2);
    entries.push_back(std::move(entry));
  }
  return entries;
}

/** Exactly `size` bytes, or nothing. */
std::optional<std::string> inflated(std::string_view packed, std::size_t size)
{
  std::string bytes(size + 1, '\0'); // one more: who packed too many is found out
  z_stream stream = {};
  if (inflateInit2(&stream, -MAX_WBITS) != Z_OK)
  {
    return std::nullopt;
  }
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
  stream.avail_in = uInt(packed.size());
  stream.next_out = reinterpret_cast<Bytef*>(bytes.data());
  stream.avail_out = uInt(bytes.size());
  const int result = inflate(&stream, Z_FINISH);
  const bool isWhole = result == Z_STREAM_END && stream.total_out == size;
  inflateEnd(&stream);
  bytes.resize(size);
  return isWhole ? std::optional(std::move(bytes)) : std::nullopt;
}

std::string unpacked(const Bytes& zip, const Entry& entry, const std::string& where)
{
  if (entry.flags & 1)
  {
    throw InvalidInput(where + ": is encrypted");
  }
  if (entry.method != 0 && entry.method != Z_DEFLATED)
  {
    throw InvalidInput(where + ": is packed with method " + std::to_string(entry.method) + "; stored and deflated arrays are read");
  }
  if (entry.size > LargestArray || entry.packedSize > 2 * LargestArray)
  {
    throw InvalidInput(where + ": " + std::to_string(std::max(entry.size, entry.packedSize)) +
                       " bytes are too many for a camera's array (at most 64 KiB)");
  }
  if (zip.piece(entry.offset, 4) != "PK\x03\x04")
  {
    throw InvalidInput(where + ": is not where the directory says");
  }
  const std::uint64_t begin = entry.offset + 30 + zip.number(entry.offset + 26, 2) + zip.number(entry.offset + 28, 2);
  const std::string_view packed = zip.piece(begin, entry.packedSize);
  const std::optional<std::string> bytes =
    entry.method == Z_DEFLATED ? inflated(packed, std::size_t(entry.size)) : std::optional<std::string>(packed);
  if (!bytes || bytes->size() != entry.size || crc32(0, reinterpret_cast<const Bytef*>(bytes->data()), uInt(bytes->size())) != entry.checksum)
  {
    throw InvalidInput(where + ": is damaged");
  }
  return *bytes;
}

/** What follows `'key':` in numpy's header, blanks left out. */
std::string_view valueOf(std::string_view header, const std::string& key, const std::string& where)
{
  const std::size_t at = header.find("'" + key + "':");
  if (at == std::string_view::npos)
  {
    throw InvalidInput(where + ": numpy's header has no " + inQuotes(key));
  }
  header.remove_prefix(at + key.size() + 3);
  header.remove_prefix(std::min(header.find_first_not_of(' '), header.size()));
  return header;
}

std::vector<std::size_t> shapeOf(std::string_view value, const std::string& where)
{
  const std::size_t end = value.find(')');
  std::vector<std::size_t> shape;
  if (value.substr(0, 1) != "(" || end == std::string_view::npos)
  {
    throw InvalidInput(where + ": the shape in numpy's header is no tuple");
  }
  const std::vector<std::string> pieces = splitText(value.substr(1, end - 1), ',');
  for (std::size_t i = 0; i < pieces.size(); ++i)
  {
    if (pieces[i].empty() && i + 1 == pieces.size())
    {
      break; // (4,) and ()
    }
    const std::optional<int> count = pieces[i].empty() ? std::nullopt : parseCount(pieces[i]);
    if (!count)
    {
      throw InvalidInput(where + ": " + inQuotes(pieces[i]) + " in the shape in numpy's header is no whole number");
    }
    shape.push_back(std::size_t(*count));
  }
  return shape;
}

template <typename Float, typename Word> double decoded(std::string_view bytes, bool isBigEndian)
{
  Word word = 0;
  for (std::size_t i = 0; i < sizeof(Word); ++i)
  {
    word = Word(word << 8) | Word(std::uint8_t(bytes[isBigEndian ? i : sizeof(Word) - 1 - i]));
  }
  Float value;
  std::memcpy(&value, &word, sizeof(Float));
  return double(value);
}

/** The values in the order in which the last index runs fastest, from that in which the first one does. */
std::vector<double> fromFortranOrder(const std::vector<double>& values, const std::vector<std::size_t>& shape)
{
  std::vector<double> ordered(values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    std::size_t rest = i, to = 0;
    for (const std::size_t count : shape) // rest % count is the index along this axis
    {
      to = to * count + rest % count;
      rest /= count;
    }
    ordered[to] = values[i];
  }
  return ordered;
}

NumpyArray parseArray(const Bytes& npy)
{
  if (npy.bytes.substr(0, 6) != "\x93NUMPY")
  {
    throw InvalidInput(npy.where + ": is not of numpy's format");
  }
  const bool isFirstVersion = npy.number(6, 1) == 1;
  const std::uint64_t headerSize = npy.number(8, isFirstVersion ? 2 : 4);
  const std::uint64_t headerBegin = isFirstVersion ? 10 : 12;
  const std::string_view header = npy.piece(headerBegin, headerSize);
  const std::string_view data = npy.bytes.substr(std::size_t(headerBegin + headerSize));

  const std::string_view type = valueOf(header, "descr", npy.where).substr(0, 5);
  const bool isDouble = type == "'<f8'" || type == "'>f8'";
  if (!isDouble && type != "'<f4'" && type != "'>f4'")
  {
    throw InvalidInput(npy.where + ": is of the type " + inQuotes(type) + "; float32 and float64 are read");
  }
  const std::size_t size = isDouble ? 8 : 4;
  NumpyArray array;
  array.shape = shapeOf(valueOf(header, "shape", npy.where), npy.where);
  double count = 1.0; // cannot overflow
  for (const std::size_t along : array.shape)
  {
    count *= double(along);
  }
  if (count * double(size) != double(data.size()))
  {
    throw InvalidInput(npy.where + ": the shape asks for " + formatNumber(count) + " numbers, but " + std::to_string(data.size()) +
                       " bytes follow");
  }
  for (std::size_t at = 0; at < data.size(); at += size)
  {
    const std::string_view one = data.substr(at, size);
    array.values.push_back(isDouble ? decoded<double, std::uint64_t>(one, type[1] == '>') : decoded<float, std::uint32_t>(one, type[1] == '>'));
  }
  if (valueOf(header, "fortran_order", npy.where).substr(0, 4) == "True")
  {
    array.values = fromFortranOrder(array.values, array.shape);
  }
  return array;
}

} // namespace

std::map<std::string, NumpyArray> readNumpyArchive(const std::filesystem::path& file, const std::function<bool(const std::string&)>& isWanted)
{
  const std::string bytes = readBytes(file);
  const Bytes zip = { bytes, file.string() };
  std::map<std::string, NumpyArray> arrays;
  for (const Entry& entry : readDirectory(zip))
  {
    const bool hasEnding = entry.name.size() > 4 && entry.name.compare(entry.name.size() - 4, 4, ".npy") == 0;
    const std::string name = hasEnding ? entry.name.substr(0, entry.name.size() - 4) : std::string();
    if (name.empty() || !isWanted(name))
    {
      continue;
    }
    const std::string where = file.string() + " array " + inQuotes(name);
    const std::string npy = unpacked(zip, entry, where);
    if (!arrays.emplace(name, parseArray({ npy, where })).second)
    {
      throw InvalidInput(where + ": occurs twice");
    }
  }
  return arrays;
}

} // namespace silhouette
