// SPDX-License-Identifier: BSD-3-Clause
#include "Figures.h"
#include "Methods.h"
#include "Promises.h"
#include "Report.h"
#include "Study.h"
#include "VoteTable.h"

#include "vtkSMPTools.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <exception>

using namespace silhouette::experiments;

namespace
{

/** What the program is asked to do. */
struct Steps
{
  bool all = false;
  bool ablation = false;
  bool scaling = false;
  bool islands = false;
  bool votes = false;
  bool figures = false;
  bool report = false;
  bool check = false;
  std::filesystem::path documentation = "Documentation";

  bool study() const
  {
    return this->all || !(this->ablation || this->scaling || this->islands || this->votes || this->figures || this->report);
  }
};

const char* const Description =
    "The noise study: how far from the truth are the surfaces, and are they sound?\n\n"
    "Without a step: the cases, into OUTPUT/results.csv. px are those of an image of 1024 and scaled for "
    "other sizes.";

/** The names of a table's entries, for the help. */
template <typename Table> std::string namesOf(const Table& table)
{
  std::string text;
  for (const auto& entry : table)
  {
    text += (text.empty() ? "" : ", ") + std::string(entry.name);
  }
  return text;
}

void addCases(CLI::App& program, StudyOptions& study)
{
  const char* const group = "Cases";
  const auto add = [&](const char* name, auto& value, const std::string& text)
  { return program.add_option(name, value, text)->group(group); };
  add("--depth", study.settings.depth, "Depth of the octrees")
      ->capture_default_str()
      ->check(CLI::Range(3, 10));
  add("--size", study.settings.size, "Pixels of the images' sides")
      ->capture_default_str()
      ->check(CLI::Range(64, 8192));
  add("--views", study.settings.views, "Number of views")->capture_default_str()->check(CLI::Range(4, 1000));
  add("--objects", study.objects, "Of " + namesOf(objects()))->delimiter(',');
  add("--noises", study.noises, "Of clean, " + namesOf(noises()))->delimiter(',');
  add("--strengths", study.strengths, "Of weak, middle, strong")->delimiter(',');
  add("--seeds", study.seeds, "Held-out ones: 1 to 4 were tuned with")
      ->delimiter(',')
      ->capture_default_str();
  add("--methods", study.methods, "Of " + namesOf(methods()))->delimiter(',');
}

void addSteps(CLI::App& program, StudyOptions& study, Steps& steps)
{
  const char* const group = "Steps and files";
  const auto flag = [&](const char* name, bool& value, const char* text)
  { program.add_flag(name, value, text)->group(group); };
  flag("--all", steps.all, "Cases, ablation, scaling, islands, votes, figures and the page");
  flag("--ablation", steps.ablation,
       "The robust local hulls without each of their stages, into OUTPUT/ablation.csv: unless said otherwise "
       "pebble, torus, jug and twig, the first seed, clean and under each noise at its strongest");
  flag("--scaling", steps.scaling,
       "Depths 6 to 9 with images of 512, 1024 and 2048 pixels, contour noise of half an octant, into "
       "OUTPUT/scaling.csv: unless said otherwise pebble and jug, the first seed");
  flag("--islands", steps.islands,
       "Flipped pixels, with islands and debris kept and dropped, beside voting, the first seed, into "
       "OUTPUT/islands.csv");
  flag("--votes", steps.votes, "The thesis's Table 6.1, into OUTPUT/votes.txt");
  flag("--figures", steps.figures, "The figures, into DOCUMENTATION/Figures");
  flag("--report", steps.report, "DOCUMENTATION/experiments.md, from what is in OUTPUT");
  flag("--check", steps.check, "After the cases and the islands: fail where a promise is broken or an order does not hold");
  flag("--resume", study.resume, "Go on with the results that are there");
  flag("--fresh", study.fresh, "Replace the results that are there");
  program.add_option("--output", study.output, "Folder of the results")->capture_default_str()->group(group);
  program.add_option("--documentation", steps.documentation, "Folder of the page")
      ->capture_default_str()
      ->group(group);
  program.add_option("--threads", study.threads, "0: all processors")->capture_default_str()->group(group);
}

/** The number of what is broken, each said. */
std::size_t check(const std::filesystem::path& file)
{
  const std::vector<Row> rows = readRows(file);
  const std::vector<std::string> broken = violations(rows);
  for (const std::string& text : broken)
  {
    std::printf("broken: %s\n", text.c_str());
  }
  std::printf("%zu rows, %zu broken\n", rows.size(), broken.size());
  return broken.size();
}

int runSteps(const StudyOptions& study, const Steps& steps)
{
  silhouette::SmpExecution execution;
  std::filesystem::create_directories(study.output);
  if (steps.study())
  {
    runStudy(study);
  }
  if (steps.all || steps.ablation)
  {
    runAblation(study);
  }
  if (steps.all || steps.scaling)
  {
    runScaling(study);
  }
  if (steps.all || steps.islands)
  {
    runIslands(study);
  }
  if (steps.all || steps.votes)
  {
    writeVoteTables(votesFile(study.output), searchVoteTables(execution));
  }
  if (steps.all || steps.figures)
  {
    makeFigures(study, steps.documentation / "Figures", execution);
  }
  if (steps.all || steps.report)
  {
    writeReport(study.output, steps.documentation);
  }
  std::size_t broken = 0;
  if (steps.check && steps.study())
  {
    broken += check(resultsFile(study.output));
  }
  if (steps.check && (steps.all || steps.islands))
  {
    broken += check(islandsFile(study.output));
  }
  return broken > 0 ? 1 : 0;
}

int run(int argc, char** argv)
{
  StudyOptions study;
  Steps steps;
  CLI::App program(Description, "silhouette-experiments");
  addCases(program, study);
  addSteps(program, study, steps);
  try
  {
    program.parse(argc, argv);
  }
  catch (const CLI::ParseError& error)
  {
    return program.exit(error);
  }
  if (study.threads > 0)
  {
    vtkSMPTools::Initialize(study.threads);
  }
  return runSteps(study, steps);
}

} // namespace

int main(int argc, char** argv)
{
  try
  {
    return run(argc, argv);
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "silhouette-experiments: %s\n", error.what());
    return 1;
  }
}
