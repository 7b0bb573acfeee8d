// SPDX-License-Identifier: BSD-3-Clause
/**
 * What can be said of outputs before any work is done.
 */
#pragma once

#include <string>
#include <vector>

namespace silhouette::program
{

/**
 * Throws ProgramError where an output cannot be written in the end (FileFailed, as checkWritable()), and (WrongArguments) where it would take the place of another
 * output, of one of some input files, or of a camera file or an image of the capture, whatever names lead to it. Empty names are of no file.
 */
void checkOutputs(const std::vector<std::string>& outputs, const std::string& capture, const std::vector<std::string>& inputs);

/** Throws CLI::ValidationError where a file that `option` names has another extension; case does not matter. An empty name is of no file. */
void checkExtension(const std::string& option, const std::string& file, const std::string& extension);

} // namespace silhouette::program
