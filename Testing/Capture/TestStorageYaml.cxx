// SPDX-License-Identifier: BSD-3-Clause
#include "StorageYaml.h"

#include "CaptureTesting.h"
#include "StorageTesting.h"

using namespace silhouette;

namespace
{

StorageNode readText(const std::string& text)
{
  StorageLimits limits("a.txt");
  return parseStorageYaml(text, limits);
}

std::string error(const std::string& text)
{
  return errorOf([&] { readText(text); });
}

} // namespace

TEST(StorageYaml, YamlByHand)
{
  EXPECT_EQ(shown(readText("- a: 1\n  b: x y # so\n- !!opencv-matrix\n  rows: 1\n-\n- 'it''s'\n- C:\\x\n")), "[{a: 1, b: 'x y'}, {rows: 1}, nothing, 'it's', 'C:\\x']");
  EXPECT_EQ(shown(readText("%YAML 1.2\r\n---\r\na: +1.5e3\r\nb: .Inf\r\nc: -.inf\r\nd: .NaN\r\na: \"7\"\r\n...\r\n[")), "{a: 1500, b: inf, c: -inf, d: nan, a: '7'}");
  EXPECT_EQ(shown(readText("7")), "7");
}

/** What yaml-cpp does not read by itself. */
TEST(StorageYaml, AsOpenCVAndJsonMeanIt)
{
  EXPECT_EQ(shown(readText("%YAML:1.0\n---\na: { x:1, y:\"b:c {\", 'z':[ 1., 'it''s ['\n] }\nb: http://d\n")), "{a: {x: 1, y: 'b:c {', z: [1, 'it's [']}, b: 'http://d'}");
  EXPECT_EQ(shown(readText("\n{\"a\": [1, -2.5E+1, 1., []], // [\n\"c\": null, // so\n\t\"d\": \"x // y\", \"e\": \"\\\"\\\\\\/\\n\\u00e4\\u20AC\\ud83d\\ude00\"}\n")),
            "{a: [1, -25, 1, []], c: nothing, d: 'x // y', e: '\"\\/\n\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80'}");
}

TEST(StorageYaml, WhatCannotBeParsed)
{
  EXPECT_EQ(error("{\n\"a\": ["), "a.txt line 2: the file ends within brackets");
  EXPECT_EQ(error("a: 1\nb: 'c\n"), "a.txt line 2: a quote is not closed");
  EXPECT_EQ(error("  a: 1\nb: 2\n"), "a.txt line 2: something follows the value");
  EXPECT_EQ(error("a: 1\n? [b]\n: 1\n"), "a.txt line 2: a key is not a text");
  EXPECT_EQ(error("a: &b [1]\nc: *b\n"), "a.txt line 2: an alias (*) is not read");
  EXPECT_EQ(error("a: 1\nb: !!binary |\n  text\n"), "a.txt line 2: base64 data (!!binary) is not read; write it as numbers");
  EXPECT_EQ(error("a: 1\nb: \"\\u0000\"\n"), "a.txt line 2: text holds a zero byte");
  EXPECT_EQ(error("a: 1\n\x04"), "a.txt line 2: holds a control character");
  EXPECT_EQ(error(std::string((std::size_t(16) << 20) + 1, ' ')), "a.txt line 1: more than 16 MiB are too much for a camera file in YAML or JSON");
  for (const char* text : { "a: 1\nb: [1, 2}\n", "a: 1\n  b: 2\n", "a:\n\tb: 2\n", "a: 1\nb: [1] 2\n", "a: 1\nb: \"\\ud800\"\n", "a: 1\nb: \"\\u00g0\"\n" })
  {
    EXPECT_NE(error(text).find("a.txt line 2: is no YAML ("), std::string::npos) << error(text);
  }
}

/** Aliases that double with each line. */
TEST(StorageYaml, NothingGrows)
{
  std::string text = "a0: &a0 [1, 1]\n";
  for (int i = 1; i < 60; ++i)
  {
    const std::string last = "*a" + std::to_string(i - 1);
    text += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [" + last + ", " + last + "]\n";
  }
  EXPECT_EQ(error(text), "a.txt line 2: an alias (*) is not read");
}
