// SPDX-License-Identifier: BSD-3-Clause
#include "PmvsCameras.h"

#include "CaptureTesting.h"

using namespace silhouette;

namespace
{

const std::string Matrix = "CONTOUR\n1 2 3 4\n5 6 7 8\n9 10 11 -12.5e0\n";

/** Without the folder. */
std::string error(const TemporaryFolder& folder)
{
  const std::string message = errorOf([&] { readPmvsCameras(folder.path()); });
  const std::string start = folder.path().string();
  EXPECT_EQ(message.compare(0, start.size(), start), 0) << message;
  return message.substr(std::min(start.size() + 1, message.size()));
}

std::string errorOfCamera(const std::string& text)
{
  const TemporaryFolder folder;
  folder.write("txt/00000000.txt", "CONTOUR\n" + std::string("1 0 0 0 0 1 0 0 0 0 1 0"));
  folder.write("visualize/00000000.jpg");
  folder.write("txt/00000001.txt", text);
  folder.write("visualize/00000001.jpg");
  return error(folder);
}

} // namespace

TEST(PmvsCameras, MatricesImagesAndMasks)
{
  const TemporaryFolder folder;
  const std::filesystem::path second = folder.write("txt/00000010.txt", "CONTOUR\r\n1 0 0 0 0 1 0 0\r\n\r\n0 0 1 0\r\n");
  const std::filesystem::path first = folder.write("txt/00000002.txt", Matrix);
  folder.write("txt/notes.txt", "of no number");
  folder.write("txt/00000003.bak", "of another ending");
  folder.write("visualize/00000002.jpg");
  folder.write("visualize/00000010.PNG");
  folder.write("visualize/00000010.txt");
  folder.write("masks/00000010.pgm");
  for (const std::filesystem::path& path : { folder.path(), folder.path() / "", folder.path() / "txt", folder.path() / "txt" / "", second })
  {
    EXPECT_EQ(pmvsFolder(path), folder.path()) << path;
    EXPECT_TRUE(isPmvsCameras(path));
    const CameraFile cameras = readPmvsCameras(path);
    EXPECT_EQ(cameras.format, CameraFormat::Pmvs);
    EXPECT_EQ(formatName(cameras.format), "PMVS");
    EXPECT_TRUE(cameras.freeSign);
    EXPECT_EQ(cameras.files, (std::vector<std::filesystem::path>{ first, second }));
    ASSERT_EQ(cameras.views.size(), 2u);
    EXPECT_EQ(cameras.views[0].name, "visualize/00000002.jpg");
    EXPECT_EQ(cameras.views[0].mask, "");
    EXPECT_EQ(cameras.views[1].name, "visualize/00000010.PNG");
    EXPECT_EQ(cameras.views[1].mask, "masks/00000010.pgm");
    Projection expected;
    expected << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, -12.5;
    EXPECT_EQ(cameras.views[0].projection, expected);
    EXPECT_FALSE(cameras.views[0].lens);
  }
}

TEST(PmvsCameras, MasksAlone)
{
  const TemporaryFolder folder;
  folder.write("txt/00000000.txt", Matrix);
  folder.write("masks/00000000.pgm");
  const NamedProjection view = readPmvsCameras(folder.path()).views.at(0);
  EXPECT_EQ(view.name, "masks/00000000.pgm");
  EXPECT_EQ(view.mask, "masks/00000000.pgm");
}

TEST(PmvsCameras, Errors)
{
  EXPECT_EQ(errorOfCamera("CONTOUR2\n1 2 3 4 5 6 7 8 9 10 11 12\n"),
            "txt/00000001.txt line 1: expected CONTOUR, found 'CONTOUR2', whose cameras are no 3 x 4 matrices and are not read");
  EXPECT_EQ(errorOfCamera("CONTOUR3\n"), "txt/00000001.txt line 1: expected CONTOUR, found 'CONTOUR3', whose cameras are no 3 x 4 matrices and are not read");
  EXPECT_EQ(errorOfCamera("1 2 3"), "txt/00000001.txt line 1: expected CONTOUR, found '1'");
  EXPECT_EQ(errorOfCamera(""), "txt/00000001.txt line 1: expected CONTOUR, found nothing");
  EXPECT_EQ(errorOfCamera("CONTOUR\n1 2 3 4\n5 6 7 8\n9 10 11\n"),
            "txt/00000001.txt: expected the 12 numbers of the 3 x 4 matrix after CONTOUR, found 11");
  EXPECT_EQ(errorOfCamera("CONTOUR\n1 2 3 4\n5 nan 7 8\n"), "txt/00000001.txt line 3: 'nan' is not a finite number");
  const TemporaryFolder folder;
  EXPECT_EQ(errorOf([&] { readPmvsCameras(folder.path()); }),
            folder.path().string() + ": has no folder txt with cameras of PMVS (00000000.txt, which begins with CONTOUR)");
  folder.write("txt/00000000.txt", Matrix);
  EXPECT_EQ(error(folder), "txt/00000000.txt: there is neither an image visualize/00000000.* nor a mask masks/00000000.*");
  folder.write("visualize/00000000.jpg");
  folder.write("visualize/00000000.ppm");
  const std::string two = error(folder);
  EXPECT_TRUE(two == "txt/00000000.txt: has the images '00000000.jpg' and '00000000.ppm'; one is needed" ||
              two == "txt/00000000.txt: has the images '00000000.ppm' and '00000000.jpg'; one is needed") << two;
}

TEST(PmvsCameras, ToldByTheFirstCamera)
{
  const TemporaryFolder folder;
  EXPECT_FALSE(isPmvsCameras(folder.path()));
  EXPECT_FALSE(isPmvsCameras(folder.path() / "none"));
  EXPECT_FALSE(isPmvsCameras(""));
  EXPECT_FALSE(isPmvsCameras(folder.write("txt/00000000.txt", "1 2 3")));
  EXPECT_FALSE(isPmvsCameras(folder.path()));
  EXPECT_FALSE(isPmvsCameras(folder.write("b/00000000.txt", Matrix)));
  folder.write("txt/00000000.txt", Matrix);
  EXPECT_TRUE(isPmvsCameras(folder.path()));
  EXPECT_FALSE(isPmvsCameras(folder.write("txt/other.txt", Matrix)));
}
