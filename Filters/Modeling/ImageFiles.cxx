// SPDX-License-Identifier: BSD-3-Clause
#include "ImageFiles.h"

#include "Error.h"
#include "ImageFileCheck.h"
#include "MessageListener.h"
#include "TiffFile.h"

#include "vtkBMPReader.h"
#include "vtkExecutive.h"
#include "vtkImageData.h"
#include "vtkJPEGReader.h"
#include "vtkNew.h"
#include "vtkPNGReader.h"
#include "vtkPNMReader.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"

#include <algorithm>
#include <string>

namespace silhouette::modeling
{
namespace
{

template <typename Reader> vtkSmartPointer<vtkImageReader2> readerIfItFits(const char* file)
{
  auto reader = vtkSmartPointer<Reader>::New();
  const MessageListener quiet({reader, reader->GetExecutive()});
  return reader->CanReadFile(file) ? vtkSmartPointer<vtkImageReader2>(reader) : nullptr;
}

vtkSmartPointer<vtkImageReader2> makeReader(const std::filesystem::path& file, ImageFileScope scope,
                                            std::vector<std::string>& warnings)
{
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
  {
    throw InvalidInput("cannot read image " + file.string() + ": no such file");
  }
  const std::string name = file.string();
  const ImageFileReport report = inspectImageFile(file, scope);
  if (!report.fault.empty())
  {
    throw InvalidInput("cannot read image " + name + ": " + report.fault);
  }
  if (report.orientation != 1)
  {
    warnings.push_back("image " + name + ": its Exif orientation is " + std::to_string(report.orientation) +
                       ", not 1; its pixels are taken as they are stored, and so has its matrix to be");
  }
  using Candidate = vtkSmartPointer<vtkImageReader2> (*)(const char*);
  for (const Candidate candidate :
       {Candidate(readerIfItFits<vtkPNGReader>), Candidate(readerIfItFits<vtkJPEGReader>),
        Candidate(readerIfItFits<vtkPNMReader>), Candidate(readerIfItFits<vtkBMPReader>)})
  {
    if (auto reader = candidate(name.c_str()))
    {
      reader->SetFileName(name.c_str());
      return reader;
    }
  }
  throw InvalidInput("cannot read image " + name +
                     ": not a PNG, JPEG, PNM, BMP or TIFF image, or a broken one");
}

void eightBits(vtkUnsignedShortArray* wide, vtkImageData* image)
{
  vtkNew<vtkUnsignedCharArray> narrow;
  narrow->SetNumberOfComponents(wide->GetNumberOfComponents());
  narrow->SetNumberOfTuples(wide->GetNumberOfTuples());
  const unsigned short* values = wide->GetPointer(0);
  const vtkIdType count = wide->GetNumberOfValues();
  const bool isBinary = std::all_of(values, values + count, [](unsigned short value) { return value <= 1; }); // 1 is object
  for (vtkIdType i = 0; i < count; ++i)
  {
    narrow->SetValue(i, static_cast<unsigned char>(isBinary ? values[i] : (values[i] + 128u) / 257u));
  }
  image->GetPointData()->SetScalars(narrow);
}

} // namespace

vtkSmartPointer<vtkImageData> readImage(const std::filesystem::path& file, std::vector<std::string>& warnings)
{
  if (isTiffFile(file))
  {
    return readTiff(file);
  }
  const auto reader = makeReader(file, ImageFileScope::Whole, warnings);
  const MessageListener listener({reader, reader->GetExecutive()});
  reader->Update();
  if (listener.heardError() || reader->GetErrorCode() != 0)
  {
    throw InvalidInput("cannot read image " + file.string() + ": " + listener.error());
  }
  if (!listener.warning().empty())
  {
    warnings.push_back("image " + file.string() + ": " + listener.warning());
  }
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->ShallowCopy(reader->GetOutput());
  int size[3];
  image->GetDimensions(size);
  vtkDataArray* scalars = image->GetPointData()->GetScalars();
  if (size[0] < 1 || size[1] < 1 || size[2] != 1 || !scalars || scalars->GetNumberOfComponents() > 4)
  {
    throw InvalidInput("cannot read image " + file.string() + ": it is not one image of 1 to 4 channels");
  }
  if (auto* wide = vtkUnsignedShortArray::SafeDownCast(scalars))
  {
    eightBits(wide, image);
  }
  else if (!vtkUnsignedCharArray::SafeDownCast(scalars))
  {
    throw InvalidInput("cannot read image " + file.string() + ": its values are of type " +
                       scalars->GetDataTypeAsString() + ", 8 or 16 bits without sign are understood");
  }
  return image;
}

std::array<int, 2> readImageSize(const std::filesystem::path& file)
{
  if (isTiffFile(file))
  {
    return readTiffSize(file);
  }
  std::vector<std::string> ignored;
  const auto reader = makeReader(file, ImageFileScope::Header, ignored);
  const MessageListener listener({reader, reader->GetExecutive()});
  reader->UpdateInformation();
  if (listener.heardError())
  {
    throw InvalidInput("cannot read image " + file.string() + ": " + listener.error());
  }
  int extent[6];
  reader->GetDataExtent(extent);
  return {extent[1] - extent[0] + 1, extent[3] - extent[2] + 1};
}

} // namespace silhouette::modeling
