// SPDX-License-Identifier: BSD-3-Clause
#include "FileBytes.h"

#include "Error.h"

#include <zlib.h>

#include <algorithm>
#include <memory>

namespace silhouette
{
namespace
{

constexpr std::size_t LargestFile = std::size_t(64) << 20;

using GzipFile = std::unique_ptr<gzFile_s, int (*)(gzFile)>;

/** Reads what is not compressed as it is. */
GzipFile openGzip(const std::filesystem::path& file)
{
  return { gzopen(file.string().c_str(), "rb"), gzclose };
}

/** Appends up to `count` bytes; false where the file is damaged. */
bool readGzip(gzFile from, std::size_t count, std::string& bytes)
{
  constexpr std::size_t piece = std::size_t(1) << 16;
  while (count > 0)
  {
    const std::size_t before = bytes.size();
    bytes.resize(before + std::min(piece, count));
    const int got = gzread(from, &bytes[before], unsigned(bytes.size() - before));
    bytes.resize(before + std::size_t(std::max(got, 0)));
    if (got <= 0)
    {
      int error = Z_OK;
      gzerror(from, &error);
      return got == 0 && (error == Z_OK || error == Z_STREAM_END);
    }
    count -= std::size_t(got);
  }
  return true;
}

} // namespace

std::string readUnpackedBytes(const std::filesystem::path& file)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
  {
    throw InvalidInput(file.string() + ": there is no such file");
  }
  const GzipFile from = openGzip(file);
  std::string bytes;
  if (!from)
  {
    throw InvalidInput(file.string() + ": cannot be read");
  }
  if (!readGzip(from.get(), LargestFile + 1, bytes))
  {
    throw InvalidInput(file.string() + ": its compression is damaged");
  }
  if (bytes.size() > LargestFile)
  {
    throw InvalidInput(file.string() + ": has, unpacked, too many bytes for a camera file (at most 64 MiB)");
  }
  return bytes;
}

std::string fileBeginning(const std::filesystem::path& file, std::size_t count)
{
  std::error_code error;
  std::string bytes;
  if (std::filesystem::is_regular_file(file, error))
  {
    const GzipFile from = openGzip(file);
    if (!from || !readGzip(from.get(), count, bytes))
    {
      return {};
    }
  }
  return bytes;
}

std::string_view withoutLeadingBlanks(std::string_view text)
{
  if (text.substr(0, 3) == "\xEF\xBB\xBF")
  {
    text.remove_prefix(3);
  }
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  text.remove_prefix(std::min(first, text.size()));
  return text;
}

} // namespace silhouette
