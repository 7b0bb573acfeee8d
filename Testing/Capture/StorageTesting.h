// SPDX-License-Identifier: BSD-3-Clause
/** A storage tree as text. */
#pragma once

#include "StorageTree.h"
#include "TextParsing.h"

namespace silhouette
{

/** In a short form of its own: {a: 1, b: ['x', 2]}. */
inline std::string shown(const StorageNode& node)
{
  using Kind = StorageNode::Kind;
  if (!node.is(Kind::Map) && !node.is(Kind::Sequence))
  {
    return node.is(Kind::Number) ? formatNumber(node.number) : node.is(Kind::Text) ? "'" + node.text + "'" : "nothing";
  }
  std::string text;
  for (const auto& [key, member] : node.members)
  {
    text += (text.empty() ? "" : ", ") + (node.is(Kind::Map) ? key + ": " : "") + shown(member);
  }
  return node.is(Kind::Map) ? "{" + text + "}" : "[" + text + "]";
}

} // namespace silhouette
