// SPDX-License-Identifier: BSD-3-Clause
#include "OutputChecks.h"

#include "Arguments.h"
#include "CaptureFolder.h"
#include "Error.h"
#include "ExitCodes.h"
#include "OutputFiles.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace silhouette::program
{
namespace fs = std::filesystem;
namespace
{

/** Do two names lead to the same file, there or not? */
bool isSameFile(const fs::path& a, const fs::path& b)
{
  std::error_code error;
  if (fs::equivalent(a, b, error) && !error)
  {
    return true;
  }
  const fs::path realA = fs::weakly_canonical(a, error), realB = fs::weakly_canonical(b, error);
  return !error && realA == realB;
}

/** The files of a capture; none where it cannot be read, which its reader will say. */
std::vector<fs::path> filesOf(const std::string& capture)
{
  try
  {
    return captureFiles(capture);
  }
  catch (const Error&)
  {
    return {};
  }
}

} // namespace

void checkOutputs(const std::vector<std::string>& outputs, const std::string& capture, const std::vector<std::string>& inputs)
{
  std::vector<std::string> named;
  std::copy_if(outputs.begin(), outputs.end(), std::back_inserter(named), [](const std::string& file) { return !file.empty(); });
  std::vector<fs::path> kept = filesOf(capture);
  std::copy_if(inputs.begin(), inputs.end(), std::back_inserter(kept), [](const std::string& file) { return !file.empty(); });
  for (std::size_t n = 0; n < named.size(); ++n)
  {
    checkWritable(named[n]);
    for (std::size_t before = 0; before < n; ++before)
    {
      if (isSameFile(named[n], named[before]))
      {
        throw ProgramError(WrongArguments, "two outputs are one file: '" + named[before] + "' and '" + named[n] + "'");
      }
    }
    for (const fs::path& input : kept)
    {
      if (isSameFile(named[n], input))
      {
        throw ProgramError(WrongArguments, "output '" + named[n] + "' would take the place of the input " + input.string());
      }
    }
  }
}

void checkExtension(const std::string& option, const std::string& file, const std::string& extension)
{
  std::string found = fs::path(file).extension().string();
  std::transform(
    found.begin(), found.end(), found.begin(), [](unsigned char letter) { return static_cast<char>(std::tolower(letter)); });
  if (!file.empty() && found != extension)
  {
    throw CLI::ValidationError(option, "'" + file + "' does not end in " + extension);
  }
}

} // namespace silhouette::program
