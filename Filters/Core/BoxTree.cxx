// SPDX-License-Identifier: BSD-3-Clause
#include "BoxTree.h"

#include "LargePages.h"

namespace silhouette
{

/** A part of the tree: that of consecutive slots. Where its nodes and leaves are is known from their numbers, so that all parts can be built at the same time. */
struct BoxTree::Part
{
  std::int32_t first = 0, last = 0; ///< slots
  std::size_t node = 0;             ///< its own, after which come those of its left half, then those of its right one
  std::size_t leaf = 0;             ///< its first
};

/** Number of nodes of the tree over so many slots. */
std::size_t BoxTree::nodesOf(std::int32_t slots)
{
  // Halves differ by one at most, and so do their halves: of each level two numbers, for `slots` >> level and for one more.
  int level = 0;
  while (slots >> level > LeafSize)
  {
    ++level;
  }
  const auto atLeaves = [](std::int32_t n) -> std::size_t { return n <= LeafSize ? 1 : 3; };
  std::size_t nodes = atLeaves(slots >> level), ofOneMore = atLeaves((slots >> level) + 1);
  while (level > 0)
  {
    --level;
    const std::size_t mixed = 1 + nodes + ofOneMore;
    const bool isOdd = (slots >> level) % 2 != 0;
    ofOneMore = isOdd ? 1 + 2 * ofOneMore : mixed;
    nodes = isOdd ? mixed : 1 + 2 * nodes;
  }
  return nodes;
}

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
  this->Slots = largeVector<Slot>(count);
  execution.forRanges(count, 4096,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t i = first; i < last; ++i)
      {
        this->Slots[i] = { boxOf(i), std::int32_t(i) };
      }
    });
  const std::size_t nodes = nodesOf(std::int32_t(count));
  this->Nodes = largeVector<Node>(nodes);
  resizeLarge(this->Leaves, (nodes + 1) / 2);
  // From the top, all parts of a level side by side, until there are enough of them; then each by itself.
  constexpr std::size_t Enough = 64;
  std::vector<Part> parts{ Part{ 0, std::int32_t(count) } };
  while (parts.size() < Enough && parts[0].last - parts[0].first > std::int32_t(Enough) * LeafSize)
  {
    std::vector<std::array<Part, 2>> halves(parts.size());
    execution.forRanges(parts.size(), 1,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t p = first; p < last; ++p)
        {
          this->divide(parts[p], halves[p]);
        }
      });
    parts.clear();
    for (const std::array<Part, 2>& two : halves)
    {
      parts.insert(parts.end(), two.begin(), two.end());
    }
  }
  execution.forRanges(parts.size(), 1,
    [&](std::size_t first, std::size_t last)
    {
      for (std::size_t p = first; p < last; ++p)
      {
        this->build(parts[p]);
      }
    });
}

BoxTree triangleTree(const std::vector<Eigen::Vector3d>& points, const std::vector<Triangle>& triangles, Execution& execution)
{
  return BoxTree(triangles.size(), [&](std::size_t n) { return triangleBox(points, triangles[n]); }, execution);
}

/** Make the node of a part; where its slots are too many for a leaf, divide them, else false. */
bool BoxTree::divide(const Part& part, std::array<Part, 2>& halves)
{
  const auto [first, last, index, leaf] = part;
  Node& node = this->Nodes[index];
  node = { Box(), first, last, 0 };
  Box centres;
  for (std::int32_t s = first; s < last; ++s)
  {
    node.box.extend(this->Slots[s].box);
    centres.extend(this->Slots[s].box.center());
  }
  if (last - first <= LeafSize)
  {
    this->Leaves[leaf] = std::int32_t(index);
    return false;
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
  const std::size_t left = nodesOf(middle - first);
  node.right = std::int32_t(index + 1 + left);
  halves = { Part{ first, middle, index + 1, leaf }, Part{ middle, last, index + 1 + left, leaf + (left + 1) / 2 } };
  return true;
}

void BoxTree::build(const Part& part)
{
  std::array<Part, 2> halves;
  if (this->divide(part, halves))
  {
    this->build(halves[0]);
    this->build(halves[1]);
  }
}

} // namespace silhouette
