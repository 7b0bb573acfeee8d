// SPDX-License-Identifier: BSD-3-Clause
#include "StorageYaml.h"

#include "Error.h"
#include "TextParsing.h"

#include <algorithm>
#include <limits>
#include <optional>

namespace silhouette
{
namespace
{

using Kind = StorageNode::Kind;

constexpr int DeepestLevel = 64;
constexpr std::size_t MostValues = 2'000'000;

void appendUtf8(std::string& text, unsigned code)
{
  if (code < 0x80)
  {
    text += char(code);
    return;
  }
  const int following = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  text += char((0xFF00 >> (following + 1) & 0xFF) | code >> (6 * following));
  for (int i = following - 1; i >= 0; --i)
  {
    text += char(0x80 | (code >> (6 * i) & 0x3F));
  }
}

/** YAML and JSON. A line is what is left of it; a dash and a key are taken off its front, and its indentation grows. */
class YamlReader
{
public:
  YamlReader(std::string_view text, StorageLimits& limits)
    : Bounds(limits)
  {
    for (int number = 1; !text.empty(); ++number)
    {
      const std::size_t end = std::min(text.find('\n'), text.size());
      std::string_view line = text.substr(0, end);
      text.remove_prefix(std::min(end + 1, text.size()));
      line = line.substr(0, line.find_last_not_of(" \t\r") + 1);
      if (line.substr(0, 3) == "..." || (line.substr(0, 3) == "---" && !this->Lines.empty()))
      {
        break; // the first document is the one that counts
      }
      const std::size_t indent = line.find_first_not_of(' ');
      if (indent == std::string_view::npos || line[indent] == '#' || line[0] == '%' || line.substr(0, 3) == "---")
      {
        continue;
      }
      this->Lines.push_back({ line.substr(indent), indent, number });
    }
  }

  StorageNode read()
  {
    StorageNode node = this->block(-1, 0);
    if (this->At < this->Lines.size())
    {
      this->fail("is indented as nothing before it");
    }
    return node;
  }

private:
  struct Line
  {
    std::string_view text;
    std::size_t indent;
    int number;
  };

  [[noreturn]] void fail(const std::string& what) const
  {
    const Line& line = this->Lines[std::min(this->At, this->Lines.size() - 1)];
    this->Bounds.fail(line.number, (line.text.empty() ? "the line's end" : inQuotes(line.text)) + " " + what);
  }

  bool isAt(long indent) const { return this->At < this->Lines.size() && long(this->Lines[this->At].indent) == indent; }
  bool isItem() const
  {
    const std::string_view text = this->Lines[this->At].text;
    return text[0] == '-' && (text.size() == 1 || text[1] == ' ');
  }

  /** Takes `count` characters, and the blanks after them, off the line; leaves it when nothing follows. */
  void take(std::size_t count)
  {
    Line& line = this->Lines[this->At];
    const std::size_t next = std::min(line.text.find_first_not_of(" \t", count), line.text.size());
    line.indent += next;
    line.text.remove_prefix(next);
  }

  /** A comment, or the end of the line. */
  void leaveLine()
  {
    if (!this->Lines[this->At].text.empty() && this->Lines[this->At].text[0] != '#')
    {
      this->fail("follows a value");
    }
    ++this->At;
  }

  /** What lies deeper than `parent`, from the line that is left. */
  StorageNode block(long parent, int level)
  {
    if (this->At >= this->Lines.size() || long(this->Lines[this->At].indent) <= parent)
    {
      return {};
    }
    this->Bounds.count(this->Lines[this->At].number, level);
    const long indent = long(this->Lines[this->At].indent);
    if (this->Lines[this->At].text[0] == '\t')
    {
      this->fail("is indented with a tab");
    }
    if (this->isItem())
    {
      return this->sequence(indent, level);
    }
    return this->keySize() > 0 ? this->map(indent, level) : this->inlineValue(level);
  }

  StorageNode sequence(long indent, int level)
  {
    StorageNode node;
    node.kind = Kind::Sequence;
    while (this->isAt(indent) && this->isItem())
    {
      this->take(1);
      this->skipTags();
      node.members.emplace_back("", this->rest(indent, level + 1));
    }
    return node;
  }

  StorageNode map(long indent, int level)
  {
    StorageNode node;
    node.kind = Kind::Map;
    while (this->isAt(indent) && !this->isItem())
    {
      const std::size_t size = this->keySize();
      if (size == 0)
      {
        this->fail("has no key");
      }
      const std::string_view key = this->Lines[this->At].text.substr(0, size);
      this->take(size + 1);
      this->skipTags();
      // A sequence's dashes may stand below its key's first letter.
      const std::size_t next = this->At + 1;
      const std::string_view left = this->Lines[this->At].text;
      const bool isBelow = (left.empty() || left[0] == '#') && next < this->Lines.size() && long(this->Lines[next].indent) == indent &&
        this->Lines[next].text[0] == '-';
      node.members.emplace_back(withoutQuotes(key), this->rest(isBelow ? indent - 1 : indent, level + 1, true));
    }
    return node;
  }

  /** What follows a dash or a key: on the line, or on the next ones. */
  StorageNode rest(long indent, int level, bool isOfKey = false)
  {
    const std::string_view text = this->Lines[this->At].text;
    if (text.empty() || text[0] == '#')
    {
      ++this->At;
      return this->block(indent, level);
    }
    if (!isOfKey)
    {
      return this->block(indent, level); // "- a: 1" begins a map as deep as a
    }
    this->Bounds.count(this->Lines[this->At].number, level);
    return this->inlineValue(level);
  }

  /** Characters of the key that the line begins with, the colon not counted; 0 where there is none. */
  std::size_t keySize() const
  {
    const std::string_view text = this->Lines[this->At].text;
    std::size_t at = 0;
    if (text[0] == '"' || text[0] == '\'')
    {
      at = text.find(text[0], 1);
      at = at == std::string_view::npos ? 0 : at + 1;
      return at > 0 && at < text.size() && text[at] == ':' ? at : 0;
    }
    if (text[0] == '[' || text[0] == '{' || text[0] == '\t')
    {
      return 0;
    }
    do
    {
      at = text.find(':', at + 1);
    } while (at < text.size() && at + 1 < text.size() && text[at + 1] != ' ');
    return at < text.size() ? at : 0;
  }

  static std::string withoutQuotes(std::string_view key)
  {
    const bool isQuoted = key[0] == '"' || key[0] == '\'';
    return std::string(isQuoted ? key.substr(1, key.size() - 2) : key.substr(0, key.find_last_not_of(' ') + 1));
  }

  /** !!opencv-matrix and its like: the keys say it, too. */
  void skipTags()
  {
    while (!this->Lines[this->At].text.empty() && this->Lines[this->At].text[0] == '!')
    {
      if (this->Lines[this->At].text.substr(0, 8) == "!!binary")
      {
        this->fail("is base64 data, which is not read; write it as numbers");
      }
      this->take(std::min(this->Lines[this->At].text.find(' '), this->Lines[this->At].text.size()));
    }
  }

  /** A value that begins on the line, to the end of its last line. */
  StorageNode inlineValue(int level)
  {
    const std::string_view text = this->Lines[this->At].text;
    if (text[0] == '[' || text[0] == '{' || text[0] == '"' || text[0] == '\'')
    {
      StorageNode node = this->flow(level);
      this->leaveLine();
      return node;
    }
    if (text[0] == '|' || text[0] == '>' || text[0] == '&' || text[0] == '*')
    {
      this->fail("is block text or an anchor, which are not read");
    }
    std::string_view word = text.substr(0, text.find(" #"));
    word = word.substr(0, word.find_last_not_of(' ') + 1);
    ++this->At;
    return wordNode(word);
  }

  /** The next character within brackets, on whichever line. */
  char next()
  {
    const auto isLeft = [this] { // OpenCV begins comments in JSON with two slashes
      const std::string_view text = this->Lines[this->At].text;
      return !text.empty() && text[0] != '#' && text.substr(0, 2) != "//";
    };
    while (!isLeft())
    {
      if (++this->At == this->Lines.size())
      {
        this->fail("ends within brackets");
      }
    }
    this->take(0);
    return this->Lines[this->At].text[0];
  }

  StorageNode flow(int level)
  {
    const char first = this->next();
    this->Bounds.count(this->Lines[this->At].number, level);
    if (first == '"' || first == '\'')
    {
      return textNode(this->quoted());
    }
    if (first == '[' || first == '{')
    {
      return this->flowCollection(first == '{', level);
    }
    const std::string_view text = this->Lines[this->At].text;
    std::string_view word = text.substr(0, text.find_first_of(",]}"));
    if (word.empty())
    {
      this->fail("is no value");
    }
    this->take(word.size());
    word = word.substr(0, word.find_last_not_of(" \t") + 1);
    return wordNode(word);
  }

  StorageNode flowCollection(bool isMap, int level)
  {
    const char close = isMap ? '}' : ']';
    StorageNode node;
    node.kind = isMap ? Kind::Map : Kind::Sequence;
    this->take(1);
    while (this->next() != close)
    {
      std::string key = isMap ? this->flowKey() : std::string();
      this->next();
      this->skipTags();
      node.members.emplace_back(std::move(key), this->flow(level + 1));
      if (this->next() == ',')
      {
        this->take(1);
      }
      else if (this->next() != close)
      {
        this->fail(std::string("is neither a comma nor a ") + close);
      }
    }
    this->take(1);
    return node;
  }

  /** A key within brackets, and its colon. */
  std::string flowKey()
  {
    const char first = this->next();
    const std::string_view text = this->Lines[this->At].text;
    std::string key;
    if (first == '"' || first == '\'')
    {
      key = this->quoted();
    }
    else
    {
      const std::string_view word = text.substr(0, text.find_first_of(":,]}[{"));
      key = std::string(word.substr(0, word.find_last_not_of(' ') + 1));
      this->take(word.size());
    }
    if (this->next() != ':' || key.empty())
    {
      this->fail("is not a key and a colon");
    }
    this->take(1);
    return key;
  }

  /** Text in quotes, on one line. */
  std::string quoted()
  {
    const std::string_view line = this->Lines[this->At].text;
    const char quote = line[0];
    std::string text;
    for (std::size_t at = 1; at < line.size(); ++at)
    {
      const char c = line[at];
      if (c == quote && quote == '\'' && line.substr(at + 1, 1) == "'")
      {
        text += line[++at];
      }
      else if (c == quote)
      {
        this->take(at + 1);
        return text;
      }
      else if (c == '\\' && quote == '"')
      {
        this->unescape(line, ++at, text);
      }
      else
      {
        text += c;
      }
    }
    this->fail("has a quote that is not closed");
  }

  /** Four hexadecimal digits; nothing where these are none. */
  static std::optional<unsigned> hexadecimal(std::string_view digits)
  {
    unsigned code = 0;
    for (const char c : digits)
    {
      const std::size_t digit = std::string_view("0123456789abcdef").find(c >= 'A' && c <= 'F' ? char(c - 'A' + 'a') : c);
      if (digit == std::string_view::npos)
      {
        return std::nullopt;
      }
      code = code * 16 + unsigned(digit);
    }
    return digits.size() == 4 ? std::optional(code) : std::nullopt;
  }

  /** The character after a backslash, `at`, which is left on the escape's last one. */
  void unescape(std::string_view line, std::size_t& at, std::string& text) const
  {
    static constexpr std::string_view letters = "nrtbf", meanings = "\n\r\t\b\f";
    const char c = at < line.size() ? line[at] : '\0';
    if (c != 'u')
    {
      const std::size_t letter = letters.find(c);
      text += letter == std::string_view::npos ? c : meanings[letter];
      return;
    }
    std::optional<unsigned> code = hexadecimal(line.substr(at + 1, 4));
    at += 4;
    if (code && *code >= 0xD800 && *code < 0xDC00 && line.substr(std::min(at + 1, line.size()), 2) == "\\u")
    {
      const std::optional<unsigned> low = hexadecimal(line.substr(std::min(at + 3, line.size()), 4));
      code = low && *low >= 0xDC00 && *low < 0xE000 ? std::optional(0x10000 + ((*code - 0xD800) << 10) + (*low - 0xDC00)) : std::nullopt;
      at += 6;
    }
    if (!code || *code == 0 || (*code >= 0xD800 && *code < 0xE000))
    {
      this->fail("has a \\u that is no character");
    }
    appendUtf8(text, *code);
  }

  StorageLimits& Bounds;
  std::vector<Line> Lines;
  std::size_t At = 0;
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
  return YamlReader(text, limits).read();
}

} // namespace silhouette
