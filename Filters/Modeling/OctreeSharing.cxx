// SPDX-License-Identifier: BSD-3-Clause
#include "OctreeSharing.h"

#include "OctreeConversion.h"

#include "vtkBitArray.h"
#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkHyperTreeGrid.h"
#include "vtkInformation.h"
#include "vtkInformationObjectBaseKey.h"
#include "vtkNew.h"
#include "vtkObject.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <utility>

namespace
{

/** A vtkObject, so that the information keeps it alive. */
class vtkSilhouetteSharedOctree : public vtkObject
{
public:
  static vtkSilhouetteSharedOctree* New();
  vtkTypeMacro(vtkSilhouetteSharedOctree, vtkObject);

  silhouette::modeling::SharedOctree Octree;
  vtkMTimeType GridTime = 0; ///< of the grid when the octree was attached

protected:
  vtkSilhouetteSharedOctree() = default;
  ~vtkSilhouetteSharedOctree() override = default;

private:
  vtkSilhouetteSharedOctree(const vtkSilhouetteSharedOctree&) = delete;
  void operator=(const vtkSilhouetteSharedOctree&) = delete;
};

vtkStandardNewMacro(vtkSilhouetteSharedOctree);

vtkInformationObjectBaseKey* octreeKey()
{
  static auto* key = vtkInformationObjectBaseKey::MakeKey("OCTREE", "vtkSilhouetteOctreeSource");
  return key;
}

/** When the grid, its field data, cells or mask last changed. */
vtkMTimeType timeOf(vtkHyperTreeGrid* grid)
{
  vtkMTimeType time = std::max(grid->GetMTime(), grid->GetCellData()->GetMTime());
  return grid->HasMask() ? std::max(time, grid->GetMask()->GetMTime()) : time;
}

} // namespace

namespace silhouette::modeling
{

void attachOctree(vtkHyperTreeGrid* grid, SharedOctree octree)
{
  vtkNew<vtkSilhouetteSharedOctree> holder;
  holder->Octree = std::move(octree);
  holder->GridTime = timeOf(grid);
  octreeKey()->Set(grid->GetInformation(), holder);
}

void forgetOctree(vtkDataObject* data)
{
  data->GetInformation()->Remove(octreeKey());
}

SharedOctree sharedOctree(vtkHyperTreeGrid* grid)
{
  auto* holder = vtkSilhouetteSharedOctree::SafeDownCast(octreeKey()->Get(grid->GetInformation()));
  if (holder && timeOf(grid) <= holder->GridTime)
  {
    return holder->Octree;
  }
  return std::make_shared<const Octree>(octreeOf(grid));
}

} // namespace silhouette::modeling
