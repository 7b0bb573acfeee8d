// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSilhouetteExtractor.h"

#include "CaptureImages.h"
#include "ItemWork.h"
#include "PieceRequests.h"
#include "SilhouetteExtraction.h"
#include "ViewConversion.h"
#include "vtkSilhouetteExecution.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"

using namespace silhouette::modeling;

class vtkSilhouetteExtractor::vtkInternals
{
public:
  std::vector<silhouette::MorphologyOperation> Operations;
};

namespace
{

/** The silhouettes as images; every other field array of the input stays with its view. */
std::vector<ImageView> silhouetteImages(const std::vector<ImageView>& views,
                                        const std::vector<silhouette::View>& silhouettes)
{
  std::vector<ImageView> images;
  for (std::size_t i = 0; i < views.size(); ++i)
  {
    ImageView view = imageOf(silhouettes[i]);
    view.image->SetSpacing(views[i].image->GetSpacing());
    view.image->SetOrigin(views[i].image->GetOrigin());
    view.image->GetPointData()->GetScalars()->SetName("Silhouette");
    view.image->GetFieldData()->ShallowCopy(views[i].image->GetFieldData());
    images.push_back(std::move(view));
  }
  return images;
}

} // namespace

vtkStandardNewMacro(vtkSilhouetteExtractor);

vtkSilhouetteExtractor::vtkSilhouetteExtractor()
    : KeyExcess(silhouette::ChromaKey().excess), Tolerance(silhouette::ExtractionOptions().tolerance),
      UseAlpha(silhouette::ExtractionOptions().alpha), InvertPolarity(silhouette::ExtractionOptions().invert),
      LargestRegion(silhouette::ExtractionOptions().largestRegion),
      FillHoles(silhouette::ExtractionOptions().fillHoles), Internals(new vtkInternals)
{
}

vtkSilhouetteExtractor::~vtkSilhouetteExtractor() = default;

void vtkSilhouetteExtractor::AddOperation(int operation, int radius)
{
  if (operation < OPENING || operation > ERODE)
  {
    vtkErrorMacro("operation " << operation << " is out of range: OPENING (0) to ERODE (3)");
    return;
  }
  this->Internals->Operations.push_back({static_cast<silhouette::MorphologyKind>(operation), radius});
  this->Modified();
}

void vtkSilhouetteExtractor::ClearOperations()
{
  if (!this->Internals->Operations.empty())
  {
    this->Internals->Operations.clear();
    this->Modified();
  }
}

int vtkSilhouetteExtractor::GetNumberOfOperations()
{
  return static_cast<int>(this->Internals->Operations.size());
}

int vtkSilhouetteExtractor::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPartitionedDataSetCollection");
  return 1;
}

int vtkSilhouetteExtractor::RequestUpdateExtent(vtkInformation* request, vtkInformationVector** inputs,
                                                vtkInformationVector* outputs)
{
  if (isNothing(requestedPiece(request, outputs)))
  {
    requestNothingNew(inputs, 1);
  }
  return 1;
}

int vtkSilhouetteExtractor::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                        vtkInformationVector* outputs)
{
  vtkPartitionedDataSetCollection* input = vtkPartitionedDataSetCollection::GetData(inputs[0]);
  vtkPartitionedDataSetCollection* output = vtkPartitionedDataSetCollection::GetData(outputs);

  const auto extract = [&](vtkSilhouetteExecution& execution)
  {
    if (isNothing(requestedPiece(request, outputs)))
    {
      return;
    }
    silhouette::ExtractionOptions options;
    if (this->KeyChannel != NONE)
    {
      options.key = {static_cast<silhouette::ColourChannel>(this->KeyChannel), this->KeyExcess};
    }
    if (this->UseBackgroundColor)
    {
      options.background = {this->BackgroundColor[0], this->BackgroundColor[1], this->BackgroundColor[2]};
    }
    options.tolerance = this->Tolerance;
    if (this->UseThreshold)
    {
      options.threshold = this->Threshold;
    }
    options.alpha = this->UseAlpha;
    options.invert = this->InvertPolarity;
    options.morphology = this->Internals->Operations;
    options.largestRegion = this->LargestRegion;
    options.fillHoles = this->FillHoles;
    silhouette::validate(options);

    const std::vector<ImageView> views = imageViews(input);
    std::vector<silhouette::View> silhouettes(views.size());
    silhouette::forItems(views.size(), execution,
                         [&](std::size_t i)
                         {
                           const ImageView& view = views[i];
                           silhouettes[i].silhouette = silhouette::extractSilhouette(
                               colourImage(view, i), options, isMask(view),
                               view.name.empty() ? silhouette::describeView(i, view.name) : view.name);
                           silhouettes[i].name = view.name;
                           silhouettes[i].projection = view.projection;
                         });
    orientBySilhouettes(views, silhouettes);
    storeViews(silhouetteImages(views, silhouettes), output);
  };
  return runFilter(this, outputs, extract);
}

void vtkSilhouetteExtractor::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const channels[] = {"None", "Red", "Green", "Blue"};
  const char* const operations[] = {"Opening", "Closing", "Dilate", "Erode"};
  os << indent << "KeyChannel: " << channels[this->KeyChannel + 1] << "\n";
  os << indent << "KeyExcess: " << this->KeyExcess << "\n";
  os << indent << "UseBackgroundColor: " << (this->UseBackgroundColor ? "On" : "Off") << "\n";
  os << indent << "BackgroundColor: (" << this->BackgroundColor[0] << ", " << this->BackgroundColor[1] << ", "
     << this->BackgroundColor[2] << ")\n";
  os << indent << "Tolerance: " << this->Tolerance << "\n";
  os << indent << "UseThreshold: " << (this->UseThreshold ? "On" : "Off") << "\n";
  os << indent << "Threshold: " << this->Threshold << "\n";
  os << indent << "UseAlpha: " << (this->UseAlpha ? "On" : "Off") << "\n";
  os << indent << "InvertPolarity: " << (this->InvertPolarity ? "On" : "Off") << "\n";
  os << indent << "Operations: " << this->Internals->Operations.size() << "\n";
  for (const silhouette::MorphologyOperation& operation : this->Internals->Operations)
  {
    os << indent.GetNextIndent() << operations[static_cast<int>(operation.kind)] << " " << operation.radius
       << "\n";
  }
  os << indent << "LargestRegion: " << (this->LargestRegion ? "On" : "Off") << "\n";
  os << indent << "FillHoles: " << this->FillHoles << "\n";
}
