// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a command of the program is to its main function.
 */
#pragma once

namespace CLI
{
class App;
}

namespace silhouette::program
{

class Command
{
public:
  Command() = default;
  virtual ~Command() = default;
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  /** The parser's part of the command; knows whether it was called. */
  CLI::App* app() const { return this->App; }

  /** Checks what the parser could not. Throws CLI::ValidationError. */
  virtual void finish() = 0;

  /** Throws ProgramError or Interrupted; CLI::ValidationError where an argument does not fit the capture. */
  virtual void run() = 0;

protected:
  CLI::App* App = nullptr;
};

} // namespace silhouette::program
