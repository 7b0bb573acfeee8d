// SPDX-License-Identifier: BSD-3-Clause
/** Any bytes as a camera file: InvalidInput, or views with finite matrices. */
#include "CameraFiles.h"
#include "Error.h"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace
{

namespace fs = std::filesystem;

constexpr char Alphabet[] = "0123456789.eE+-# \t\n\r,\"nainf_pngx\xef\xbb\xbf";

/** Mostly text: plain bytes would seldom get past the first number. */
std::string listedBytes(const std::uint8_t* data, std::size_t size)
{
  std::string text;
  for (std::size_t n = 0; n < size; ++n)
  {
    text += data[0] % 4 == 0 ? char(data[n]) : Alphabet[data[n] % (sizeof(Alphabet) - 1)];
    if (data[0] % 4 == 1 && n % 13 == 0)
    {
      text += "\na.png 1 0 0 0 0 1 0 0 0 0 1 ";
    }
  }
  return text;
}

/** A file that is right, changed in places. */
std::string changed(std::string content, const std::uint8_t* data, std::size_t size)
{
  for (std::size_t n = 2; n + 2 < size && n < 2 + 3 * (1 + data[1] / 64u) && !content.empty(); n += 3)
  {
    const std::size_t at = (data[n] + 256u * (data[n + 1] % 4u)) % content.size();
    switch (data[n + 1] / 4 % 8)
    {
      case 0: content.erase(at, 1 + data[n + 2] % 9u); break;
      case 1: content.insert(at, 1, Alphabet[data[n + 2] % (sizeof(Alphabet) - 1)]); break;
      case 2: content.resize(at + 1); break;
      case 3: content.insert(at, content.substr(at, data[n + 2])); break;
      default: content[at] = char(data[n + 2]);
    }
  }
  return content;
}

/** So many doubles of 1. */
std::string ones(int numbers)
{
  std::string bytes;
  for (int n = 0; n < numbers; ++n)
  {
    bytes += std::string("\0\0\0\0\0\0\xf0\x3f", 8);
  }
  return bytes;
}

std::string little(std::uint64_t value, std::size_t bytes)
{
  std::string text;
  for (std::size_t n = 0; n < bytes; ++n, value /= 256)
  {
    text += char(value % 256);
  }
  return text;
}

void write(const fs::path& file, const std::string& bytes)
{
  std::ofstream(file, std::ios::binary) << bytes;
}

/** The camera file of one of the formats, in that folder. */
fs::path writeCameras(const fs::path& folder, const std::uint8_t* data, std::size_t size)
{
  const auto some = [&](bool isChanged, const std::string& content) { return isChanged ? changed(content, data, size) : content; };
  const bool first = data[1] % 2 == 0;
  switch (data[0] / 4 % 4)
  {
    case 0:
    {
      const std::string keys = R"("camera_angle_x": 0.7, "fl_y": 5.5, "w": 64, "h": 48, "cx": 3, "k1": 0.1, "p2": 0, "camera_model": "OPENCV", "is_fisheye": false)";
      const std::string frame = R"({"file_path": "./a", "mask_path": "m.png", "fl_x": 7, "transform_matrix": [[1,0,0,1],[0,1,0,2],[0,0,1,3],[0,0,0,1]]})";
      write(folder / "transforms.json", some(true, "{" + keys + ", \"frames\": [" + frame + "]}"));
      return folder / "transforms.json";
    }
    case 1:
      write(folder / "cameras.txt", some(first, "# Camera list with\n1 OPENCV 64 48 50 50 32 24 0.1 0 0 0\n2 SIMPLE_RADIAL_FISHEYE 64 48 50 32 24 0.1\n"));
      write(folder / "images.txt", some(!first, "# Image list with\n1 1 0 0 0 1 2 3 1 a b.png\n1 2 -1 3 4 7\n2 0.5 0.5 -0.5 0.5 1 2 3 2 c.png\n\n"));
      return folder / "images.txt";
    case 2:
      write(folder / "cameras.bin", some(first, little(2, 8) + little(1, 4) + little(1, 4) + little(64, 8) + little(48, 8) + ones(4) + little(2, 4) +
                                                  little(6, 4) + little(64, 8) + little(48, 8) + ones(12)));
      write(folder / "images.bin", some(!first, little(2, 8) + little(1, 4) + ones(7) + little(1, 4) + std::string("a.png\0", 6) + little(2, 8) + ones(6) +
                                                  little(2, 4) + ones(7) + little(2, 4) + std::string("b.png\0", 6) + little(0, 8)));
      return folder / "cameras.bin";
    default:
    {
      const fs::path file = folder / (size % 2 ? "a_par.txt" : "a.txt");
      write(file, listedBytes(data, size));
      return file;
    }
  }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size < 2)
  {
    return 0;
  }
  const fs::path folder = fs::temp_directory_path() / ("silhouette-fuzz-cameras-" + std::to_string(getpid()));
  fs::create_directories(folder);
  const fs::path file = writeCameras(folder, data, size);
  try
  {
    for (const auto& view : silhouette::readCameraFile(file).views)
    {
      const auto made = view.ofSize ? view.ofSize(64, 48) : view;
      if (!made.projection.allFinite() || (made.lens && !made.lens->intrinsics.allFinite()))
      {
        std::abort();
      }
    }
  }
  catch (const silhouette::Error&)
  {
  }
  fs::remove_all(folder);
  return 0;
}
