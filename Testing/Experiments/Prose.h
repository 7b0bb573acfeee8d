// SPDX-License-Identifier: BSD-3-Clause
/**
 * All that Documentation/experiments.md says in words, in the order of the page.
 */
#pragma once

namespace silhouette::experiments::prose
{

extern const char* const Opening;
extern const char* const Setting;
extern const char* const Measures;
extern const char* const Promises;
extern const char* const Targets;
extern const char* const Errors;
extern const char* const Shapes;
extern const char* const Times;
extern const char* const Failures;
extern const char* const Stages;
extern const char* const Scaling;
extern const char* const Islands;
extern const char* const Votes;
extern const char* const Generations;
extern const char* const Hulls;

} // namespace silhouette::experiments::prose
