// SPDX-License-Identifier: BSD-3-Clause
#include "PieceRequests.h"

#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

namespace silhouette::modeling
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

Piece requestedPiece(vtkInformation* request, vtkInformationVector* outputs)
{
  const int port = request->Has(Pipeline::FROM_OUTPUT_PORT()) ? request->Get(Pipeline::FROM_OUTPUT_PORT()) : 0;
  vtkInformation* output = outputs->GetInformationObject(std::max(port, 0));
  Piece piece;
  if (output->Has(Pipeline::UPDATE_PIECE_NUMBER()) && output->Has(Pipeline::UPDATE_NUMBER_OF_PIECES()))
  {
    piece.number = output->Get(Pipeline::UPDATE_PIECE_NUMBER());
    piece.count = std::max(1, output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()));
  }
  return piece;
}

void requestWhole(vtkInformationVector** inputs, int ports)
{
  for (int port = 0; port < ports; ++port)
  {
    for (int connection = 0; connection < inputs[port]->GetNumberOfInformationObjects(); ++connection)
    {
      vtkInformation* input = inputs[port]->GetInformationObject(connection);
      input->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
      input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
      input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    }
  }
}

} // namespace silhouette::modeling
