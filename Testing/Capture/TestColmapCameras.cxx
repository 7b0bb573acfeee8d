// SPDX-License-Identifier: BSD-3-Clause
#include "ColmapCameras.h"

#include "CameraTesting.h"
#include "CaptureTesting.h"

#include <cstring>

using namespace silhouette;

namespace
{

struct Model
{
  std::string name;
  int number;
  std::vector<double> parameters;
};

const std::vector<Model> Models = {{"SIMPLE_PINHOLE", 0, {700, 310.75, 252}},
                                   {"PINHOLE", 1, {700, 690, 310.75, 252}},
                                   {"SIMPLE_RADIAL", 2, {700, 310.75, 252, -0.11}},
                                   {"RADIAL", 3, {700, 310.75, 252, -0.11, 0.03}},
                                   {"OPENCV", 4, {700, 690, 310.75, 252, -0.11, 0.03, 0.002, -0.003}},
                                   {"OPENCV_FISHEYE", 5, {700, 690, 310.75, 252, 0.04, -0.02, 0.01, -0.003}},
                                   {"FULL_OPENCV", 6, {700, 690, 310.75, 252, -0.11, 0.03, 0.002, -0.003, 0.01, 0.02, -0.01, 0.005}},
                                   {"SIMPLE_RADIAL_FISHEYE", 8, {700, 310.75, 252, 0.04}},
                                   {"RADIAL_FISHEYE", 9, {700, 310.75, 252, 0.04, -0.02}}};

/** Where COLMAP has a point, its first pixel's centre at (0.5, 0.5). */
Vector2 colmapPixel(const Model& model, const Vector2& plane)
{
  const std::vector<double>& p = model.parameters;
  const bool isSingle = model.name.rfind("SIMPLE", 0) == 0 || model.name.rfind("RADIAL", 0) == 0;
  const auto centre = p.begin() + (isSingle ? 1 : 2);
  const std::vector<double> coefficients(centre + 2, p.end());
  const bool isFisheye = model.name.find("FISHEYE") != std::string::npos;
  const Vector2 bent = isFisheye ? fisheyeLens(plane, coefficients) : brownLens(plane, coefficients);
  return {p[0] * bent.x() + centre[0], (isSingle ? p[0] : p[1]) * bent.y() + centre[1]};
}

const std::vector<std::string> Names = {"a.png", "with blank.png", "#c.png", "sub/d.png"};

/** Of pose `i`, in COLMAP's order; its length is not 1. */
std::vector<double> pose(unsigned i)
{
  const TestPose pose(i);
  const double length = 1.0 + 0.5 * i;
  return {length * pose.Turn.w(), length * pose.Turn.x(), length * pose.Turn.y(), length * pose.Turn.z(),
          pose.Translation.x(), pose.Translation.y(), pose.Translation.z()};
}

void writeText(const TemporaryFolder& folder, const std::vector<Model>& models)
{
  std::string cameras = "# Camera list\n", images = "# Image list\n\n";
  for (std::size_t i = 0; i < models.size(); ++i)
  {
    cameras += std::to_string(70 - i) + " " + models[i].name + " 640 480" + written(models[i].parameters) + "\r\n";
  }
  for (unsigned i = unsigned(Names.size()); i-- > 0;) // not in the names' order
  {
    images += std::to_string(20 + 3 * i) + written(pose(i)) + " " + std::to_string(70 - i % models.size()) + " " + Names[i] + "\n" +
              (i == 1 ? "\n" : "1.5 2.5 -1 3.5 4.5 17\n");
  }
  folder.write("cameras.txt", cameras);
  folder.write("images.txt", images);
}

template <typename Number> std::string packed(Number number)
{
  std::string bytes(sizeof(number), '\0');
  std::memcpy(bytes.data(), &number, sizeof(number)); // the tests run on little-endian machines
  return bytes;
}

std::string packed(const std::vector<double>& numbers)
{
  std::string bytes;
  for (const double number : numbers)
  {
    bytes += packed(number);
  }
  return bytes;
}

std::string binaryCameras(const std::vector<Model>& models)
{
  std::string bytes = packed(std::uint64_t(models.size()));
  for (std::size_t i = 0; i < models.size(); ++i)
  {
    bytes += packed(std::uint32_t(70 - i)) + packed(std::int32_t(models[i].number)) + packed(std::uint64_t(640)) +
             packed(std::uint64_t(480)) + packed(models[i].parameters);
  }
  return bytes;
}

std::string binaryImages(std::size_t cameras)
{
  std::string bytes = packed(std::uint64_t(Names.size()));
  for (unsigned i = unsigned(Names.size()); i-- > 0;)
  {
    bytes += packed(std::uint32_t(20 + 3 * i)) + packed(pose(i)) + packed(std::uint32_t(70 - i % cameras)) + Names[i] + '\0';
    const std::uint64_t points = i == 1 ? 0 : 2;
    bytes += packed(points) + std::string(24 * points, 'x');
  }
  return bytes;
}

void writeBinary(const TemporaryFolder& folder, const std::vector<Model>& models)
{
  folder.write("cameras.bin", binaryCameras(models));
  folder.write("images.bin", binaryImages(models.size()));
}

/** The error after a change of a text file. */
std::string errorAfter(const std::string& file, const std::string& old, const std::string& now)
{
  const TemporaryFolder folder;
  writeText(folder, {Models[1]});
  std::ifstream stream(folder.path() / file);
  std::string text((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  const std::size_t place = text.find(old);
  EXPECT_NE(place, std::string::npos) << old;
  folder.write(file, text.replace(place, old.size(), now));
  std::string error = errorOf([&] { readColmapCameras(folder.path()); });
  const std::string path = folder.path().string() + "/";
  for (std::size_t at = error.find(path); at != std::string::npos; at = error.find(path))
  {
    error.erase(at, path.size());
  }
  return error;
}

} // namespace

TEST(ColmapCameras, ProjectsAsEveryModelDoes)
{
  for (const Model& model : Models)
  {
    const TemporaryFolder folder;
    writeText(folder, {model});
    const CameraFile file = readColmapCameras(folder.path());
    EXPECT_EQ(file.format, CameraFormat::Colmap);
    EXPECT_EQ(file.files, (std::vector<std::filesystem::path>{folder.path() / "cameras.txt", folder.path() / "images.txt"}));
    ASSERT_EQ(file.views.size(), 4u);
    const std::array<unsigned, 4> order = {2, 0, 3, 1}; // by name
    for (std::size_t n = 0; n < 4; ++n)
    {
      const NamedProjection& view = file.views[n];
      EXPECT_EQ(view.name, Names[order[n]]);
      EXPECT_EQ(view.width, 640);
      EXPECT_EQ(view.height, 480);
      EXPECT_EQ(view.lens.has_value(), model.number > 1) << model.name;
      for (const Vector3& point : testPoints())
      {
        const Vector2 expected = colmapPixel(model, TestPose(order[n]).plane(point)) - Vector2(0.5, 0.5);
        EXPECT_LT((pixelOf(view, point) - expected).norm(), 1e-9) << model.name;
        EXPECT_GT(view.projection.row(2).dot(point.homogeneous()), 0.0);
      }
    }
  }
}

TEST(ColmapCameras, BinaryIsAsText)
{
  const TemporaryFolder folder;
  writeText(folder, Models);
  const CameraFile text = readColmapCameras(folder.path() / "cameras.txt");
  writeBinary(folder, Models);
  const CameraFile binary = readColmapCameras(folder.path());
  EXPECT_EQ(binary.files, (std::vector<std::filesystem::path>{folder.path() / "cameras.bin", folder.path() / "images.bin"}))
      << "binary files come first";
  ASSERT_EQ(binary.views.size(), text.views.size());
  for (std::size_t i = 0; i < text.views.size(); ++i)
  {
    EXPECT_EQ(binary.views[i].name, text.views[i].name);
    EXPECT_EQ(binary.views[i].projection, text.views[i].projection);
    ASSERT_EQ(binary.views[i].lens.has_value(), text.views[i].lens.has_value());
    if (text.views[i].lens)
    {
      EXPECT_EQ(binary.views[i].lens->coefficients, text.views[i].lens->coefficients);
      EXPECT_EQ(binary.views[i].lens->intrinsics, text.views[i].lens->intrinsics);
    }
  }
}

TEST(ColmapCameras, CoefficientsOfZeroAreNoLens)
{
  const TemporaryFolder folder;
  writeText(folder, {{"OPENCV", 4, {700, 690, 310.75, 252, 0, 0, 0, 0}}});
  EXPECT_FALSE(readColmapCameras(folder.path()).views[0].lens);
}

TEST(ColmapCameras, FilesAreRecognised)
{
  const TemporaryFolder folder;
  EXPECT_TRUE(colmapModelIn(folder.path()).empty());
  const auto list = folder.write("cameras.txt", "a.png 1 0 0 0 0 1 0 0 0 0 1 0\n");
  EXPECT_FALSE(isColmapFile(list)) << "a P list may be called so";
  EXPECT_TRUE(colmapModelIn(folder.path()).empty());
  EXPECT_TRUE(isColmapFile(folder.write("cameras.txt", "# Camera list with one line of data per camera:\n")));
  EXPECT_TRUE(isColmapFile(folder.write("images.txt", "")));
  EXPECT_TRUE(isColmapFile(folder.path() / "cameras.bin"));
  EXPECT_FALSE(isColmapFile(folder.write("points3D.txt", "")));
  EXPECT_EQ(colmapModelIn(folder.path()), folder.path() / "images.txt");
  folder.write("cameras.txt", "\n# mine\na.png 1 0 0 0 0 1 0 0 0 0 1 0\n");
  EXPECT_FALSE(isColmapFile(list)) << "beside other images too";
  EXPECT_TRUE(colmapModelIn(folder.path()).empty());
  folder.write("cameras.txt", "\n# mine\n1 PINHOLE 640 480 700 700 320 240\n");
  EXPECT_TRUE(isColmapFile(list));
}

TEST(ColmapCameras, WhatIsWrongInTextIsNamed)
{
  const std::string read = "which is not read; SIMPLE_PINHOLE, PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV, OPENCV_FISHEYE, FULL_OPENCV, "
                           "SIMPLE_RADIAL_FISHEYE, RADIAL_FISHEYE are. COLMAP's image_undistorter makes images and cameras without a lens's distortion";
  EXPECT_EQ(errorAfter("cameras.txt", "PINHOLE", "FOV"), "cameras.txt line 2: camera 70 has the model 'FOV', " + read);
  EXPECT_EQ(errorAfter("cameras.txt", "PINHOLE", "pinhole"), "cameras.txt line 2: camera 70 has the model 'pinhole', " + read);
  EXPECT_EQ(errorAfter("cameras.txt", " 690", ""), "cameras.txt line 2: camera 70 has 3 parameters; PINHOLE has 4");
  EXPECT_EQ(errorAfter("cameras.txt", " 690", " nan"),
            "cameras.txt line 2: parameter 2 of camera 70 is 'nan', which is not a finite number");
  EXPECT_EQ(errorAfter("cameras.txt", " 690", " -690"), "cameras.txt line 2: camera 70 has the focal length -690, which is not above 0");
  EXPECT_EQ(errorAfter("cameras.txt", " 480", " 0"), "cameras.txt line 2: camera 70 has the height 0; 1 to 2147483647 pixels are possible");
  EXPECT_EQ(errorAfter("cameras.txt", " 640", " 6.4"), "cameras.txt line 2: the width of camera 70 is '6.4', which is not a whole number of at least 0");
  EXPECT_EQ(errorAfter("cameras.txt", "70 ", "x "), "cameras.txt line 2: the camera's number is 'x', which is not a whole number of at least 0");
  EXPECT_EQ(errorAfter("cameras.txt", "70 ", "70\n70 "),
            "cameras.txt line 2: expected number, model, width, height and parameters of a camera, found 1 words, the first '70'");
  EXPECT_EQ(errorAfter("cameras.txt", "70 ", "70 PINHOLE 1 1 1 1 1 1\n70 "), "cameras.txt line 3: there is a camera 70 already");
  EXPECT_EQ(errorAfter("images.txt", " 70 sub", " 71 sub"), "images.txt line 3: image 'sub/d.png' has camera 71, which cameras.txt has not");
  EXPECT_EQ(errorAfter("images.txt", " 70 sub", " many sub"),
            "images.txt line 3: the camera of image 'sub/d.png' is 'many', which is not a whole number of at least 0");
  EXPECT_EQ(errorAfter("images.txt", " 6 70 sub", " 6e 70 sub"), "images.txt line 3: TZ of image 'sub/d.png' is '6e', which is not a finite number");
  EXPECT_EQ(errorAfter("images.txt", "29 ", "29 0 0 0 0 1 2 3 70 z.png\n\n29 "),
            "images.txt line 3: the quaternion of image 'z.png' is 0, which is no rotation");
  EXPECT_EQ(errorAfter("images.txt", "29 ", "29 1 0 0 0 1 2 3 70\n\n29 "),
            "images.txt line 3: expected number, quaternion (4), translation (3), camera and name of an image, found '29 1 0 0 0 1 2 3 70'");
  EXPECT_EQ(errorAfter("images.txt", "1.5 2.5 -1 3.5", "1.5 2.5 -1"),
            "images.txt line 4: expected the points of image 'sub/d.png', x, y and number each, or an empty line; found '1.5 2.5 -1 4.5 17'");
  EXPECT_TRUE(holds(errorAfter("images.txt", "1.5 2.5 -1 3.5 4.5 17\n", ""), "images.txt line 4: expected the points of image 'sub/d.png'"))
      << "a missing line takes no image with it";
}

TEST(ColmapCameras, FilesAreMissing)
{
  const TemporaryFolder folder;
  EXPECT_TRUE(holds(errorOf([&] { readColmapCameras(folder.path()); }),
                    ": neither cameras.bin and images.bin nor cameras.txt and images.txt are there"));
  writeText(folder, {Models[1]});
  std::filesystem::remove(folder.path() / "images.txt");
  EXPECT_TRUE(holds(errorOf([&] { readColmapCameras(folder.path() / "cameras.txt"); }), "images.txt: there is no such file"));
  folder.write("images.bin", binaryImages(1));
  EXPECT_TRUE(holds(errorOf([&] { readColmapCameras(folder.path() / "images.bin"); }), "cameras.bin: there is no such file"));
}

TEST(ColmapCameras, WhatIsWrongInBinaryFilesIsNamed)
{
  const TemporaryFolder folder;
  const auto error = [&](const std::string& cameras, const std::string& images)
  {
    folder.write("cameras.bin", cameras);
    folder.write("images.bin", images);
    return errorOf([&] { readColmapCameras(folder.path()); });
  };
  const std::string cameras = binaryCameras({Models[1]}), images = binaryImages(1);
  const std::string huge = packed(std::uint64_t(1) << 60);
  EXPECT_TRUE(holds(error(huge + cameras.substr(8), images), "cameras.bin: announces 1152921504606846976 cameras, but 56 bytes are left"));
  EXPECT_TRUE(holds(error(cameras, huge + images.substr(8)), "images.bin: announces 1152921504606846976 images, but "));
  EXPECT_TRUE(holds(error(cameras + "xyz", images), "cameras.bin: 3 bytes follow what it announces"));
  EXPECT_TRUE(holds(error(binaryCameras({{"FOV", 7, {1, 1, 1, 1, 1}}}), images), "cameras.bin camera 1: camera 70 has the model 'FOV', which is not read"));
  EXPECT_TRUE(holds(error(binaryCameras({{"", 99, {1, 1, 1, 1, 1}}}), images),
                    "cameras.bin camera 1: camera 70 has the model of number 99, which is not read"));
  EXPECT_TRUE(holds(error(binaryCameras({{"", 1, {1, HUGE_VAL, 1, 1}}}), images),
                    "cameras.bin camera 1: parameter 2 of camera 70 is inf, which is not a finite number"));
  std::string wrong = images;
  wrong.replace(12, 8, packed(std::nan("")));
  EXPECT_TRUE(holds(error(cameras, wrong), "images.bin image 1: QW of image 'sub/d.png' is nan, which is not a finite number"));
  for (std::size_t length = 0; length < cameras.size(); ++length)
  {
    EXPECT_TRUE(holds(error(cameras.substr(0, length), images), "cameras.bin"));
  }
  for (std::size_t length = 0; length < images.size(); ++length)
  {
    EXPECT_TRUE(holds(error(cameras, images.substr(0, length)), "images.bin"));
  }
}
