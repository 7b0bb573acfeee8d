// SPDX-License-Identifier: BSD-3-Clause
/**
 * How a parameter out of range is refused: with its name, its value as a user would write it, and the range.
 */
#pragma once

#include "Error.h"

#include <limits>
#include <locale>
#include <sstream>
#include <string>

namespace silhouette
{

/** A number as a user would write it: 3, 0.35, 1e-06. */
inline std::string numberText(double value)
{
  std::ostringstream text;
  text.imbue(std::locale::classic());
  text.precision(10); // 2^32 in full
  text << value;
  return text.str();
}

/** Throws InvalidInput where `value` is not from `least` to `greatest`, which NaN never is. */
inline void requireRange(const char* name, double value, double least, double greatest = std::numeric_limits<double>::infinity())
{
  if (!(value >= least && value <= greatest))
  {
    throw InvalidInput(std::string(name) + " " + numberText(value) +
      (greatest < std::numeric_limits<double>::infinity() ? " is outside " + numberText(least) + " to " + numberText(greatest)
                                                          : ": at least " + numberText(least) + " is needed"));
  }
}

/** The same where it is not above 0, or above `greatest`. */
inline void requireAboveZero(const char* name, double value, double greatest = std::numeric_limits<double>::infinity())
{
  if (!(value > 0.0 && value <= greatest))
  {
    throw InvalidInput(std::string(name) + " " + numberText(value) + ": above 0" +
      (greatest < std::numeric_limits<double>::infinity() ? " and at most " + numberText(greatest) : "") + " is needed");
  }
}

} // namespace silhouette
