// SPDX-License-Identifier: BSD-3-Clause
/**
 * The figures of Documentation/experiments.md, rendered off screen.
 */
#pragma once

#include "Cases.h"
#include "Execution.h"

#include <filesystem>

namespace silhouette::experiments
{

/**
 * All figures, as experiments-NAME.png in `folder`: figure-6-3, figure-6-4 and one for each object of the
 * options, of their first seed. Throws InvalidInput where nothing can be rendered.
 */
void makeFigures(const StudyOptions& options, const std::filesystem::path& folder, Execution& execution);

} // namespace silhouette::experiments
