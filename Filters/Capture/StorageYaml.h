// SPDX-License-Identifier: BSD-3-Clause
/**
 * The YAML and JSON of StorageTree.h by yaml-cpp, and what its parsers share.
 */
#pragma once

#include "StorageTree.h"

#include <string_view>

namespace silhouette
{

/** Counts what a file makes us keep, and how deep it goes: at most 2 million values, 64 levels. */
class StorageLimits
{
public:
  explicit StorageLimits(std::filesystem::path path)
    : Path(std::move(path))
  {
  }
  /** Throws InvalidInput: the file, the line, and what is wrong. */
  [[noreturn]] void fail(int line, const std::string& what) const;
  /** One more value. Throws InvalidInput beyond the limits. */
  void count(int line, int level);

private:
  std::filesystem::path Path;
  std::size_t Values = 0;
};

StorageNode textNode(std::string text);

/** A plain word: a number, nothing (null), or text. */
StorageNode wordNode(std::string_view word);

/** Parse a text without byte order mark that is not blank. */
StorageNode parseStorageYaml(std::string_view text, StorageLimits& limits);

} // namespace silhouette
