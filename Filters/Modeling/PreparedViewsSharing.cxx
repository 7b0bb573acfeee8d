// SPDX-License-Identifier: BSD-3-Clause
#include "PreparedViewsSharing.h"

#include "FieldValues.h"
#include "ViewConversion.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"

#include <utility>
#include <vector>

namespace
{

/** A collection's images, in order, and when each last changed. An image that is gone is never taken for another: no two objects change at the same time. */
using Images = std::vector<std::pair<const vtkDataObject*, vtkMTimeType>>;

/** A vtkObject, so that the information keeps it alive. */
class vtkSilhouettePreparedViews : public vtkObject
{
public:
  static vtkSilhouettePreparedViews* New();
  vtkTypeMacro(vtkSilhouettePreparedViews, vtkObject);

  silhouette::modeling::SharedViews Views;
  Images From; ///< what the views were prepared from

protected:
  vtkSilhouettePreparedViews() = default;
  ~vtkSilhouettePreparedViews() override = default;

private:
  vtkSilhouettePreparedViews(const vtkSilhouettePreparedViews&) = delete;
  void operator=(const vtkSilhouettePreparedViews&) = delete;
};

vtkStandardNewMacro(vtkSilhouettePreparedViews);

vtkInformationObjectBaseKey* preparedViewsKey()
{
  static auto* key = vtkInformationObjectBaseKey::MakeKey("PREPARED_VIEWS", "vtkSilhouetteOctreeSource");
  return key;
}

Images imagesOf(vtkPartitionedDataSetCollection* collection)
{
  Images images;
  for (unsigned int i = 0; i < collection->GetNumberOfPartitionedDataSets(); ++i)
  {
    for (unsigned int j = 0; j < collection->GetNumberOfPartitions(i); ++j)
    {
      vtkDataObject* image = collection->GetPartitionAsDataObject(i, j);
      images.emplace_back(image, image ? image->GetMTime() : 0);
    }
  }
  return images;
}

} // namespace

namespace silhouette::modeling
{

void attachPreparedViews(vtkPartitionedDataSetCollection* collection, SharedViews views)
{
  vtkNew<vtkSilhouettePreparedViews> holder;
  holder->From = imagesOf(collection);
  setField(collection, "OutsidePolicy", int(views->options().outside));
  setField(collection, "ViewsFingerprint", views->fingerprint());
  holder->Views = std::move(views);
  preparedViewsKey()->Set(collection->GetInformation(), holder);
}

void forgetPreparedViews(vtkDataObject* data)
{
  data->GetInformation()->Remove(preparedViewsKey());
}

SharedViews preparedViews(vtkPartitionedDataSetCollection* collection, const ViewOptions& options,
                          Execution& execution)
{
  if (collection)
  {
    auto* holder =
        vtkSilhouettePreparedViews::SafeDownCast(preparedViewsKey()->Get(collection->GetInformation()));
    if (holder && holder->Views->options().outside == options.outside &&
        imagesOf(collection) == holder->From)
    {
      return holder->Views;
    }
  }
  return std::make_shared<const PreparedViews>(silhouetteViews(imageViews(collection), execution), options, execution);
}

} // namespace silhouette::modeling
