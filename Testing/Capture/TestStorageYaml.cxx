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
  EXPECT_EQ(shown(readText("a: 1\nb:\n- x\n- y z # a comment\n# another\n-\n  - 1\n  - 2\nc: d#e\n")), "{a: 1, b: ['x', 'y z', [1, 2]], c: 'd#e'}");
  EXPECT_EQ(shown(readText("- a: 1\n  b: 2\n- - 3\n  - 4\n-\n- 'it''s'\n")), "[{a: 1, b: 2}, [3, 4], nothing, 'it's']");
  EXPECT_EQ(shown(readText("---\n\"a b\": [1, [2,\n   3.], # more\n  {x: y, 'z': \"\"}]\nc: # below\n  d: ~\ne: null\n...\nf: 1")),
            "{a b: [1, [2, 3], {x: 'y', z: ''}], c: {d: nothing}, e: nothing}");
  EXPECT_EQ(shown(readText("a: !!opencv-matrix\n  rows: 1\nb: !!seq [1]\nc: C:\\x\nd: http://e\n")), "{a: {rows: 1}, b: [1], c: 'C:\\x', d: 'http://e'}");
  EXPECT_EQ(shown(readText("%YAML 1.2\r\n---\r\na: +1.5e3\r\nb: .Inf\r\nc: -.inf\r\nd: .NaN\r\n")), "{a: 1500, b: inf, c: -inf, d: nan}");
  EXPECT_EQ(shown(readText("7")), "7");
}

TEST(StorageYaml, PlainJson)
{
  EXPECT_EQ(shown(readText("\n{\"a\": [1, -2.5E+1, 1., []], \"b\": {}, \"c\": null,\n\t\"d\": true, \"e:f\": \"x\\\"\\\\\\/\\n\\u00e4\\u20AC\\ud83d\\ude00, [y]\"}\n")),
            "{a: [1, -25, 1, []], b: {}, c: nothing, d: 'true', e:f: 'x\"\\/\n\xC3\xA4\xE2\x82\xAC\xF0\x9F\x98\x80, [y]'}");
  EXPECT_EQ(shown(readText("[{\"a\":1},{\"b\":2}]")), "[{a: 1}, {b: 2}]");
}

TEST(StorageYaml, WhatCannotBeParsed)
{
  EXPECT_EQ(error("{\n\"a\": ["), "a.txt line 2: the line's end ends within brackets");
  EXPECT_EQ(error("a: [1, 2\nb: 3\n"), "a.txt line 2: 'b: 3' is neither a comma nor a ]");
  EXPECT_EQ(error("a: [1, 2}\n"), "a.txt line 1: '}' is neither a comma nor a ]");
  EXPECT_EQ(error("a: {1, 2}\n"), "a.txt line 1: ', 2}' is not a key and a colon");
  EXPECT_EQ(error("a: [,]\n"), "a.txt line 1: ',]' is no value");
  EXPECT_EQ(error("a: [1] 2\n"), "a.txt line 1: '2' follows a value");
  EXPECT_EQ(error("a: 1\nb\n"), "a.txt line 2: 'b' has no key");
  EXPECT_EQ(error("a: 1\n  b: 2\n"), "a.txt line 2: 'b: 2' is indented as nothing before it");
  EXPECT_EQ(error("  a: 1\nb: 2\n"), "a.txt line 2: 'b: 2' is indented as nothing before it");
  EXPECT_EQ(error("a:\n\tb: 2\n"), "a.txt line 2: '?b: 2' has no key");
  EXPECT_EQ(error("a: \"b\n"), "a.txt line 1: '\"b' has a quote that is not closed");
  EXPECT_EQ(error("a: \"\\u00g0\"\n"), "a.txt line 1: '\"\\u00g0\"' has a \\u that is no character");
  EXPECT_EQ(error("a: \"\\ud800\"\n"), "a.txt line 1: '\"\\ud800\"' has a \\u that is no character");
  EXPECT_EQ(error("a: |\n  text\n"), "a.txt line 1: '|' is block text or an anchor, which are not read");
  EXPECT_EQ(error("a: !!binary |\n  text\n"), "a.txt line 1: '!!binary |' is base64 data, which is not read; write it as numbers");
}
