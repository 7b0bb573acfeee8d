// SPDX-License-Identifier: BSD-3-Clause
#include "StorageTree.h"

#include "CaptureTesting.h"
#include "StorageTesting.h"

#include <opencv2/core.hpp>

using namespace silhouette;

namespace
{

using Kind = StorageNode::Kind;

StorageNode readText(const std::string& text)
{
  const TemporaryFolder folder;
  return readStorageTree(folder.write("a.txt", text));
}

/** Without the folder. */
std::string error(const std::string& text)
{
  const std::string message = errorOf([&] { readText(text); });
  return message.substr(std::min(message.find("a.txt"), message.size()));
}

/** What OpenCV itself reads, as StorageTesting.h shows it. */
std::string shown(const cv::FileNode& node)
{
  if (node.isInt() || node.isReal())
  {
    return formatNumber(node.real());
  }
  if (node.isString())
  {
    return "'" + node.string() + "'";
  }
  std::string text;
  for (const cv::FileNode member : node)
  {
    text += (text.empty() ? "" : ", ") + (node.isMap() ? member.name() + ": " : "") + shown(member);
  }
  return node.isMap() ? "{" + text + "}" : "[" + text + "]";
}

} // namespace

/** Whatever OpenCV writes we read as it does. */
TEST(StorageTree, WhatOpenCVWrites)
{
  for (const char* name : { "a.yml", "a.xml", "a.json", "a.yml.gz", "a.xml.gz", "a.json.gz" })
  {
    const TemporaryFolder folder;
    const std::string file = (folder.path() / name).string();
    cv::Mat random(7, 9, CV_64F), whole(2, 3, CV_32S), single(3, 1, CV_32FC2);
    cv::randu(random, -1e5, 1e-5);
    cv::randu(whole, -1000, 1000);
    cv::randu(single, 0, 1);
    {
      cv::FileStorage storage(file, cv::FileStorage::WRITE);
      storage << "random" << random << "whole" << whole << "single" << single;
      if (std::string(name).find("xml") == std::string::npos) // where it reads an empty element as text, we read nothing
      {
        storage << "empty" << cv::Mat();
      }
      storage << "text" << "a b" << "quote" << "say \"hi\" \\ <&> 'you'" << "word" << "word" << "digits" << "0001" << "path" << "C:/a/b c.png";
      storage << "integer" << -7 << "real" << 1e-300 << "large" << 1.7976931348623157e308 << "third" << 1.0 / 3.0;
      storage.writeComment("a comment");
      storage << "list" << "[" << 1 << 2.5 << "three" << "[" << 4 << "]" << "{" << "five" << 5 << "}" << "]";
      storage << "flow" << "[:" << 1 << 2.5 << "three" << "]" << "map" << "{:" << "x" << 1 << "y" << "b c" << "}";
      storage << "deep" << "{" << "a" << "{" << "b" << "[" << "{" << "c" << random << "}" << "]" << "}" << "}";
    }
    const StorageNode read = readStorageTree(file);
    const cv::FileStorage storage(file, cv::FileStorage::READ);
    EXPECT_EQ(shown(read), shown(storage.root())) << name;
  }
}

TEST(StorageTree, Xml)
{
  EXPECT_EQ(shown(readText("<?xml version=\"1.0\"?>\n<opencv_storage><!-- so --><a>1 2\n 3</a><b><_>\"x y\"</_><_>z</_></b><c/><d>\"a &lt;\" \"b&quot;c\" \"e</d></opencv_storage>")),
            "{a: [1, 2, 3], b: ['x y', 'z'], c: nothing, d: ['a <', 'b\"c', 'e']}");
}

TEST(StorageTree, Find)
{
  const StorageNode node = readText("a: ~\nb: 2\nc: 3\n");
  EXPECT_EQ(node.find({ "a", "c", "b" }).number, 3);
  EXPECT_TRUE(node.find({ "d" }).is(Kind::Nothing));
  EXPECT_TRUE(node.find({ "b" }).find({ "b" }).is(Kind::Nothing));
}

TEST(StorageTree, WhatCannotBeParsed)
{
  EXPECT_EQ(error(""), "a.txt: is empty");
  EXPECT_EQ(error(" \n\n"), "a.txt: is empty");
  EXPECT_EQ(error(std::string("a: \0", 4)), "a.txt: not a text file (it holds a zero byte)");
  EXPECT_EQ(error("<?xml version=\"1.0\"?>\n<opencv_storage><K type_id="), "a.txt line 2: is no XML (Error parsing element attribute)");
  EXPECT_EQ(error("<?xml version=\"1.0\"?>\n<document/>"), "a.txt line 2: the element is <document>, not <opencv_storage>");
}

TEST(StorageTree, DepthAndSizeAreBounded)
{
  EXPECT_EQ(error(std::string(100000, '[')), "a.txt line 1: is nested deeper than 64 levels");
  std::string yaml, dashes, xml = "<opencv_storage>";
  for (int i = 0; i < 3000; ++i)
  {
    yaml += std::string(std::size_t(i), ' ') + "a:\n";
    dashes += "- ";
    xml += "<a>\n";
  }
  for (int i = 0; i < 3000; ++i)
  {
    xml += "</a>";
  }
  EXPECT_EQ(error(yaml), "a.txt line 66: is nested deeper than 64 levels");
  EXPECT_EQ(error(dashes), "a.txt line 1: is nested deeper than 64 levels");
  EXPECT_EQ(error(xml + "</opencv_storage>"), "a.txt line 65: is nested deeper than 64 levels");
  EXPECT_EQ(shown(readText(std::string(60, '[') + std::string(60, ']'))), std::string(60, '[') + std::string(60, ']'));
  std::string many = "a: [0";
  for (int i = 0; i < 2000000; ++i)
  {
    many += ",1";
  }
  EXPECT_EQ(error(many + "]"), "a.txt line 1: more than 2 million values are too many for a camera file");
}
