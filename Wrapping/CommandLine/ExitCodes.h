// SPDX-License-Identifier: BSD-3-Clause
/**
 * How the program ends, and the two ways in which its code gives up. `--help` prints the same list.
 */
#pragma once

#include <stdexcept>
#include <string>

namespace silhouette::program
{

enum ExitCode
{
  Success = 0,
  ProcessingFailed = 1, ///< the data do not allow a result: bad silhouettes or cameras, nothing survives
  WrongArguments = 2,   ///< by themselves, or for this capture
  FileFailed = 3, ///< a file, the capture's included, cannot be read, understood or written
  Stopped = 130   ///< interrupted: 128 and the number of SIGINT, as shells have it
};

constexpr const char* ExitCodesHelp = "Exit codes:\n"
                                      "  0    done\n"
                                      "  1    the data allow no result: bad silhouettes or cameras, nothing survives\n"
                                      "  2    wrong arguments, by themselves or for this capture\n"
                                      "  3    a file or the capture cannot be read, understood or written\n"
                                      "  130  interrupted; no partial file is left\n";

/** What went wrong, in one line, and the exit code that goes with it. */
class ProgramError : public std::runtime_error
{
public:
  ProgramError(ExitCode code, const std::string& message)
    : std::runtime_error(message)
    , Code(code)
  {
  }

  ExitCode Code;
};

/** Thrown once the user has interrupted the program. */
class Interrupted : public std::exception
{
};

} // namespace silhouette::program
