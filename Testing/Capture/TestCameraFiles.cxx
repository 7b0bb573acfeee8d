// SPDX-License-Identifier: BSD-3-Clause
#include "CameraFiles.h"

#include "CaptureTesting.h"

#include <Eigen/Geometry>

using namespace silhouette;

namespace
{

const std::string Identity = " 1 0 0 0 0 1 0 0 0 0 1 0";

std::string errorIn(const std::string& name, const std::string& text)
{
  const TemporaryFolder folder;
  const auto file = folder.write(name, text);
  std::string error = errorOf([&] { readCameraFile(file); });
  for (std::size_t at = error.find(file.string()); at != std::string::npos; at = error.find(file.string()))
  {
    error.replace(at, file.string().size(), name);
  }
  return error;
}

} // namespace

TEST(CameraFiles, NoViewAtAll)
{
  EXPECT_EQ(errorIn("a_par.txt", "0\n"), "a_par.txt: names no view");
  EXPECT_EQ(errorIn("projections.txt", "# nothing\n"), "projections.txt: names no view");
  EXPECT_EQ(errorIn("transforms.json", "{\"frames\": []}"), "transforms.json: names no view");
}

TEST(CameraFiles, Names)
{
  EXPECT_EQ(errorIn("projections.txt", "a.png" + Identity + "\n\na.png" + Identity),
            "projections.txt line 3: the image name 'a.png' occurs twice (first in projections.txt line 1)");
  EXPECT_EQ(errorIn("projections.txt", "\"\"" + Identity), "projections.txt line 1: the image name is empty");
  const std::string pose = R"("fl_x": 5, "cx": 5, "cy": 5, "transform_matrix": [[1,0,0,0],[0,1,0,0],[0,0,1,0]])";
  EXPECT_EQ(errorIn("transforms.json", R"({"frames": [{"file_path": "./a", )" + pose + R"(}, {"file_path": "a.png", )" + pose + "}]}"),
            "transforms.json frame 1, 'a.png': the image name 'a.png' occurs twice (first in transforms.json frame 0, 'a.png')");
}

TEST(CameraFiles, CornerFamilyIsHalfAPixelAway)
{
  Projection corner;
  corner << 100, 3, 50, 7, 1, 200, 60, 9, 0.1, 0.2, 1, 3;
  const Projection integer = cornerToInteger(corner);
  const Eigen::Vector4d point(0.3, -0.2, 2.0, 1.0);
  const Vector2 difference = (corner * point).hnormalized() - (integer * point).hnormalized();
  EXPECT_NEAR(difference.x(), 0.5, 1e-12);
  EXPECT_NEAR(difference.y(), 0.5, 1e-12);
}
