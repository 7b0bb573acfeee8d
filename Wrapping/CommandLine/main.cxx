// SPDX-License-Identifier: BSD-3-Clause
#include "Arguments.h"
#include "Evaluate.h"
#include "ExitCodes.h"
#include "Interrupt.h"
#include "Progress.h"
#include "Reconstruct.h"
#include "Stages.h"
#include "Synthesize.h"
#include "Version.h"

#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <vector>

using namespace silhouette::program;

namespace
{

const char* const Description = "Closed meshes from the silhouettes of an object in calibrated photographs.";

const char* const Footer = "Examples:\n"
                           "  vtksilhouette synthesize jug\n"
                           "  vtksilhouette reconstruct jug -o jug.ply --truth jug/truth.ply --image jug.png\n"
                           "  vtksilhouette evaluate jug.ply --capture jug --truth jug/truth.ply\n\n"
                           "vtksilhouette COMMAND --help explains a command.\n\n";

int runCommand(const std::vector<std::unique_ptr<Command>>& commands)
{
  for (const std::unique_ptr<Command>& command : commands)
  {
    if (command->app()->parsed())
    {
      command->finish();
      command->run();
    }
  }
  return Success;
}

/** What is wrong with the arguments: where no command is named, the parser's own words do not say which there are. */
std::string describeError(const CLI::App& program, const CLI::ParseError& error, int argc, char** argv)
{
  if (!program.get_subcommands().empty())
  {
    return error.what();
  }
  const std::string commands = "reconstruct, synthesize and evaluate are the commands";
  return argc < 2 ? "no command; " + commands : "'" + std::string(argv[1]) + "' is no command; " + commands;
}

/** One line, and where to find help. */
int failArguments(const CLI::App& program, const CLI::ParseError& error, int argc, char** argv)
{
  if (error.get_exit_code() == Success)
  {
    return program.exit(error, std::cout, std::cerr); // --help, --version
  }
  const std::vector<CLI::App*> called = program.get_subcommands();
  const std::string command = called.empty() ? "" : called.front()->get_name() + " ";
  sayError(describeError(program, error, argc, argv) + " (vtksilhouette " + command + "--help explains)");
  return WrongArguments;
}

int runProgram(int argc, char** argv)
{
  CLI::App program(Description, "vtksilhouette");
  program.formatter(std::make_shared<HelpFormatter>());
  program.set_help_flag("-h,--help", "This text");
  program.set_version_flag("--version", ProgramVersion, "The program's version");
  program.require_subcommand(1);
  program.footer(std::string(Footer) + ExitCodesHelp);
  std::vector<std::unique_ptr<Command>> commands;
  commands.push_back(std::make_unique<Reconstruct>(program));
  commands.push_back(std::make_unique<Synthesize>(program));
  commands.push_back(std::make_unique<Evaluate>(program));
  try
  {
    program.parse(argc, argv);
    return runCommand(commands);
  }
  catch (const CLI::ParseError& error)
  {
    return failArguments(program, error, argc, argv);
  }
}

} // namespace

int main(int argc, char** argv)
{
  watchForInterrupts();
  routeOutputWindow();
  try
  {
    return runProgram(argc, argv);
  }
  catch (const Interrupted&)
  {
    sayError("interrupted");
    return Stopped;
  }
  catch (const ProgramError& error)
  {
    sayError(error.what());
    return error.Code;
  }
  catch (const std::bad_alloc&)
  {
    sayError("not enough memory; a smaller depth needs less");
    return ProcessingFailed;
  }
  catch (const std::exception& error)
  {
    sayError(error.what());
    return ProcessingFailed;
  }
}
