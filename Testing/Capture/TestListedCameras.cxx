// SPDX-License-Identifier: BSD-3-Clause
#include "ListedCameras.h"

#include "CaptureTesting.h"

#include <random>

using namespace silhouette;

namespace
{

const std::string Identity = " 1 0 0 0 0 1 0 0 0 0 1 0";
const std::string Middlebury = " 100 0 50 0 200 60 0 0 1  0 -1 0 1 0 0 0 0 1  1 2 3";

std::string listError(const std::string& text)
{
  const TemporaryFolder folder;
  return errorOf([&] { readCameraFile(folder.write("projections.txt", text)); });
}

std::string parametersError(const std::string& text)
{
  const TemporaryFolder folder;
  return errorOf([&] { readCameraFile(folder.write("a_par.txt", text)); });
}

} // namespace

TEST(ListedCameras, ProjectionList)
{
  const TemporaryFolder folder;
  const std::string text =
      "\xEF\xBB\xBF# cameras\r\n\r\na.png 1 2 3 4 5 6 7 8 9 10 11 -1.2e1\r\nb.png" + Identity;
  const CameraFile file = readCameraFile(folder.write("projections.txt", text));
  EXPECT_EQ(file.format, CameraFormat::ProjectionList);
  EXPECT_EQ(formatName(file.format), "P list");
  EXPECT_TRUE(file.freeSign);
  ASSERT_EQ(file.views.size(), 2u);
  EXPECT_EQ(file.views[0].name, "a.png");
  EXPECT_EQ(file.views[0].line, 3);
  Projection expected;
  expected << 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, -12;
  EXPECT_EQ(file.views[0].projection, expected);
  EXPECT_EQ(file.views[1].name, "b.png");
}

TEST(ListedCameras, MiddleburyIsKTimesRAndT)
{
  const TemporaryFolder folder;
  const CameraFile file = readCameraFile(folder.write("a_par.txt", "1\na.png" + Middlebury + "\n"));
  EXPECT_EQ(file.format, CameraFormat::Middlebury);
  EXPECT_EQ(formatName(file.format), "Middlebury");
  EXPECT_FALSE(file.freeSign);
  Projection expected; // by hand: rows of K times [R t]
  expected << 0, -100, 50, 250, 200, 0, 60, 580, 0, 0, 1, 3;
  EXPECT_EQ(file.views.at(0).projection, expected);
  // Recognised by its first line under another name too.
  const CameraFile other = readCameraFile(folder.write("cameras.txt", "\n1\na.png" + Middlebury));
  EXPECT_EQ(other.format, CameraFormat::Middlebury);
}

TEST(ListedCameras, WrongNumbers)
{
  EXPECT_TRUE(holds(listError("a.png" + Identity + "\nb.png 1 2 3"),
                    "projections.txt line 2: expected an image name and 12 numbers (the 3 x 4 matrix row by "
                    "row), found 3 values "
                    "after 'b.png'"));
  EXPECT_TRUE(holds(listError("a.png" + Identity + " 7"), "line 1: expected an image name and 12 numbers"));
  EXPECT_TRUE(holds(listError("a.png 1 0 0 0 0 nan 0 0 0 0 1 0"),
                    "line 1: 'nan' (value 6 of view 'a.png') is not a finite number"));
  EXPECT_TRUE(holds(listError("a.png 1 0 0 0 0 1 0 0 0 0 1 -inf"), "'-inf' (value 12 of view 'a.png')"));
  EXPECT_TRUE(holds(listError("a.png 1 0 0 0 0 1 0 0 0 0 1 1e999"), "'1e999'"));
  EXPECT_TRUE(holds(listError("a.png 1 0 0 0 0 1,5 0 0 0 0 1 0"), "'1,5' (value 6"));
  EXPECT_TRUE(holds(
      parametersError("1\na.png 1 2 3"),
      "a_par.txt line 2: expected an image name and 21 numbers (9 of K, 9 of R, 3 of t), found 3 values"));
  EXPECT_TRUE(holds(parametersError("1\na.png 1e300 0 0 0 1 0 0 0 1 1e300 0 0 0 1 0 0 0 1 0 0 0"),
                    "line 2: K [R t] of view 'a.png' is too large to be finite"));
}

TEST(ListedCameras, WrongCounts)
{
  EXPECT_TRUE(holds(parametersError("3\na.png" + Middlebury + "\nb.png" + Middlebury),
                    "a_par.txt line 1: announces 3 views, but 2 lines follow"));
  EXPECT_TRUE(
      holds(parametersError("1\na.png" + Middlebury + "\nb.png" + Middlebury), "announces 1 views, but 2"));
  EXPECT_TRUE(
      holds(parametersError("a.png" + Middlebury),
            "a_par.txt line 1: expected the number of views, alone on the first line, found 'a.png'"));
  EXPECT_TRUE(holds(parametersError("99999999999999\na.png"), "found '99999999999999'"));
  EXPECT_TRUE(holds(parametersError(""), "expected the number of views"));
}

TEST(ListedCameras, GarbageIsRefusedNotObeyed)
{
  std::mt19937 generator(7);
  std::uniform_int_distribution<int> byte(1, 255);
  for (int trial = 0; trial < 50; ++trial)
  {
    std::string bytes(2000, ' ');
    for (char& c : bytes)
    {
      c = char(byte(generator));
    }
    EXPECT_FALSE(listError(bytes).empty());
    EXPECT_FALSE(parametersError(bytes).empty());
  }
}
