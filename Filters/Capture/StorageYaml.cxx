// SPDX-License-Identifier: BSD-3-Clause
#include "StorageYaml.h"

#include "Error.h"
#include "TextParsing.h"

#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <optional>
#include <sstream>

namespace silhouette
{
namespace
{

using Kind = StorageNode::Kind;

constexpr int DeepestLevel = 64;
constexpr std::size_t MostValues = 2'000'000;
constexpr std::size_t MostBytes = std::size_t(16) << 20; // of text: more than 1 GB in yaml-cpp, where it all lies within brackets

/**
 * A copy that yaml-cpp reads as OpenCV and JSON mean it: a blank after the colon of `{ x:1 }`, no directives (`%YAML:1.0` is none), no
 * comments, which JSON of OpenCV begins with two slashes, one \U for the two \u of a surrogate pair, nothing but the first document.
 */
class YamlMender
{
public:
  YamlMender(std::string_view text, const StorageLimits& limits)
    : Bounds(limits)
    , Text(text)
  {
  }

  /** Lines are counted from 1 by yaml-cpp, too: a first line is put before them, which also settles the encoding. */
  std::string mended()
  {
    while (this->At < this->Text.size() && !this->isEnd())
    {
      const char c = this->Text[this->At];
      if (this->isLeftOut())
      {
        this->At = std::min(this->Text.find('\n', this->At), this->Text.size());
      }
      else if ((c == '"' || c == '\'') && (this->IsFresh || (c == '\'' && this->before() == c)))
      {
        this->quoted(c);
      }
      else if (!this->Open.empty() || (this->IsFresh && (c == '[' || c == '{')))
      {
        this->flow(c);
      }
      else
      {
        this->block(c);
      }
    }
    if (!this->Open.empty()) // yaml-cpp would take the first bracket for a key
    {
      this->Bounds.fail(this->Line, "the file ends within brackets");
    }
    return std::move(this->Mended);
  }

private:
  static bool isBlank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  char before() const { return this->At == 0 ? '\n' : this->Text[this->At - 1]; }
  char after() const { return this->At + 1 < this->Text.size() ? this->Text[this->At + 1] : '\n'; }
  bool isAt(std::string_view what) const { return this->Text.substr(this->At, what.size()) == what; }
  bool isBlockLine() const { return this->Open.empty() && this->before() == '\n'; }
  bool isEnd() const { return this->isBlockLine() && (this->isAt("...") || (this->isAt("---") && this->HasContent)); }

  bool isLeftOut() const
  {
    const bool isComment = this->isAt("#") || (this->isAt("//") && !this->Open.empty());
    return (isComment && (this->IsFresh || isBlank(this->before()))) || (this->isAt("%") && this->isBlockLine());
  }

  void put()
  {
    this->Line += this->Text[this->At] == '\n';
    this->Mended += this->Text[this->At++];
  }

  void quoted(char quote)
  {
    const int line = this->Line;
    this->IsFresh = false;
    this->HasContent = true;
    this->put();
    while (this->At < this->Text.size() && this->Text[this->At] != quote)
    {
      quote == '"' && this->isAt("\\") ? this->escape() : this->put();
    }
    if (this->At == this->Text.size()) // yaml-cpp takes a last line for a closed one
    {
      this->Bounds.fail(line, "a quote is not closed");
    }
    this->put();
  }

  /** The number of `\uXXXX` at a place. */
  std::optional<unsigned> unitAt(std::size_t at) const
  {
    const std::string_view escape = this->Text.substr(std::min(at, this->Text.size()), 6);
    unsigned unit = 0;
    const bool isUnit = escape.size() == 6 && escape.substr(0, 2) == "\\u" &&
      std::from_chars(escape.data() + 2, escape.data() + 6, unit, 16).ptr == escape.data() + 6;
    return isUnit ? std::optional(unit) : std::nullopt;
  }

  void escape()
  {
    const std::optional<unsigned> high = this->unitAt(this->At), low = this->unitAt(this->At + 6);
    if (!high || !low || *high >> 10 != 0x36 || *low >> 10 != 0x37)
    {
      this->put();
      this->At < this->Text.size() ? this->put() : void();
      return;
    }
    std::ostringstream code;
    code << std::hex << 0x10000 + ((*high & 0x3FF) << 10 | (*low & 0x3FF));
    this->Mended += "\\U" + std::string(8 - code.str().size(), '0') + code.str();
    this->At += 12;
  }

  /** Within brackets, or at the first of them. Values are counted here, too: yaml-cpp reads to the last bracket before it tells of any. */
  void flow(char c)
  {
    this->HasContent = true;
    if (c == '[' || c == '{' || c == ',')
    {
      this->Bounds.count(this->Line, int(this->Open.size()));
      this->Open += c == ',' ? "" : std::string(1, c);
    }
    else if (c == ']' || c == '}')
    {
      this->Open.pop_back();
    }
    const bool endsKey = c == ':' && this->IsKey;
    this->IsFresh = c == '[' || c == '{' || c == ',' || endsKey || (this->IsFresh && isBlank(c)) || (c == ':' && isBlank(this->after()));
    this->IsKey = !this->Open.empty() && this->Open.back() == '{' && (c == '{' || c == ',' || (this->IsKey && !endsKey));
    this->put();
    this->Mended += endsKey ? " " : "";
  }

  /** Of block collections only what tells where a value may begin: after a dash, a colon, a tag. */
  void block(char c)
  {
    if (this->isBlockLine() && this->isAt("---"))
    {
      this->At += 3;
      return;
    }
    this->HasContent = this->HasContent || !isBlank(c);
    const bool isTag = this->IsFresh && c == '!';
    while (isTag && !isBlank(this->after()))
    {
      this->put();
    }
    const bool isBefore = isBlank(this->after()) && (c == ':' || (this->IsFresh && (c == '-' || c == '?')));
    this->IsFresh = c == '\n' || isTag || isBefore || (this->IsFresh && isBlank(c));
    this->put();
  }

  StorageLimits Bounds; ///< a copy: the values are counted once more when they are kept
  std::string_view Text;
  std::string Mended = "#\n";
  std::string Open; ///< brackets
  std::size_t At = 0;
  int Line = 1;
  bool IsFresh = true;     ///< a value or a key may begin here
  bool IsKey = false;      ///< within braces, before the colon
  bool HasContent = false; ///< of the first document
};

/** The tree from yaml-cpp's events. */
class TreeBuilder final : public YAML::EventHandler
{
public:
  explicit TreeBuilder(StorageLimits& limits)
    : Bounds(limits)
  {
  }

  StorageNode Root;

  void OnDocumentStart(const YAML::Mark& mark) override
  {
    if (this->HasDocument)
    {
      this->Bounds.fail(lineOf(mark), "something follows the value");
    }
    this->HasDocument = true;
  }
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { this->place(mark); }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t) override { this->Bounds.fail(lineOf(mark), "an alias (*) is not read"); }
  void OnSequenceStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override { this->open(mark, Kind::Sequence); }
  void OnSequenceEnd() override { this->Open.pop_back(); }
  void OnMapStart(const YAML::Mark& mark, const std::string&, YAML::anchor_t, YAML::EmitterStyle::value) override { this->open(mark, Kind::Map); }
  void OnMapEnd() override { this->Open.pop_back(); }

  /** yaml-cpp's tags: "?" for a plain word, "!" for quoted and block text. Of others the keys say what they say. */
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t, const std::string& value) override
  {
    static const std::string yaml = "tag:yaml.org,2002:";
    if (tag == yaml + "binary")
    {
      this->Bounds.fail(lineOf(mark), "base64 data (!!binary) is not read; write it as numbers");
    }
    if (value.find('\0') != std::string::npos)
    {
      this->Bounds.fail(lineOf(mark), "text holds a zero byte");
    }
    if (!this->Open.empty() && this->Open.back().node->is(Kind::Map) && !this->Open.back().hasKey)
    {
      this->Open.back().node->members.emplace_back(value, StorageNode());
      this->Open.back().hasKey = true;
      return;
    }
    this->place(mark) = tag == "!" || tag == yaml + "str" ? textNode(value) : wordNode(value);
  }

private:
  struct Level
  {
    StorageNode* node;
    bool hasKey; ///< of a map: the last member lacks its value
  };

  static int lineOf(const YAML::Mark& mark) { return std::max(mark.line, 1); }

  /** Where the next value goes. */
  StorageNode& place(const YAML::Mark& mark)
  {
    this->Bounds.count(lineOf(mark), int(this->Open.size()));
    if (this->Open.empty())
    {
      return this->Root;
    }
    Level& level = this->Open.back();
    if (level.node->is(Kind::Sequence))
    {
      return level.node->members.emplace_back().second;
    }
    if (!level.hasKey)
    {
      this->Bounds.fail(lineOf(mark), "a key is not a text");
    }
    level.hasKey = false;
    return level.node->members.back().second;
  }

  void open(const YAML::Mark& mark, Kind kind)
  {
    StorageNode& node = this->place(mark);
    node.kind = kind;
    this->Open.push_back({ &node, false });
  }

  StorageLimits& Bounds;
  std::vector<Level> Open;
  bool HasDocument = false;
};

} // namespace

void StorageLimits::fail(int line, const std::string& what) const
{
  throw InvalidInput(this->Path.string() + " line " + std::to_string(line) + ": " + what);
}

void StorageLimits::count(int line, int level)
{
  if (level > DeepestLevel)
  {
    this->fail(line, "is nested deeper than 64 levels");
  }
  if (++this->Values > MostValues)
  {
    this->fail(line, "more than 2 million values are too many for a camera file");
  }
}

StorageNode textNode(std::string text)
{
  StorageNode node;
  node.kind = Kind::Text;
  node.text = std::move(text);
  return node;
}

StorageNode wordNode(std::string_view word)
{
  StorageNode node;
  const std::string lower = lowerCase(std::string(word));
  const std::optional<double> number = parseFinite(word);
  if (number || lower == ".nan" || lower == ".inf" || lower == "+.inf" || lower == "-.inf")
  {
    node.kind = Kind::Number;
    node.number = number ? *number : lower == ".nan" ? std::numeric_limits<double>::quiet_NaN() : std::numeric_limits<double>::infinity();
    node.number = lower == "-.inf" ? -node.number : node.number;
  }
  else if (!word.empty() && lower != "null" && lower != "~")
  {
    return textNode(std::string(word));
  }
  return node;
}

StorageNode parseStorageYaml(std::string_view text, StorageLimits& limits)
{
  const auto isControl = [](char c) { return c >= 0 && c < ' ' && c != '\t' && c != '\r' && c != '\n'; };
  const auto control = std::find_if(text.begin(), text.end(), isControl); // one of them ends the file for yaml-cpp
  if (control != text.end())
  {
    limits.fail(1 + int(std::count(text.begin(), control, '\n')), "holds a control character");
  }
  if (text.size() > MostBytes)
  {
    limits.fail(1, "more than 16 MiB are too much for a camera file in YAML or JSON");
  }
  TreeBuilder builder(limits);
  std::istringstream stream(YamlMender(text, limits).mended());
  try
  {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(builder))
    {
    }
  }
  catch (const YAML::Exception& error)
  {
    limits.fail(std::max(error.mark.line, 1), "is no YAML (" + error.msg + ")");
  }
  return std::move(builder.Root);
}

} // namespace silhouette
