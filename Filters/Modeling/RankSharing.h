// SPDX-License-Identifier: BSD-3-Clause
/**
 * What the first of a controller's ranks does for all of them, so that it is done once. Every function here
 * but oneForEachRank() is called by all ranks at the same point, or by the first and its counterpart by each
 * other. Private to the module.
 */
#pragma once

#include "TreePieces.h"
#include "vtkSilhouetteExecution.h"

class vtkAlgorithm;
class vtkInformation;
class vtkMultiProcessController;
class vtkPolyData;

namespace silhouette::modeling
{

/**
 * Whether this rank, of several, is asked for its own of as many pieces as there are ranks. Then every rank
 * is, and all work at the same time.
 */
bool oneForEachRank(vtkMultiProcessController* controller, const Piece& piece);

/** The piece of a rank. */
Piece pieceOfRank(vtkMultiProcessController* controller, int rank);

/**
 * Bring the filter's inputs up to date, as VTK does before it asks a filter for data, and tell the others how
 * that went: VTK does not ask a filter at all whose inputs failed, and the others would wait for it. To be
 * called when VTK is about to forward REQUEST_DATA; what it forwards then finds everything up to date. True
 * where no rank failed. Elsewhere the outputs are empty, and a rank that did not fail itself reports which
 * one did.
 */
bool updateInputsTogether(vtkAlgorithm* filter, vtkInformation* request,
                          vtkMultiProcessController* controller);

/** The first rank tells the others how its work ended. */
void tellOutcome(vtkMultiProcessController* controller, const Outcome& outcome);

/** What the first rank tells. */
Outcome hearOutcome(vtkMultiProcessController* controller);

/**
 * The first rank sends another its share: of one without triangles the field data alone. Throws Error where
 * the controller cannot.
 */
void sendShare(vtkMultiProcessController* controller, vtkPolyData* share, int rank);

/** Receive this rank's share from the first. Throws Error where the controller cannot. */
void receiveShare(vtkMultiProcessController* controller, vtkPolyData* share);

} // namespace silhouette::modeling
