// SPDX-License-Identifier: BSD-3-Clause
/** A small PLY or OBJ file that is changed in places: ProgramError, or faces of points that are there. */
#include "ExitCodes.h"
#include "MeshNumbers.h"
#include "ObjFile.h"
#include "PlyFile.h"

#include "vtkPolyData.h"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

using namespace silhouette::program;

namespace
{

const std::string Header = "element vertex 3\nproperty float x\nproperty float y\nproperty double z\nelement face 2\n"
                           "property list uchar int vertex_indices\nproperty short part\nend_header\n";
const std::string Text = "ply\nformat ascii 1.0\n" + Header + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2 7\n3 0 2 1 -7\n";
const std::string Wavefront = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1//2 3//1 -2//7\n";

std::string binary(const char* order)
{
  // Zeros are as good as other coordinates.
  std::string face("\3\0\0\0\0\1\0\0\0\2\0\0\0\0\0", 15);
  return std::string("ply\nformat binary_") + order + "_endian 1.0\n" + Header + std::string(3 * 16, '\0') + face + face;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  if (size == 0)
  {
    return 0;
  }
  const std::string files[] = { Text, binary("little"), binary("big"), Wavefront };
  const unsigned kind = data[0] % 4u;
  std::string content = files[kind];
  for (std::size_t n = 1; n + 2 < size && n < 3 * 12 && !content.empty(); n += 3)
  {
    const std::size_t at = (data[n] + 256u * (data[n + 1] % 2u)) % content.size();
    static const char alphabet[] = "0123456789-+.e \n\0\xff x";
    switch (data[n + 1] / 2 % 4)
    {
      case 0: content.erase(at, 1 + data[n + 2] % 9u); break;
      case 1: content.insert(at, 1, alphabet[data[n + 2] % (sizeof(alphabet) - 1)]); break;
      case 2: content[at] = char(data[n + 2]); break;
      default: content.resize(at + 1);
    }
  }
  const auto file = std::filesystem::temp_directory_path() / ("silhouette-fuzz-mesh-" + std::to_string(getpid()));
  std::ofstream(file, std::ios::binary) << content;
  try
  {
    if (!cornersFault(kind == 3 ? readObj(file) : readPly(file)).empty())
    {
      std::abort();
    }
  }
  catch (const ProgramError&)
  {
  }
  std::filesystem::remove(file);
  return 0;
}
