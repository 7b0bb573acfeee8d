// SPDX-License-Identifier: BSD-3-Clause
#include "Study.h"

#include "Error.h"
#include "Measures.h"

#include <algorithm>
#include <cstdio>
#include <memory>

namespace silhouette::experiments
{
namespace
{

std::vector<std::string> chosenObjects(const StudyOptions& options)
{
  std::vector<std::string> names;
  for (const std::string& name : options.objects)
  {
    names.push_back(objectNamed(name).name);
  }
  for (std::size_t i = 0; options.objects.empty() && i < objects().size(); ++i)
  {
    names.push_back(objects()[i].name);
  }
  return names;
}

std::vector<const Method*> chosenMethods(const StudyOptions& options)
{
  std::vector<const Method*> chosen;
  for (const std::string& name : options.methods)
  {
    chosen.push_back(&methodNamed(name));
  }
  for (std::size_t i = 0; options.methods.empty() && i < methods().size(); ++i)
  {
    chosen.push_back(&methods()[i]);
  }
  return chosen;
}

void checkNames(const StudyOptions& options)
{
  for (const std::string& name : options.noises)
  {
    if (name != CleanName)
    {
      noiseNamed(name);
    }
  }
  const std::vector<std::string>& known = strengthNames();
  for (const std::string& name : options.strengths)
  {
    if (std::find(known.begin(), known.end(), name) == known.end())
    {
      throw InvalidInput("there is no strength '" + name + "'; there are weak, middle and strong");
    }
  }
}

bool isFirst(const Case& at, const StudyOptions& options)
{
  return at.noise == CleanName || at.seed == options.seeds.front();
}

/** What of a case is to be done yet. */
std::vector<const Method*> missingMethods(const Case& at, const std::vector<const Method*>& chosen,
                                          const StudyOptions& options, const std::vector<Row>& done)
{
  std::vector<const Method*> missing;
  for (const Method* method : chosen)
  {
    Row wanted;
    wanted.at = at;
    wanted.method = method->name;
    wanted.settings = options.settings;
    const bool isDone =
        std::any_of(done.begin(), done.end(), [&](const Row& row) { return sameRun(row, wanted); });
    if (!isDone && (isFirst(at, options) || !method->firstSeedOnly))
    {
      missing.push_back(method);
    }
  }
  return missing;
}

void say(const Case& at, const std::vector<Row>& rows, double seconds)
{
  std::printf("%s, %s, seed %d: %.1f s; error", at.object.c_str(),
              describeNoise(at.noise, at.strength).c_str(), int(at.seed), seconds);
  for (const Row& row : rows)
  {
    if (row.failure.empty())
    {
      std::printf("  %s %.3f (%.1f s)", row.method.c_str(), row.value[Error], row.value[Seconds]);
    }
    else
    {
      std::printf("  %s: %s", row.method.c_str(), row.failure.c_str());
    }
  }
  std::printf("\n");
  std::fflush(stdout);
}

class ObjectRun
{
public:
  ObjectRun(const std::string& name, const StudyOptions& options, Execution& execution)
      : Name(name), Options(options), TheExecution(execution)
  {
  }

  void run(const std::vector<const Method*>& chosen, const std::vector<Row>& done)
  {
    for (const Case& at : casesOf(this->Name, this->Options))
    {
      const std::vector<const Method*> missing = missingMethods(at, chosen, this->Options, done);
      if (!missing.empty())
      {
        this->runCase(at, missing);
      }
    }
  }

private:
  void runCase(const Case& at, const std::vector<const Method*>& missing)
  {
    if (!this->TheSubject)
    {
      const Stopwatch watch;
      this->TheSubject =
          std::make_unique<Subject>(objectNamed(this->Name), this->Options.settings, this->TheExecution);
      std::printf("%s: reference of %zu triangles in %.1f s\n", this->Name.c_str(),
                  this->TheSubject->reference->surface().triangles.size(), watch.seconds());
    }
    const Stopwatch watch;
    Trial trial(*this->TheSubject, at, this->Options.settings, isFirst(at, this->Options),
                this->TheExecution);
    std::vector<Row> rows;
    for (const Method* method : missing)
    {
      rows.push_back(runMethod(*method, trial, at, this->Options.settings));
      appendRow(this->Options.output / this->Options.results, rows.back());
    }
    say(at, rows, watch.seconds());
  }

  std::string Name;
  const StudyOptions& Options;
  Execution& TheExecution;
  std::unique_ptr<Subject> TheSubject;
};

} // namespace

std::filesystem::path resultsFile(const std::filesystem::path& folder)
{
  return folder / "results.csv";
}

std::filesystem::path votesFile(const std::filesystem::path& folder)
{
  return folder / "votes.txt";
}

std::filesystem::path ablationFile(const std::filesystem::path& folder)
{
  return folder / "ablation.csv";
}

std::filesystem::path scalingFile(const std::filesystem::path& folder)
{
  return folder / "scaling.csv";
}

std::filesystem::path islandsFile(const std::filesystem::path& folder)
{
  return folder / "islands.csv";
}

void runStudy(const StudyOptions& options)
{
  checkNames(options);
  const std::vector<std::string> names = chosenObjects(options);
  const std::vector<const Method*> chosen = chosenMethods(options);
  const std::filesystem::path file = options.output / options.results;
  std::filesystem::create_directories(options.output);
  if (options.fresh)
  {
    std::filesystem::remove(file);
  }
  else if (!options.resume && std::filesystem::exists(file))
  {
    throw InvalidInput(file.string() + " is there: --resume goes on with it, --fresh replaces it");
  }
  const std::vector<Row> done = readRows(file);
  SmpExecution execution;
  for (const std::string& name : names)
  {
    ObjectRun(name, options, execution).run(chosen, done);
  }
}

void runAblation(const StudyOptions& options)
{
  StudyOptions ablation = options;
  ablation.results = ablationFile("");
  ablation.seeds = {options.seeds.front()};
  ablation.methods = {"cubes-exact", "hulls-robust"};
  for (const Method& method : ablations())
  {
    ablation.methods.push_back(method.name);
  }
  if (options.objects.empty())
  {
    ablation.objects = {"pebble", "torus", "jug", "twig"};
  }
  if (options.strengths.empty())
  {
    ablation.strengths = {"strong"};
  }
  runStudy(ablation);
}

void runIslands(const StudyOptions& options)
{
  StudyOptions islands = options;
  islands.results = islandsFile("");
  islands.seeds = {options.seeds.front()};
  islands.noises = {"pixels"};
  islands.methods = {"cubes-exact",  "consistent-1", "consistent-2",
                     "consistent-3", "hulls-robust", WithoutIslands};
  runStudy(islands);
}

void runScaling(const StudyOptions& options)
{
  StudyOptions scaling = options;
  scaling.results = scalingFile("");
  scaling.seeds = {options.seeds.front()};
  scaling.methods = {"cubes-exact", "hulls-robust"};
  scaling.contourOctants = 0.5;
  if (options.objects.empty())
  {
    scaling.objects = {"pebble", "jug"};
  }
  for (scaling.settings.depth = 6; scaling.settings.depth <= 9; ++scaling.settings.depth)
  {
    for (scaling.settings.size = 512; scaling.settings.size <= 2048; scaling.settings.size *= 2)
    {
      runStudy(scaling);
      scaling.fresh = false; // the others are added
      scaling.resume = true;
    }
  }
}

} // namespace silhouette::experiments
