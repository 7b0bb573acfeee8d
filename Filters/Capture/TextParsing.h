// SPDX-License-Identifier: BSD-3-Clause
/**
 * Text files of numbers, and numbers in text, read alike under every locale.
 */
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace silhouette
{

/** A line that holds something. */
struct TextLine
{
  int number = 0;                  ///< counted from 1, blank lines and comments included
  std::vector<std::string> tokens; ///< never empty
};

/**
 * The lines of a text file, cut at blanks and tabs; a token in double quotes may hold blanks. A `#` at the
 * start of a token (outside quotes) begins a comment; blank lines are left out. Any line ending and a UTF-8
 * byte order mark are accepted. Throws InvalidInput, naming the file: not a regular file, not readable,
 * larger than 64 MiB, not text (a zero byte), a quote that is not closed.
 */
std::vector<TextLine> readTextLines(const std::filesystem::path& file);

/** All bytes of a file. Throws InvalidInput, naming it: not a regular file, not readable, larger than 64 MiB. */
std::string readBytes(const std::filesystem::path& file);

/** All of `text` as a finite number, with a point whatever the locale; a leading `+` is accepted. */
std::optional<double> parseFinite(std::string_view text);

/** All of `text` as a whole number of at least 0. */
std::optional<int> parseCount(std::string_view text);

/** `text` cut at every `separator`, blanks around the pieces removed; empty pieces are kept. */
std::vector<std::string> splitText(std::string_view text, char separator);

/** `text` in single quotes for a message: at most 60 bytes, control characters replaced by `?`. */
std::string inQuotes(std::string_view text);

/** A number as short as it can be written, for messages: 0.08, nan. */
std::string formatNumber(double value);

/** Does `text` end so? */
bool endsWith(std::string_view text, std::string_view ending);

/** `text` with the letters A to Z made small. */
std::string lowerCase(std::string text);

} // namespace silhouette
