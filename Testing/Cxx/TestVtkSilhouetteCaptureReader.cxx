// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSilhouetteCaptureReader.h"

#include "ModelingTesting.h"
#include "vtkSilhouetteExtractor.h"
#include "vtkSilhouetteOctreeSource.h"

#include "vtkBMPWriter.h"
#include "vtkCellData.h"
#include "vtkHyperTreeGrid.h"
#include "vtkImageWriter.h"
#include "vtkJPEGWriter.h"
#include "vtkPNGWriter.h"
#include "vtkPNMWriter.h"
#include "vtkTIFFWriter.h"

#include <filesystem>
#include <fstream>
#include <iomanip>

using namespace silhouette::testing;
namespace fs = std::filesystem;

namespace
{

template <typename Writer> void writeImage(vtkImageData* image, const fs::path& file)
{
  vtkNew<Writer> writer;
  writer->SetInputData(image);
  writer->SetFileName(file.c_str());
  writer->Write();
}

/** A folder of a test's own, with eight disc masks and a P list. */
class VtkSilhouetteCaptureReader : public ::testing::Test
{
protected:
  void SetUp() override
  {
    this->Folder =
        fs::path(SILHOUETTE_TEMPORARY_DIR) /
        (std::string("capture-") + ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(this->Folder);
    fs::create_directories(this->Folder / "images");
    fs::create_directories(this->Folder / "masks");
    this->Views = ringViews();
    this->writeProjections(1.0);
    for (unsigned int i = 0; i < 8; ++i)
    {
      writeImage<vtkPNGWriter>(this->image(i), this->Folder / "masks" / this->name(i));
    }
    this->Reader->SetFileName(this->Folder.c_str());
  }
  void TearDown() override { fs::remove_all(this->Folder); }

  vtkImageData* image(unsigned int i) { return vtkImageData::SafeDownCast(this->Views->GetPartition(i, 0)); }
  std::string name(unsigned int i) { return "disc" + std::to_string(i) + ".png"; }

  /** The P list, with each second matrix times `factor`. */
  void writeProjections(double factor)
  {
    std::ofstream file(this->Folder / "projections.txt");
    file << std::setprecision(17);
    for (unsigned int i = 0; i < 8; ++i)
    {
      file << this->name(i);
      for (int n = 0; n < 12; ++n)
      {
        file << " "
             << (i % 2 ? factor : 1.0) *
                    this->image(i)->GetFieldData()->GetArray("Projection")->GetComponent(0, n);
      }
      file << "\n";
    }
  }

  vtkImageData* output(unsigned int i)
  {
    return vtkImageData::SafeDownCast(this->Reader->GetOutput()->GetPartition(i, 0));
  }

  fs::path Folder;
  vtkSmartPointer<vtkPartitionedDataSetCollection> Views;
  vtkNew<vtkSilhouetteCaptureReader> Reader;
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

TEST_F(VtkSilhouetteCaptureReader, ReadsEveryImageFormat)
{
  auto image = discImage(ImageSize, 30.0);
  vtkNew<vtkImageData> wide;
  wide->SetDimensions(ImageSize, ImageSize, 1);
  wide->AllocateScalars(VTK_UNSIGNED_SHORT, 1);
  for (int i = 0; i < ImageSize * ImageSize; ++i)
  {
    static_cast<unsigned short*>(wide->GetScalarPointer())[i] =
        static_cast<unsigned short>(257 * static_cast<unsigned char*>(image->GetScalarPointer())[i]);
  }
  fs::remove_all(this->Folder / "masks");
  fs::create_directories(this->Folder / "masks");
  writeImage<vtkPNGWriter>(wide, this->Folder / "masks/disc0.png");
  writeImage<vtkJPEGWriter>(image, this->Folder / "masks/disc1.jpg");
  writeImage<vtkPNMWriter>(image, this->Folder / "masks/disc2.pgm");
  writeImage<vtkBMPWriter>(image, this->Folder / "masks/disc3.bmp");
  writeImage<vtkTIFFWriter>(image, this->Folder / "masks/disc4.tif");
  this->Reader->SetViews("0-4");
  const Listener listener(this->Reader);
  this->Reader->Update();
  EXPECT_TRUE(listener.silent());
  ASSERT_EQ(this->Reader->GetOutput()->GetNumberOfPartitionedDataSets(), 5u);
  for (unsigned int i = 0; i < 5; ++i)
  {
    vtkImageData* found = this->output(i);
    ASSERT_EQ(found->GetScalarType(), VTK_UNSIGNED_CHAR);
    for (int y = 0; y < ImageSize; y += 5)
    {
      for (int x = 0; x < ImageSize; x += 5)
      {
        const int expected = *static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
        ASSERT_NEAR(*static_cast<unsigned char*>(found->GetScalarPointer(x, y, 0)), expected, 100) << i;
      }
    }
  }
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

TEST_F(VtkSilhouetteCaptureReader, SurvivesBrokenImages)
{
  // Each format whole, then cut short at many places, then with a byte changed.
  auto image = discImage(64, 20.0);
  fs::remove_all(this->Folder / "masks");
  fs::create_directories(this->Folder / "masks");
  this->Reader->SetViews("2");
  const auto tryAll = [&](const fs::path& file)
  {
    const auto size = fs::file_size(file);
    std::ifstream stream(file, std::ios::binary);
    const std::string whole{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    this->Reader->Modified();
    this->Reader->Update();
    ASSERT_EQ(this->Reader->GetOutput()->GetNumberOfPartitionedDataSets(), 1u) << file;
    for (const double share : {0.0, 0.02, 0.1, 0.3, 0.6, 0.9})
    {
      std::ofstream(file, std::ios::binary) << whole.substr(0, std::size_t(share * double(size)));
      expectError(this->Reader, {"cannot read image", file.filename().string()});
    }
    for (std::size_t at = 0; at < whole.size(); at += whole.size() / 40 + 1)
    {
      std::string changed = whole;
      changed[at] = char(changed[at] ^ 0x5a);
      std::ofstream(file, std::ios::binary) << changed;
      const Listener listener(this->Reader);
      this->Reader->Modified();
      this->Reader->Update(); // an image or an error, but no crash
    }
    fs::remove(file);
  };
  writeImage<vtkPNGWriter>(image, this->Folder / "masks/disc2.png");
  tryAll(this->Folder / "masks/disc2.png");
  writeImage<vtkJPEGWriter>(image, this->Folder / "masks/disc2.jpg");
  tryAll(this->Folder / "masks/disc2.jpg");
  writeImage<vtkPNMWriter>(image, this->Folder / "masks/disc2.pgm");
  tryAll(this->Folder / "masks/disc2.pgm");
  std::ofstream(this->Folder / "masks/disc2.pgm") << "P5 2 2 65535\n12345678";
  expectError(this->Reader, {"disc2.pgm", "more than 8 bits"});
  std::ofstream(this->Folder / "masks/disc2.pgm") << "P2\n2 2\n255\n0 1 2 3\n";
  expectError(this->Reader, {"disc2.pgm", "P5 and P6"});
}
