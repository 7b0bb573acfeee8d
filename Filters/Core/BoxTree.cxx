// SPDX-License-Identifier: BSD-3-Clause
#include "BoxTree.h"

namespace silhouette
{

/** A part of the tree over consecutive slots: split further, or built by itself with numbers of its own. */
struct BoxTree::Part
{
  std::int32_t first, last;
  Node node{};
  std::size_t left = 0, right = 0; ///< parts, where it is split
  std::vector<Node> nodes{};
  std::vector<std::int32_t> leaves{};
};

BoxTree::BoxTree(const std::vector<Box>& boxes)
{
  Execution alone;
  *this = BoxTree(boxes, alone);
}

BoxTree::BoxTree(const std::vector<Box>& boxes, Execution& execution)
  : BoxTree(boxes.size(), [&](std::size_t item) { return boxes[item]; }, execution)
{
}

BoxTree::BoxTree(std::size_t count, const std::function<Box(std::size_t)>& boxOf, Execution& execution)
{
  if (count == 0)
  {
    return;
  }
  this->Slots.resize(count);
  execution.forRanges(count, 4096,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        this->Slots[i] = { boxOf(i), std::int32_t(i) };
      }
    });
  std::vector<Part> parts = this->split(execution);
  std::size_t nodes = 0;
  for (const Part& part : parts)
  {
    nodes += part.nodes.empty() ? 1 : part.nodes.size();
  }
  this->Nodes.reserve(nodes);
  this->append(parts, 0);
}

/** Split from the top, all parts of a level side by side, until there are enough of them; then build each. */
std::vector<BoxTree::Part> BoxTree::split(Execution& execution)
{
  constexpr std::size_t Enough = 64;
  std::vector<Part> parts{ Part{ 0, std::int32_t(this->Slots.size()) } };
  std::size_t level = 0; // the first part of the last level
  while (parts.size() - level < Enough && parts[level].last - parts[level].first > std::int32_t(Enough) * LeafSize)
  {
    const std::size_t end = parts.size();
    execution.forRanges(end - level, 1,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t p = level + first; p < level + last; ++p)
        {
          parts[p].left = std::size_t(this->divide(parts[p].first, parts[p].last, parts[p].node)); // where, so far
        }
      });
    for (; level < end; ++level)
    {
      const auto middle = std::int32_t(parts[level].left);
      parts[level].left = parts.size();
      parts[level].right = parts.size() + 1;
      parts.push_back(Part{ parts[level].first, middle });
      parts.push_back(Part{ middle, parts[level].last });
    }
  }
  execution.forRanges(parts.size() - level, 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t p = level + first; p < level + last; ++p)
      {
        this->build(parts[p].first, parts[p].last, parts[p].nodes, parts[p].leaves);
      }
    });
  return parts;
}

/** Append a part's nodes, itself first, then those of its left half. */
void BoxTree::append(std::vector<Part>& parts, std::size_t p)
{
  Part& part = parts[p];
  const auto index = std::int32_t(this->Nodes.size());
  if (part.nodes.empty())
  {
    this->Nodes.push_back(part.node);
    this->append(parts, part.left);
    this->Nodes[std::size_t(index)].right = std::int32_t(this->Nodes.size());
    this->append(parts, part.right);
    return;
  }
  for (Node& node : part.nodes)
  {
    node.right += node.right != 0 ? index : 0;
    this->Nodes.push_back(node);
  }
  for (const std::int32_t leaf : part.leaves)
  {
    this->Leaves.push_back(index + leaf);
  }
  part = Part{}; // its memory is given back
}

BoxTree triangleTree(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles, Execution& execution)
{
  return BoxTree(triangles.size(), [&](std::size_t n) { return triangleBox(points, triangles[n]); }, execution);
}

/** Make the node of some slots; where they are too many for a leaf, divide them in two halves and return where the second begins, else -1. */
std::int32_t BoxTree::divide(std::int32_t first, std::int32_t last, Node& node)
{
  node = { Box(), first, last, 0 };
  Box centres;
  for (std::int32_t s = first; s < last; ++s)
  {
    node.box.extend(this->Slots[s].box);
    centres.extend(this->Slots[s].box.center());
  }
  if (last - first <= LeafSize)
  {
    return -1;
  }
  int axis = 0;
  centres.sizes().maxCoeff(&axis);
  const std::int32_t middle = first + (last - first) / 2;
  std::nth_element(this->Slots.begin() + first, this->Slots.begin() + middle, this->Slots.begin() + last,
    [axis](const Slot& a, const Slot& b)
    {
      const double ca = a.box.min()[axis] + a.box.max()[axis];
      const double cb = b.box.min()[axis] + b.box.max()[axis];
      return ca != cb ? ca < cb : a.item < b.item;
    });
  return middle;
}

void BoxTree::build(std::int32_t first, std::int32_t last, std::vector<Node>& nodes, std::vector<std::int32_t>& leaves)
{
  const std::size_t index = nodes.size();
  Node node;
  const std::int32_t middle = this->divide(first, last, node);
  nodes.push_back(node);
  if (middle < 0)
  {
    leaves.push_back(std::int32_t(index));
    return;
  }
  this->build(first, middle, nodes, leaves);
  nodes[index].right = std::int32_t(nodes.size());
  this->build(middle, last, nodes, leaves);
}

} // namespace silhouette
