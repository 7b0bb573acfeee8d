// SPDX-License-Identifier: BSD-3-Clause
/** What the tests of captures read from files share: a folder of a test's own, and its reader. */
#pragma once

#include "ModelingTesting.h"
#include "vtkSilhouetteCaptureReader.h"

#include "vtkPNGWriter.h"

#include <filesystem>
#include <fstream>
#include <iomanip>

namespace silhouette::testing
{

namespace fs = std::filesystem;

template <typename Writer> void writeImage(vtkImageData* image, const fs::path& file)
{
  vtkNew<Writer> writer;
  writer->SetInputData(image);
  writer->SetFileName(file.c_str());
  writer->Write();
}

/** A folder of a test's own, with eight disc masks and a P list. */
class CaptureReaderTest : public ::testing::Test
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

} // namespace silhouette::testing
