// SPDX-License-Identifier: BSD-3-Clause
#include "BoxTree.h"

namespace silhouette
{

BoxTree::BoxTree(const std::vector<Box>& boxes)
  : BoxTree(boxes.size(), [&](std::size_t item) { return boxes[item]; })
{
}

BoxTree::BoxTree(std::size_t count, const std::function<Box(std::size_t)>& boxOf)
{
  if (count == 0)
  {
    return;
  }
  this->Slots.reserve(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    this->Slots.push_back({ boxOf(i), std::int32_t(i) });
  }
  this->Nodes.reserve(count);
  this->build(this->Slots, 0, std::int32_t(count));
}

BoxTree triangleTree(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles)
{
  return BoxTree(triangles.size(), [&](std::size_t n) { return triangleBox(points, triangles[n]); });
}

void BoxTree::build(std::vector<Slot>& slots, std::int32_t first, std::int32_t last)
{
  const std::size_t index = this->Nodes.size();
  Node node{ Box(), first, last, 0 };
  Box centres;
  for (std::int32_t s = first; s < last; ++s)
  {
    node.box.extend(slots[s].box);
    centres.extend(slots[s].box.center());
  }
  this->Nodes.push_back(node);
  if (last - first <= LeafSize)
  {
    this->Leaves.push_back(std::int32_t(index));
    return;
  }
  int axis = 0;
  centres.sizes().maxCoeff(&axis);
  const std::int32_t middle = first + (last - first) / 2;
  std::nth_element(slots.begin() + first, slots.begin() + middle, slots.begin() + last,
    [axis](const Slot& a, const Slot& b)
    {
      const double ca = a.box.min()[axis] + a.box.max()[axis];
      const double cb = b.box.min()[axis] + b.box.max()[axis];
      return ca != cb ? ca < cb : a.item < b.item;
    });
  this->build(slots, first, middle);
  this->Nodes[index].right = std::int32_t(this->Nodes.size());
  this->build(slots, middle, last);
}

} // namespace silhouette
