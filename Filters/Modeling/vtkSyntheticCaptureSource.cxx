// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSyntheticCaptureSource.h"

#include "FieldValues.h"
#include "MeshConversion.h"
#include "PieceRequests.h"
#include "SyntheticCapture.h"
#include "SyntheticShapes.h"
#include "ViewConversion.h"
#include "vtkSilhouetteExecution.h"

#include "vtkDemandDrivenPipeline.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

using namespace silhouette::modeling;

namespace
{

std::vector<ImageView> maskImages(const silhouette::SyntheticCapture& capture)
{
  std::vector<ImageView> images;
  for (const silhouette::SyntheticView& view : capture.views)
  {
    images.push_back(imageOf({view.name, view.projection, view.mask}));
    setField(images.back().image, "IsMask", 1);
  }
  return images;
}

std::vector<ImageView> photographImages(const silhouette::SyntheticCapture& capture)
{
  std::vector<ImageView> images;
  for (const silhouette::SyntheticView& view : capture.views)
  {
    images.push_back(
        {makeImage({capture.width, capture.height, 3, view.photograph}), view.name, view.projection});
  }
  return images;
}

} // namespace

vtkStandardNewMacro(vtkSyntheticCaptureSource);

vtkSyntheticCaptureSource::vtkSyntheticCaptureSource()
    : Refinement(silhouette::SyntheticShapeOptions().refinement)
{
  const silhouette::SyntheticCaptureOptions defaults;
  this->NumberOfViews = defaults.views;
  this->Width = defaults.width;
  this->Height = defaults.height;
  this->Seed = static_cast<vtkIdType>(defaults.seed);
  this->NoiseContour = defaults.noiseContour;
  this->NoiseBlobs = defaults.noiseBlobs;
  this->NoisePixels = defaults.noisePixels;
  this->NoiseCamera = defaults.noiseCamera;
  this->NoiseRotation = defaults.noiseRotation;
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(3);
}

int vtkSyntheticCaptureSource::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkSyntheticCaptureSource::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkPolyData" : "vtkPartitionedDataSetCollection");
  return 1;
}

vtkPolyData* vtkSyntheticCaptureSource::GetTruthOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

vtkPartitionedDataSetCollection* vtkSyntheticCaptureSource::GetPhotographsOutput()
{
  return vtkPartitionedDataSetCollection::SafeDownCast(this->GetOutputDataObject(2));
}

void vtkSyntheticCaptureSource::SetInputData(vtkPolyData* mesh)
{
  this->SetInputDataInternal(0, mesh);
}

int vtkSyntheticCaptureSource::RequestInformation(vtkInformation*, vtkInformationVector**,
                                                  vtkInformationVector* outputs)
{
  outputs->GetInformationObject(0)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  outputs->GetInformationObject(2)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  return 1;
}

vtkTypeBool vtkSyntheticCaptureSource::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                                      vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_NOT_GENERATED()))
  {
    leaveOthersFromNothing(request, outputs);
    return 1;
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

int vtkSyntheticCaptureSource::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                           vtkInformationVector* outputs)
{
  vtkPolyData* given = vtkPolyData::GetData(inputs[0]);

  if (isNothing(requestedPiece(request, outputs)))
  {
    return 1;
  }

  const auto synthesize = [&](vtkSilhouetteExecution& execution)
  {
    silhouette::SyntheticShapeOptions shapeOptions;
    shapeOptions.refinement = this->Refinement;
    const silhouette::Mesh truth =
        given
            ? meshOf(given, "the mesh to photograph")
            : silhouette::syntheticShape(static_cast<silhouette::SyntheticShape>(this->Shape), shapeOptions);
    execution.checkpoint(0.2);

    silhouette::SyntheticCaptureOptions options;
    options.views = this->NumberOfViews;
    options.width = this->Width;
    options.height = this->Height;
    options.seed = static_cast<std::uint64_t>(this->Seed);
    options.noiseContour = this->NoiseContour;
    options.noiseBlobs = this->NoiseBlobs;
    options.noisePixels = this->NoisePixels;
    options.noiseCamera = this->NoiseCamera;
    options.noiseRotation = this->NoiseRotation;
    silhouette::Phase rendering(execution, 0.2, 0.95);
    const silhouette::SyntheticCapture capture = silhouette::synthesizeCapture(truth, options, rendering);

    storeViews(maskImages(capture), vtkPartitionedDataSetCollection::GetData(outputs, 0));
    storeMesh(truth, MeshOutput(), vtkPolyData::GetData(outputs, 1));
    storeViews(photographImages(capture), vtkPartitionedDataSetCollection::GetData(outputs, 2));
    execution.progress(1.0);
  };
  return runFilter(this, outputs, synthesize);
}

void vtkSyntheticCaptureSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const shapes[] = {"Jug", "Sphere", "Torus", "Twig", "Pebble", "Pumpkin"};
  os << indent << "Shape: " << shapes[this->Shape] << "\n";
  os << indent << "Refinement: " << this->Refinement << "\n";
  os << indent << "NumberOfViews: " << this->NumberOfViews << "\n";
  os << indent << "Width: " << this->Width << "\n";
  os << indent << "Height: " << this->Height << "\n";
  os << indent << "Seed: " << this->Seed << "\n";
  os << indent << "NoiseContour: " << this->NoiseContour << "\n";
  os << indent << "NoiseBlobs: " << this->NoiseBlobs << "\n";
  os << indent << "NoisePixels: " << this->NoisePixels << "\n";
  os << indent << "NoiseCamera: " << this->NoiseCamera << "\n";
  os << indent << "NoiseRotation: " << this->NoiseRotation << "\n";
}
