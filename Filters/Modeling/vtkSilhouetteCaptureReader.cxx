// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSilhouetteCaptureReader.h"

#include "CaptureFolder.h"
#include "CaptureImages.h"
#include "ImageFiles.h"
#include "PieceRequests.h"
#include "ViewConversion.h"
#include "vtkSilhouetteExecution.h"

#include "vtkDemandDrivenPipeline.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"

#include <exception>

using namespace silhouette::modeling;

vtkStandardNewMacro(vtkSilhouetteCaptureReader);

vtkSilhouetteCaptureReader::vtkSilhouetteCaptureReader()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(2);
}

vtkSilhouetteCaptureReader::~vtkSilhouetteCaptureReader()
{
  this->SetFileName(nullptr);
  this->SetViews(nullptr);
}

int vtkSilhouetteCaptureReader::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkPartitionedDataSetCollection" : "vtkPolyData");
  return 1;
}

vtkPolyData* vtkSilhouetteCaptureReader::GetCamerasOutput()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

int vtkSilhouetteCaptureReader::CanReadFile(const char* fileName)
{
  try
  {
    silhouette::CaptureOptions options;
    options.sizeOf = readImageSize;
    silhouette::describeCapture(fileName ? fileName : "", options);
    return 1;
  }
  catch (const std::exception&)
  {
    return 0;
  }
}

int vtkSilhouetteCaptureReader::RequestInformation(vtkInformation*, vtkInformationVector**,
                                                   vtkInformationVector* outputs)
{
  outputs->GetInformationObject(0)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  return 1;
}

vtkTypeBool vtkSilhouetteCaptureReader::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                                       vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_NOT_GENERATED()))
  {
    leaveOthersFromNothing(request, outputs);
    return 1;
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

int vtkSilhouetteCaptureReader::RequestData(vtkInformation* request, vtkInformationVector**,
                                            vtkInformationVector* outputs)
{
  if (isNothing(requestedPiece(request, outputs)))
  {
    return 1;
  }

  const auto read = [&](vtkSilhouetteExecution& execution)
  {
    if (!this->FileName || !*this->FileName)
    {
      throw silhouette::InvalidInput("no file name: the folder of a capture or its camera file is needed");
    }
    silhouette::CaptureOptions options;
    options.views = this->Views ? this->Views : "";
    options.cornerFamily = this->PixelFamily == CORNER;
    options.sizeOf = readImageSize;
    const silhouette::CaptureDescription capture = silhouette::describeCapture(this->FileName, options);
    silhouette::Phase reading(execution, 0.0, 0.98);
    std::vector<std::string> warnings = capture.warnings;
    const std::vector<ImageView> views =
        readCapture(capture, static_cast<CaptureImageChoice>(this->ImageChoice), warnings, reading);
    for (const std::string& warning : warnings)
    {
      vtkWarningMacro(<< warning);
    }
    storeViews(views, vtkPartitionedDataSetCollection::GetData(outputs, 0));
    storeFrustums(views, vtkPolyData::GetData(outputs, 1));
    execution.progress(1.0);
  };
  return runFilter(this, outputs, read);
}

void vtkSilhouetteCaptureReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const choices[] = {"MasksWherePresent", "Photographs", "Masks"};
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "Views: " << (this->Views ? this->Views : "(all)") << "\n";
  os << indent << "ImageChoice: " << choices[this->ImageChoice] << "\n";
  os << indent << "PixelFamily: " << (this->PixelFamily == CORNER ? "Corner" : "Integer") << "\n";
}
