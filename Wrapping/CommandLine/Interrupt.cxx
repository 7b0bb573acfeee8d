// SPDX-License-Identifier: BSD-3-Clause
#include "Interrupt.h"

#include "ExitCodes.h"

#include <csignal>
#include <ctime>

namespace silhouette::program
{
namespace
{

volatile std::sig_atomic_t interrupted = 0;
timespec whenInterrupted = {};

double secondsSince(const timespec& then)
{
  timespec now = {};
  clock_gettime(CLOCK_MONOTONIC, &now); // may be called in a handler
  return double(now.tv_sec - then.tv_sec) + 1e-9 * double(now.tv_nsec - then.tv_nsec);
}

extern "C" void rememberInterrupt(int signal)
{
  constexpr double one = 0.5; // seconds
  if (interrupted == 0)
  {
    clock_gettime(CLOCK_MONOTONIC, &whenInterrupted);
    interrupted = 1;
  }
  else if (secondsSince(whenInterrupted) > one)
  {
    std::signal(signal, SIG_DFL);
    raise(signal);
  }
}

} // namespace

void watchForInterrupts()
{
  for (const int signal : { SIGINT, SIGTERM, SIGHUP })
  {
    struct sigaction before = {};
    sigaction(signal, nullptr, &before);
    if (before.sa_handler == SIG_IGN)
    {
      continue; // nohup, or a shell's background job
    }
    struct sigaction action = {};
    action.sa_handler = rememberInterrupt;
    action.sa_flags = static_cast<int>(SA_RESTART);
    sigaction(signal, &action, nullptr);
  }
}

bool isInterrupted()
{
  return interrupted != 0;
}

void checkInterrupt()
{
  if (isInterrupted())
  {
    throw Interrupted();
  }
}

} // namespace silhouette::program
