// SPDX-License-Identifier: BSD-3-Clause
// VTK's PNG writer knows no palettes, and makes files three times as large.
#include "Pictures.h"

#include "Error.h"

#include "vtkImageData.h"
#include "vtkImageQuantizeRGBToIndex.h"
#include "vtkLookupTable.h"
#include "vtkNew.h"
#include "vtkZLibDataCompressor.h"

#include <algorithm>
#include <cmath>
#include <fstream>

namespace silhouette::experiments
{
namespace
{

using Bytes = std::vector<std::uint8_t>;

void appendNumber(Bytes& bytes, std::uint32_t number)
{
  for (int shift = 24; shift >= 0; shift -= 8)
  {
    bytes.push_back(std::uint8_t(number >> shift));
  }
}

/** The check sum that PNG asks for: CRC-32, bit by bit. */
std::uint32_t checkSum(const Bytes& bytes)
{
  std::uint32_t sum = 0xffffffffu;
  for (const std::uint8_t byte : bytes)
  {
    sum ^= byte;
    for (int bit = 0; bit < 8; ++bit)
    {
      sum = sum >> 1 ^ ((sum & 1) != 0 ? 0xedb88320u : 0);
    }
  }
  return ~sum;
}

void appendChunk(Bytes& file, const std::string& kind, const Bytes& data)
{
  appendNumber(file, std::uint32_t(data.size()));
  Bytes body(kind.begin(), kind.end());
  body.insert(body.end(), data.begin(), data.end());
  file.insert(file.end(), body.begin(), body.end());
  appendNumber(file, checkSum(body));
}

/** The picture's rows as indices into a palette, each after a byte that says that it is stored as it is. */
struct Indexed
{
  Bytes rows;
  Bytes palette;
};

Indexed quantize(const Picture& picture)
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(picture.width, picture.height, 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, 3);
  std::copy(picture.pixels.begin(), picture.pixels.end(),
            static_cast<std::uint8_t*>(image->GetScalarPointer()));
  vtkNew<vtkImageQuantizeRGBToIndex> quantize;
  quantize->SetInputData(image);
  quantize->SetNumberOfColors(256);
  quantize->Update();
  Indexed result;
  const auto* index = static_cast<const std::uint16_t*>(quantize->GetOutput()->GetScalarPointer());
  for (int row = 0; row < picture.height; ++row)
  {
    result.rows.push_back(0);
    for (int column = 0; column < picture.width; ++column)
    {
      result.rows.push_back(std::uint8_t(*index++));
    }
  }
  vtkLookupTable* table = quantize->GetLookupTable();
  for (vtkIdType colour = 0; colour < table->GetNumberOfTableValues(); ++colour)
  {
    for (int channel = 0; channel < 3; ++channel)
    {
      result.palette.push_back(std::uint8_t(std::lround(255.0 * table->GetTableValue(colour)[channel])));
    }
  }
  return result;
}

Bytes compressed(const Bytes& bytes)
{
  vtkNew<vtkZLibDataCompressor> compressor;
  compressor->SetCompressionLevel(9);
  Bytes result(compressor->GetMaximumCompressionSpace(bytes.size()));
  result.resize(compressor->Compress(bytes.data(), bytes.size(), result.data(), result.size()));
  return result;
}

} // namespace

void writePng(const Picture& picture, const std::filesystem::path& file)
{
  const Indexed indexed = quantize(picture);
  Bytes bytes = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n'};
  Bytes head;
  appendNumber(head, std::uint32_t(picture.width));
  appendNumber(head, std::uint32_t(picture.height));
  head.insert(head.end(), {8, 3, 0, 0, 0}); // eight bits a pixel, a palette
  appendChunk(bytes, "IHDR", head);
  appendChunk(bytes, "PLTE", indexed.palette);
  appendChunk(bytes, "IDAT", compressed(indexed.rows));
  appendChunk(bytes, "IEND", {});
  std::ofstream stream(file, std::ios::binary);
  stream.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
  if (!stream)
  {
    throw InvalidInput("cannot write " + file.string());
  }
}

} // namespace silhouette::experiments
