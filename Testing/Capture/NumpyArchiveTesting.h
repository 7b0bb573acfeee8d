// SPDX-License-Identifier: BSD-3-Clause
/** Writes numpy's archives, of every kind that numpy does and of some that it does not. */
#pragma once

#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace silhouette
{

/** `value` in `count` bytes, the least significant first. */
inline std::string littleEndian(std::uint64_t value, int count)
{
  std::string bytes;
  for (int i = 0; i < count; ++i)
  {
    bytes += char(value >> (8 * i) & 0xFF);
  }
  return bytes;
}

/** As numpy's type says: <f8, >f8, <f4, >f4. */
inline std::string encodedNumbers(const std::vector<double>& values, const std::string& type)
{
  std::string bytes;
  for (const double value : values)
  {
    std::uint64_t word = 0;
    const float single = float(value);
    type[2] == '8' ? std::memcpy(&word, &value, 8) : std::memcpy(&word, &single, 4); // on a little-endian machine
    std::string one = littleEndian(word, type[2] - '0');
    if (type[0] == '>')
    {
      std::reverse(one.begin(), one.end());
    }
    bytes += one;
  }
  return bytes;
}

inline std::string npyBytes(const std::string& type, const std::string& order, const std::string& shape, const std::string& data, int version = 1)
{
  const std::string header = "{'descr': '" + type + "', 'fortran_order': " + order + ", 'shape': " + shape + ", }\n";
  return "\x93NUMPY" + std::string(1, char(version)) + std::string(1, '\0') + littleEndian(header.size(), version == 1 ? 2 : 4) + header + data;
}

/** A 4 x 4 matrix, row by row. */
inline std::string npyMatrix(const std::vector<double>& values)
{
  return npyBytes("<f8", "False", "(4, 4)", encodedNumbers(values, "<f8"));
}

struct ZipMember
{
  std::string name;
  std::string bytes;
  bool isDeflated = false;
};

inline std::string deflated(const std::string& bytes)
{
  std::string packed(bytes.size() + 100, '\0');
  z_stream stream = {};
  deflateInit2(&stream, 9, Z_DEFLATED, -MAX_WBITS, 8, Z_DEFAULT_STRATEGY);
  stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  stream.avail_in = uInt(bytes.size());
  stream.next_out = reinterpret_cast<Bytef*>(packed.data());
  stream.avail_out = uInt(packed.size());
  deflate(&stream, Z_FINISH);
  packed.resize(stream.total_out);
  deflateEnd(&stream);
  return packed;
}

/** A zip file. As numpy's, the local headers have an extra field that the directory has not. */
inline std::string zipBytes(const std::vector<ZipMember>& members)
{
  std::string file, directory;
  for (const ZipMember& member : members)
  {
    const std::string packed = member.isDeflated ? deflated(member.bytes) : member.bytes;
    const std::string shared = littleEndian(member.isDeflated ? 8 : 0, 2) + std::string(4, '\0') +
      littleEndian(crc32(0, reinterpret_cast<const Bytef*>(member.bytes.data()), uInt(member.bytes.size())), 4) +
      littleEndian(packed.size(), 4) + littleEndian(member.bytes.size(), 4) + littleEndian(member.name.size(), 2);
    directory += std::string("PK\x01\x02") + littleEndian(20, 2) + littleEndian(20, 2) + littleEndian(0, 2) + shared + std::string(12, '\0') +
      littleEndian(file.size(), 4) + member.name;
    file += std::string("PK\x03\x04") + littleEndian(20, 2) + littleEndian(0, 2) + shared + littleEndian(4, 2) + member.name +
      std::string("\x63\x63\0\0", 4) + packed;
  }
  const std::string end = std::string("PK\x05\x06") + std::string(4, '\0') + littleEndian(members.size(), 2) + littleEndian(members.size(), 2) +
    littleEndian(directory.size(), 4) + littleEndian(file.size(), 4) + littleEndian(0, 2);
  return file + directory + end;
}

} // namespace silhouette
