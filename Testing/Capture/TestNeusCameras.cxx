// SPDX-License-Identifier: BSD-3-Clause
#include "NeusCameras.h"

#include "CaptureTesting.h"
#include "LensTesting.h"
#include "NumpyArchiveTesting.h"

using namespace silhouette;

namespace
{

// By hand: f 100, principal point (50, 40), turned by a quarter about the axis forward, moved by (1, 2, 5).
const double F = 100, Cx = 50, Cy = 40;
const std::vector<double> WorldMatrix = { Cx * 0, -F, Cx, F * 1 + Cx * 5, F, 0, Cy, F * 2 + Cy * 5, 0, 0, 1, 5, 0, 0, 0, 1 };
const std::vector<double> ScaleMatrix = { 2, 0, 0, 1, 0, 2, 0, 1, 0, 0, 2, 1, 0, 0, 0, 1 };

Vector2 truth(const Vector3& point)
{
  const Vector3 p(-point.y() + 1, point.x() + 2, point.z() + 5);
  return { F * p.x() / p.z() + Cx, F * p.y() / p.z() + Cy };
}

std::vector<double> other()
{
  std::vector<double> matrix = WorldMatrix;
  matrix[3] += 7;
  return matrix;
}

void write(const TemporaryFolder& folder, const std::string& name, const std::vector<ZipMember>& members)
{
  folder.write(name, zipBytes(members));
}

/** Without the folder. */
std::string error(const TemporaryFolder& folder)
{
  const std::string message = errorOf([&] { readNeusCameras(folder.path()); });
  const std::string start = folder.path().string();
  EXPECT_EQ(message.compare(0, start.size(), start), 0) << message;
  return message.substr(std::min(start.size() + 1, message.size()));
}

std::string errorOfArrays(const std::vector<ZipMember>& members)
{
  const TemporaryFolder folder;
  write(folder, "cameras.npz", members);
  folder.write("image/0.png");
  return error(folder);
}

} // namespace

TEST(NeusCameras, MatricesImagesAndMasks)
{
  const TemporaryFolder folder;
  write(folder, "cameras_sphere.npz",
        { { "world_mat_1.npy", npyMatrix(other()), true },
          { "scale_mat_0.npy", npyMatrix(ScaleMatrix) },
          { "world_mat_inv_0.npy", "no array at all" },
          { "world_mat_0.npy", npyMatrix(WorldMatrix), true } });
  write(folder, "cameras.npz", {}); // the other one comes first
  folder.write("image/001.png");
  folder.write("image/000.jpg");
  folder.write("image/Thumbs.db");
  folder.write("image/.hidden.png");
  folder.write("mask/b.png");
  folder.write("mask/a.png");
  for (const std::filesystem::path& path : { folder.path(), folder.path() / "cameras_sphere.npz" })
  {
    EXPECT_EQ(neusFile(path), folder.path() / "cameras_sphere.npz");
    const CameraFile cameras = readNeusCameras(path);
    EXPECT_EQ(cameras.format, CameraFormat::Neus);
    EXPECT_EQ(formatName(cameras.format), "NeuS");
    EXPECT_FALSE(cameras.freeSign);
    EXPECT_EQ(cameras.files, std::vector<std::filesystem::path>{ folder.path() / "cameras_sphere.npz" });
    ASSERT_EQ(cameras.views.size(), 2u);
    EXPECT_EQ(cameras.views[0].name, "image/000.jpg");
    EXPECT_EQ(cameras.views[0].mask, "mask/a.png");
    EXPECT_EQ(cameras.views[1].name, "image/001.png");
    EXPECT_EQ(cameras.views[1].mask, "mask/b.png");
    for (const Vector3& point : { Vector3(0, 0, 0), Vector3(0.3, -0.4, 0.5), Vector3(-1, 2, 3) })
    {
      EXPECT_LT((pixelOf(cameras.views[0].projection, point) - truth(point)).norm(), 1e-9);
    }
    EXPECT_EQ(cameras.views[1].projection(0, 3), WorldMatrix[3] + 7);
  }
}

/** float32, in Fortran order, big-endian, of three rows. */
TEST(NeusCameras, OtherWaysToWriteAMatrix)
{
  std::vector<double> columns, rows(WorldMatrix.begin(), WorldMatrix.begin() + 12);
  for (int i = 0; i < 16; ++i)
  {
    columns.push_back(WorldMatrix[std::size_t(i % 4 * 4 + i / 4)]);
  }
  for (const std::string& npy : { npyBytes(">f4", "True", "(4, 4)", encodedNumbers(columns, ">f4")), npyBytes("<f8", "False", "(3, 4)", encodedNumbers(rows, "<f8")) })
  {
    const TemporaryFolder folder;
    write(folder, "cameras.npz", { { "world_mat_0.npy", npy } });
    folder.write("rgb/0.png");
    const NamedProjection view = readNeusCameras(folder.path()).views.at(0);
    EXPECT_EQ(view.name, "rgb/0.png");
    EXPECT_EQ(view.mask, "");
    EXPECT_LT((pixelOf(view.projection, Vector3(0.3, -0.4, 0.5)) - truth(Vector3(0.3, -0.4, 0.5))).norm(), 1e-9);
  }
}

TEST(NeusCameras, MasksAlone)
{
  const TemporaryFolder folder;
  write(folder, "cameras.npz", { { "world_mat_0.npy", npyMatrix(WorldMatrix) } });
  folder.write("masks/0.png");
  const NamedProjection view = readNeusCameras(folder.path()).views.at(0);
  EXPECT_EQ(view.name, "masks/0.png");
  EXPECT_EQ(view.mask, "masks/0.png");
}

TEST(NeusCameras, CountsThatDiffer)
{
  const TemporaryFolder folder;
  write(folder, "cameras.npz", { { "world_mat_0.npy", npyMatrix(WorldMatrix) }, { "world_mat_1.npy", npyMatrix(WorldMatrix) } });
  EXPECT_EQ(error(folder), "cameras.npz: there are images neither in image, images or rgb nor in mask or masks beside it");
  folder.write("images/0.png");
  EXPECT_EQ(error(folder), "cameras.npz: has 2 matrices, but the folder images 1 images");
  folder.write("images/1.png");
  EXPECT_EQ(readNeusCameras(folder.path()).views.size(), 2u);
  for (const char* name : { "mask/0.png", "mask/1.png", "mask/2.png" })
  {
    folder.write(name);
  }
  EXPECT_EQ(error(folder), "cameras.npz: has 2 matrices, but the folder mask 3 images");
}

TEST(NeusCameras, WrongArrays)
{
  EXPECT_EQ(errorOfArrays({}), "cameras.npz: has no world_mat_0");
  EXPECT_EQ(errorOfArrays({ { "world_mat_1.npy", npyMatrix(WorldMatrix) } }), "cameras.npz: has no world_mat_0, but 1 of its kind");
  EXPECT_EQ(errorOfArrays({ { "world_mat_0.npy", npyMatrix(WorldMatrix) }, { "world_mat_2.npy", npyMatrix(WorldMatrix) } }),
            "cameras.npz: has no world_mat_1, but 2 of its kind");
  EXPECT_EQ(errorOfArrays({ { "world_mat_0.npy", npyBytes("<f8", "False", "(2, 4)", std::string(64, '\0')) } }),
            "cameras.npz array 'world_mat_0': is 2 x 4; 4 x 4 is needed");
  EXPECT_EQ(errorOfArrays({ { "world_mat_0.npy", npyBytes("<f8", "False", "()", std::string(8, '\0')) } }),
            "cameras.npz array 'world_mat_0': is a single number; 4 x 4 is needed");
  std::vector<double> infinite = WorldMatrix;
  infinite[2] = HUGE_VAL;
  EXPECT_EQ(errorOfArrays({ { "world_mat_0.npy", npyMatrix(infinite) } }), "cameras.npz array 'world_mat_0': holds a number that is not finite");
  const TemporaryFolder folder;
  EXPECT_EQ(errorOf([&] { readNeusCameras(folder.path()); }),
            folder.path().string() + ": is neither an .npz file nor a folder with cameras_sphere.npz or cameras.npz");
  folder.write("cameras.npz", "PK and garbage");
  EXPECT_EQ(error(folder), "cameras.npz: is no zip file, or cut off");
}

TEST(NeusCameras, ToldByTheirFile)
{
  const TemporaryFolder folder;
  const std::filesystem::path other = folder.path() / "cameras.npz", own = folder.path() / "cameras_sphere.npz";
  EXPECT_FALSE(neusFile(folder.path()));
  EXPECT_FALSE(neusFile(other));
  write(folder, "cameras.npz", {});
  EXPECT_EQ(neusFile(folder.path()), other);
  write(folder, "cameras_sphere.npz", {});
  EXPECT_EQ(neusFile(folder.path()), own);
  EXPECT_EQ(neusFile(other), other);
  EXPECT_FALSE(neusFile(folder.write("cameras.zip", "PK")));
}
