// SPDX-License-Identifier: BSD-3-Clause
#include "OpenCVCameras.h"

#include "CaptureTesting.h"
#include "LensTesting.h"

#include <opencv2/core.hpp>

#include <random>

using namespace silhouette;

namespace
{

// A camera by hand: K with skew, a turn about an axis by Rodrigues's formula, a shift.
const Vector3 Turn(0.3, -0.4, 0.2);
const Vector3 Shift(0.1, -0.2, 6.0);
const double Fx = 900, Fy = 950, Skew = 2, Cx = 320.5, Cy = 239.25;
const std::vector<double> Distortion = { 0.1, -0.05, 0.002, -0.003, 0.01, 0.03, -0.02, 0.004 };

Vector3 inCamera(const Vector3& point)
{
  const double angle = Turn.norm();
  const Vector3 axis = Turn / angle;
  return std::cos(angle) * point + std::sin(angle) * axis.cross(point) + (1 - std::cos(angle)) * axis.dot(point) * axis + Shift;
}

Vector2 truth(const Vector3& point)
{
  const Vector3 p = inCamera(point);
  return { (Fx * p.x() + Skew * p.y()) / p.z() + Cx, Fy * p.y() / p.z() + Cy };
}

std::vector<Vector3> points()
{
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<Vector3> result(20);
  for (Vector3& point : result)
  {
    point = { any(generator), any(generator), any(generator) };
  }
  return result;
}

void expectTruth(const Projection& projection)
{
  for (const Vector3& point : points())
  {
    EXPECT_LT((pixelOf(projection, point) - truth(point)).norm(), 1e-9);
    EXPECT_GT(projection.row(2) * point.homogeneous(), 0);
  }
}

cv::Mat matrixK()
{
  return (cv::Mat_<double>(3, 3) << Fx, Skew, Cx, 0, Fy, Cy, 0, 0, 1);
}

cv::Mat matrixR()
{
  cv::Mat R(3, 3, CV_64F);
  for (int column = 0; column < 3; ++column)
  {
    const Vector3 image = inCamera(Vector3::Unit(column)) - Shift;
    for (int row = 0; row < 3; ++row)
    {
      R.at<double>(row, column) = image[row];
    }
  }
  return R;
}

cv::Mat vectorOf(const Vector3& values)
{
  return (cv::Mat_<double>(3, 1) << values[0], values[1], values[2]);
}

CameraFile readText(const std::string& text, const std::string& name = "a.json")
{
  const TemporaryFolder folder;
  return readOpenCVCameras(folder.write(name, text));
}

/** Without the folder. */
std::string error(const std::string& text, const std::string& name = "a.json")
{
  const std::string message = errorOf([&] { readText(text, name); });
  return message.substr(std::min(message.find(name), message.size()));
}

const std::string K = R"("K": [[100, 0, 50], [0, 100, 40], [0, 0, 1]])";
const std::string Pose = R"("R": [0, 0, 0], "t": [0, 0, 5])";

/** A view with K and a pose, and what else is given. */
std::string viewWith(const std::string& more)
{
  return "{" + K + R"(, "views": [{"image": "a.png", )" + Pose + (more.empty() ? "" : ", ") + more + "}]}";
}

} // namespace

/** Files of OpenCV's own writing, in all of its languages. */
TEST(OpenCVCameras, WrittenByOpenCV)
{
  for (const char* name : { "a.yml", "a.yaml", "a.xml", "a.json", "a.yml.gz", "a.xml.gz", "a.json.gz" })
  {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / name;
    {
      cv::FileStorage storage(file.string(), cv::FileStorage::WRITE);
      storage << "camera_matrix" << matrixK() << "distortion_coefficients" << cv::Mat(Distortion) << "image_width" << 640 << "image_height" << 480;
      storage << "views" << "["
              << "{" << "image" << "b 1.png" << "R" << matrixR() << "t" << vectorOf(Shift) << "}"
              << "{" << "image" << "a.png" << "rvec" << vectorOf(Turn) << "tvec" << vectorOf(Shift) << "}" << "]";
    }
    ASSERT_TRUE(isOpenCVCameras(file)) << name;
    const CameraFile cameras = readOpenCVCameras(file);
    EXPECT_EQ(cameras.format, CameraFormat::OpenCv);
    EXPECT_EQ(formatName(cameras.format), "OpenCV");
    EXPECT_FALSE(cameras.freeSign);
    EXPECT_EQ(cameras.files, std::vector<std::filesystem::path>{ file });
    ASSERT_EQ(cameras.views.size(), 2u);
    EXPECT_EQ(cameras.views[0].name, "b 1.png");
    EXPECT_EQ(cameras.views[1].name, "a.png");
    for (const NamedProjection& view : cameras.views)
    {
      expectTruth(view.projection);
      EXPECT_EQ(view.width, 640);
      EXPECT_EQ(view.height, 480);
      EXPECT_TRUE(view.mask.empty());
      ASSERT_TRUE(view.lens);
      EXPECT_EQ(view.lens->model, LensDistortion::Model::Brown);
      EXPECT_EQ(view.lens->coefficients, Distortion);
      LensDistortion straight = *view.lens;
      straight.coefficients = { 0, 0, 0, 0 };
      EXPECT_LT((distortedPixel(straight, inCamera(Vector3(0.5, 0.2, -0.3))) - truth(Vector3(0.5, 0.2, -0.3))).norm(), 1e-9);
    }
  }
}

TEST(OpenCVCameras, EveryKey)
{
  for (const char* sequence : { "views", "cameras", "frames" })
  {
    for (const char* image : { "image", "name", "file", "file_name" })
    {
      for (const char* intrinsics : { "camera_matrix", "cameraMatrix", "K" })
      {
        const CameraFile cameras = readText(std::string("{\"") + sequence + "\": [{\"" + image + "\": \"a.png\", \"" + intrinsics +
                                            "\": [100, 0, 50, 0, 100, 40, 0, 0, 1], " + Pose + "}]}");
        EXPECT_EQ(cameras.views.at(0).name, "a.png");
        EXPECT_EQ(pixelOf(cameras.views[0].projection, Vector3(1, 2, 0)), Vector2(70, 80));
      }
    }
  }
  for (const char* R : { "R", "rotation_matrix", "rvec", "rotation_vector" })
  {
    for (const char* t : { "t", "T", "tvec", "translation_vector" })
    {
      const std::string view = std::string("{\"image\": \"a.png\", \"") + R + "\": [[0, -1, 0], [1, 0, 0], [0, 0, 1]], \"" + t + "\": [[0], [0], [5]]}";
      EXPECT_EQ(pixelOf(readText("{" + K + ", \"views\": [" + view + "]}").views.at(0).projection, Vector3(1, 2, 0)), Vector2(10, 60));
    }
  }
  for (const char* distortion : { "distortion_coefficients", "distCoeffs", "dist" })
  {
    EXPECT_EQ(readText(viewWith(std::string("\"") + distortion + "\": [[0.5, 0, 0, 0]]")).views.at(0).lens.value().coefficients,
              (std::vector<double>{ 0.5, 0, 0, 0 }));
  }
  for (const char* P : { "projection_matrix", "P" })
  {
    EXPECT_TRUE(readText(std::string("{\"views\": [{\"image\": \"a\", \"") + P + "\": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]}]}").freeSign);
  }
  const NamedProjection sized = readText(viewWith(R"("width": 64, "height": 48)")).views.at(0);
  EXPECT_EQ(sized.width, 64);
  EXPECT_EQ(sized.height, 48);
}

/** JSON as Python's json writes it, and as the example script reads it: nested lists, whole numbers, columns, exponents. */
TEST(OpenCVCameras, PlainJson)
{
  const CameraFile cameras = readText(R"({"K": [[100.0, 0.0, 50.0], [0, 100, 40], [0, 0, 1]], "dist": [], "note": null, "views": [
    {"image": "photos/a.png", "R": [[1, 0, 0], [0, 1, 0], [0, 0, 1]], "t": [[0.0], [0.0], [5e0]]},
    {"image": "\u00e4.png", "R": [0.0, 0.0, 1.5707963267948966], "t": [0, 0, 5], "dist": [[1e-05], [0], [0], [0], [0]]},
    {"image": "c.png", "R": [[0], [0], [0]], "t": [1e1, -2E0, 5], "K": [[200, 0, 0], [0, 200, 0], [0, 0, 1]]}]})");
  ASSERT_EQ(cameras.views.size(), 3u);
  EXPECT_EQ(cameras.views[0].name, "photos/a.png");
  EXPECT_EQ(pixelOf(cameras.views[0].projection, Vector3(1, 2, 0)), Vector2(70, 80));
  EXPECT_FALSE(cameras.views[0].lens);
  EXPECT_LT((pixelOf(cameras.views[1].projection, Vector3(1, 2, 0)) - Vector2(10, 60)).norm(), 1e-12);
  EXPECT_EQ(cameras.views[1].lens.value().coefficients, (std::vector<double>{ 1e-5, 0, 0, 0, 0 }));
  EXPECT_EQ(pixelOf(cameras.views[2].projection, Vector3(0, 0, 0)), Vector2(400, -80));
}

TEST(OpenCVCameras, AnEmptyMatrixIsNoDistortion)
{
  for (const char* name : { "a.yml", "a.xml", "a.json" })
  {
    const TemporaryFolder folder;
    const std::filesystem::path file = folder.path() / name;
    {
      cv::FileStorage storage(file.string(), cv::FileStorage::WRITE);
      storage << "K" << matrixK() << "distCoeffs" << cv::Mat() << "views" << "[" << "{" << "image" << "a" << "R" << matrixR() << "t" << vectorOf(Shift) << "}" << "]";
    }
    EXPECT_FALSE(readOpenCVCameras(file).views.at(0).lens);
  }
}

TEST(OpenCVCameras, YamlByHand)
{
  const CameraFile cameras = readText("# my cameras\nK: [[100, 0, 50], [0, 100, 40], [0, 0, 1]]\nviews:\n- image: a 1.png # the first\n  R: [0, 0, 0]\n"
                                      "  t:\n  - 0\n  - 0\n  - 5\n- {image: b.png, R: [0, 0, 0], t: [0, 0, 10]}\n", "a.yaml");
  ASSERT_EQ(cameras.views.size(), 2u);
  EXPECT_EQ(cameras.views[0].name, "a 1.png");
  EXPECT_EQ(pixelOf(cameras.views[0].projection, Vector3(1, 2, 0)), Vector2(70, 80));
  EXPECT_EQ(cameras.views[1].name, "b.png");
  EXPECT_EQ(pixelOf(cameras.views[1].projection, Vector3(1, 2, 0)), Vector2(60, 60));
}

TEST(OpenCVCameras, AViewsOwnComesBeforeTheTops)
{
  const CameraFile cameras = readText("{" + K + R"(, "dist": [0.1, 0, 0, 0], "image_width": 10, "image_height": 20, "cameras": [
    {"name": "a", )" + Pose + R"(, "K": [[200, 0, 1], [0, 200, 2], [0, 0, 1]], "dist": [0, 0, 0, 0, 0], "image_width": 30, "image_height": 40},
    {"name": "b", )" + Pose + "}]}");
  EXPECT_EQ(pixelOf(cameras.views.at(0).projection, Vector3(1, 1, 0)), Vector2(41, 42));
  EXPECT_FALSE(cameras.views[0].lens);
  EXPECT_EQ(cameras.views[0].width, 30);
  EXPECT_EQ(cameras.views[1].lens.value().intrinsics(0, 0), 100);
  EXPECT_EQ(cameras.views[1].height, 20);
}

TEST(OpenCVCameras, FisheyeModel)
{
  const LensDistortion lens = readText(viewWith(R"("fisheye_model": 1, "dist": [0.1, 0.2, 0.3, 0.4])")).views.at(0).lens.value();
  EXPECT_EQ(lens.model, LensDistortion::Model::Fisheye);
  EXPECT_EQ(lens.coefficients, (std::vector<double>{ 0.1, 0.2, 0.3, 0.4 }));
  // Without coefficients of its own a fisheye still bends lines.
  EXPECT_TRUE(readText(viewWith(R"("fisheye_model": 1, "dist": [0, 0, 0, 0])")).views.at(0).lens);
  EXPECT_FALSE(readText(viewWith(R"("fisheye_model": 0, "dist": [0, 0, 0, 0])")).views.at(0).lens);
}

TEST(OpenCVCameras, ProjectionsByThemselvesHaveAFreeSign)
{
  const CameraFile cameras = readText(R"({"views": [{"image": "a", "P": [[-1, -2, -3, -4], [5, 6, 7, 8], [9, 10, 11, 12]]}]})");
  EXPECT_TRUE(cameras.freeSign);
  Projection expected;
  expected << -1, -2, -3, -4, 5, 6, 7, 8, 9, 10, 11, 12;
  EXPECT_EQ(cameras.views.at(0).projection, expected);
  // K, R and t count before P, and their sign is not free.
  const CameraFile both = readText(viewWith(R"("P": [1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12])"));
  EXPECT_FALSE(both.freeSign);
  EXPECT_EQ(pixelOf(both.views.at(0).projection, Vector3(1, 2, 0)), Vector2(70, 80));
}

TEST(OpenCVCameras, ALensNeedsTheProjectionOfItsOwnImage)
{
  const std::string lens = R"("dist": [0.1, 0, 0, 0], )";
  const std::string P = R"("views": [{"image": "a", "P": [-200, 0, -100, -500, 0, -200, -80, -400, 0, 0, -2, -10]}]})"; // -2 K [I t]
  EXPECT_EQ(readText("{" + lens + K + ", " + P).views.at(0).lens.value().intrinsics(0, 2), 50);
  EXPECT_EQ(error("{" + lens + P), "a.json view 0 'a': the lens distorts, but P is given without K");
  EXPECT_EQ(error("{" + lens + R"("K": [[110, 0, 50], [0, 100, 40], [0, 0, 1]], )" + P),
            "a.json view 0 'a': the lens distorts, but P is no multiple of K [R t] with a rotation R, and of another image than K");
}

TEST(OpenCVCameras, WhatIsNoCamera)
{
  EXPECT_EQ(error("{\"a\": 1}"), "a.json: no sequence views, cameras or frames");
  EXPECT_EQ(error("{\"views\": {\"a\": 1}}"), "a.json: no sequence views, cameras or frames");
  EXPECT_EQ(error("{\"views\": [1]}"), "a.json view 0: no image name (image, name, file or file_name, text)");
  EXPECT_EQ(error("{\"views\": [{\"image\": 7}]}"), "a.json view 0: no image name (image, name, file or file_name, text)");
  EXPECT_EQ(error("{\"views\": [{\"image\": \"a\"}]}"), "a.json view 0 'a': neither P nor K, R and t (no K)");
  EXPECT_EQ(error("{" + K + ", \"views\": [{\"image\": \"a\"}]}"), "a.json view 0 'a': neither P nor K, R and t (no R)");
  EXPECT_EQ(error("{" + K + ", \"views\": [{\"image\": \"a\", \"R\": [0, 0, 0]}]}"), "a.json view 0 'a': neither P nor K, R and t (no t)");
  const TemporaryFolder folder;
  const auto file = folder.write("a.json", "{" + K + ", \"views\": [{\"image\": \"a\", " + Pose + "}, {\"image\": \"a\", " + Pose + "}]}");
  EXPECT_EQ(errorOf([&] { readCameraFile(file); }), file.string() + " view 1 'a': the image name 'a' occurs twice (first in " + file.string() + " view 0 'a')");
}

TEST(OpenCVCameras, WrongNumbers)
{
  const auto wrong = [](const std::string& K3, const std::string& R, const std::string& t) {
    return error("{\"K\": " + K3 + ", \"views\": [{\"image\": \"a\", \"R\": " + R + ", \"t\": " + t + "}]}");
  };
  const std::string good = "[1, 0, 0, 0, 1, 0, 0, 0, 1]", where = "a.json view 0 'a': ";
  EXPECT_EQ(wrong("[1, 2]", good, "[0, 0, 1]"), where + "K is 1 x 2 numbers; 3 x 3 are needed");
  EXPECT_EQ(wrong("\"text\"", good, "[0, 0, 1]"), where + "K is neither a sequence of numbers nor a matrix with rows, cols and data");
  EXPECT_EQ(wrong("[1, 0, 0, 0, -1, 0, 0, 0, 1]", good, "[0, 0, 1]"), where + "focal lengths 1 and -1 are not above 0");
  EXPECT_EQ(wrong(good, "[[1, 0], [0, 1]]", "[0, 0, 1]"), where + "R is 2 x 2 numbers; 3 x 3, or the 3 of a rotation vector are needed");
  EXPECT_EQ(wrong(good, "[[1, 0, 0], [0, 1, 0], [0, 0, -1]]", "[0, 0, 1]"), where + "R is no rotation: 1 0 0, 0 1 0, 0 0 -1");
  EXPECT_EQ(wrong(good, good, "[0, 0]"), where + "t is 1 x 2 numbers; 3 are needed");
  EXPECT_EQ(wrong(good, good, "[0, 0, \"x\"]"), where + "t holds 'x', which is not a number");
  EXPECT_EQ(wrong(good, good, "[[0, 0], [1]]"), where + "t: row 1 has 1 numbers, not as many as the first");
  EXPECT_EQ(wrong(good, good, "[[0], [0], 1]"), where + "t has numbers beside its rows");
  EXPECT_EQ(error("%YAML:1.0\n---\nviews:\n   - { image: \"a\", P: [ 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, .Nan ] }\n", "a.yml"),
            "a.yml view 0 'a': P holds nan, which is not a finite number");
  EXPECT_EQ(error("%YAML:1.0\n---\nviews:\n   - { image: \"a\", P: { rows: 300000, cols: 300000, dt: d, data: [ 1, 2 ] } }\n", "a.yml"),
            "a.yml view 0 'a': P announces 3e+05 x 3e+05 numbers, but 2 follow");
  EXPECT_EQ(error(viewWith("\"dist\": [1, 2, 3]")), "a.json view 0 'a.png': the distortion has 3 coefficients; OpenCV's model has 4, 5, 8, 12 or 14");
  EXPECT_EQ(error(viewWith("\"dist\": [1, 2, 3, 4, 5], \"fisheye_model\": 1")),
            "a.json view 0 'a.png': the distortion has 5 coefficients; OpenCV's fisheye model has 4");
  EXPECT_EQ(error(viewWith("\"width\": 10, \"height\": 1.5")), "a.json view 0 'a.png': the image's height is not a whole number from 1 on");
  EXPECT_EQ(error(viewWith("\"height\": 10")), "a.json view 0 'a.png': the image's width is not a whole number from 1 on");
}

TEST(OpenCVCameras, ToldByTheirBeginning)
{
  const TemporaryFolder folder;
  const auto is = [&](const std::string& text) { return isOpenCVCameras(folder.write("a", text)); };
  EXPECT_TRUE(is("%YAML:1.0\n---\n"));
  EXPECT_TRUE(is("<?xml version=\"1.0\"?>\n<opencv_storage>"));
  EXPECT_TRUE(is("\n {\"views\": ["));
  EXPECT_TRUE(isOpenCVCameras(folder.write("a.yml", "# by hand\nviews:\n- image: a.png\n")));
  EXPECT_FALSE(isOpenCVCameras(folder.write("b.yml", "a: 1\n")));
  EXPECT_FALSE(is("{\"frames\": [{\"transform_matrix\": ["));
  EXPECT_FALSE(is("{\"a\": 1}"));
  EXPECT_FALSE(is("<?xml version=\"1.0\"?>\n<document><chunk>"));
  EXPECT_FALSE(is("a.png 1 0 0 0"));
  EXPECT_FALSE(is(""));
  EXPECT_FALSE(isOpenCVCameras(folder.path()));
  EXPECT_FALSE(isOpenCVCameras(folder.path() / "none"));
}
