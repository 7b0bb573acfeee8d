// SPDX-License-Identifier: BSD-3-Clause
/**
 * From where a preview looks at an object.
 */
#pragma once

#include <array>

class vtkPartitionedDataSetCollection;
class vtkPolyData;

namespace silhouette::program
{

using Direction = std::array<double, 3>;

struct PreviewCamera
{
  std::array<double, 3> target{}; ///< the middle of what is seen
  Direction back{};               ///< of unit length, towards the camera
  Direction up{};                 ///< of unit length, upwards in the picture
  double width = 1.0;             ///< of what is seen, in the mesh's unit
  double height = 1.0;
  double radius = 1.0; ///< of a sphere around the target that holds the mesh
};

/**
 * Upright as the views see it, or along the axis of the ring that they stand on; from 20 degrees above. Around
 * the upright axis: where the object is longer than deep, 35 degrees off its broad side; else 35 degrees off the
 * first view.
 */
PreviewCamera previewCamera(vtkPolyData* mesh, vtkPartitionedDataSetCollection* views);

} // namespace silhouette::program
