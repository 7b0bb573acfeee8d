// SPDX-License-Identifier: BSD-3-Clause
#include "CaptureReaderTesting.h"
#include "vtkSilhouetteEvaluator.h"
#include "vtkSilhouetteExtractor.h"
#include "vtkSilhouetteOctreeSource.h"
#include "vtkVotingMarchingCubes.h"

#include "vtkCellData.h"
#include "vtkHyperTreeGrid.h"
#include "vtkTable.h"

#include <array>

using namespace silhouette::testing;

namespace
{

class VtkSilhouetteCaptureReader : public CaptureReaderTest
{
};

} // namespace

TEST_F(VtkSilhouetteCaptureReader, ReadsMasksAndMatrices)
{
  const Listener listener(this->Reader);
  this->Reader->Update();
  EXPECT_TRUE(listener.silent());
  ASSERT_EQ(this->Reader->GetOutput()->GetNumberOfPartitionedDataSets(), 8u);
  for (unsigned int i = 0; i < 8; ++i)
  {
    EXPECT_EQ(this->Reader->GetOutput()->GetMetaData(i)->Get(vtkCompositeDataSet::NAME()), this->name(i));
    EXPECT_EQ(bytes(this->output(i)->GetPointData()->GetScalars()),
              bytes(this->image(i)->GetPointData()->GetScalars()));
    EXPECT_EQ(bytes(this->output(i)->GetFieldData()->GetArray("Projection")),
              bytes(this->image(i)->GetFieldData()->GetArray("Projection")));
    EXPECT_EQ(field(this->output(i), "IsMask"), 1);
  }
  vtkPolyData* cameras = this->Reader->GetCamerasOutput();
  EXPECT_EQ(cameras->GetNumberOfPoints(), 40);
  EXPECT_EQ(cameras->GetNumberOfLines(), 40);
  vtkDataArray* ids = cameras->GetCellData()->GetArray("View");
  ASSERT_NE(ids, nullptr);
  EXPECT_EQ(ids->GetTuple1(39), 7);
  double centre[3];
  cameras->GetPoint(0, centre);
  EXPECT_NEAR(centre[0], CameraDistance * std::cos(0.1), 1e-9);
  EXPECT_NEAR(centre[1], CameraDistance * std::sin(0.1), 1e-9);
  for (vtkIdType i = 0; i < 40; ++i)
  {
    double p[3];
    cameras->GetPoint(i, p);
    EXPECT_LE(std::hypot(p[0], p[1], p[2]), CameraDistance + 1e-9) << "the lines run towards the object";
  }
}

TEST_F(VtkSilhouetteCaptureReader, FeedsTheOctreeSource)
{
  vtkNew<vtkSilhouetteExtractor> extractor;
  extractor->SetInputConnection(this->Reader->GetOutputPort());
  vtkNew<vtkSilhouetteOctreeSource> octree;
  octree->SetInputConnection(extractor->GetOutputPort());
  octree->SetDepth(4);
  octree->Update();
  vtkNew<vtkSilhouetteOctreeSource> direct;
  direct->SetInputData(this->Views);
  direct->SetDepth(4);
  direct->Update();
  EXPECT_EQ(field(octree->GetOutput(), "OctantsTested"), field(direct->GetOutput(), "OctantsTested"));
  EXPECT_EQ(bytes(octree->GetOutput()->GetCellData()->GetArray("State")),
            bytes(direct->GetOutput()->GetCellData()->GetArray("State")));
}

TEST_F(VtkSilhouetteCaptureReader, TurnsMatricesOfFreeSign)
{
  this->writeProjections(-1.0);
  this->Reader->Update();
  for (unsigned int i = 0; i < 8; ++i)
  {
    EXPECT_NEAR(this->output(i)->GetFieldData()->GetArray("Projection")->GetComponent(0, 11), CameraDistance,
                1e-9);
  }
}

TEST_F(VtkSilhouetteCaptureReader, ChoosesImagesViewsAndFamily)
{
  for (unsigned int i = 0; i < 8; ++i)
  {
    writeImage<vtkPNGWriter>(plainImage(ImageSize, ImageSize, 77, 3),
                             this->Folder / "images" / this->name(i));
  }
  this->Reader->Update();
  EXPECT_EQ(this->output(0)->GetNumberOfScalarComponents(), 1) << "masks where they exist";
  this->Reader->SetImageChoiceToPhotographs();
  this->Reader->SetViews("1,disc4.png,6-7");
  this->Reader->Update();
  ASSERT_EQ(this->Reader->GetOutput()->GetNumberOfPartitionedDataSets(), 4u);
  EXPECT_EQ(this->output(0)->GetNumberOfScalarComponents(), 3);
  EXPECT_EQ(field(this->output(0), "IsMask"), 0);
  EXPECT_STREQ(this->Reader->GetOutput()->GetMetaData(1u)->Get(vtkCompositeDataSet::NAME()), "disc4.png");
  const double before = this->output(0)->GetFieldData()->GetArray("Projection")->GetComponent(0, 3);
  this->Reader->SetPixelFamilyToCorner();
  this->Reader->Update();
  EXPECT_NEAR(this->output(0)->GetFieldData()->GetArray("Projection")->GetComponent(0, 3),
              before - 0.5 * CameraDistance, 1e-9);
}

TEST_F(VtkSilhouetteCaptureReader, GivesAllViewsToEveryPiece)
{
  this->Reader->UpdatePiece(1, 2, 0);
  EXPECT_EQ(this->Reader->GetOutput()->GetNumberOfPartitionedDataSets(), 8u);
}

TEST_F(VtkSilhouetteCaptureReader, IsAProperFilter)
{
  expectPrints(this->Reader, {"FileName", "Views", "ImageChoice", "PixelFamily"});
  expectModifies(this->Reader, [&] { this->Reader->SetViews("0-6"); });
  expectModifies(this->Reader, [&] { this->Reader->SetImageChoiceToMasks(); });
  expectModifies(this->Reader,
                 [&] { this->Reader->SetFileName((this->Folder / "projections.txt").c_str()); });
  expectProgress(this->Reader);
  expectAbort(this->Reader, 0.3);
  EXPECT_EQ(vtkSilhouetteCaptureReader::CanReadFile(this->Folder.c_str()), 1);
  EXPECT_EQ(vtkSilhouetteCaptureReader::CanReadFile((this->Folder / "projections.txt").c_str()), 1);
  EXPECT_EQ(vtkSilhouetteCaptureReader::CanReadFile((this->Folder / "masks").c_str()), 0);
  EXPECT_EQ(vtkSilhouetteCaptureReader::CanReadFile(nullptr), 0);
}

TEST_F(VtkSilhouetteCaptureReader, RefusesWhatItCannotRead)
{
  vtkNew<vtkSilhouetteCaptureReader> nameless;
  expectError(nameless, {"no file name"});
  nameless->SetFileName("/nowhere/at/all");
  expectError(nameless, {"/nowhere/at/all"});

  const fs::path mask = this->Folder / "masks/disc3.png";
  std::ofstream(mask) << "not an image";
  expectError(this->Reader, {"cannot read image", "disc3.png", "not a PNG, JPEG, PNM, BMP or TIFF"});
  const fs::path earlier = this->Folder / "masks/disc2.png"; // they are read side by side
  std::ofstream(earlier) << "nor this";
  expectError(this->Reader, {"cannot read image", "disc2.png", "not a PNG, JPEG, PNM, BMP or TIFF"});
  writeImage<vtkPNGWriter>(this->image(2), earlier);
  writeImage<vtkPNGWriter>(this->image(3), mask);

  writeImage<vtkPNGWriter>(plainImage(10, 12, 9, 3), this->Folder / "images/disc5.png");
  expectError(this->Reader, {"disc5.png", "96 x 96", "10 x 12"});
  fs::remove(this->Folder / "images/disc5.png");
  this->Reader->SetImageChoiceToPhotographs();
  expectError(this->Reader, {"view 0 (disc0.png)", "no photograph"});
  this->Reader->SetImageChoiceToMasks();
  this->Reader->SetViews("99");
  expectError(this->Reader, {"99"});
}

/** Cameras side by side, whose axes diverge: only their silhouettes show that the object is in front of them. */
TEST_F(VtkSilhouetteCaptureReader, SilhouettesTellSignsThatPhotographsDoNot)
{
  fs::remove_all(this->Folder / "masks");
  const std::array<double, 3> object = {0.3, -0.2, 3.0};
  constexpr double radius = 0.4, focal = 90.0, middle = 0.5 * (ImageSize - 1);
  std::ofstream projections(this->Folder / "projections.txt");
  projections << std::setprecision(17);
  std::vector<Matrix> matrices;
  for (int i = 0; i < 5; ++i)
  {
    const double x = 0.25 * (i - 2), turn = 0.1 * (i - 2); // the outer ones look outwards
    const double right[3] = {std::cos(turn), 0.0, -std::sin(turn)}, forward[3] = {std::sin(turn), 0.0, std::cos(turn)};
    Matrix p{};
    for (int axis = 0; axis < 3; ++axis)
    {
      p[axis] = focal * right[axis] + middle * forward[axis];
      p[4 + axis] = focal * (axis == 1 ? 1.0 : 0.0) + middle * forward[axis];
      p[8 + axis] = forward[axis];
    }
    for (int row = 0; row < 3; ++row)
    {
      p[4 * row + 3] = -p[4 * row] * x; // the camera's centre is (x, 0, 0)
    }
    auto image = plainImage(ImageSize, ImageSize, 0, 3);
    for (int v = 0; v < ImageSize; ++v)
    {
      for (int u = 0; u < ImageSize; ++u)
      {
        const double a = (u - middle) / focal, b = (v - middle) / focal; // the ray, and how far the object's middle is from it
        const double ray[3] = {forward[0] + a * right[0], b, forward[2] + a * right[2]};
        const double to[3] = {object[0] - x, object[1], object[2]};
        const double along = (ray[0] * to[0] + ray[1] * to[1] + ray[2] * to[2]) / (ray[0] * ray[0] + ray[1] * ray[1] + ray[2] * ray[2]);
        const double away = std::hypot(to[0] - along * ray[0], to[1] - along * ray[1], to[2] - along * ray[2]);
        auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(u, ImageSize - 1 - v, 0));
        pixel[0] = away < radius ? static_cast<unsigned char>(100 + u % 100) : 0;
      }
    }
    const std::string name = "photo" + std::to_string(i) + ".png";
    writeImage<vtkPNGWriter>(image, this->Folder / "images" / name);
    projections << name;
    const double sign = i % 2 == 0 ? 1.0 : -3.0; // scale and sign are free
    for (const double number : p)
    {
      projections << ' ' << sign * number;
    }
    projections << '\n';
    matrices.push_back(p);
  }
  projections.close();
  vtkNew<vtkSilhouetteExtractor> extractor;
  extractor->SetInputConnection(this->Reader->GetOutputPort());
  extractor->SetUseThreshold(true);
  extractor->SetThreshold(0.2);
  extractor->Update();
  ASSERT_EQ(extractor->GetOutput()->GetNumberOfPartitionedDataSets(), 5u);
  for (unsigned int i = 0; i < 5; ++i)
  {
    Matrix found;
    extractor->GetOutput()->GetPartitionAsDataObject(i, 0)->GetFieldData()->GetArray("Projection")->GetTuple(0, found.data());
    double depth = found[11];
    for (int axis = 0; axis < 3; ++axis)
    {
      depth += found[8 + axis] * object[axis];
    }
    EXPECT_GT(depth, 0.0) << i;
  }
}

namespace
{

/** The ring's eight cameras as transforms.json, with a lens that bends; images that it makes of the ring's discs. */
class VtkCapturesOfOtherPrograms : public CaptureReaderTest
{
protected:
  void SetUp() override
  {
    CaptureReaderTest::SetUp();
    fs::remove(this->Folder / "projections.txt");
    fs::remove_all(this->Folder / "masks");
    this->writeTransforms(Bent);
  }

  static constexpr double Middle = 0.5 * (ImageSize - 1);
  static constexpr const char* Bent = R"("camera_model": "OPENCV", "k1": -0.8, "k2": 0.5, "p1": 0.01, "p2": -0.02)";
  static constexpr const char* Straight = R"("camera_model": "PINHOLE")";

  /** Where the lens puts a pixel, and back. */
  static std::array<double, 2> bent(double u, double v)
  {
    const double x = (u - Middle) / Focal, y = (v - Middle) / Focal, r = x * x + y * y;
    const double radial = 1.0 - 0.8 * r + 0.5 * r * r;
    return {Focal * (x * radial + 2.0 * 0.01 * x * y - 0.02 * (r + 2.0 * x * x)) + Middle,
            Focal * (y * radial + 0.01 * (r + 2.0 * y * y) - 2.0 * 0.02 * x * y) + Middle};
  }
  static std::array<double, 2> straightened(double u, double v)
  {
    std::array<double, 2> found = {u, v};
    for (int step = 0; step < 50; ++step)
    {
      const std::array<double, 2> there = bent(found[0], found[1]);
      found = {found[0] + u - there[0], found[1] + v - there[1]};
    }
    return found;
  }

  /** The disc as the lens shows it; its value in each channel, 0 elsewhere. */
  static vtkSmartPointer<vtkImageData> bentDisc(const std::vector<unsigned char>& value)
  {
    const double radius = Focal / std::sqrt(CameraDistance * CameraDistance - 1.0);
    auto image = plainImage(ImageSize, ImageSize, 0, int(value.size()));
    for (int v = 0; v < ImageSize; ++v)
    {
      for (int u = 0; u < ImageSize; ++u)
      {
        const std::array<double, 2> at = straightened(u, v);
        if (std::hypot(at[0] - Middle, at[1] - Middle) <= radius)
        {
          std::copy(value.begin(), value.end(), static_cast<unsigned char*>(image->GetScalarPointer(u, ImageSize - 1 - v, 0)));
        }
      }
    }
    return image;
  }

  void writeImages(vtkImageData* image)
  {
    for (unsigned int i = 0; i < 8; ++i)
    {
      writeImage<vtkPNGWriter>(image, this->Folder / "images" / this->name(i));
    }
  }

  /** Keys of the lens; by the angle, so that the images' size is needed, or by the focal length and that size. */
  void writeTransforms(const std::string& lens, const std::string& more = {})
  {
    std::ofstream file(this->Folder / "transforms.json");
    file << std::setprecision(17) << "{\"camera_angle_x\": " << 2.0 * std::atan(0.5 * ImageSize / Focal) << ", " << lens << more << ", \"frames\": [";
    for (unsigned int i = 0; i < 8; ++i)
    {
      const double angle = 2.0 * 3.14159265358979 * i / 8 + 0.1, x = std::cos(angle), y = std::sin(angle);
      file << (i > 0 ? ", " : "") << "{\"file_path\": \"images/" << this->name(i) << "\", \"transform_matrix\": [[" << -y << ", 0, " << x << ", "
           << CameraDistance * x << "], [" << x << ", 0, " << y << ", " << CameraDistance * y << "], [0, 1, 0, 0], [0, 0, 0, 1]]}";
    }
    file << "]}";
  }

  /** Pixels of the images read that are not as the discs of a lens that does not bend, as a share of theirs. */
  double pixelShare()
  {
    vtkNew<vtkSilhouetteExtractor> extractor;
    extractor->SetInputConnection(this->Reader->GetOutputPort());
    extractor->Update();
    auto* found = vtkImageData::SafeDownCast(extractor->GetOutput()->GetPartition(3, 0));
    const std::string seen = bytes(found->GetPointData()->GetScalars()), disc = bytes(this->image(3)->GetPointData()->GetScalars());
    std::size_t differ = 0;
    for (std::size_t i = 0; i < disc.size(); ++i)
    {
      differ += seen.at(i) != disc[i];
    }
    return double(differ) / double(std::count(disc.begin(), disc.end(), char(255)));
  }

  /** Mean XOR of the mesh against the discs. */
  double meshShare()
  {
    vtkNew<vtkSilhouetteOctreeSource> octree;
    octree->SetInputConnection(this->Reader->GetOutputPort());
    octree->SetDepth(6);
    vtkNew<vtkVotingMarchingCubes> cubes;
    cubes->SetInputConnection(0, octree->GetOutputPort(0));
    cubes->SetInputConnection(1, octree->GetOutputPort(1));
    vtkNew<vtkSilhouetteEvaluator> evaluator;
    evaluator->SetInputConnection(0, cubes->GetOutputPort());
    evaluator->SetViewsData(this->Views);
    evaluator->Update();
    return evaluator->GetOutput()->GetFieldData()->GetArray("MeanXOR")->GetComponent(0, 0);
  }
};

} // namespace

TEST_F(VtkCapturesOfOtherPrograms, MatricesAreTheRings)
{
  this->writeImages(bentDisc({255}));
  const Listener listener(this->Reader);
  this->Reader->Update();
  EXPECT_TRUE(listener.silent());
  ASSERT_EQ(this->Reader->GetOutput()->GetNumberOfPartitionedDataSets(), 8u);
  for (unsigned int i = 0; i < 8; ++i)
  {
    EXPECT_EQ(field(this->output(i), "SignIsFree"), 0);
    for (int n = 0; n < 12; ++n)
    {
      EXPECT_NEAR(this->output(i)->GetFieldData()->GetArray("Projection")->GetComponent(0, n),
                  this->image(i)->GetFieldData()->GetArray("Projection")->GetComponent(0, n), 1e-9);
    }
  }
  EXPECT_EQ(vtkSilhouetteCaptureReader::CanReadFile((this->Folder / "transforms.json").c_str()), 1);
}

TEST_F(VtkCapturesOfOtherPrograms, LensesAreTakenOut)
{
  this->writeImages(bentDisc({255}));
  const double pixels = this->pixelShare(), mesh = this->meshShare();
  EXPECT_LT(pixels, 0.02) << "of the contour's pixels, a fourteenth of the disc, some are drawn over into their neighbours";
  EXPECT_LT(mesh, 0.02);
  this->writeTransforms(Straight);
  this->Reader->Modified();
  EXPECT_GT(this->pixelShare(), 0.05) << "the same images, taken for a pinhole's";
  EXPECT_GT(this->meshShare(), 2.0 * mesh);
}

TEST_F(VtkCapturesOfOtherPrograms, AlphaAndMasks)
{
  this->writeImages(bentDisc({200, 100, 50, 255})); // as NeRF's synthetic captures
  EXPECT_LT(this->pixelShare(), 0.02);
  EXPECT_EQ(this->output(0)->GetNumberOfScalarComponents(), 4);
  this->writeImages(plainImage(ImageSize, ImageSize, 77, 3));
  fs::create_directories(this->Folder / "masks");
  for (const unsigned char object : {1, 255})
  {
    for (unsigned int i = 0; i < 8; ++i)
    {
      writeImage<vtkPNGWriter>(bentDisc({object}), this->Folder / "masks" / this->name(i));
    }
    this->Reader->Modified();
    EXPECT_LT(this->pixelShare(), 0.02);
    EXPECT_EQ(field(this->output(0), "IsMask"), 1);
    EXPECT_EQ(this->output(0)->GetScalarRange()[1], object);
  }
}

TEST_F(VtkCapturesOfOtherPrograms, Refuses)
{
  this->writeImages(bentDisc({255}));
  this->writeTransforms(Bent, ", \"w\": 97, \"h\": 96");
  expectError(this->Reader, {"image " + (this->Folder / "images/disc0.png").string() + " has 96 x 96 pixels, its camera is for 97 x 96"});
  this->writeTransforms(Bent, ", \"k4\": 0.1");
  expectError(this->Reader, {(this->Folder / "transforms.json").string() + " frame 0, 'images/disc0.png': k4 is 0.1; "});
  this->writeTransforms(Bent);
  this->Reader->SetPixelFamilyToCorner();
  expectError(this->Reader, {"transforms.json: its format, transforms.json, states its pixel family, corner; "});
  this->Reader->SetPixelFamilyToInteger();
  fs::remove(this->Folder / "images/disc4.png");
  expectError(this->Reader, {"transforms.json frame 4, 'images/disc4.png': image 'images/disc4.png' is missing"});
}
