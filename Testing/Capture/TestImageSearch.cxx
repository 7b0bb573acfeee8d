// SPDX-License-Identifier: BSD-3-Clause
#include "ImageSearch.h"

#include "CaptureTesting.h"

using namespace silhouette;

namespace
{

NamedProjection viewOf(const std::string& name, const std::string& mask = {})
{
  NamedProjection view;
  view.name = name;
  view.mask = mask;
  return view;
}

} // namespace

TEST(ImageSearch, ImageNames)
{
  for (const char* name : {"a.png", "b/a.JPG", "a.b.tiff"})
  {
    EXPECT_TRUE(isImageName(name)) << name;
  }
  for (const char* name : {"a", "r_0.1", "png", ".png", "a.txt", "a.png/b"})
  {
    EXPECT_FALSE(isImageName(name)) << name;
  }
}

TEST(ImageSearch, Photographs)
{
  const TemporaryFolder folder;
  folder.write("images/a.png");
  folder.write("a.png");
  folder.write("b.png");
  EXPECT_EQ(findPhotograph(folder.path(), viewOf("a.png")), folder.path() / "images" / "a.png");
  EXPECT_EQ(findPhotograph(folder.path(), viewOf("./b.png")), folder.path() / "b.png");
  EXPECT_EQ(findPhotograph(folder.path(), viewOf("images/a.png")), folder.path() / "images" / "a.png");
  EXPECT_TRUE(findPhotograph(folder.path(), viewOf("c.png")).empty());
  folder.write("images/frame.0001.jpg");
  EXPECT_EQ(findPhotograph(folder.path(), viewOf("a")), folder.path() / "images" / "a.png") << "an ending may be missing";
  EXPECT_EQ(findPhotograph(folder.path(), viewOf("frame.0001")), folder.path() / "images" / "frame.0001.jpg");
}

TEST(ImageSearch, Masks)
{
  const TemporaryFolder folder;
  folder.write("masks/cam/a.jpg.png");
  folder.write("masks/b.png");
  folder.write("masks/d.png");
  folder.write("images/d.png");
  EXPECT_EQ(findMask(folder.path(), viewOf("cam/a.jpg")), folder.path() / "masks/cam/a.jpg.png");
  EXPECT_EQ(findMask(folder.path(), viewOf("images/b.jpg")), folder.path() / "masks/b.png");
  EXPECT_EQ(findMask(folder.path(), viewOf("../images/d.png")), folder.path() / "masks/d.png") << "not the photograph";
  EXPECT_EQ(findMask(folder.path(), viewOf("b")), folder.path() / "masks/b.png");
  EXPECT_TRUE(findMask(folder.path(), viewOf("c.png")).empty());
  EXPECT_EQ(findMask(folder.path(), viewOf("b.jpg", "elsewhere/b.png")), folder.path() / "elsewhere/b.png") << "as the camera file names it";
  EXPECT_EQ(findMask(folder.path(), viewOf("b.jpg", folder.path().string() + "/masks/d.png")), folder.path() / "masks/d.png");
}
