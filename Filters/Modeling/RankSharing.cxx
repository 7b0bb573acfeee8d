// SPDX-License-Identifier: BSD-3-Clause
#include "RankSharing.h"

#include "Error.h"

#include "vtkAlgorithm.h"
#include "vtkCommunicator.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkMultiProcessStream.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

namespace silhouette::modeling
{
namespace
{

constexpr int FirstRank = 0;
constexpr int ShareTag = 7341;

/** Forward the request to all inputs, as vtkExecutive::ForwardUpstream() does. */
bool forwardUpstream(vtkAlgorithm* filter, vtkInformation* request)
{
  const int from = request->Get(vtkExecutive::FROM_OUTPUT_PORT());
  bool done = true;
  for (int port = 0; port < filter->GetNumberOfInputPorts(); ++port)
  {
    for (int connection = 0; connection < filter->GetNumberOfInputConnections(port); ++connection)
    {
      vtkExecutive* producer = nullptr;
      int producerPort = 0;
      vtkExecutive::PRODUCER()->Get(filter->GetExecutive()->GetInputInformation(port, connection), producer,
                                    producerPort);
      if (producer)
      {
        request->Set(vtkExecutive::FROM_OUTPUT_PORT(), producerPort);
        done = producer->ProcessRequest(request, producer->GetInputInformation(),
                                        producer->GetOutputInformation()) &&
               done;
      }
    }
  }
  request->Set(vtkExecutive::FROM_OUTPUT_PORT(), from);
  return done;
}

} // namespace

bool oneForEachRank(vtkMultiProcessController* controller, const Piece& piece)
{
  return controller && controller->GetNumberOfProcesses() > 1 &&
         piece.count == controller->GetNumberOfProcesses() && piece.number == controller->GetLocalProcessId();
}

Piece pieceOfRank(vtkMultiProcessController* controller, int rank)
{
  return {rank, controller->GetNumberOfProcesses()};
}

bool updateInputsTogether(vtkAlgorithm* filter, vtkInformation* request,
                          vtkMultiProcessController* controller)
{
  const int ranks = controller->GetNumberOfProcesses(), own = controller->GetLocalProcessId();
  const bool done = forwardUpstream(filter, request);
  const int failed = done ? ranks : own;
  int firstFailed = failed;
  controller->AllReduce(&failed, &firstFailed, 1, vtkCommunicator::MIN_OP);
  if (firstFailed == ranks)
  {
    return true;
  }
  Outcome outcome{Outcome::End::Cancelled, {}}; // the input that failed has said why
  if (done)
  {
    outcome = {Outcome::End::Failed,
               "rank " + std::to_string(firstFailed) +
                   " could not make what the surface is made from; its own messages say why"};
  }
  settle(filter, filter->GetExecutive()->GetOutputInformation(), outcome,
         request->Get(vtkExecutive::FROM_OUTPUT_PORT()));
  return false;
}

void tellOutcome(vtkMultiProcessController* controller, const Outcome& outcome)
{
  vtkMultiProcessStream stream;
  stream << static_cast<int>(outcome.end) << outcome.message;
  controller->Broadcast(stream, FirstRank);
}

Outcome hearOutcome(vtkMultiProcessController* controller)
{
  vtkMultiProcessStream stream;
  controller->Broadcast(stream, FirstRank);
  int end = 0;
  Outcome outcome;
  stream >> end >> outcome.message;
  outcome.end = static_cast<Outcome::End>(end);
  return outcome;
}

void sendShare(vtkMultiProcessController* controller, vtkPolyData* share, int rank)
{
  vtkNew<vtkPolyData> fields;
  if (share->GetNumberOfCells() == 0)
  {
    // VTK sends what has neither points nor cells as text, which rounds the field data: a point keeps it
    // from that.
    vtkNew<vtkPoints> points;
    points->InsertNextPoint(0.0, 0.0, 0.0);
    fields->SetPoints(points);
    fields->GetFieldData()->PassData(share->GetFieldData());
    share = fields;
  }
  if (!controller->Send(share, rank, ShareTag))
  {
    throw Error("the share of rank " + std::to_string(rank) + " could not be sent");
  }
}

void receiveShare(vtkMultiProcessController* controller, vtkPolyData* share)
{
  if (!controller->Receive(share, FirstRank, ShareTag))
  {
    throw Error("the share of this rank could not be received");
  }
  if (share->GetNumberOfCells() == 0)
  {
    share->SetPoints(nullptr);
  }
}

} // namespace silhouette::modeling
