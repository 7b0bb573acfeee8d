// SPDX-License-Identifier: BSD-3-Clause
/** Image files of every kind, whole, broken and made to mislead, as the capture reader finds them. */
#include "CaptureReaderTesting.h"

#include "vtkBMPWriter.h"
#include "vtkJPEGWriter.h"
#include "vtkPNMWriter.h"
#include "vtkTIFFWriter.h"
#include "vtkZLibDataCompressor.h"

#include <algorithm>
#include <iterator>

using namespace silhouette::testing;

namespace
{

/** A PNG file of one's own, as good or as bad as wanted. */
struct PngFile
{
  std::uint32_t width = 4, height = 4;
  int depth = 8, colour = 0, interlacing = 0;
  std::string rows = std::string(20, '\0'); ///< what is compressed
  std::string before;                       ///< chunks before the pixels
  std::string after;                        ///< and after them
  bool wrongSum = false;

  static std::string number(std::uint32_t n)
  {
    return {char(n >> 24), char(n >> 16), char(n >> 8), char(n)};
  }

  static std::string chunk(const std::string& type, const std::string& data)
  {
    std::uint32_t sum = 0xffffffffu;
    for (const char c : type + data)
    {
      sum ^= static_cast<unsigned char>(c);
      for (int bit = 0; bit < 8; ++bit)
      {
        sum = sum >> 1 ^ ((sum & 1) != 0 ? 0xedb88320u : 0);
      }
    }
    return number(std::uint32_t(data.size())) + type + data + number(~sum);
  }

  std::string pixels() const
  {
    vtkNew<vtkZLibDataCompressor> zlib;
    std::string packed(zlib->GetMaximumCompressionSpace(this->rows.size()), '\0');
    packed.resize(zlib->Compress(reinterpret_cast<const unsigned char*>(this->rows.data()), this->rows.size(),
                                 reinterpret_cast<unsigned char*>(&packed[0]), packed.size()));
    packed.back() = char(packed.back() ^ (this->wrongSum ? 1 : 0));
    return packed;
  }

  std::string bytes() const
  {
    const std::string header = number(this->width) + number(this->height) + char(this->depth) +
                               char(this->colour) + std::string(2, '\0') + char(this->interlacing);
    return "\x89PNG\r\n\x1a\n" + chunk("IHDR", header) + this->before + chunk("IDAT", this->pixels()) +
           this->after + chunk("IEND", "");
  }
};

class ImageFiles : public CaptureReaderTest
{
};

} // namespace

TEST_F(ImageFiles, ReadsEveryImageFormat)
{
  // Another in each quarter, so that what is turned or mirrored shows.
  auto image = discImage(ImageSize, 30.0);
  for (int y = 0; y < ImageSize; ++y)
  {
    for (int x = 0; x < ImageSize; ++x)
    {
      const bool isRight = x > ImageSize / 2, isUpper = y > ImageSize / 2;
      auto* pixel = static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
      *pixel = isUpper && !isRight ? 255 : isUpper ? *pixel : isRight && x > y + 40 ? 255 : 0;
    }
  }
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
  vtkNew<vtkTIFFWriter> tiff;
  const auto writeTiff = [&](vtkImageData* content, int compression, const char* name)
  {
    vtkNew<vtkImageData> copy; // which compression may change
    copy->DeepCopy(content);
    tiff->SetInputData(copy);
    tiff->SetCompression(compression);
    tiff->SetFileName((this->Folder / "masks" / name).c_str());
    tiff->Write();
  };
  writeTiff(image, vtkTIFFWriter::NoCompression, "disc4.tif");
  writeTiff(image, vtkTIFFWriter::PackBits, "disc5.tif");
  writeTiff(image, vtkTIFFWriter::Deflate, "disc6.tif");
  writeTiff(wide, vtkTIFFWriter::PackBits, "disc7.tiff");
  this->Reader->SetViews("0-7");
  const Listener listener(this->Reader);
  this->Reader->Update();
  EXPECT_TRUE(listener.silent());
  ASSERT_EQ(this->Reader->GetOutput()->GetNumberOfPartitionedDataSets(), 8u);
  for (unsigned int i = 0; i < 8; ++i)
  {
    vtkImageData* found = this->output(i);
    ASSERT_EQ(found->GetScalarType(), VTK_UNSIGNED_CHAR);
    ASSERT_EQ(found->GetNumberOfScalarComponents(), i == 3 ? 3 : 1) << i; // BMP has colours
    for (int y = 0; y < ImageSize; y += 5)
    {
      for (int x = 0; x < ImageSize; x += 5)
      {
        const int expected = *static_cast<unsigned char*>(image->GetScalarPointer(x, y, 0));
        ASSERT_NEAR(*static_cast<unsigned char*>(found->GetScalarPointer(x, y, 0)), expected, 100) << i << ": " << x << " " << y;
      }
    }
  }
}

TEST_F(ImageFiles, RefusesTiffFilesThatCannotHoldTheirSize)
{
  fs::remove_all(this->Folder / "masks");
  fs::create_directories(this->Folder / "masks");
  this->Reader->SetViews("2");
  const fs::path file = this->Folder / "masks/disc2.tif";
  const auto write = [&](std::uint16_t width)
  {
    const auto bytes = [](std::uint32_t value, int count)
    {
      std::string text;
      for (int n = 0; n < count; ++n)
      {
        text += char(value >> 8 * n & 255);
      }
      return text;
    };
    // Of 100 rows, uncompressed, 8 bits a pixel, in one strip after the entries.
    const std::uint32_t entries[][3] = {{256, 3, width}, {257, 3, 100}, {258, 3, 8}, {259, 3, 1}, {262, 3, 1}, {273, 4, 122}, {277, 3, 1}, {278, 3, 100}, {279, 4, 10000}};
    std::string text = std::string("II*\0", 4) + bytes(8, 4) + bytes(9, 2);
    for (const auto& [tag, type, value] : entries)
    {
      text += bytes(tag, 2) + bytes(type, 2) + bytes(1, 4) + bytes(value, 4);
    }
    std::ofstream(file, std::ios::binary) << text + bytes(0, 4) + std::string(10000, char(255));
  };
  write(100);
  this->Reader->Modified();
  this->Reader->Update();
  ASSERT_EQ(this->Reader->GetOutput()->GetNumberOfPartitionedDataSets(), 1u);
  write(60000); // pixels for 6 MB
  expectError(this->Reader, {"cannot read image", "disc2.tif", "its size makes no sense"});
}

TEST_F(ImageFiles, RefusesPngFilesThatLibpngWouldGiveUp)
{
  fs::remove_all(this->Folder / "masks");
  fs::create_directories(this->Folder / "masks");
  this->Reader->SetViews("2");
  const fs::path file = this->Folder / "masks/disc2.png";
  const auto expectFault = [&](const PngFile& png, const std::string& fault)
  {
    std::ofstream(file, std::ios::binary) << png.bytes();
    expectError(this->Reader, {"cannot read image", "disc2.png", fault});
  };
  const auto expectSize = [&](const PngFile& png, int width, int height)
  {
    std::ofstream(file, std::ios::binary) << png.bytes();
    this->Reader->Modified();
    this->Reader->Update();
    ASSERT_EQ(this->Reader->GetOutput()->GetNumberOfPartitionedDataSets(), 1u) << png.rows.size();
    int size[3];
    vtkImageData::SafeDownCast(this->Reader->GetOutput()->GetPartition(0, 0))->GetDimensions(size);
    EXPECT_EQ(size[0], width);
    EXPECT_EQ(size[1], height);
  };
  PngFile png;
  expectSize(png, 4, 4);
  png.wrongSum = true;
  expectFault(png, "damaged");
  png = PngFile();
  png.rows.resize(19);
  expectFault(png, "not as many");
  png.rows.resize(25);
  expectFault(png, "not as many");
  png = PngFile();
  png.rows[15] = 5; // begins the last row
  expectFault(png, "filter");
  png = PngFile();
  png.width = png.height = 1000000; // a terabyte, from a handful of bytes
  expectFault(png, "not as many");
  png.width = 1000001;
  expectFault(png, "header makes no sense");
  png = PngFile();
  png.before = PngFile::chunk("JUNK", "?");
  expectFault(png, "chunk JUNK");
  png.before = PngFile::chunk("j?nk", "?");
  expectFault(png, "no name");
  png.before = PngFile::chunk("teXt", "a comment, of no importance");
  expectSize(png, 4, 4);
  png.after = PngFile::chunk("tEXt", "") + PngFile::chunk("IDAT", "more");
  expectFault(png, "not in one place");
  png = PngFile();
  png.colour = 3;
  expectFault(png, "no palette");
  png.before = PngFile::chunk("PLTE", "four");
  expectFault(png, "palette");
  png.before = PngFile::chunk("PLTE", std::string(6, 'c'));
  expectSize(png, 4, 4);
  png.before += png.before;
  expectFault(png, "palette");

  // Interlaced: seven small images, here of rows of 1, 1, 2, 2, 3, 3 and 6 pixels, five of the first, but none of what a narrow image has not.
  png = PngFile();
  png.interlacing = 1;
  png.width = 6;
  png.height = 9;
  png.rows = std::string(2 * 2 + 1 * 2 * 2 + 1 * 3 + 3 * 2 + 2 * 4 + 5 * 4 + 4 * 7, '\0');
  expectSize(png, 6, 9);
  png.rows.pop_back();
  expectFault(png, "not as many");
  png.interlacing = 0;
  png.width = 9; // pixels of one bit
  png.depth = 1;
  png.height = 2;
  png.rows = std::string(6, '\0');
  expectSize(png, 9, 2);
}

TEST_F(ImageFiles, OnesAreObjectInMasksOf16BitsToo)
{
  fs::remove_all(this->Folder / "masks");
  fs::create_directories(this->Folder / "masks");
  vtkNew<vtkImageData> wide;
  wide->SetDimensions(9, 5, 1);
  wide->AllocateScalars(VTK_UNSIGNED_SHORT, 1);
  auto* values = static_cast<unsigned short*>(wide->GetScalarPointer());
  for (const int greatest : {1, 2, 255, 65535})
  {
    std::fill_n(values, 45, static_cast<unsigned short>(0));
    values[0] = values[11] = static_cast<unsigned short>(greatest);
    writeImage<vtkPNGWriter>(wide, this->Folder / "masks/disc2.png");
    writeImage<vtkTIFFWriter>(wide, this->Folder / "masks/disc3.tif");
    this->Reader->SetViews("2,3");
    this->Reader->Modified();
    this->Reader->Update();
    ASSERT_EQ(this->Reader->GetOutput()->GetNumberOfPartitionedDataSets(), 2u);
    for (unsigned int i = 0; i < 2; ++i)
    {
      const auto* found = static_cast<unsigned char*>(this->output(i)->GetScalarPointer());
      const int expected = greatest == 1 ? 1 : (greatest + 128) / 257;
      EXPECT_EQ(int(found[0]), expected) << greatest << " " << i;
      EXPECT_EQ(int(found[11]), expected) << greatest << " " << i;
      EXPECT_EQ(std::count(found, found + 45, 0), expected > 0 ? 43 : 45) << greatest << " " << i;
    }
  }
}

TEST_F(ImageFiles, RefusesJpegOfInks)
{
  fs::remove_all(this->Folder / "masks");
  fs::create_directories(this->Folder / "masks");
  this->Reader->SetViews("2");
  const fs::path file = this->Folder / "masks/disc2.jpg";
  writeImage<vtkJPEGWriter>(discImage(64, 20.0), file);
  std::ifstream stream(file, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  const std::size_t frame = std::min(bytes.find("\xff\xc0"), bytes.find("\xff\xc2")); // baseline, or progressive
  ASSERT_NE(frame, std::string::npos);
  bytes[frame + 9] = 4; // components
  std::ofstream(file, std::ios::binary) << bytes;
  expectError(this->Reader, {"disc2.jpg", "CMYK"});
}

TEST_F(ImageFiles, WarnsOfOrientationsThatItDoesNotApply)
{
  fs::remove_all(this->Folder / "masks");
  fs::create_directories(this->Folder / "masks");
  this->Reader->SetViews("2");
  const auto exif = [](int orientation, bool isLittle)
  {
    // A TIFF header, and one entry: tag 0x112, a short.
    const std::string little = std::string("II*\0\x08\0\0\0\x01\0\x12\x01\x03\0\x01\0\0\0", 18) + char(orientation) + std::string(7, '\0');
    const std::string big = std::string("MM\0*\0\0\0\x08\0\x01\x01\x12\0\x03\0\0\0\x01\0", 19) + char(orientation) + std::string(6, '\0');
    return isLittle ? little : big;
  };
  const auto expectWarnings = [&](int orientation)
  {
    const Listener listener(this->Reader);
    this->Reader->Modified();
    this->Reader->Update();
    ASSERT_EQ(this->Reader->GetOutput()->GetNumberOfPartitionedDataSets(), 1u);
    EXPECT_EQ(listener.Warnings.size(), orientation == 1 ? 0u : 1u);
    EXPECT_EQ(listener.warnings("Exif orientation is " + std::to_string(orientation)), orientation == 1 ? 0 : 1);
  };
  const fs::path jpeg = this->Folder / "masks/disc2.jpg", png = this->Folder / "masks/disc2.png";
  writeImage<vtkJPEGWriter>(discImage(64, 20.0), jpeg);
  std::ifstream stream(jpeg, std::ios::binary);
  const std::string whole{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  for (const int orientation : {1, 3, 6, 8})
  {
    for (const bool isLittle : {true, false})
    {
      const std::string data = std::string("Exif\0\0", 6) + exif(orientation, isLittle);
      std::ofstream(jpeg, std::ios::binary) << whole.substr(0, 2) << "\xff\xe1" << '\0' << char(data.size() + 2) << data << whole.substr(2);
      expectWarnings(orientation);
    }
  }
  std::ofstream(jpeg, std::ios::binary) << whole.substr(0, 2) << "\xff\xe1" << std::string("\0\x10" "Exif\0\0II*\0\xff\xff\xff\xff", 16) << whole.substr(2);
  expectWarnings(1); // it leads nowhere
  fs::remove(jpeg);
  PngFile file;
  file.before = PngFile::chunk("eXIf", exif(6, false));
  std::ofstream(png, std::ios::binary) << file.bytes();
  expectWarnings(6);
}

TEST_F(ImageFiles, SurvivesBrokenImages)
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
  writeImage<vtkBMPWriter>(image, this->Folder / "masks/disc2.bmp");
  tryAll(this->Folder / "masks/disc2.bmp");
  writeImage<vtkTIFFWriter>(image, this->Folder / "masks/disc2.tif");
  tryAll(this->Folder / "masks/disc2.tif");
  std::ofstream(this->Folder / "masks/disc2.pgm") << "P5 2 2 65535\n12345678";
  expectError(this->Reader, {"disc2.pgm", "more than 8 bits"});
  std::ofstream(this->Folder / "masks/disc2.pgm") << "P5 2 2 15\n12345678";
  expectError(this->Reader, {"disc2.pgm", "white is 15"});
  const auto writeBmp = [&](int bits, int compression)
  {
    std::string bytes(14 + 40 + 8 + 64, '\0'); // two colours, and room for eight rows of eight bytes
    bytes[0] = 'B';
    bytes[1] = 'M';
    bytes[10] = 14 + 40 + 8;
    bytes[14] = 40;
    bytes[18] = bytes[22] = 8;
    bytes[26] = 1;
    bytes[28] = char(bits);
    bytes[30] = char(compression);
    std::ofstream(this->Folder / "masks/disc2.bmp", std::ios::binary) << bytes;
  };
  fs::remove(this->Folder / "masks/disc2.pgm");
  for (const int bits : {1, 4, 16, 32, 0})
  {
    writeBmp(bits, 0);
    expectError(this->Reader, {"disc2.bmp", "BMP of " + std::to_string(bits) + " bits a pixel; 8 and 24 are understood"});
  }
  writeBmp(8, 1);
  expectError(this->Reader, {"disc2.bmp", "compressed"});
  writeBmp(8, 0);
  this->Reader->Modified();
  this->Reader->Update();
  EXPECT_EQ(this->Reader->GetOutput()->GetNumberOfPartitionedDataSets(), 1u);
  writeBmp(24, 0);
  expectError(this->Reader, {"disc2.bmp", "too soon"});
  fs::remove(this->Folder / "masks/disc2.bmp");
  std::ofstream(this->Folder / "masks/disc2.pgm") << "P2\n2 2\n255\n0 1 2 3\n";
  expectError(this->Reader, {"disc2.pgm", "P5 and P6"});
}
