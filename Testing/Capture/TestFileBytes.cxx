// SPDX-License-Identifier: BSD-3-Clause
#include "FileBytes.h"

#include "CaptureTesting.h"
#include "TextParsing.h"

#include <zlib.h>

using namespace silhouette;

namespace
{

std::filesystem::path writePacked(const TemporaryFolder& folder, const std::string& name, const std::string& bytes)
{
  const std::filesystem::path file = folder.path() / name;
  const gzFile to = gzopen(file.string().c_str(), "wb");
  gzwrite(to, bytes.data(), unsigned(bytes.size()));
  gzclose(to);
  return file;
}

} // namespace

TEST(FileBytes, PlainAndPacked)
{
  const TemporaryFolder folder;
  std::string text;
  for (int i = 0; i < 40000; ++i)
  {
    text += std::to_string(i * i);
  }
  EXPECT_EQ(readUnpackedBytes(folder.write("a", text)), text);
  const std::filesystem::path packed = writePacked(folder, "a.gz", text);
  EXPECT_EQ(readUnpackedBytes(packed), text);
  EXPECT_LT(std::filesystem::file_size(packed), text.size());
  EXPECT_EQ(fileBeginning(packed, 100), text.substr(0, 100));
  EXPECT_EQ(fileBeginning(folder.path() / "a", 100), text.substr(0, 100));
  EXPECT_EQ(fileBeginning(folder.write("b", "xy"), 100), "xy");
  EXPECT_EQ(readUnpackedBytes(folder.write("c", "")), "");
}

TEST(FileBytes, Errors)
{
  const TemporaryFolder folder;
  const std::string path = folder.path().string();
  EXPECT_EQ(errorOf([&] { readUnpackedBytes(path + "/no"); }), path + "/no: there is no such file");
  EXPECT_EQ(errorOf([&] { readUnpackedBytes(folder.path()); }), path + ": there is no such file");
  EXPECT_EQ(fileBeginning(path + "/no", 9), "");
  EXPECT_EQ(fileBeginning(path, 9), "");
  const std::string bytes = readBytes(writePacked(folder, "a.gz", std::string(10000, 'a') + "b"));
  folder.write("cut.gz", bytes.substr(0, bytes.size() - 12));
  EXPECT_EQ(errorOf([&] { readUnpackedBytes(path + "/cut.gz"); }), path + "/cut.gz: its compression is damaged");
  writePacked(folder, "large.gz", std::string((64 << 20) + 1, ' '));
  EXPECT_EQ(errorOf([&] { readUnpackedBytes(path + "/large.gz"); }), path + "/large.gz: has, unpacked, too many bytes for a camera file (at most 64 MiB)");
}

TEST(FileBytes, LeadingBlanks)
{
  EXPECT_EQ(withoutLeadingBlanks("\xEF\xBB\xBF \r\n\tab "), "ab ");
  EXPECT_EQ(withoutLeadingBlanks("ab"), "ab");
  EXPECT_EQ(withoutLeadingBlanks("  "), "");
}
