// SPDX-License-Identifier: BSD-3-Clause
#include "TextParsing.h"

#include "CaptureTesting.h"

#include <clocale>
#include <limits>
#include <locale>

using namespace silhouette;

namespace
{

std::vector<std::vector<std::string>> tokensOf(const std::string& bytes)
{
  const TemporaryFolder folder;
  std::vector<std::vector<std::string>> tokens;
  for (const TextLine& line : readTextLines(folder.write("a.txt", bytes)))
  {
    tokens.push_back(line.tokens);
  }
  return tokens;
}

} // namespace

TEST(TextParsing, LinesAreTheSameUnderEveryEnding)
{
  const std::vector<std::vector<std::string>> expected = {{"a.png", "1", "2"}, {"b.png", "3"}};
  EXPECT_EQ(tokensOf("a.png 1\t2\nb.png 3\n"), expected);
  EXPECT_EQ(tokensOf("a.png 1  2 \r\n b.png 3"), expected);
  EXPECT_EQ(tokensOf("a.png 1 2\rb.png 3\r"), expected);
  EXPECT_EQ(tokensOf("\xEF\xBB\xBF"
                     "a.png 1 2\r\n\r\n# c\r\nb.png 3 # more\r\n"),
            expected);
  EXPECT_TRUE(tokensOf("").empty());
  EXPECT_TRUE(tokensOf("\xEF\xBB\xBF").empty());
}

TEST(TextParsing, LineNumbersCountBlankLinesAndComments)
{
  const TemporaryFolder folder;
  const auto lines = readTextLines(folder.write("a.txt", "# first\r\n\r\na\r\n\nb"));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].number, 3);
  EXPECT_EQ(lines[1].number, 5);
}

TEST(TextParsing, QuotedTokensHoldBlanks)
{
  const std::vector<std::vector<std::string>> expected = {{"my #1 image.png", "1"}};
  EXPECT_EQ(tokensOf("\"my #1 image.png\" 1"), expected);
  EXPECT_TRUE(holds(errorOf([] { tokensOf("a 1\n\"open 1"); }),
                    "a.txt line 2: the quote before 'open 1' is not closed"));
}

TEST(TextParsing, BadFiles)
{
  const TemporaryFolder folder;
  EXPECT_TRUE(
      holds(errorOf([&] { readTextLines(folder.path() / "none.txt"); }), "none.txt: there is no such file"));
  EXPECT_TRUE(holds(errorOf([&] { readTextLines(folder.path()); }), "there is no such file"));
  const auto binary = folder.write("b.txt", std::string("P\0\x01\xFF", 4));
  EXPECT_TRUE(holds(errorOf([&] { readTextLines(binary); }), "b.txt: not a text file"));
  const auto large = folder.write("c.txt");
  std::filesystem::resize_file(large, (std::uintmax_t(64) << 20) + 1); // sparse: takes no room
  EXPECT_TRUE(holds(errorOf([&] { readTextLines(large); }), "67108865 bytes are too many"));
}

TEST(TextParsing, Numbers)
{
  EXPECT_EQ(parseFinite("-1.5e-3"), -1.5e-3);
  EXPECT_EQ(parseFinite("+2"), 2.0);
  EXPECT_EQ(parseFinite(".5"), 0.5);
  for (const char* bad : {"", "+", "+-1", "1,5", "1.5x", "nan", "NaN", "inf", "-inf", "1e999", "0x10", "1D3"})
  {
    EXPECT_FALSE(parseFinite(bad)) << bad;
  }
  EXPECT_EQ(parseCount("16"), 16);
  for (const char* bad : {"", "-1", "-0", "1.0", "99999999999999999999", "a"})
  {
    EXPECT_FALSE(parseCount(bad)) << bad;
  }
}

TEST(TextParsing, NumbersIgnoreTheLocale)
{
  struct Comma : std::numpunct<char>
  {
    char do_decimal_point() const override { return ','; }
  };
  const std::locale before = std::locale::global(std::locale(std::locale(), new Comma));
  // The C library's own, where one with a decimal comma is installed.
  std::setlocale(LC_NUMERIC, "de_DE.UTF-8");
  EXPECT_EQ(parseFinite("0.75"), 0.75);
  EXPECT_FALSE(parseFinite("0,75"));
  EXPECT_EQ(formatNumber(0.75), "0.75");
  std::setlocale(LC_NUMERIC, "C");
  std::locale::global(before);
}

TEST(TextParsing, SmallHelpers)
{
  EXPECT_EQ(splitText(" a, b ,,c", ','), (std::vector<std::string>{"a", "b", "", "c"}));
  EXPECT_EQ(splitText("", ','), std::vector<std::string>{""});
  EXPECT_EQ(inQuotes("a\tb\x1B"), "'a?b?'");
  EXPECT_EQ(inQuotes(std::string(100, 'x')), "'" + std::string(60, 'x') + "...'");
  EXPECT_EQ(formatNumber(0.08), "0.08");
  EXPECT_EQ(formatNumber(std::numeric_limits<double>::quiet_NaN()), "nan");
  EXPECT_EQ(lowerCase("BLUE.Png"), "blue.png");
}

TEST(TextParsing, EndsWith)
{
  EXPECT_TRUE(endsWith("a_par.txt", "_par.txt"));
  EXPECT_TRUE(endsWith("a", ""));
  EXPECT_FALSE(endsWith("par.txt", "_par.txt"));
  EXPECT_FALSE(endsWith("a_par.txt.gz", "_par.txt"));
}
