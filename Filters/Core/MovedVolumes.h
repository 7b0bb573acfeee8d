// SPDX-License-Identifier: BSD-3-Clause
/**
 * What becomes of the volumes of a closed surface's components where some of its points move: none is to be turned inside out.
 */
#pragma once

#include "ConcurrentUnionFind.h"
#include "Mesh.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace silhouette
{

class MovedVolumes
{
public:
  /**
   * `mesh`: as it is when it is asked about; `number`: of each of its points among those that move, or -1; `original`: where these were before. None of them is copied,
   * and all have to outlive this; triangles and numbers stay.
   */
  MovedVolumes(const Mesh& mesh, const std::vector<std::int32_t>& number, const std::vector<Eigen::Vector3d>& original)
    : TheMesh(mesh)
    , Number(number)
    , Originals(original)
  {
  }

  /** Where a point was before. */
  const Eigen::Vector3d& original(std::int32_t point) const
  {
    const std::int32_t m = this->Number[std::size_t(point)];
    return m >= 0 ? this->Originals[std::size_t(m)] : this->TheMesh.points[std::size_t(point)];
  }

  /**
   * May a component's volume be less than it was? `moving`: the triangles with a point that moves. What these change of it is what they sweep, those together that share points,
   * wherever it is measured from. Cost: n log n in these.
   */
  bool mayShrink(const std::vector<std::int32_t>& moving) const;

  /** The points that move, by their numbers among these, ascending, of components whose volume was above 0 and is no longer. Cost: a pass over the triangles, the first
   * time two. */
  std::vector<std::size_t> inverted(Execution& execution);

private:
  /** Six times a signed volume. */
  struct Volume
  {
    double before = 0.0, now = 0.0;

    double growth() const { return this->now - this->before; }
  };
  using Volumes = std::map<std::uint32_t, Volume>; ///< of components, by their first points

  Volume sixfoldVolume(const Eigen::Vector3d& from, const Triangle& t) const;
  void addVolume(const Triangle& t, Volumes& volumes);
  Volumes volumes(Execution& execution);

  const Mesh& TheMesh;
  const std::vector<std::int32_t>& Number;
  const std::vector<Eigen::Vector3d>& Originals;
  ConcurrentUnionFind Components; ///< of the mesh's points; none until they are asked for
};

} // namespace silhouette
