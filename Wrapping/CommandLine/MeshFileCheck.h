// SPDX-License-Identifier: BSD-3-Clause
/**
 * A look at a mesh file before VTK's reader opens it: the PLY reader believes a header that promises more than there is, and the STL reader
 * takes what is there for all.
 */
#pragma once

#include <filesystem>
#include <string>

namespace silhouette::program
{

/** What is wrong with a PLY file, in words; empty where nothing is: its header can be read, and everything that it promises is there. Cost: the file is read once. */
std::string plyFault(const std::filesystem::path& file);

/** The same of an STL file, binary or text. */
std::string stlFault(const std::filesystem::path& file);

} // namespace silhouette::program
