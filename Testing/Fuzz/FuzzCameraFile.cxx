// SPDX-License-Identifier: BSD-3-Clause
/** Any bytes as a camera file: InvalidInput, or views with finite matrices. */
#include "CameraFiles.h"
#include "Error.h"

#include <cstdlib>
#include <fstream>
#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  // Mostly text: plain bytes would seldom get past the first number.
  static const char Alphabet[] = "0123456789.eE+-# \t\n\r,\"nainf_pngx\xef\xbb\xbf";
  std::string text;
  for (std::size_t n = 0; n < size; ++n)
  {
    text += data[0] % 4 == 0 ? char(data[n]) : Alphabet[data[n] % (sizeof(Alphabet) - 1)];
    if (data[0] % 4 == 1 && n % 13 == 0)
    {
      text += "\na.png 1 0 0 0 0 1 0 0 0 0 1 ";
    }
  }
  const auto file = std::filesystem::temp_directory_path() /
    ("silhouette-fuzz-" + std::to_string(getpid()) + (size % 2 ? "_par.txt" : ".txt"));
  std::ofstream(file, std::ios::binary) << text;
  try
  {
    for (const auto& view : silhouette::readCameraFile(file).views)
    {
      if (!view.projection.allFinite())
      {
        std::abort();
      }
    }
  }
  catch (const silhouette::Error&)
  {
  }
  std::filesystem::remove(file);
  return 0;
}
