// SPDX-License-Identifier: BSD-3-Clause
#include "TransformsCameras.h"

#include "CameraTesting.h"
#include "CaptureTesting.h"

using namespace silhouette;

namespace
{

std::string matrixOf(const TestPose& pose)
{
  const Eigen::Matrix4d matrix = pose.openGlToWorld();
  std::string text;
  for (int row = 0; row < 4; ++row)
  {
    const std::array<double, 4> numbers = {matrix(row, 0), matrix(row, 1), matrix(row, 2), matrix(row, 3)};
    std::string line = written(numbers).substr(1);
    std::replace(line.begin(), line.end(), ' ', ',');
    text += (row > 0 ? ",[" : "[") + line + "]";
  }
  return "[" + text + "]";
}

/** A frame with the pose `i`, and more keys. */
std::string frame(unsigned i, const std::string& image, const std::string& keys = {})
{
  return "{\"file_path\": \"" + image + "\", " + keys + (keys.empty() ? "" : ", ") + "\"transform_matrix\": " + matrixOf(TestPose(i)) + "}";
}

/** Keys for all, and the frames. */
CameraFile read(const std::string& keys, const std::string& frames)
{
  const TemporaryFolder folder;
  return readTransformsCameras(folder.write("transforms.json", "{" + keys + (keys.empty() ? "" : ", ") + "\"frames\": [" + frames + "]}"));
}

const std::string Pixels = R"("fl_x": 700, "fl_y": 690, "cx": 310.75, "cy": 252)";

/** fx, fy, cx, cy of the corner family. */
void expectProjects(const NamedProjection& view, unsigned pose, const std::array<double, 4>& camera, const std::vector<double>& lens = {},
                    bool isFisheye = false)
{
  for (const Vector3& point : testPoints())
  {
    const Vector2 plane = TestPose(pose).plane(point), bent = isFisheye ? fisheyeLens(plane, lens) : brownLens(plane, lens);
    const Vector2 expected(camera[0] * bent.x() + camera[2] - 0.5, camera[1] * bent.y() + camera[3] - 0.5);
    EXPECT_LT((pixelOf(view, point) - expected).norm(), 1e-9);
    EXPECT_GT(view.projection.row(2).dot(point.homogeneous()), 0.0);
  }
}

/** After the file's name. */
std::string errorIn(const std::string& text)
{
  const TemporaryFolder folder;
  const auto file = folder.write("transforms.json", text);
  return errorOf([&] { readTransformsCameras(file); }).substr(file.string().size());
}

std::string errorOfKeys(const std::string& keys)
{
  return errorIn("{" + keys + ", \"frames\": [" + frame(0, "a.png") + "]}");
}

} // namespace

TEST(TransformsCameras, NumbersOfPixels)
{
  const CameraFile file = read(Pixels + R"(, "w": 640.0, "h": 480, "camera_model": "OPENCV", "k1": 0)",
                               frame(0, "./images/a.jpg") + "," + frame(1, "b.PNG", R"("fl_x": 500, "cx": 300, "w": 600, "mask_path": "masks/b.png")"));
  EXPECT_EQ(file.format, CameraFormat::Transforms);
  ASSERT_EQ(file.views.size(), 2u);
  EXPECT_EQ(file.files.size(), 1u);
  EXPECT_EQ(file.views[0].name, "images/a.jpg");
  EXPECT_EQ(file.views[0].width, 640);
  EXPECT_EQ(file.views[0].height, 480);
  EXPECT_FALSE(file.views[0].lens);
  EXPECT_TRUE(file.views[0].mask.empty());
  expectProjects(file.views[0], 0, {700, 690, 310.75, 252});
  EXPECT_EQ(file.views[1].name, "b.PNG");
  EXPECT_EQ(file.views[1].width, 600) << "a frame's own come first";
  EXPECT_EQ(file.views[1].mask, "masks/b.png");
  expectProjects(file.views[1], 1, {500, 690, 300, 252});
}

TEST(TransformsCameras, AnAngleAndTheImagesSize)
{
  const double fx = 320.0 / std::tan(0.35), fy = 240.0 / std::tan(0.25);
  const CameraFile stated = read(R"("camera_angle_x": 0.7, "w": 640, "h": 480)", frame(0, "a.png"));
  expectProjects(stated.views[0], 0, {fx, fx, 320, 240});
  const CameraFile both = read(R"("camera_angle_x": 0.7, "camera_angle_y": 0.5, "w": 640, "h": 480)", frame(0, "a.png"));
  expectProjects(both.views[0], 0, {fx, fy, 320, 240});
  // As Blender's: no size, no extension.
  const CameraFile blender = read(R"("camera_angle_x": 0.7)", frame(0, "./train/r_0") + "," + frame(1, "train/r.1", R"("fl_x": 500)"));
  EXPECT_EQ(blender.views[0].name, "train/r_0.png");
  EXPECT_EQ(blender.views[1].name, "train/r.1.png");
  ASSERT_TRUE(blender.views[0].ofSize);
  const NamedProjection made = blender.views[0].ofSize(640, 480);
  EXPECT_EQ(made.name, "train/r_0.png");
  EXPECT_FALSE(made.ofSize);
  expectProjects(made, 0, {fx, fx, 320, 240});
  expectProjects(blender.views[1].ofSize(640, 480), 1, {500, 500, 320, 240});
  EXPECT_FALSE(read(Pixels, frame(0, "a.png")).views[0].ofSize) << "all is known without the size";
  const CameraFile partly = read(R"("fl_x": 700, "h": 100)", frame(0, "a.png"));
  expectProjects(partly.views[0].ofSize(640, 480), 0, {700, 700, 320, 50});
}

TEST(TransformsCameras, Lenses)
{
  const std::string some = Pixels + R"(, "w": 640, "h": 480, "k1": -0.11, "k2": 0.03, "p1": 0.002, "p2": -0.003)";
  const std::array<double, 4> camera = {700, 690, 310.75, 252};
  for (const char* model : {"OPENCV", "PINHOLE", "RADIAL"})
  {
    const CameraFile file = read(some + R"(, "k3": 0.01, "k4": 0.0, "camera_model": ")" + model + "\"", frame(0, "a.png"));
    expectProjects(file.views[0], 0, camera, {-0.11, 0.03, 0.002, -0.003, 0.01});
  }
  const std::string fisheye = Pixels + R"(, "k1": 0.04, "k2": -0.02, "k3": 0.01, "k4": -0.003, )";
  expectProjects(read(fisheye + R"("camera_model": "OPENCV_FISHEYE")", frame(0, "a.png")).views[0], 0, camera, {0.04, -0.02, 0.01, -0.003}, true);
  expectProjects(read(fisheye + R"("is_fisheye": true)", frame(0, "a.png")).views[0], 0, camera, {0.04, -0.02, 0.01, -0.003}, true);
  const NamedProjection late = read(R"("camera_angle_x": 0.7, "k1": 0.1)", frame(0, "a.png")).views[0].ofSize(640, 480);
  expectProjects(late, 0, {320.0 / std::tan(0.35), 320.0 / std::tan(0.35), 320, 240}, {0.1});
}

TEST(TransformsCameras, WhatIsWrongIsNamed)
{
  const std::string a = " frame 0, 'a.png': ";
  EXPECT_EQ(errorOfKeys(R"("w": 640, "h": 480)"), a + "neither \"fl_x\" nor \"camera_angle_x\" is there");
  EXPECT_EQ(errorOfKeys(R"("fl_x": "wide")"), a + "fl_x is '\"wide\"', which is not a finite number");
  EXPECT_EQ(errorOfKeys(R"("fl_x": 0)"), a + "fl_x is 0, which is not above 0");
  EXPECT_EQ(errorOfKeys(R"("fl_x": null)"), a + "neither \"fl_x\" nor \"camera_angle_x\" is there");
  EXPECT_EQ(errorOfKeys(R"("camera_angle_x": [])"), a + "camera_angle_x is '[]', which is not a finite number");
  EXPECT_EQ(errorOfKeys(R"("camera_angle_x": 4)"), a + "camera_angle_x is 4; radians between 0 and pi are needed");
  EXPECT_EQ(errorOfKeys(Pixels + R"(, "w": 640.5)"), a + "w is 640.5, which is not a number of pixels");
  EXPECT_EQ(errorOfKeys(Pixels + R"(, "h": 0)"), a + "h is 0, which is not a number of pixels");
  EXPECT_EQ(errorOfKeys(Pixels + R"(, "k4": 0.1)"), a + "k4 is 0.1; of radial coefficients k1, k2 and k3 are read, so it has to be 0");
  EXPECT_EQ(errorOfKeys(Pixels + R"(, "k6": 1)"), a + "k6 is 1; of radial coefficients k1, k2 and k3 are read, so it has to be 0");
  EXPECT_EQ(errorOfKeys(Pixels + R"(, "p1": 0.1, "is_fisheye": true)"), a + "p1 is 0.1; OpenCV's fisheye model has k1 to k4 alone, so it has to be 0");
  EXPECT_EQ(errorOfKeys(Pixels + R"(, "is_fisheye": 1)"), a + "is_fisheye is '1'; true or false is needed");
  EXPECT_EQ(errorOfKeys(Pixels + R"(, "camera_model": "EQUIRECTANGULAR")"),
            a + "the camera model is '\"EQUIRECTANGULAR\"', which is not read; PINHOLE, SIMPLE_PINHOLE, SIMPLE_RADIAL, RADIAL, OPENCV and OPENCV_FISHEYE are");
  const auto errorOfMatrix = [](const std::string& matrix)
  { return errorIn("{" + Pixels + R"(, "frames": [{"file_path": "a.png")" + (matrix.empty() ? "" : ", \"transform_matrix\": " + matrix) + "}]}"); };
  EXPECT_EQ(errorOfMatrix(""), a + "transform_matrix is missing; 4 rows of 4 numbers are needed");
  EXPECT_EQ(errorOfMatrix("[[1,0,0],[0,1,0],[0,0,1]]"), a + "transform_matrix is '[[1,0,0],[0,1,0],[0,0,1]]'; 4 rows of 4 numbers are needed");
  EXPECT_EQ(errorOfMatrix("[[1,0,0,0],[0,1,0,\"far\"],[0,0,1,0]]"), a + "transform_matrix[1][3] is '\"far\"', which is not a finite number");
  EXPECT_EQ(errorOfMatrix("[[2,0,0,0],[0,2,0,0],[0,0,2,0]]"),
            a + "transform_matrix is '[[2,0,0,0],[0,2,0,0],[0,0,2,0]]', which is no rotation and translation");
  EXPECT_TRUE(holds(errorOfMatrix("[[-1,0,0,0],[0,1,0,0],[0,0,1,0]]"), "no rotation")) << "mirrored";
  EXPECT_TRUE(holds(errorOfMatrix("[[1,0,0,0],[0,1,0,0],[0,0,1,0],[0,0,0,2]]"), "no rotation"));
  EXPECT_EQ(errorIn("[]"), ": there is no list \"frames\"");
  EXPECT_EQ(errorIn(R"({"frames": 5})"), ": there is no list \"frames\"");
  EXPECT_EQ(errorIn(R"({"frames": [5]})"), " frame 0 is '5'; an object is needed");
  EXPECT_EQ(errorIn(R"({"frames": [{}]})"), " frame 0: file_path is missing; a text is needed");
  EXPECT_EQ(errorIn(R"({"frames": [{"file_path": 7}]})"), " frame 0: file_path is '7'; a text is needed");
  EXPECT_EQ(errorIn(R"({"frames": [{"file_path": "a.png", "mask_path": 7}]})"), a + "mask_path is '7'; a text is needed");
  EXPECT_TRUE(holds(errorIn("{"), ": not JSON (")) << "and what the parser says";
  EXPECT_TRUE(holds(errorIn("{\"w\": 1e999}"), ": not JSON ("));
  EXPECT_LT(errorIn("{\"" + std::string(10000, 'x')).size(), 300u) << "the file is not quoted at length";
  EXPECT_TRUE(holds(errorIn(std::string(1000000, '[')), ": not JSON ("));
}

TEST(TransformsCameras, IsRecognised)
{
  EXPECT_TRUE(isTransforms("{\"frames\": []}"));
  EXPECT_TRUE(isTransforms("\xEF\xBB\xBF \r\n{ \"w\": 5, \"frames\": []}"));
  EXPECT_FALSE(isTransforms("{\"views\": []}"));
  EXPECT_FALSE(isTransforms("a.png \"frames\""));
  EXPECT_FALSE(isTransforms(""));
}
