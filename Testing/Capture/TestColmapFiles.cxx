// SPDX-License-Identifier: BSD-3-Clause
#include "ColmapFiles.h"

#include "CaptureTesting.h"

using namespace silhouette;

namespace
{

std::string little(std::uint64_t value, std::size_t bytes)
{
  std::string text;
  for (; bytes > 0; --bytes, value /= 256)
  {
    text += char(value % 256);
  }
  return text;
}

/** One image without points, of camera 258. */
std::string binaryImage(const std::string& name, std::uint64_t points)
{
  return little(1, 8) + little(9, 4) + std::string("\0\0\0\0\0\0\xf0\x3f", 8) + std::string(48, '\0') + little(258, 4) + name + '\0' + little(points, 8);
}

} // namespace

TEST(ColmapFiles, Text)
{
  const TemporaryFolder folder;
  const auto cameras = readTextColmapCameras(folder.write("cameras.txt", "# CAMERA_ID, MODEL\r\n\r\n 3\tSIMPLE_PINHOLE 20 10 5.5 +10 -5e0\r\n"));
  ASSERT_EQ(cameras.size(), 1u);
  EXPECT_EQ(cameras[0].number, 3u);
  EXPECT_STREQ(cameras[0].model->name, "SIMPLE_PINHOLE");
  EXPECT_EQ(cameras[0].width, 20u);
  EXPECT_EQ(cameras[0].height, 10u);
  EXPECT_EQ(cameras[0].parameters, (std::vector<double>{5.5, 10.0, -5.0}));
  const auto images = readTextColmapImages(
      folder.write("images.txt", "# IMAGE_ID\n\n1 1 0 0 0 4 5 6 3  a \"b\" #c.png \r\n\r\n2 0 1 0 0 7 8 9 3 d.png\n1 2 -1\n3 0 1 0 0 7 8 9 3 e.png"));
  ASSERT_EQ(images.size(), 3u);
  EXPECT_EQ(images[0].name, "a \"b\" #c.png") << "a name goes to the end of the line";
  EXPECT_EQ(images[0].line, 3);
  EXPECT_EQ(images[0].pose, (std::array<double, 7>{1, 0, 0, 0, 4, 5, 6}));
  EXPECT_EQ(images[1].name, "d.png");
  EXPECT_EQ(images[2].name, "e.png") << "the last image's points may be missing with their line";
}

TEST(ColmapFiles, LinesOfManyPoints)
{
  const TemporaryFolder folder;
  std::string points;
  for (int n = 0; n < 200000; ++n)
  {
    points += "1.5 2.5 -1 ";
  }
  const auto images = readTextColmapImages(folder.write("images.txt", "1 1 0 0 0 4 5 6 3 a.png\n" + points + "\n2 1 0 0 0 4 5 6 3 b.png\n\n"));
  ASSERT_EQ(images.size(), 2u);
  EXPECT_EQ(images[1].name, "b.png");
}

TEST(ColmapFiles, Binary)
{
  const TemporaryFolder folder;
  const auto images = readBinaryColmapImages(folder.write("images.bin", binaryImage("a b.png", 2) + std::string(48, '\xff')));
  ASSERT_EQ(images.size(), 1u);
  EXPECT_EQ(images[0].name, "a b.png");
  EXPECT_EQ(images[0].camera, 258u);
  EXPECT_EQ(images[0].pose, (std::array<double, 7>{1, 0, 0, 0, 0, 0, 0}));
}

TEST(ColmapFiles, Refuse)
{
  const TemporaryFolder folder;
  const auto binary = [&](const std::string& bytes)
  { return errorOf([&] { readBinaryColmapImages(folder.write("images.bin", bytes)); }); };
  EXPECT_TRUE(holds(binary(binaryImage("a.png", std::uint64_t(1) << 61)), "images.bin image 1: announces 2305843009213693952 points, but 0 bytes are left"));
  EXPECT_TRUE(holds(binary(binaryImage(std::string(70000, 'x'), 0)), "images.bin image 1: its name 'xxx"));
  EXPECT_TRUE(holds(binary(binaryImage("a.png", 0).substr(0, 82)), "images.bin image 1: the file ends within it"));
  const auto text = [&](const std::string& bytes)
  { return errorOf([&] { readTextColmapImages(folder.write("images.txt", bytes)); }); };
  EXPECT_TRUE(holds(text(std::string("1 1 0 0 0 4 5 6 3 a.png\n1 2\0 -1", 31)), "images.txt line 2: not a text file (it holds a zero byte)"));
  EXPECT_TRUE(holds(errorOf([&] { readTextColmapImages(folder.path()); }), ": there is no such file")) << "a folder";
  EXPECT_TRUE(holds(errorOf([&] { readBinaryColmapCameras(folder.path() / "none.bin"); }), "none.bin: there is no such file"));
}
