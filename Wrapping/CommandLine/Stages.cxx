// SPDX-License-Identifier: BSD-3-Clause
#include "Stages.h"

#include "Interrupt.h"

#include "vtkAlgorithm.h"
#include "vtkCommand.h"
#include "vtkExecutive.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkLogger.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkOutputWindow.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <chrono>

namespace silhouette::program
{
namespace
{

/** Hears a filter, and its executive, while it runs. */
class Listener : public vtkCommand
{
public:
  static Listener* New() { return new Listener; }

  void Execute(vtkObject* caller, unsigned long event, void* data) override
  {
    switch (event)
    {
      case vtkCommand::ProgressEvent:
        this->Bar->update(*static_cast<double*>(data));
        if (isInterrupted())
        {
          this->Filter->SetAbortExecute(1);
        }
        break;
      case vtkCommand::WarningEvent:
        sayWarning(plainMessage(static_cast<const char*>(data)));
        break;
      case vtkCommand::ErrorEvent:
        this->remember(caller, plainMessage(static_cast<const char*>(data)));
        break;
      default:
        break;
    }
  }

  /** The filter's own first error; the executive's, which only repeats that there was one, where it has none. */
  std::string message() const { return this->Own.empty() ? this->Executives : this->Own; }

  vtkAlgorithm* Filter = nullptr;
  Progress* Bar = nullptr;

private:
  void remember(vtkObject* caller, const std::string& text)
  {
    std::string& place = caller == this->Filter ? this->Own : this->Executives;
    if (place.empty())
    {
      place = text.empty() ? "unknown error" : text;
    }
  }

  std::string Own;
  std::string Executives;
};

/** Observes for as long as it lives. */
class Observation
{
public:
  Observation(vtkAlgorithm* filter, Progress& bar)
  {
    this->Heard->Filter = filter;
    this->Heard->Bar = &bar;
    for (const unsigned long event : { vtkCommand::ProgressEvent, vtkCommand::WarningEvent, vtkCommand::ErrorEvent })
    {
      filter->AddObserver(event, this->Heard);
    }
    filter->GetExecutive()->AddObserver(vtkCommand::ErrorEvent, this->Heard);
  }
  ~Observation()
  {
    this->Heard->Filter->RemoveObserver(this->Heard);
    this->Heard->Filter->GetExecutive()->RemoveObserver(this->Heard);
  }
  Observation(const Observation&) = delete;
  Observation& operator=(const Observation&) = delete;

  std::string message() const { return this->Heard->message(); }

private:
  vtkNew<Listener> Heard;
};

/** VTK's window for messages that no one observes. */
class WarningWindow : public vtkOutputWindow
{
public:
  static WarningWindow* New();
  vtkTypeMacro(WarningWindow, vtkOutputWindow);

  void DisplayText(const char* text) override { sayWarning(plainMessage(text)); }
};
vtkStandardNewMacro(WarningWindow);

/** Of all outputs: one that is asked for later, by itself, would be made by all the work again. */
void updatePiece(vtkAlgorithm* filter, int piece, int pieces)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  vtkNew<vtkInformationVector> requests;
  requests->SetNumberOfInformationObjects(filter->GetNumberOfOutputPorts());
  for (int port = 0; port < filter->GetNumberOfOutputPorts(); ++port)
  {
    vtkInformation* request = requests->GetInformationObject(port);
    request->Set(Pipeline::UPDATE_PIECE_NUMBER(), piece);
    request->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), pieces);
    request->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
  }
  filter->Update(-1, requests);
}

} // namespace

std::string plainMessage(const char* vtkText)
{
  // "ERROR: In FILE, line N\nCLASS (ADDRESS): MESSAGE\n\n"
  std::string text = vtkText ? vtkText : "";
  const bool prefixed = text.rfind("ERROR: In ", 0) == 0 || text.rfind("Warning: In ", 0) == 0 ||
    text.rfind("Generic Warning: In ", 0) == 0;
  const std::size_t line = text.find('\n');
  if (prefixed && line != std::string::npos)
  {
    text.erase(0, line + 1);
    const std::size_t end = text.find("): ");
    if (text.rfind("vtk", 0) == 0 && end != std::string::npos)
    {
      text.erase(0, end + 3);
    }
  }
  while (!text.empty() && (text.back() == '\n' || text.back() == ' '))
  {
    text.pop_back();
  }
  return text;
}

void routeOutputWindow()
{
  vtkNew<WarningWindow> window;
  vtkOutputWindow::SetInstance(window);
  vtkLogger::SetStderrVerbosity(vtkLogger::VERBOSITY_OFF); // it repeats what the window is told
}

void Stages::run(
  vtkAlgorithm* filter, const std::string& key, const std::string& words, ExitCode code, int piece, int pieces)
{
  const auto update = [&]
  {
    const Observation observation(filter, this->Bar);
    if (pieces > 1)
    {
      updatePiece(filter, piece, pieces);
    }
    else
    {
      filter->Update(); // writers are asked for no piece
    }
    checkInterrupt();
    if (!observation.message().empty())
    {
      throw ProgramError(code, observation.message());
    }
  };
  this->run(key, words, update);
}

void Stages::run(const std::string& key, const std::string& words, const std::function<void()>& work)
{
  checkInterrupt();
  this->Bar.begin(words);
  const auto start = std::chrono::steady_clock::now();
  work();
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  this->Bar.end();
  this->addSeconds(key, taken.count());
  checkInterrupt();
}

void Stages::addSeconds(const std::string& key, double seconds)
{
  const auto found = std::find_if(
    this->Seconds.begin(), this->Seconds.end(), [&key](const auto& stage) { return stage.first == key; });
  if (found == this->Seconds.end())
  {
    this->Seconds.emplace_back(key, seconds);
  }
  else
  {
    found->second += seconds;
  }
}

} // namespace silhouette::program
