// SPDX-License-Identifier: BSD-3-Clause
#include "TiffFile.h"

#include "Error.h"

#include "vtkImageData.h"

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

extern "C"
{
#include "vtk_tiff.h"
}

namespace silhouette::modeling
{
namespace
{

/** An open file, at its first image. */
class Tiff
{
public:
  explicit Tiff(const std::filesystem::path& file)
      : File(file), Handle(open(file), TIFFClose)
  {
    if (!this->Handle)
    {
      this->fail("its header is broken");
    }
    this->checkImages();
    std::uint32_t width = 0, height = 0;
    TIFFGetField(this->get(), TIFFTAG_IMAGEWIDTH, &width);
    TIFFGetField(this->get(), TIFFTAG_IMAGELENGTH, &height);
    constexpr std::uint32_t largest = 1000000;
    constexpr double most = 2e5; // pixels for a byte of the file: an empty fax of 10,000 x 10,000 has a third of that
    const bool isPacked = this->field(TIFFTAG_COMPRESSION) != COMPRESSION_NONE;
    if (width - 1 >= largest || height - 1 >= largest ||
        double(width) * height > (isPacked ? most : 8.0) * double(std::filesystem::file_size(file)))
    {
      this->fail("its size makes no sense");
    }
    std::uint16_t orientation = ORIENTATION_TOPLEFT;
    TIFFGetFieldDefaulted(this->get(), TIFFTAG_ORIENTATION, &orientation);
    if (orientation > ORIENTATION_BOTLEFT)
    {
      this->fail("its rows stand for columns (orientation " + std::to_string(orientation) +
                 "); a copy that is turned can be read");
    }
    this->Size = {int(width), int(height)};
  }

  const std::array<int, 2>& size() const { return this->Size; }

  /** Red, green, blue and opacity of all pixels, the lowest row first, in the bytes of a word each, the lowest first. */
  std::vector<std::uint32_t> pixels() const
  {
    char why[1024] = "";
    if (!TIFFRGBAImageOK(this->get(), why))
    {
      this->fail(why);
    }
    std::vector<std::uint32_t> pixels(std::size_t(this->Size[0]) * std::size_t(this->Size[1]));
    const int stopAtErrors = 1;
    if (!TIFFReadRGBAImageOriented(this->get(), std::uint32_t(this->Size[0]), std::uint32_t(this->Size[1]),
                                   pixels.data(), ORIENTATION_BOTLEFT, stopAtErrors))
    {
      this->fail("it is damaged, or ends too soon");
    }
    return pixels;
  }

  /** Whether the file has values of 16 bits, in rows that can be read one by one. */
  bool hasWideRows() const
  {
    return this->field(TIFFTAG_BITSPERSAMPLE) == 16 && this->field(TIFFTAG_PHOTOMETRIC) == PHOTOMETRIC_MINISBLACK && !TIFFIsTiled(this->get()) &&
           TIFFScanlineSize(this->get()) == tmsize_t(this->Size[0]) * 2;
  }

  /** The values of such rows as 8 bits, by 257, but where there are only zeros and ones as they are; the lowest row first. */
  std::vector<unsigned char> wideRows() const
  {
    const auto width = std::size_t(this->Size[0]), height = std::size_t(this->Size[1]);
    std::uint16_t orientation = ORIENTATION_TOPLEFT;
    TIFFGetFieldDefaulted(this->get(), TIFFTAG_ORIENTATION, &orientation);
    const bool fromTop = orientation == ORIENTATION_TOPLEFT || orientation == ORIENTATION_TOPRIGHT;
    const bool fromRight = orientation == ORIENTATION_TOPRIGHT || orientation == ORIENTATION_BOTRIGHT;
    std::vector<std::uint16_t> values(width * height);
    for (std::size_t r = 0; r < height; ++r)
    {
      std::uint16_t* const row = &values[width * (fromTop ? height - 1 - r : r)];
      if (TIFFReadScanline(this->get(), row, std::uint32_t(r), 0) < 0)
      {
        this->fail("it is damaged, or ends too soon");
      }
      if (fromRight)
      {
        std::reverse(row, row + width);
      }
    }
    const bool isMask = std::all_of(values.begin(), values.end(), [](std::uint16_t value) { return value <= 1; });
    std::vector<unsigned char> bytes(values.size());
    std::transform(values.begin(), values.end(), bytes.begin(),
                   [isMask](std::uint16_t value) { return static_cast<unsigned char>(isMask ? value : (value + 128) / 257); });
    return bytes;
  }

  bool isGrey() const
  {
    const std::uint16_t kind = this->field(TIFFTAG_PHOTOMETRIC);
    return kind == PHOTOMETRIC_MINISBLACK || kind == PHOTOMETRIC_MINISWHITE;
  }

  bool hasOpacity() const
  {
    std::uint16_t count = 0;
    std::uint16_t* kinds = nullptr;
    TIFFGetFieldDefaulted(this->get(), TIFFTAG_EXTRASAMPLES, &count, &kinds);
    return count > 0 && (kinds[0] == EXTRASAMPLE_ASSOCALPHA || kinds[0] == EXTRASAMPLE_UNASSALPHA);
  }

private:
  static TIFF* open(const std::filesystem::path& file)
  {
    // As VTK's reader does, since these print; once, since they are everybody's and files are read side by side.
    [[maybe_unused]] static const auto formerErrors = TIFFSetErrorHandler(nullptr);
    [[maybe_unused]] static const auto formerWarnings = TIFFSetWarningHandler(nullptr);
    return TIFFOpen(file.c_str(), "r");
  }

  TIFF* get() const { return this->Handle.get(); }

  std::uint16_t field(std::uint32_t tag) const
  {
    std::uint16_t value = 0xffff;
    TIFFGetField(this->get(), tag, &value);
    return value;
  }

  /** Small copies of an image may follow it, other images not. */
  void checkImages()
  {
    int images = 0;
    do
    {
      std::uint32_t kind = 0;
      TIFFGetFieldDefaulted(this->get(), TIFFTAG_SUBFILETYPE, &kind);
      images += (kind & FILETYPE_REDUCEDIMAGE) == 0;
    } while (TIFFReadDirectory(this->get()));
    if (images != 1 || !TIFFSetDirectory(this->get(), 0))
    {
      this->fail("it holds " + std::to_string(images) + " images, not one");
    }
  }

  [[noreturn]] void fail(const std::string& why) const
  {
    throw InvalidInput("cannot read image " + this->File.string() + ": " + why);
  }

  std::filesystem::path File;
  std::unique_ptr<TIFF, void (*)(TIFF*)> Handle;
  std::array<int, 2> Size{};
};

} // namespace

bool isTiffFile(const std::filesystem::path& file)
{
  char start[4] = {};
  std::ifstream(file, std::ios::binary).read(start, 4);
  const std::string bytes(start, 4);
  return bytes == std::string("II*\0", 4) || bytes == std::string("MM\0*", 4) ||
         bytes == std::string("II+\0", 4) || bytes == std::string("MM\0+", 4);
}

vtkSmartPointer<vtkImageData> readTiff(const std::filesystem::path& file)
{
  const Tiff tiff(file);
  const int colours = tiff.isGrey() ? 1 : 3, channels = colours + (tiff.hasOpacity() ? 1 : 0);
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(tiff.size()[0], tiff.size()[1], 1);
  image->AllocateScalars(VTK_UNSIGNED_CHAR, channels);
  auto* out = static_cast<unsigned char*>(image->GetScalarPointer());
  if (channels == 1 && tiff.hasWideRows())
  {
    const std::vector<unsigned char> bytes = tiff.wideRows(); // libtiff's own 8 bits cut off, and a 255 would be nothing
    std::copy(bytes.begin(), bytes.end(), out);
    return image;
  }
  const std::vector<std::uint32_t> pixels = tiff.pixels();
  for (const std::uint32_t pixel : pixels)
  {
    const unsigned char parts[4] = {static_cast<unsigned char>(TIFFGetR(pixel)), static_cast<unsigned char>(TIFFGetG(pixel)),
                                    static_cast<unsigned char>(TIFFGetB(pixel)), static_cast<unsigned char>(TIFFGetA(pixel))};
    for (int channel = 0; channel < channels; ++channel)
    {
      *out++ = channel < colours ? parts[channel] : parts[3];
    }
  }
  return image;
}

std::array<int, 2> readTiffSize(const std::filesystem::path& file)
{
  return Tiff(file).size();
}

} // namespace silhouette::modeling
