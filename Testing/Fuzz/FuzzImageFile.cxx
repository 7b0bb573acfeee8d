// SPDX-License-Identifier: BSD-3-Clause
/** A small image file of some format that is changed in places: InvalidInput, or an image of 1 to 4 channels of 8 bits. */
#include "Error.h"
#include "ImageFiles.h"

#include "vtkBMPWriter.h"
#include "vtkImageData.h"
#include "vtkJPEGWriter.h"
#include "vtkNew.h"
#include "vtkPNGWriter.h"
#include "vtkPNMWriter.h"
#include "vtkTIFFWriter.h"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include <unistd.h>

namespace
{

std::filesystem::path temporaryFile()
{
  return std::filesystem::temp_directory_path() / ("silhouette-fuzz-image-" + std::to_string(getpid()));
}

std::string contentOf(const std::filesystem::path& file)
{
  std::ifstream stream(file, std::ios::binary);
  return { std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>() };
}

template <typename Writer>
std::string written(int channels, const char* extension)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(11, 7, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, channels);
  auto* values = static_cast<unsigned char*>(image->GetScalarPointer());
  for (int n = 0; n < 77 * channels; ++n)
  {
    values[n] = static_cast<unsigned char>(37 * n);
  }
  const std::string file = temporaryFile().string() + extension;
  vtkNew<Writer> writer;
  writer->SetInputData(image);
  writer->SetFileName(file.c_str());
  writer->Write();
  std::string content = contentOf(file);
  std::filesystem::remove(file);
  return content;
}

std::uint32_t bigEndian(const std::string& bytes, std::size_t at)
{
  std::uint32_t number = 0;
  for (std::size_t n = at; n < at + 4; ++n)
  {
    number = number << 8 | static_cast<unsigned char>(bytes[n]);
  }
  return number;
}

/** Give the chunks of a PNG file the checksums of what they hold, as far as they can be followed. */
void sumChunks(std::string& png)
{
  for (std::size_t at = 8; at + 12 <= png.size();)
  {
    const std::size_t end = at + 8 + bigEndian(png, at);
    if (end + 4 > png.size())
    {
      return;
    }
    std::uint32_t sum = 0xffffffffu;
    for (std::size_t n = at + 4; n < end; ++n)
    {
      sum ^= static_cast<unsigned char>(png[n]);
      for (int bit = 0; bit < 8; ++bit)
      {
        sum = sum >> 1 ^ ((sum & 1) != 0 ? 0xedb88320u : 0);
      }
    }
    for (int n = 0; n < 4; ++n)
    {
      png[end + std::size_t(n)] = char(~sum >> (24 - 8 * n));
    }
    at = end + 4;
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  static const std::vector<std::string> files = { written<vtkPNGWriter>(1, ".png"), written<vtkPNGWriter>(4, ".png"),
    written<vtkJPEGWriter>(1, ".jpg"), written<vtkJPEGWriter>(3, ".jpg"), written<vtkBMPWriter>(3, ".bmp"),
    written<vtkTIFFWriter>(1, ".tif"), written<vtkTIFFWriter>(3, ".tif"), written<vtkPNMWriter>(1, ".pgm"), written<vtkPNMWriter>(3, ".ppm") };
  if (size < 2)
  {
    return 0;
  }
  std::string content = files[data[0] % files.size()];
  for (std::size_t n = 2; n + 3 < size && n < 2 + 4 * 6u && !content.empty(); n += 4)
  {
    const std::size_t at = (data[n] + 256u * data[n + 1]) % content.size();
    switch (data[n + 2] % 8)
    {
      case 0: content.erase(at, 1 + data[n + 3] % 9u); break;
      case 1: content.insert(at, 1, char(data[n + 3])); break;
      case 2: content.resize(at); break;
      default: content[at] = char(data[n + 3]);
    }
  }
  if (data[1] % 4 != 0)
  {
    sumChunks(content);
  }
  const std::filesystem::path file = temporaryFile();
  std::ofstream(file, std::ios::binary) << content;
  try
  {
    std::vector<std::string> warnings;
    silhouette::modeling::readImageSize(file);
    const auto image = silhouette::modeling::readImage(file, warnings);
    const int channels = image->GetNumberOfScalarComponents();
    if (image->GetScalarType() != VTK_UNSIGNED_CHAR || channels < 1 || channels > 4 || image->GetNumberOfPoints() < 1)
    {
      std::abort();
    }
  }
  catch (const silhouette::Error&)
  {
  }
  std::filesystem::remove(file);
  return 0;
}
