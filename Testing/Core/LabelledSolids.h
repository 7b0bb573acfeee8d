// SPDX-License-Identifier: BSD-3-Clause
/**
 * Solids given by a field on a small lattice, every cell of which is in the shell, and the topology of their surfaces.
 */
#pragma once

#include "BrickField.h"
#include "CornerShell.h"
#include "LatticeLabels.h"
#include "LatticeSurface.h"
#include "MeshSoundness.h"

#include <functional>
#include <memory>

namespace silhouette::test
{

struct LabelledSolid
{
  Execution execution;
  Octree octree; ///< all intersection octants
  BrickField field;
  std::unique_ptr<LatticeLabels> labels;

  LabelledSolid(int depth, const std::function<double(const LatticePoint&)>& value)
  {
    this->octree.lattice = Lattice{ { Eigen::Vector3d::Zero(), 1.0 }, depth };
    this->octree.viewCount = 1;
    for (int g = 0; g <= depth; ++g)
    {
      Generation generation;
      for (std::uint64_t code = 0; code < std::uint64_t(1) << 3 * g; ++code)
      {
        generation.code.push_back(code);
        generation.state.push_back(OctantState::Intersection);
        generation.childBlock.push_back(std::uint32_t(code));
      }
      this->octree.generations.push_back(std::move(generation));
    }
    const auto cells = leafCells(this->octree, OctantState::Intersection);
    this->field = BrickField(this->octree.lattice, cells, 0, this->execution);
    for (std::size_t n = 0; n < this->field.size(); ++n)
    {
      this->field.values()[n] = float(value(fromMorton(this->field.code(n))));
    }
    this->labels = std::make_unique<LatticeLabels>(this->octree, makeCornerShell(cells, this->execution), this->field, this->execution);
  }

  void fill(const std::vector<std::uint64_t>& points)
  {
    for (const std::uint64_t point : points)
    {
      this->labels->setInside(std::size_t(this->labels->shell().find(point)));
    }
  }

  MeshSoundness surface()
  {
    const auto& shell = this->labels->shell();
    std::vector<std::uint8_t> inside;
    for (const std::uint64_t corner : shell.corners)
    {
      inside.push_back(this->labels->insideAt(fromMorton(corner)));
    }
    const LatticeSurface contoured = contour(shell, inside, this->execution);
    Mesh mesh;
    mesh.triangles = contoured.triangles;
    for (const auto& edge : contoured.edges)
    {
      mesh.points.push_back(crossingPosition(this->octree.lattice, shell, edge, 0.5));
    }
    return assessMesh(mesh, this->execution);
  }
};

inline double within(double x, double low, double high)
{
  return std::min(x - low, high - x);
}

/** A box, as a field of octants. */
inline double boxField(const LatticePoint& p, const LatticePoint& low, const LatticePoint& high)
{
  return std::min({ within(p.i, low.i - 0.5, high.i + 0.5), within(p.j, low.j - 0.5, high.j + 0.5), within(p.k, low.k - 0.5, high.k + 0.5) });
}

} // namespace silhouette::test
