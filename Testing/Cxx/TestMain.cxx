// SPDX-License-Identifier: BSD-3-Clause
/**
 * The main of every test that uses VTK: windows in memory, threads as the environment asks, errors of VTK on
 * the console.
 *
 * SILHOUETTE_TEST_THREADS: the number of threads of VTK's parallel loops; unset, all.
 */
#include "SilhouetteOffScreen.h"

#include "vtkSMPTools.h"

#include <gtest/gtest.h>

#include <cstdlib>

int main(int argc, char* argv[])
{
  silhouette::useOffScreenWindow();
  testing::InitGoogleTest(&argc, argv);
  if (const char* threads = std::getenv("SILHOUETTE_TEST_THREADS"))
  {
    vtkSMPTools::Initialize(std::atoi(threads));
  }
  return RUN_ALL_TESTS();
}
