// SPDX-License-Identifier: BSD-3-Clause
#include "CameraFormats.h"

#include "CaptureTesting.h"

#include <array>
#include <set>
#include <utility>

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
  EXPECT_EQ(formatOfText("transforms.json", "{\"w\": 5, \"frames\": []}"), CameraFormat::Transforms);
  EXPECT_EQ(formatOfText("x.json", "{\"frames\": [{\"file_path\": \"a\", \"transform_matrix\": []}]}"), CameraFormat::Transforms);
  EXPECT_EQ(formatOfText("x.json", "{\"frames\": [{\"image\": \"a\", \"P\": []}]}"), CameraFormat::OpenCv);
  EXPECT_EQ(formatOfText("cameras.yml", "%YAML:1.0\n---\n"), CameraFormat::OpenCv);
  EXPECT_EQ(formatOfText("cameras.xml", "<?xml version=\"1.0\"?>\n<opencv_storage>\n"), CameraFormat::OpenCv);
  EXPECT_EQ(formatOfText("cameras.xml", "<?xml version=\"1.0\"?>\n<document version=\"1.5\"><chunk>\n"), CameraFormat::Metashape);
  EXPECT_EQ(formatOfText("txt/00000004.txt", "CONTOUR\n1 0 0 0\n"), CameraFormat::Pmvs);
  EXPECT_EQ(formatOfText("cameras.npz", "PK\x03\x04"), CameraFormat::Neus);
  EXPECT_EQ(formatOfText("cameras.npz", "\x80 damaged"), CameraFormat::Neus) << "or the file would be taken for a list";
  EXPECT_EQ(formatOfText("cameras.txt", "# Camera list with one line of data per camera:\n1 PINHOLE 4 4 1 1 2 2\n"), CameraFormat::Colmap);
  EXPECT_EQ(formatOfText("images.bin", ""), CameraFormat::Colmap);
  for (const char* name : {"CONTOUR-1.png", "{a}.png"}) // images may be called so
  {
    EXPECT_EQ(formatOfText("projections.txt", name + Identity), CameraFormat::ProjectionList);
  }
}

TEST(CameraFormats, WhatIsNotReadIsCalledByItsName)
{
  for (const auto& [bytes, kind] : {std::pair("{\n  \"poses\": []\n}", "JSON, without a list \"frames\", \"views\" or \"cameras\""),
                                    {"<?xml version=\"1.0\"?>", "XML, but neither OpenCV's nor a chunk of Metashape's"},
                                    {"CONTOUR\n1 0 0 0", "a camera of PMVS's, but it lies in no folder txt"}})
  {
    const TemporaryFolder folder;
    const std::string error = errorOf([&] { readCameraFile(folder.write("cameras.txt", bytes)); });
    EXPECT_TRUE(holds(error, kind));
    EXPECT_TRUE(holds(error, "cameras.txt: this looks like"));
    EXPECT_TRUE(holds(error, "undistorted"));
  }
}

/** Of each format, the last first, the camera file; it is found once it lies in the folder beside those of the formats that come later. */
TEST(CameraFormats, AFolderIsSearchedInTheirOrder)
{
  const TemporaryFolder folder;
  folder.write("visualize/00000000.jpg");
  const std::array<std::pair<const char*, std::string>, 7> files = {{{"cameras.npz", "PK\x03\x04"},
                                                                    {"txt/00000000.txt", "CONTOUR\n1 0 0 0 0 1 0 0 0 0 1 0\n"},
                                                                    {"my.xml", "<document><chunk>"},
                                                                    {"cameras.yml", "%YAML:1.0\n---\nviews: []\n"},
                                                                    {"sparse/0/images.txt", ""},
                                                                    {"transforms.json", "{\"frames\": []}"},
                                                                    {"projections.txt", ""}}};
  folder.write("sparse/0/cameras.txt", "");
  for (const auto& [name, text] : files)
  {
    folder.write(name, text);
    std::vector<std::filesystem::path> found;
    for (const CameraFormatTraits& traits : cameraFormats())
    {
      found = found.empty() ? traits.filesIn(folder.path()) : found;
    }
    ASSERT_EQ(found.size(), 1u) << name;
    EXPECT_EQ(found[0], folder.path() / name);
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
