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

#include <algorithm>
#include <utility>

namespace
{

/** A vtkObject, so that the information keeps it alive. */
class vtkSilhouettePreparedViews : public vtkObject
{
public:
  static vtkSilhouettePreparedViews* New();
  vtkTypeMacro(vtkSilhouettePreparedViews, vtkObject);

  silhouette::modeling::SharedViews Views;
  vtkMTimeType ImageTime = 0; ///< of the newest image when the views were prepared

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

vtkMTimeType newestImage(vtkPartitionedDataSetCollection* collection)
{
  vtkMTimeType newest = 0;
  for (unsigned int i = 0; i < collection->GetNumberOfPartitionedDataSets(); ++i)
  {
    for (unsigned int j = 0; j < collection->GetNumberOfPartitions(i); ++j)
    {
      if (vtkDataObject* image = collection->GetPartitionAsDataObject(i, j))
      {
        newest = std::max(newest, image->GetMTime());
      }
    }
  }
  return newest;
}

} // namespace

namespace silhouette::modeling
{

void attachPreparedViews(vtkPartitionedDataSetCollection* collection, SharedViews views)
{
  vtkNew<vtkSilhouettePreparedViews> holder;
  holder->ImageTime = newestImage(collection);
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
        int(collection->GetNumberOfPartitionedDataSets()) == holder->Views->size() &&
        newestImage(collection) <= holder->ImageTime)
    {
      return holder->Views;
    }
  }
  return std::make_shared<const PreparedViews>(silhouetteViews(imageViews(collection), execution), options, execution);
}

} // namespace silhouette::modeling
