// SPDX-License-Identifier: BSD-3-Clause
/**
 * A look at an STL file before VTK's reader opens it, which takes what is there for all.
 */
#pragma once

#include <filesystem>
#include <string>

namespace silhouette::program
{

/** What is wrong with an STL file, binary or text, in words; empty where all is there that it promises. Cost: the file is read once. */
std::string stlFault(const std::filesystem::path& file);

} // namespace silhouette::program
