// SPDX-License-Identifier: BSD-3-Clause
/**
 * Interrupts (SIGINT, SIGTERM, SIGHUP): the first asks the work to stop, which then leaves no partial file; a
 * second one ends the program at once. What follows the first within half a second is taken for the same, since some who stop a program tell
 * it twice, once itself and once as one of a group (timeout does).
 */
#pragma once

namespace silhouette::program
{

/** From now on interrupts are remembered. A signal that the parent process had ignored stays ignored. */
void watchForInterrupts();

bool isInterrupted();

/** Throws Interrupted once there was an interrupt. */
void checkInterrupt();

} // namespace silhouette::program
