// SPDX-License-Identifier: BSD-3-Clause
#include "Interrupt.h"

#include "ExitCodes.h"

#include <csignal>

namespace silhouette::program
{
namespace
{

volatile std::sig_atomic_t interrupted = 0;

extern "C" void rememberInterrupt(int)
{
  interrupted = 1;
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
    action.sa_flags = static_cast<int>(SA_RESETHAND | SA_RESTART); // the second one finds the default action
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
