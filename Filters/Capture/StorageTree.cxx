// SPDX-License-Identifier: BSD-3-Clause
#include "StorageTree.h"

#include "Error.h"
#include "FileBytes.h"
#include "StorageYaml.h"

#include <pugixml.hpp>

#include <algorithm>
#include <string_view>

namespace silhouette
{
namespace
{

using Kind = StorageNode::Kind;

/** XML's own entities as what they stand for. */
std::string withoutEntities(std::string_view text)
{
  static constexpr std::pair<std::string_view, char> entities[] = { { "&lt;", '<' }, { "&gt;", '>' }, { "&quot;", '"' }, { "&apos;", '\'' }, { "&amp;", '&' } };
  std::string plain;
  while (!text.empty())
  {
    const auto* const found = std::find_if(std::begin(entities), std::end(entities), [&](const auto& one) { return text.substr(0, one.first.size()) == one.first; });
    plain += found == std::end(entities) ? text[0] : found->second;
    text.remove_prefix(found == std::end(entities) ? 1 : found->first.size());
  }
  return plain;
}

class XmlReader
{
public:
  XmlReader(std::string_view text, StorageLimits& limits)
    : Bounds(limits)
    , Text(text)
  {
    const pugi::xml_parse_result result = this->Document.load_buffer(text.data(), text.size(), Flags);
    if (!result)
    {
      this->Bounds.fail(this->line(result.offset), std::string("is no XML (") + result.description() + ")");
    }
  }

  StorageNode read()
  {
    const pugi::xml_node root = this->Document.document_element();
    if (std::string_view(root.name()) != "opencv_storage")
    {
      this->Bounds.fail(this->line(root.offset_debug()), "the element is <" + std::string(root.name()) + ">, not <opencv_storage>");
    }
    return this->element(root, 0);
  }

private:
  static constexpr unsigned Flags = pugi::parse_default & ~pugi::parse_escapes; // a &quot; does not end text in quotes

  int line(std::ptrdiff_t offset) const
  {
    const auto end = this->Text.begin() + std::clamp<std::ptrdiff_t>(offset, 0, std::ptrdiff_t(this->Text.size()));
    return 1 + int(std::count(this->Text.begin(), end, '\n'));
  }

  void count(const pugi::xml_node& node, int level)
  {
    this->Bounds.count(level > 64 ? this->line(node.offset_debug()) : 1, level); // a line is not cheap to tell
  }

  /** Words, those in quotes with their blanks. */
  void appendWords(std::string_view text, StorageNode& node)
  {
    static constexpr std::string_view blanks = " \t\r\n";
    while (true)
    {
      text.remove_prefix(std::min(text.find_first_not_of(blanks), text.size()));
      if (text.empty())
      {
        return;
      }
      this->Bounds.count(1, 0);
      const bool isQuoted = text[0] == '"';
      const std::size_t end = std::min(isQuoted ? text.find('"', 1) : text.find_first_of(blanks), text.size());
      const std::string word = withoutEntities(text.substr(isQuoted ? 1 : 0, end - (isQuoted ? 1 : 0)));
      node.members.emplace_back("", isQuoted ? textNode(word) : wordNode(word));
      text.remove_prefix(std::min(end + 1, text.size()));
    }
  }

  /** Words and elements `_` are a sequence, one word alone is a value. */
  StorageNode element(const pugi::xml_node& element, int level)
  {
    this->count(element, level);
    StorageNode node;
    for (const pugi::xml_node child : element.children())
    {
      if (child.type() == pugi::node_pcdata || child.type() == pugi::node_cdata)
      {
        this->appendWords(child.value(), node);
      }
      else if (child.type() == pugi::node_element)
      {
        const bool isItem = std::string_view(child.name()) == "_";
        node.kind = isItem ? Kind::Sequence : Kind::Map;
        node.members.emplace_back(isItem ? "" : child.name(), this->element(child, level + 1));
      }
    }
    if (node.is(Kind::Nothing) && node.members.size() == 1)
    {
      return StorageNode(node.members[0].second);
    }
    node.kind = node.is(Kind::Nothing) && !node.members.empty() ? Kind::Sequence : node.kind;
    return node;
  }

  StorageLimits& Bounds;
  std::string_view Text;
  pugi::xml_document Document;
};

} // namespace

const StorageNode& StorageNode::find(std::initializer_list<const char*> keys) const
{
  static const StorageNode nothing;
  for (const char* key : keys)
  {
    for (const auto& [name, member] : this->members)
    {
      if (this->kind == Kind::Map && name == key && !member.is(Kind::Nothing))
      {
        return member;
      }
    }
  }
  return nothing;
}

StorageNode readStorageTree(const std::filesystem::path& file)
{
  const std::string bytes = readUnpackedBytes(file);
  if (bytes.find('\0') != std::string::npos)
  {
    throw InvalidInput(file.string() + ": not a text file (it holds a zero byte)");
  }
  std::string_view text = bytes;
  if (text.substr(0, 3) == "\xEF\xBB\xBF")
  {
    text.remove_prefix(3);
  }
  const std::string_view first = withoutLeadingBlanks(text);
  if (first.empty())
  {
    throw InvalidInput(file.string() + ": is empty");
  }
  StorageLimits limits(file);
  return first[0] == '<' ? XmlReader(text, limits).read() : parseStorageYaml(text, limits);
}

} // namespace silhouette
