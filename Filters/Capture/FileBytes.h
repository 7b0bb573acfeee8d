// SPDX-License-Identifier: BSD-3-Clause
/**
 * Camera files as bytes, packed with gzip or not, and how they begin.
 */
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace silhouette
{

/**
 * All bytes of a file; what is packed with gzip is unpacked. Throws InvalidInput, naming it: not a regular file, not readable,
 * packed and damaged, larger than 64 MiB, unpacked.
 */
std::string readUnpackedBytes(const std::filesystem::path& file);

/** At most the first `count` bytes, unpacked as above; none where the file cannot be read. Never throws InvalidInput. */
std::string fileBeginning(const std::filesystem::path& file, std::size_t count);

/** `text` without a UTF-8 byte order mark and without white space at its start. */
std::string_view withoutLeadingBlanks(std::string_view text);

} // namespace silhouette
