// SPDX-License-Identifier: BSD-3-Clause
#include "CaptureFiles.h"

#include "ExitCodes.h"
#include "Interrupt.h"
#include "Metrics.h"
#include "OutputFiles.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"

#include <limits>
#include <locale>
#include <sstream>

namespace silhouette::program
{
namespace
{

std::string imageName(const std::string& view)
{
  return std::filesystem::path(view).stem().string() + ".png";
}

} // namespace

void writeImages(vtkPartitionedDataSetCollection* views, const std::filesystem::path& folder)
{
  std::error_code error;
  std::filesystem::create_directory(folder, error);
  const std::vector<std::string> names = viewNames(views);
  for (unsigned int i = 0; i < views->GetNumberOfPartitionedDataSets(); ++i)
  {
    checkInterrupt();
    const std::filesystem::path file = folder / imageName(names[i]);
    vtkNew<vtkPNGWriter> writer;
    writer->SetInputData(views->GetPartitionedDataSet(i)->GetPartition(0));
    writer->SetFileName(file.c_str());
    writer->Write();
    if (writer->GetErrorCode() != 0 || !std::filesystem::exists(file))
    {
      throw ProgramError(FileFailed, "cannot write image " + file.string() + "; is the disk full?");
    }
  }
}

void writeProjections(vtkPartitionedDataSetCollection* views, const std::filesystem::path& file)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(std::numeric_limits<double>::max_digits10);
  const std::vector<std::string> names = viewNames(views);
  for (unsigned int i = 0; i < views->GetNumberOfPartitionedDataSets(); ++i)
  {
    vtkDataArray* matrix = views->GetPartitionedDataSet(i)->GetPartition(0)->GetFieldData()->GetArray("Projection");
    text << imageName(names[i]);
    for (int n = 0; n < 12; ++n)
    {
      text << ' ' << matrix->GetVariantValue(n).ToDouble();
    }
    text << '\n';
  }
  writeText(file, text.str());
}

} // namespace silhouette::program
