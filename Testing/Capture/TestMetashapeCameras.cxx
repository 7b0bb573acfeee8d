// SPDX-License-Identifier: BSD-3-Clause
#include "MetashapeCameras.h"

#include "CaptureTesting.h"
#include "LensTesting.h"

#include <array>
#include <iomanip>
#include <random>
#include <sstream>

using namespace silhouette;

namespace
{

/** Numbers with all of their digits. */
std::string text(std::initializer_list<double> numbers)
{
  std::ostringstream stream;
  stream << std::setprecision(17);
  for (const double number : numbers)
  {
    stream << number << ' ';
  }
  return stream.str();
}

std::string rowsOfMatrix(const Eigen::Matrix3d& m)
{
  return text({ m(0, 0), m(0, 1), m(0, 2), m(1, 0), m(1, 1), m(1, 2), m(2, 0), m(2, 1), m(2, 2) });
}

Eigen::Matrix3d turn(double angle, const Vector3& axis)
{
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

// The chunk to the world, and a camera in the chunk.
const Eigen::Matrix3d ChunkTurn = turn(1.1, Vector3(1, -2, 0.5));
const Vector3 ChunkShift(10, -20, 5);
const double ChunkScale = 2.5;
const Eigen::Matrix3d CameraTurn = turn(2.2, Vector3(0.2, 1, 0.4));
const Vector3 CameraCentre(0.3, 0.6, -0.9);

const int Width = 640, Height = 480;
const double F = 900, Cx = 3.5, Cy = -2.25, B1 = 1.5, B2 = -0.75, K1 = 0.1, K2 = -0.05, K3 = 0.02, P1 = 0.003, P2 = -0.002;

/** A point before the camera, brought to the world by what the format says. */
Vector3 inWorld(const Vector3& inCamera)
{
  return ChunkScale * (ChunkTurn * (CameraTurn * inCamera + CameraCentre)) + ChunkShift;
}

/** Metashape's model of a frame camera, from its manual; `lens` 0 leaves the distortion out. Corner family. */
Vector2 frameModel(const Vector3& inCamera, double lens)
{
  const double x = inCamera.x() / inCamera.z(), y = inCamera.y() / inCamera.z(), r2 = x * x + y * y;
  const double radial = 1 + lens * (K1 * r2 + K2 * r2 * r2 + K3 * r2 * r2 * r2);
  const double bentX = x * radial + lens * (P1 * (r2 + 2 * x * x) + 2 * P2 * x * y);
  const double bentY = y * radial + lens * (P2 * (r2 + 2 * y * y) + 2 * P1 * x * y);
  return { Width * 0.5 + Cx + bentX * F + bentX * B1 + bentY * B2, Height * 0.5 + Cy + bentY * F };
}

std::vector<Vector3> pointsBefore()
{
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> any(-1, 1);
  std::vector<Vector3> points(30);
  for (Vector3& point : points)
  {
    point = { any(generator), any(generator), 3 + any(generator) };
  }
  return points;
}

const Vector2 Half(0.5, 0.5); // from the integer family to the corner family

std::string calibration(const std::string& terms, const std::string& type = "frame", const std::string& kind = "adjusted")
{
  return "<calibration type=\"" + type + "\" class=\"" + kind + "\"><resolution width=\"640\" height=\"480\"/>" + terms + "</calibration>";
}

std::string sensor(const std::string& inside, const std::string& type = "frame")
{
  return "<sensors><sensor id=\"7\" type=\"" + type + "\">" + inside + "</sensor></sensors>";
}

std::string term(const std::string& name, double value)
{
  return "<" + name + ">" + text({ value }) + "</" + name + ">";
}

const std::string Full = term("f", F) + term("cx", Cx) + term("cy", Cy) + term("b1", B1) + term("b2", B2) + term("k1", K1) + term("k2", K2) +
  term("k3", K3) + term("p1", P1) + term("p2", P2);

std::string similarity()
{
  return "<transform><rotation locked=\"true\">" + rowsOfMatrix(ChunkTurn) + "</rotation><translation>" +
    text({ ChunkShift.x(), ChunkShift.y(), ChunkShift.z() }) + "</translation><scale>" + text({ ChunkScale }) + "</scale></transform>";
}

std::string pose(const Eigen::Matrix3d& m, const Vector3& c)
{
  return "<transform>" + text({ m(0, 0), m(0, 1), m(0, 2), c.x(), m(1, 0), m(1, 1), m(1, 2), c.y(), m(2, 0), m(2, 1), m(2, 2), c.z() }) +
    "0 0 0 1</transform>";
}

std::string camera(const std::string& label, const std::string& more = "", const std::string& inside = pose(CameraTurn, CameraCentre))
{
  return "<camera id=\"0\" sensor_id=\"7\" label=\"" + label + "\" " + more + ">" + inside + "</camera>\n";
}

/** The camera is on line 3. */
std::string document(const std::string& sensors, const std::string& cameras, const std::string& rest = "")
{
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<document version=\"2.0.0\"><chunk label=\"Chunk 1\" enabled=\"true\">" + sensors +
    "<cameras>\n" + cameras + "</cameras>" + rest + "</chunk></document>\n";
}

CameraFile readText(const std::string& bytes)
{
  const TemporaryFolder folder;
  return readMetashapeCameras(folder.write("a.xml", bytes));
}

/** Without the folder. */
std::string error(const std::string& bytes)
{
  const std::string message = errorOf([&] { readText(bytes); });
  return message.substr(std::min(message.find("a.xml"), message.size()));
}

void expectTruth(const NamedProjection& view)
{
  for (const Vector3& point : pointsBefore())
  {
    EXPECT_LT((pixelOf(view.projection, inWorld(point)) + Half - frameModel(point, 0)).norm(), 1e-9);
    EXPECT_GT(view.projection.row(2) * inWorld(point).homogeneous(), 0);
    ASSERT_TRUE(view.lens);
    EXPECT_LT((distortedPixel(*view.lens, point) + Half - frameModel(point, 1)).norm(), 1e-9);
  }
}

} // namespace

TEST(MetashapeCameras, FrameCamera)
{
  const CameraFile cameras =
    readText(document(sensor(calibration(term("f", 1), "frame", "initial") + calibration(Full)), camera("a.jpg"), similarity()));
  EXPECT_EQ(cameras.format, CameraFormat::Metashape);
  EXPECT_EQ(formatName(cameras.format), "Metashape");
  EXPECT_FALSE(cameras.freeSign);
  EXPECT_EQ(cameras.files.size(), 1u);
  EXPECT_TRUE(cameras.warnings.empty());
  ASSERT_EQ(cameras.views.size(), 1u);
  const NamedProjection& view = cameras.views[0];
  EXPECT_EQ(view.name, "a.jpg");
  EXPECT_EQ(view.line, 3);
  EXPECT_EQ(view.width, 640);
  EXPECT_EQ(view.height, 480);
  EXPECT_TRUE(view.mask.empty());
  expectTruth(view);
}

/** The image by an undistorted view's own K: the skew reaches the pixels, not only the matrix. */
TEST(MetashapeCameras, SkewReachesTheImage)
{
  const std::string skewed = term("f", 100) + term("b2", 20) + term("k1", 0.2);
  const LensDistortion lens = readText(document(sensor(calibration(skewed)), camera("a"))).views.at(0).lens.value();
  LensDistortion small = lens; // of an image whose columns are its values
  small.intrinsics(0, 2) = 127.5;
  small.intrinsics(1, 2) = 99.5;
  const int width = 256, height = 200;
  std::vector<std::uint8_t> ramp(std::size_t(width) * height);
  for (std::size_t i = 0; i < ramp.size(); ++i)
  {
    ramp[i] = std::uint8_t(i % width);
  }
  const std::vector<std::uint8_t> straight = undistorted(ramp.data(), width, height, 1, small);
  const Eigen::Matrix3d toRay = small.intrinsics.inverse();
  for (int v = 60; v < 140; v += 7)
  {
    for (int u = 80; u < 180; u += 11)
    {
      const Vector2 from = distortedPixel(small, toRay * Vector3(u, v, 1));
      EXPECT_NEAR(straight[std::size_t(v) * width + std::size_t(u)], from.x(), 1.0) << u << ' ' << v;
    }
  }
}

TEST(MetashapeCameras, GroupsAndSharedSensors)
{
  const CameraFile cameras = readText(document(sensor(calibration(term("f", F))),
                                               camera("b") + "<group id=\"0\"><camera id=\"1\" sensor_id=\"7\" label=\"a\">" +
                                                 pose(CameraTurn, CameraCentre) + "</camera></group>\n" + camera("c")));
  ASSERT_EQ(cameras.views.size(), 3u);
  EXPECT_EQ(cameras.views[0].name, "b");
  EXPECT_EQ(cameras.views[1].name, "a");
  EXPECT_EQ(cameras.views[2].name, "c");
  EXPECT_EQ(cameras.views[2].line, 5);
  EXPECT_FALSE(cameras.views[2].lens);
}

TEST(MetashapeCameras, TheWaysToTheWorld)
{
  const std::string sensors = sensor(calibration(Full));
  const std::string component = "<components><component id=\"3\">" + similarity() + "</component></components>";
  expectTruth(readText(document(sensors, camera("a", "component_id=\"3\""), component)).views.at(0));
  // A component's transform stands for the chunk's.
  const std::string other = "<transform><scale>9</scale></transform>";
  expectTruth(readText(document(sensors, camera("a", "component_id=\"3\""), component + other)).views.at(0));
  // A component without one has the chunk's.
  expectTruth(readText(document(sensors, camera("a", "component_id=\"3\""), "<components><component id=\"3\"/></components>" + similarity())).views.at(0));
  // 16 numbers, scale included, as PhotoScan had them.
  const Eigen::Matrix3d scaled = ChunkScale * ChunkTurn;
  expectTruth(readText(document(sensors, camera("a"), pose(scaled, ChunkShift))).views.at(0));
  // Without any the chunk is the world.
  const Projection P = readText(document(sensors, camera("a"))).views.at(0).projection;
  for (const Vector3& point : pointsBefore())
  {
    EXPECT_LT((pixelOf(P, CameraTurn * point + CameraCentre) + Half - frameModel(point, 0)).norm(), 1e-9);
  }
  const std::string two = camera("a", "component_id=\"3\"") + camera("b", "component_id=\"4\"");
  EXPECT_EQ(error(document(sensors, two, component)),
            "a.xml: the cameras are of 2 components, and not every one has a transform to the world; export one");
  EXPECT_EQ(readText(document(sensors, two, "<components><component id=\"3\">" + similarity() + "</component><component id=\"4\">" +
                                similarity() + "</component></components>")).views.size(), 2u);
}

/** PhotoScan's calibrations before b1 and b2: absolute cx and cy, p1 and p2 as OpenCV. */
TEST(MetashapeCameras, OlderCalibrations)
{
  const std::string terms = term("fx", 900) + term("fy", 905) + term("cx", 323) + term("cy", 236) + term("skew", 2) + term("k1", K1) +
    term("k2", K2) + term("k3", K3) + term("p1", P1) + term("p2", P2);
  const NamedProjection view = readText(document(sensor(calibration(terms)), camera("a"), similarity())).views.at(0);
  for (const Vector3& point : pointsBefore())
  {
    const double x = point.x() / point.z(), y = point.y() / point.z(), r2 = x * x + y * y;
    const double radial = 1 + K1 * r2 + K2 * r2 * r2 + K3 * r2 * r2 * r2;
    const double bentX = x * radial + P2 * (r2 + 2 * x * x) + 2 * P1 * x * y;
    const double bentY = y * radial + P1 * (r2 + 2 * y * y) + 2 * P2 * x * y;
    EXPECT_LT((distortedPixel(view.lens.value(), point) + Half - Vector2(323 + bentX * 900 + bentY * 2, 236 + bentY * 905)).norm(), 1e-9);
    EXPECT_LT((pixelOf(view.projection, inWorld(point)) + Half - Vector2(323 + x * 900 + y * 2, 236 + y * 905)).norm(), 1e-9);
  }
}

TEST(MetashapeCameras, EquidistantFisheye)
{
  const double K4 = 0.004;
  for (const char* type : { "fisheye", "equidistant_fisheye" })
  {
    const std::string terms = term("f", 300) + term("cx", Cx) + term("cy", Cy) + term("b1", B1) + term("b2", B2) + term("k1", K1) + term("k2", K2) +
      term("k3", K3) + term("k4", K4);
    const NamedProjection view = readText(document(sensor(calibration(terms, type), type), camera("a"), similarity())).views.at(0);
    for (const Vector3& point : pointsBefore())
    {
      // Metashape's manual: the angle for the radius, then the radial terms of that.
      const double r0 = std::hypot(point.x(), point.y()) / point.z(), theta = std::atan(r0), t2 = theta * theta;
      const double x = point.x() / point.z() * theta / r0, y = point.y() / point.z() * theta / r0;
      const double radial = 1 + K1 * t2 + K2 * t2 * t2 + K3 * t2 * t2 * t2 + K4 * t2 * t2 * t2 * t2;
      const Vector2 expected(320 + Cx + x * radial * (300 + B1) + y * radial * B2, 240 + Cy + y * radial * 300);
      EXPECT_LT((distortedPixel(view.lens.value(), point) + Half - expected).norm(), 1e-9);
    }
  }
  // Without any terms a fisheye still bends lines.
  EXPECT_TRUE(readText(document(sensor(calibration(term("f", 300), "fisheye"), "fisheye"), camera("a"))).views.at(0).lens);
}

TEST(MetashapeCameras, WhatIsLeftOut)
{
  const CameraFile cameras = readText(document(sensor(calibration(term("f", F))),
                                               camera("a") + camera("b", "", "") + camera("c", "enabled=\"false\"") + camera("d", "", "<orientation>1</orientation>") +
                                                 camera("e", "enabled=\"0\"") + camera("f", "enabled=\"true\"") + camera("g", "enabled=\"false\"")));
  ASSERT_EQ(cameras.views.size(), 2u);
  EXPECT_EQ(cameras.views[1].name, "f");
  ASSERT_EQ(cameras.warnings.size(), 2u);
  EXPECT_TRUE(holds(cameras.warnings[0], "a.xml: 2 cameras without a transform (not aligned, or of a rig) left out, the first is 'b'"));
  EXPECT_TRUE(holds(cameras.warnings[1], "a.xml: 3 cameras switched off left out, the first is 'c'"));
  EXPECT_TRUE(readText(document(sensor(calibration(term("f", F))), camera("a", "", ""))).views.empty());
}

TEST(MetashapeCameras, WhatOpenCVsModelsHaveNot)
{
  const auto wrong = [](const std::string& terms, const std::string& type) {
    return error(document(sensor(calibration(term("f", F) + terms, type), type), camera("a")));
  };
  const std::string where = "a.xml line 2: sensor '7': ", rest = "; undistort the images, and export their cameras";
  EXPECT_EQ(wrong(term("k4", 0.5), "frame"), where + "k4 is 0.5, and OpenCV's lens model has no such term" + rest);
  EXPECT_EQ(wrong(term("p3", 0.5), "frame"), where + "p3 is 0.5, and OpenCV's lens model has no such term" + rest);
  EXPECT_EQ(wrong(term("p4", -1), "frame"), where + "p4 is -1, and OpenCV's lens model has no such term" + rest);
  EXPECT_EQ(wrong(term("p1", 2), "fisheye"), where + "p1 is 2, and OpenCV's fisheye model has no such term" + rest);
  EXPECT_FALSE(readText(document(sensor(calibration(term("f", F) + term("k4", 0))), camera("a"))).views.at(0).lens); // 0 is no term
  for (const char* type : { "spherical", "cylindrical", "equisolid_fisheye", "rpc" })
  {
    EXPECT_EQ(wrong("", type), where + "is of the type '" + type + "'; frame and (equidistant) fisheye are read");
  }
  EXPECT_EQ(error(document(sensor("", "spherical"), camera("a"))), where + "is of the type 'spherical'; frame and (equidistant) fisheye are read");
  // A sensor that no camera of the result has may be anything.
  EXPECT_EQ(readText(document("<sensors><sensor id=\"7\" type=\"frame\">" + calibration(term("f", F)) + "</sensor><sensor id=\"8\" type=\"spherical\"/></sensors>",
                              camera("a"))).views.size(), 1u);
}

TEST(MetashapeCameras, WrongValues)
{
  const std::string good = sensor(calibration(term("f", F)));
  const std::string at = "a.xml line 3: camera 'a': ", of = "a.xml line 2: sensor '7': ";
  const auto posed = [&](const std::string& transform) { return error(document(good, camera("a", "", "<transform>" + transform + "</transform>"))); };
  EXPECT_EQ(posed("1 2 3"), at + "<transform> has 3 numbers, not 16");
  EXPECT_EQ(posed("1 0 0 0 0 1 0 0 0 0 1 x 0 0 0 1"), at + "'x' in <transform> is not a finite number");
  EXPECT_EQ(posed("1 0 0 0 0 1 0 0 0 0 1 inf 0 0 0 1"), at + "'inf' in <transform> is not a finite number");
  EXPECT_EQ(posed("1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 2"), at + "the last row of <transform> is not 0 0 0 1");
  EXPECT_EQ(posed("1 0 0 0 0 1 0 0 0 0 -1 0 0 0 0 1"), at + "R is no rotation: 1 0 0, 0 1 0, 0 0 -1");
  EXPECT_EQ(posed("2 0 0 0 0 2 0 0 0 0 2 0 0 0 0 1"), at + "R is no rotation: 2 0 0, 0 2 0, 0 0 2");
  EXPECT_EQ(error(document(good, camera(""))), "a.xml line 3: camera '': the label is empty");
  const TemporaryFolder folder;
  const auto twice = folder.write("a.xml", document(good, camera("a") + camera("a")));
  EXPECT_EQ(errorOf([&] { readCameraFile(twice); }), twice.string() + " line 4: the image name 'a' occurs twice (first in " + twice.string() + " line 3)");
  EXPECT_EQ(error(document("", camera("a"))), at + "there is no sensor '7'");
  EXPECT_EQ(error(document(sensor(""), camera("a"))), of + "has no <calibration>");
  EXPECT_EQ(error(document(sensor(calibration("")), camera("a"))), of + "focal lengths 0 and 0 are not above 0");
  EXPECT_EQ(error(document(sensor(calibration("<f>9 9</f>")), camera("a"))), of + "<f> has 2 numbers, not 1");
  EXPECT_EQ(error(document(sensor("<calibration><f>9</f></calibration>"), camera("a"))), of + "the resolution's width is '', not a whole number from 1 on");
  EXPECT_EQ(error(document(sensor("<resolution width=\"5\" height=\"-5\"/><calibration><f>9</f></calibration>"), camera("a"))),
            of + "the resolution's height is '-5', not a whole number from 1 on");
  EXPECT_EQ(error(document(good, camera("a"), "<transform><scale>-1</scale></transform>")), "a.xml line 4: the scale is -1, not above 0");
}

TEST(MetashapeCameras, WhatIsNoDocument)
{
  EXPECT_EQ(error("<document>\n<chunk>\n</document>"), "a.xml line 3: is no XML (Start-end tags mismatch)");
  EXPECT_EQ(error(""), "a.xml line 1: is no XML (No document element found)");
  EXPECT_EQ(error("<document><chunk/></document>"), "a.xml: has 0 chunks with cameras; export one");
  EXPECT_EQ(error("<document><chunk><cameras/></chunk><chunk><cameras/></chunk></document>"), "a.xml: has 2 chunks with cameras; export one");
  const TemporaryFolder folder;
  const auto empty = folder.write("a.xml", "<document><chunk><cameras/></chunk></document>");
  EXPECT_EQ(errorOf([&] { readCameraFile(empty); }), empty.string() + ": names no view");
}

TEST(MetashapeCameras, ToldByTheirBeginning)
{
  const TemporaryFolder folder;
  EXPECT_TRUE(isMetashapeCameras(folder.write("a", document(sensor(calibration(Full)), camera("a")))));
  EXPECT_FALSE(isMetashapeCameras(folder.write("b", "<?xml version=\"1.0\"?>\n<opencv_storage>")));
  EXPECT_FALSE(isMetashapeCameras(folder.write("c", "text <document><chunk>")));
  EXPECT_FALSE(isMetashapeCameras(folder.path()));
  EXPECT_FALSE(isMetashapeCameras(folder.path() / "none"));
}
