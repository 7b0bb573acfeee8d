// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a file of OpenCV's FileStorage holds, as a tree: YAML, XML and JSON alike, packed with gzip or not.
 *
 * cv::FileStorage itself is not used: version 4.6 does not come to an end on some files that are none (a bracket too many, a broken
 * !!binary), reads beyond the end of XML that breaks off within a tag, and knows neither JSON's null nor its \u escapes.
 */
#pragma once

#include <filesystem>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

namespace silhouette
{

struct StorageNode
{
  enum class Kind
  {
    Nothing, ///< not there, or null
    Number,
    Text,
    Sequence,
    Map
  };
  Kind kind = Kind::Nothing;
  double number = 0.0; ///< may be infinite or nan: .Inf, .Nan
  std::string text;
  std::vector<std::pair<std::string, StorageNode>> members; ///< of a map with their keys, of a sequence with empty ones

  bool is(Kind other) const { return this->kind == other; }
  /** The first member with the first of these keys that a map has and that is not null; else a node of Kind::Nothing. */
  const StorageNode& find(std::initializer_list<const char*> keys) const;
};

/**
 * Read a file. YAML as OpenCV writes it and as people do by hand, the first document; tags are passed over, keys are texts; aliases and
 * base64 data are not read. XML: elements called `_` are a sequence, other elements a map, and several words a sequence. JSON: with
 * numbers as YAML has them, too (`1.`). Throws InvalidInput, naming file and line: none of the three; what cannot be parsed; more than
 * 64 levels, 2 million values, or 16 MiB of YAML or JSON; what FileBytes.h throws. Cost: linear in the file; at most 1.5 GB, of YAML.
 */
StorageNode readStorageTree(const std::filesystem::path& file);

} // namespace silhouette
