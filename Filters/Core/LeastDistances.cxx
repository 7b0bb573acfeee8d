// SPDX-License-Identifier: BSD-3-Clause
#include "LeastDistances.h"

#include "Vectorised.h"

namespace silhouette
{

SILHOUETTE_VECTORISED void keepLeast(float* distances, std::size_t points, float* least, int rank)
{
  for (int k = 0; k < rank; ++k, least += FieldViews::BlockPoints)
  {
    for (std::size_t n = 0; n < points; ++n)
    {
      const float greater = least[n] < distances[n] ? distances[n] : least[n];
      least[n] = distances[n] < least[n] ? distances[n] : least[n];
      distances[n] = greater;
    }
  }
}

} // namespace silhouette
