// SPDX-License-Identifier: BSD-3-Clause
/**
 * Arrays out of numpy's archives (.npz): a zip file of .npy files, stored or deflated.
 */
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace silhouette
{

struct NumpyArray
{
  std::vector<std::size_t> shape; ///< empty for a single number
  std::vector<double> values;     ///< the last index runs fastest, whatever the file's order
};

/**
 * The arrays whose names (without `.npy`) are wanted; others are not unpacked. float32 and float64 of either byte order, C and
 * Fortran order. Throws InvalidInput, naming file and array: no such file, larger than 64 MiB; no zip file, cut off or of the zip64
 * kind; an array that is encrypted, packed otherwise than deflated, larger than 64 KiB, damaged (its CRC is checked), not of numpy's
 * format, or of another type; a name that occurs twice. Cost: the file is read, the wanted are unpacked.
 */
std::map<std::string, NumpyArray> readNumpyArchive(const std::filesystem::path& file, const std::function<bool(const std::string&)>& isWanted);

} // namespace silhouette
