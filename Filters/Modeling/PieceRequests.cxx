// SPDX-License-Identifier: BSD-3-Clause
#include "PieceRequests.h"

#include "vtkDataObject.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <limits>

namespace silhouette::modeling
{

using Pipeline = vtkStreamingDemandDrivenPipeline;

namespace
{

constexpr Piece Whole{0, 1};
constexpr Piece Nothing{1, std::numeric_limits<int>::max()};

bool differ(const Piece& one, const Piece& other)
{
  return one.number != other.number || one.count != other.count;
}

/** Leave each output for which `another(piece under request, its piece)`. */
template <typename Another>
void leaveOthers(vtkInformation* request, vtkInformationVector* outputs, const Another& another)
{
  const int from =
      request->Has(Pipeline::FROM_OUTPUT_PORT()) ? request->Get(Pipeline::FROM_OUTPUT_PORT()) : -1;
  for (int port = 0; from >= 0 && port < outputs->GetNumberOfInformationObjects(); ++port)
  {
    if (another(requestedPiece(outputs, from), requestedPiece(outputs, port)))
    {
      outputs->GetInformationObject(port)->Set(Pipeline::DATA_NOT_GENERATED(), 1);
    }
  }
}

bool holdsWhole(vtkInformation* input)
{
  vtkDataObject* data = vtkDataObject::GetData(input);
  vtkInformation* held = data ? data->GetInformation() : nullptr;
  return held && held->Get(vtkDataObject::DATA_PIECE_NUMBER()) == Whole.number &&
         held->Get(vtkDataObject::DATA_NUMBER_OF_PIECES()) == Whole.count;
}

/** Ask for `pieceOf(input)` of each input. */
template <typename PieceOf>
void requestPieces(vtkInformationVector** inputs, int ports, const PieceOf& pieceOf)
{
  for (int port = 0; port < ports; ++port)
  {
    for (int connection = 0; connection < inputs[port]->GetNumberOfInformationObjects(); ++connection)
    {
      vtkInformation* input = inputs[port]->GetInformationObject(connection);
      const Piece piece = pieceOf(input);
      input->Set(Pipeline::UPDATE_PIECE_NUMBER(), piece.number);
      input->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), piece.count);
      input->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
    }
  }
}

} // namespace

Piece requestedPiece(vtkInformationVector* outputs, int port)
{
  vtkInformation* output = outputs->GetInformationObject(port);
  Piece piece;
  if (output->Has(Pipeline::UPDATE_PIECE_NUMBER()) && output->Has(Pipeline::UPDATE_NUMBER_OF_PIECES()))
  {
    piece.number = output->Get(Pipeline::UPDATE_PIECE_NUMBER());
    piece.count = std::max(1, output->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()));
  }
  return piece;
}

Piece requestedPiece(vtkInformation* request, vtkInformationVector* outputs)
{
  const int port =
      request->Has(Pipeline::FROM_OUTPUT_PORT()) ? request->Get(Pipeline::FROM_OUTPUT_PORT()) : 0;
  return requestedPiece(outputs, std::max(port, 0));
}

bool isNothing(const Piece& piece)
{
  return piece.number > 0 && piece.count == Nothing.count;
}

void requestWhole(vtkInformationVector** inputs, int ports)
{
  requestPieces(inputs, ports, [](vtkInformation*) { return Whole; });
}

void requestNothing(vtkInformationVector** inputs, int ports)
{
  requestPieces(inputs, ports, [](vtkInformation*) { return Nothing; });
}

void requestNothingNew(vtkInformationVector** inputs, int ports)
{
  requestPieces(inputs, ports, [](vtkInformation* input) { return holdsWhole(input) ? Whole : Nothing; });
}

void leaveOtherPieces(vtkInformation* request, vtkInformationVector* outputs)
{
  leaveOthers(request, outputs, differ);
}

void leaveOthersFromNothing(vtkInformation* request, vtkInformationVector* outputs)
{
  leaveOthers(request, outputs,
              [](const Piece& asked, const Piece& other) { return isNothing(asked) && !isNothing(other); });
}

bool isGenerated(vtkInformationVector* outputs, int port)
{
  return !outputs->GetInformationObject(port)->Get(Pipeline::DATA_NOT_GENERATED());
}

} // namespace silhouette::modeling
