// SPDX-License-Identifier: BSD-3-Clause
/**
 * Prepared views travel with the collection they were made from, under a key of the data object's
 * information, so that the filters of one pipeline decode and sum nothing twice. A copy of the collection
 * loses them, and they are prepared again. Private to the module.
 */
#pragma once

#include "PreparedViews.h"

#include <memory>

class vtkDataObject;
class vtkPartitionedDataSetCollection;

namespace silhouette::modeling
{

using SharedViews = std::shared_ptr<const PreparedViews>;

/** Let the views travel with the collection that holds their images. */
void attachPreparedViews(vtkPartitionedDataSetCollection* collection, SharedViews views);

/** Drop what travels with a data object; harmless where nothing does. */
void forgetPreparedViews(vtkDataObject* data);

/**
 * The collection's views: those that travel with it where no image has changed since and the policy is the
 * same, else prepared now. Throws as silhouetteViews and PreparedViews do.
 */
SharedViews preparedViews(vtkPartitionedDataSetCollection* collection, const ViewOptions& options,
                          Execution& execution);

} // namespace silhouette::modeling
