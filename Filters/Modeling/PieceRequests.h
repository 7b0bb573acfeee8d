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

/** The piece that the output port under request is asked for; the whole where it is not asked for a piece. */
Piece requestedPiece(vtkInformation* request, vtkInformationVector* outputs);

/** Ask for all there is of each input, whatever the output is asked for. */
void requestWhole(vtkInformationVector** inputs, int ports);

} // namespace silhouette::modeling
