// SPDX-License-Identifier: BSD-3-Clause
#include "vtkSilhouetteOctreeSource.h"

#include "AutomaticBounds.h"
#include "Carving.h"
#include "CarvingSetup.h"
#include "FieldValues.h"
#include "OctreeConversion.h"
#include "OctreeSharing.h"
#include "PieceRequests.h"
#include "PreparedViewsSharing.h"
#include "ViewConversion.h"
#include "vtkSilhouetteExecution.h"

#include "vtkDemandDrivenPipeline.h"
#include "vtkHyperTreeGrid.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>

using namespace silhouette::modeling;

class vtkSilhouetteOctreeSource::vtkInternals
{
public:
  std::vector<ImageView> Added;
  FoundWhole Found; ///< what the last piece left for those after it

  /** The views of the input, then those added. */
  std::vector<ImageView> views(vtkPartitionedDataSetCollection* input) const
  {
    std::vector<ImageView> all = imageViews(input);
    all.insert(all.end(), this->Added.begin(), this->Added.end());
    return all;
  }

  /**
   * The same, made ready; what travels with the input is taken where it is all there is, and what was made
   * for another piece where nothing has changed since.
   */
  SharedViews prepare(vtkPartitionedDataSetCollection* input, const silhouette::ViewOptions& options,
                      silhouette::Execution& execution)
  {
    const std::vector<ImageView> all = this->views(input);
    if (!this->isPrepared(all, options))
    {
      this->Last.views.reset();
      this->Last.views = this->Added.empty() ? preparedViews(input, options, execution)
                                             : std::make_shared<const silhouette::PreparedViews>(
                                                   silhouetteViews(all, execution), options, execution);
      this->Last.given = all;
      this->Last.times.clear();
      for (const ImageView& view : all)
      {
        this->Last.times.push_back(view.image->GetMTime());
      }
    }
    return this->Last.views;
  }

private:
  bool isPrepared(const std::vector<ImageView>& all, const silhouette::ViewOptions& options) const
  {
    if (!this->Last.views || this->Last.views->options().outside != options.outside ||
        this->Last.given.size() != all.size())
    {
      return false;
    }
    for (std::size_t i = 0; i < all.size(); ++i)
    {
      const ImageView& before = this->Last.given[i];
      if (before.image != all[i].image || before.projection != all[i].projection ||
          before.name != all[i].name || this->Last.times[i] != all[i].image->GetMTime())
      {
        return false;
      }
    }
    return true;
  }

  /** The views prepared last, and what they were prepared from. */
  struct
  {
    SharedViews views;
    std::vector<ImageView> given;
    std::vector<vtkMTimeType> times;
  } Last;
};

namespace
{

/** The views that were used, as VTK carries them. */
void storeUsed(const CarvedViews& carved, const std::vector<ImageView>& given,
               vtkPartitionedDataSetCollection* output)
{
  std::vector<ImageView> dilated;
  for (const silhouette::View& view : carved.dilatedViews)
  {
    dilated.push_back(imageOf(view));
  }
  storeViews(dilated.empty() ? given : dilated, output);
  attachPreparedViews(output, carved.views);
}

void storeTolerance(const CarvedViews& carved, vtkHyperTreeGrid* grid)
{
  setField(grid, "Dilation", carved.dilation);
  if (carved.uncovered && carved.strictUncovered)
  {
    setField(grid, "UncoveredShare", *carved.uncovered);
    setField(grid, "StrictUncoveredShare", *carved.strictUncovered);
  }
}

void storeGrid(CarvedViews& carved, const silhouette::Piece& piece, vtkHyperTreeGrid* grid)
{
  storeOctree(carved.octree, grid);
  setField(grid, "Piece", piece.number);
  setField(grid, "NumberOfPieces", piece.count);
  storeTolerance(carved, grid);
  attachOctree(grid, std::make_shared<const silhouette::Octree>(std::move(carved.octree)));
}

} // namespace

vtkStandardNewMacro(vtkSilhouetteOctreeSource);

vtkSilhouetteOctreeSource::vtkSilhouetteOctreeSource()
    : Depth(silhouette::AutomaticBoundsOptions().depth),
      BackgroundVotes(silhouette::CarveOptions().backgroundVotes),
      OutsidePolicy(static_cast<int>(silhouette::ViewOptions().outside)), Internals(new vtkInternals)
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(2);
}

vtkSilhouetteOctreeSource::~vtkSilhouetteOctreeSource() = default;

void vtkSilhouetteOctreeSource::AddView(vtkImageData* image, const double p[12], const char* name)
{
  if (!image || !p)
  {
    vtkErrorMacro("AddView needs an image and a matrix of 12 numbers");
    return;
  }
  ImageView view;
  view.image = image;
  view.name = name ? name : "";
  std::copy_n(p, 12, view.projection.data());
  this->Internals->Added.push_back(std::move(view));
  this->Modified();
}

void vtkSilhouetteOctreeSource::RemoveAllViews()
{
  if (!this->Internals->Added.empty())
  {
    this->Internals->Added.clear();
    this->Modified();
  }
}

int vtkSilhouetteOctreeSource::GetNumberOfAddedViews()
{
  return static_cast<int>(this->Internals->Added.size());
}

void vtkSilhouetteOctreeSource::SetBoundsOrigin(double x, double y, double z)
{
  double size[3];
  this->GetBoundsSize(size);
  this->SetBounds(x, x + size[0], y, y + size[1], z, z + size[2]);
}

void vtkSilhouetteOctreeSource::GetBoundsOrigin(double origin[3])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    origin[axis] = this->Bounds[2 * axis];
  }
}

void vtkSilhouetteOctreeSource::SetBoundsSize(double x, double y, double z)
{
  double origin[3];
  this->GetBoundsOrigin(origin);
  this->SetBounds(origin[0], origin[0] + x, origin[1], origin[1] + y, origin[2], origin[2] + z);
}

void vtkSilhouetteOctreeSource::GetBoundsSize(double size[3])
{
  for (int axis = 0; axis < 3; ++axis)
  {
    size[axis] = this->Bounds[2 * axis + 1] - this->Bounds[2 * axis];
  }
}

vtkHyperTreeGrid* vtkSilhouetteOctreeSource::GetOutput()
{
  return vtkHyperTreeGrid::SafeDownCast(this->GetOutputDataObject(0));
}

vtkPartitionedDataSetCollection* vtkSilhouetteOctreeSource::GetViewsOutput()
{
  return vtkPartitionedDataSetCollection::SafeDownCast(this->GetOutputDataObject(1));
}

void vtkSilhouetteOctreeSource::SetInputData(vtkPartitionedDataSetCollection* views)
{
  this->SetInputDataInternal(0, views);
}

vtkMTimeType vtkSilhouetteOctreeSource::GetMTime()
{
  vtkMTimeType time = this->Superclass::GetMTime();
  for (const ImageView& view : this->Internals->Added)
  {
    time = std::max(time, view.image->GetMTime());
  }
  return time;
}

int vtkSilhouetteOctreeSource::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPartitionedDataSetCollection");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  return 1;
}

int vtkSilhouetteOctreeSource::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(),
            port == 0 ? "vtkHyperTreeGrid" : "vtkPartitionedDataSetCollection");
  return 1;
}

vtkTypeBool vtkSilhouetteOctreeSource::ProcessRequest(vtkInformation* request, vtkInformationVector** inputs,
                                                      vtkInformationVector* outputs)
{
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_INFORMATION()))
  {
    for (int port = 0; port < 2; ++port)
    {
      outputs->GetInformationObject(port)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
    }
    return 1;
  }
  if (request->Has(vtkStreamingDemandDrivenPipeline::REQUEST_UPDATE_EXTENT()))
  {
    if (isNothing(requestedPiece(request, outputs)))
    {
      requestNothingNew(inputs, 1);
    }
    else
    {
      requestWhole(inputs, 1); // every piece needs every view
    }
    return 1;
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA_NOT_GENERATED()))
  {
    leaveOtherPieces(request, outputs);
    return 1;
  }
  if (request->Has(vtkDemandDrivenPipeline::REQUEST_DATA()))
  {
    return this->RequestData(request, inputs, outputs);
  }
  return this->Superclass::ProcessRequest(request, inputs, outputs);
}

int vtkSilhouetteOctreeSource::RequestData(vtkInformation* request, vtkInformationVector** inputs,
                                           vtkInformationVector* outputs)
{
  vtkPartitionedDataSetCollection* input = vtkPartitionedDataSetCollection::GetData(inputs[0]);
  vtkHyperTreeGrid* grid = vtkHyperTreeGrid::GetData(outputs, 0);
  vtkPartitionedDataSetCollection* viewsOut = vtkPartitionedDataSetCollection::GetData(outputs, 1);

  const silhouette::Piece piece = requestedPiece(request, outputs);
  const bool gridAsked = isGenerated(outputs, 0), viewsAsked = isGenerated(outputs, 1);

  const auto grow = [&](vtkSilhouetteExecution& execution)
  {
    if (gridAsked)
    {
      forgetOctree(grid); // before the next one is made
    }
    if (isNothing(piece))
    {
      if (viewsAsked)
      {
        forgetPreparedViews(viewsOut);
      }
      return;
    }
    silhouette::Phase preparing(execution, 0.0, 0.1);
    silhouette::ViewOptions viewOptions;
    viewOptions.outside = static_cast<silhouette::OutsidePolicy>(this->OutsidePolicy);
    const SharedViews views = this->Internals->prepare(input, viewOptions, preparing);

    silhouette::Phase carving(execution, 0.1, 0.95);
    LatticeSettings settings;
    settings.depth = this->Depth;
    settings.leafEdge = this->LeafEdge;
    settings.automaticBounds = this->AutomaticBounds;
    std::copy_n(this->Bounds, 6, settings.bounds.begin());
    settings.backgroundVotes = this->BackgroundVotes;
    settings.piece = piece;
    const auto warn = [this](const std::string& text)
    { vtkWarningMacro(<< text); };
    CarvedViews carved =
        carveViews(views, settings, this->AutomaticTolerance, this->Internals->Found, warn, carving);
    const std::string cut =
        cutByBoxWarning(carved.octree, silhouette::LatticeViews(*carved.views, carved.octree.lattice));
    if (!cut.empty())
    {
      warn(cut);
    }

    if (viewsAsked)
    {
      storeUsed(carved, this->Internals->views(input), viewsOut);
    }
    if (gridAsked)
    {
      storeGrid(carved, piece, grid);
    }
    execution.progress(1.0);
  };
  return runFilter(this, outputs, grow, gridAsked && viewsAsked ? -1 : int(viewsAsked));
}

void vtkSilhouetteOctreeSource::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const policies[] = {"Border", "Unknown", "Background"};
  os << indent << "Depth: " << this->Depth << "\n";
  os << indent << "LeafEdge: " << this->LeafEdge << "\n";
  os << indent << "AutomaticBounds: " << (this->AutomaticBounds ? "On" : "Off") << "\n";
  os << indent << "Bounds: (" << this->Bounds[0] << ", " << this->Bounds[1] << ", " << this->Bounds[2] << ", "
     << this->Bounds[3] << ", " << this->Bounds[4] << ", " << this->Bounds[5] << ")\n";
  os << indent << "BackgroundVotes: " << this->BackgroundVotes << "\n";
  os << indent << "AutomaticTolerance: " << (this->AutomaticTolerance ? "On" : "Off") << "\n";
  os << indent << "OutsidePolicy: " << policies[this->OutsidePolicy] << "\n";
  os << indent << "AddedViews: " << this->Internals->Added.size() << "\n";
  for (std::size_t i = 0; i < this->Internals->Added.size(); ++i)
  {
    const ImageView& view = this->Internals->Added[i];
    os << indent.GetNextIndent() << silhouette::describeView(i, view.name) << ": " << view.image.GetPointer()
       << ", Projection:";
    for (int n = 0; n < 12; ++n)
    {
      os << " " << view.projection.data()[n];
    }
    os << "\n";
  }
}
