// SPDX-License-Identifier: BSD-3-Clause
/**
 * Piece requests, as VTK's pipeline and so ParaView's engine make them. Private to the module.
 */
#pragma once

#include "TreePieces.h"

class vtkInformation;
class vtkInformationVector;

namespace silhouette::modeling
{

/** The piece that an output port is asked for; the whole where it is not asked for a piece. */
Piece requestedPiece(vtkInformationVector* outputs, int port);

/** The same of the output port under request. */
Piece requestedPiece(vtkInformation* request, vtkInformationVector* outputs);

/**
 * Whether a piece is the one that requestNothing() asks for: the second of 2^31 - 1, in which no even
 * division of anything leaves an item. Who is asked for it reads and makes nothing; VTK does not run a source
 * for it that knows no pieces.
 */
bool isNothing(const Piece& piece);

/** Ask for all there is of each input, whatever the output is asked for. */
void requestWhole(vtkInformationVector** inputs, int ports);

/** Ask for nothing of each input. */
void requestNothing(vtkInformationVector** inputs, int ports);

/**
 * Ask for nothing new: for nothing, but for the whole where an input holds that already, so that it is not
 * made again for the next who asks.
 */
void requestNothingNew(vtkInformationVector** inputs, int ports);

/**
 * For REQUEST_DATA_NOT_GENERATED of a filter with several outputs: those that are asked for another piece
 * than the one under request are left as they are, and stay out of date where they were. Otherwise VTK would
 * take what is made now for what they are asked for.
 */
void leaveOtherPieces(vtkInformation* request, vtkInformationVector* outputs);

/**
 * The same for a filter that gives the whole whatever piece it is asked for: only who asks for nothing asks
 * for another.
 */
void leaveOthersFromNothing(vtkInformation* request, vtkInformationVector* outputs);

/** Whether an output is not left as it is. */
bool isGenerated(vtkInformationVector* outputs, int port);

} // namespace silhouette::modeling
