// SPDX-License-Identifier: BSD-3-Clause
/**
 * The few errors that the core throws. Each message names the view and the value at fault; the caller adds
 * the file. Nothing is ever signalled by an empty result alone.
 */
#pragma once

#include <stdexcept>

namespace silhouette
{

/** Base of every error of the core. */
struct Error : std::runtime_error
{
  using std::runtime_error::runtime_error;
};

/** A parameter or an input is outside what the function accepts. */
struct InvalidInput : Error
{
  using Error::Error;
};

/** The views carve everything away. */
struct NothingSurvives : Error
{
  using Error::Error;
};

/** The viewing cones do not bound the object, so that no root cube can be found. */
struct UnboundedObject : Error
{
  using Error::Error;
};

/** The caller asked to stop (Execution::cancelled). */
struct Cancelled : Error
{
  Cancelled()
    : Error("cancelled")
  {
  }
};

} // namespace silhouette
