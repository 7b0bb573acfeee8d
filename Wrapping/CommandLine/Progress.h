// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the program says while it works: a bar for each stage on a terminal, errors and warnings of one line.
 */
#pragma once

#include <string>

namespace silhouette::program
{

/** A bar on standard error; says nothing where that is no terminal, or where it is told to be quiet. */
class Progress
{
public:
  explicit Progress(bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /** Begin a stage, in words: "carving the octree". */
  void begin(const std::string& stage);
  /** The share of the stage that is done, 0 to 1. */
  void update(double fraction);
  /** End the stage: the bar disappears. */
  void end();

private:
  bool Shown;
  std::string Stage;
  int Drawn = -1; ///< tenths of a per cent; -1 where there is no bar
};

/** One line, "vtksilhouette: error: ...", on standard error, in place of the bar. */
void sayError(const std::string& message);
/** One line, "vtksilhouette: warning: ..."; said once, however often it is called with the same text. */
void sayWarning(const std::string& message);

} // namespace silhouette::program
