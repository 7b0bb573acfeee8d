// SPDX-License-Identifier: BSD-3-Clause
#include "Progress.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <set>

#include <unistd.h>

namespace silhouette::program
{
namespace
{

constexpr int BarWidth = 30;
constexpr int StageWidth = 26;

bool barOnScreen = false;

void eraseBar()
{
  if (barOnScreen)
  {
    std::fputs("\r\033[K", stderr);
    std::fflush(stderr);
    barOnScreen = false;
  }
}

/** Line breaks would make several lines of one message. */
std::string oneLine(std::string text)
{
  std::replace(text.begin(), text.end(), '\n', ' ');
  const std::size_t last = text.find_last_not_of(' ');
  return last == std::string::npos ? std::string() : text.substr(0, last + 1);
}

void say(const char* kind, const std::string& message)
{
  eraseBar();
  std::fprintf(stderr, "vtksilhouette: %s: %s\n", kind, oneLine(message).c_str());
}

} // namespace

Progress::Progress(bool quiet)
  : Shown(!quiet && isatty(STDERR_FILENO) != 0)
{
}

Progress::~Progress()
{
  eraseBar();
}

void Progress::begin(const std::string& stage)
{
  this->Stage = stage;
  this->Drawn = -1;
  this->update(0.0);
}

void Progress::update(double fraction)
{
  const int done = static_cast<int>(std::lround(1000.0 * std::clamp(fraction, 0.0, 1.0)));
  if (!this->Shown || done == this->Drawn)
  {
    return;
  }
  this->Drawn = done;
  std::string bar(static_cast<std::size_t>(done * BarWidth / 1000), '=');
  bar.resize(BarWidth, ' ');
  std::fprintf(stderr, "\r%-*s [%s] %3d %%", StageWidth, this->Stage.c_str(), bar.c_str(), done / 10);
  std::fflush(stderr);
  barOnScreen = true;
}

void Progress::end()
{
  eraseBar();
}

void sayError(const std::string& message)
{
  say("error", message);
}

void sayWarning(const std::string& message)
{
  static std::set<std::string> said;
  if (said.insert(message).second)
  {
    say("warning", message);
  }
}

} // namespace silhouette::program
