// SPDX-License-Identifier: BSD-3-Clause
#include "CameraFormats.h"

#include "CaptureTesting.h"

#include <set>

using namespace silhouette;

namespace
{

const std::string Identity = " 1 0 0 0 0 1 0 0 0 0 1 0";

CameraFormat formatOfText(const std::string& name, const std::string& text)
{
  const TemporaryFolder folder;
  return formatOf(folder.write(name, text)).format;
}

} // namespace

TEST(CameraFormats, EachFormatHasARow)
{
  std::set<CameraFormat> formats;
  std::set<std::string> names;
  for (const CameraFormatTraits& traits : cameraFormats())
  {
    EXPECT_EQ(&traitsOf(traits.format), &traits);
    EXPECT_EQ(formatName(traits.format), traits.name);
    EXPECT_TRUE(formats.insert(traits.format).second);
    EXPECT_TRUE(names.insert(traits.name).second);
  }
}

TEST(CameraFormats, AreToldFromOneAnother)
{
  EXPECT_EQ(formatOfText("cameras.dat", "a.png" + Identity), CameraFormat::ProjectionList);
  EXPECT_EQ(formatOfText("a_par.txt", "a.png" + Identity), CameraFormat::Middlebury);
  EXPECT_EQ(formatOfText("cameras.txt", "\xEF\xBB\xBF# two\r\n\r\n 2 # views\r\na.png"), CameraFormat::Middlebury);
  EXPECT_EQ(formatOfText("x.json", "{\"w\": 5, \"frames\": []}"), CameraFormat::Transforms);
  EXPECT_EQ(formatOfText("cameras.txt", "# Camera list with one line of data per camera:\n1 PINHOLE 4 4 1 1 2 2\n"), CameraFormat::Colmap);
  EXPECT_EQ(formatOfText("images.bin", ""), CameraFormat::Colmap);
  for (const char* name : {"CONTOUR-1.png", "{a}.png"}) // images may be called so
  {
    EXPECT_EQ(formatOfText("projections.txt", name + Identity), CameraFormat::ProjectionList);
  }
}

TEST(CameraFormats, WhatIsNotReadIsCalledByItsName)
{
  for (const auto& [bytes, kind] : {std::pair("{\n  \"views\": []\n}", "JSON without a list \"frames\""), {"<?xml version=\"1.0\"?>", "Metashape"},
                                    {"%YAML:1.0\n---", "OpenCV"}, {"CONTOUR\n1 0 0 0", "PMVS"}})
  {
    const TemporaryFolder folder;
    const std::string error = errorOf([&] { readCameraFile(folder.write("cameras.txt", bytes)); });
    EXPECT_TRUE(holds(error, kind));
    EXPECT_TRUE(holds(error, "cameras.txt: this looks like"));
    EXPECT_TRUE(holds(error, "undistorted"));
  }
}

TEST(CameraFormats, FoldersOfColmapModels)
{
  const auto folderOf = traitsOf(CameraFormat::Colmap).captureFolder;
  EXPECT_EQ(folderOf("my/images.bin"), "my");
  EXPECT_EQ(folderOf("my/sparse/images.bin"), "my");
  EXPECT_EQ(folderOf("my/sparse/0/images.txt"), "my");
  EXPECT_EQ(folderOf("sparse/3/cameras.txt"), ".");
  EXPECT_EQ(folderOf("images.txt"), ".");
  EXPECT_EQ(folderOf("/my/sparse/0/images.txt"), "/my");
}
