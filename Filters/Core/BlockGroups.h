// SPDX-License-Identifier: BSD-3-Clause
/**
 * Parts of the blocks of a field: what is asked of a few points of a block need not be asked of all.
 */
#pragma once

#include <cstddef>
#include <cstdint>

namespace silhouette
{

/**
 * Some of the eight groups of 2 x 2 x 2 lattice points of a block of 4 x 4 x 4, ascending: a group's points are consecutive in Morton order, eight values that a
 * processor works on together. Values of the groups lie close together, group after group.
 */
class BlockGroups
{
public:
  static constexpr std::size_t Points = 8; ///< of a group

  /** Those whose bits are set. */
  explicit BlockGroups(std::uint8_t bits)
  {
    for (std::size_t group = 0; group < Most; ++group)
    {
      this->add(group, bits >> group & 1);
    }
  }

  /** Those with a point for which `test(n)` holds, n being 0 to 63. */
  template <typename Test>
  static BlockGroups where(const Test& test)
  {
    unsigned bits = 0;
    for (std::size_t n = 0; n < Most * Points; ++n)
    {
      bits |= unsigned(test(n)) << n / Points;
    }
    return BlockGroups(std::uint8_t(bits));
  }

  static BlockGroups all() { return BlockGroups(0xff); }

  /** Of these, those at some places among them: the first has place 0. */
  BlockGroups at(const BlockGroups& places) const
  {
    BlockGroups some(0);
    for (std::size_t m = 0; m < places.Count; ++m)
    {
      some.add(this->Groups[places.Groups[m]], true);
    }
    return some;
  }

  bool empty() const { return this->Count == 0; }
  std::size_t size() const { return this->Count; }
  /** Points of all of them. */
  std::size_t points() const { return this->Count * Points; }
  /** Where in the block the points of the m-th one begin. */
  std::size_t first(std::size_t m) const { return this->Groups[m] * Points; }
  /** Where in the block the n-th of their points is. */
  std::size_t point(std::size_t n) const { return this->first(n / Points) + n % Points; }

private:
  static constexpr std::size_t Most = 8;

  void add(std::size_t group, bool whether)
  {
    this->Groups[this->Count] = std::uint8_t(group); // beyond the last one where it is not to be
    this->Count += whether;
  }

  std::uint8_t Groups[Most + 1] = {};
  std::uint8_t Count = 0;
};

} // namespace silhouette
