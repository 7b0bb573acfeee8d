// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the study measures of a surface.
 */
#pragma once

#include "Methods.h"
#include "Rows.h"

namespace silhouette::experiments
{

/** Make the method's surface and measure it; whatever is thrown on the way becomes the row's failure. */
Row runMethod(const Method& method, Trial& trial, const Case& at, const Settings& settings);

} // namespace silhouette::experiments
