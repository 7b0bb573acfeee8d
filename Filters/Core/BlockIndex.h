// SPDX-License-Identifier: BSD-3-Clause
/**
 * Finding blocks of 4 x 4 x 4 lattice points, or whatever else has a Morton code, among many.
 */
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace silhouette
{

class BlockIndex
{
public:
  BlockIndex() = default;
  /** `codes`: Morton codes, ascending, no code twice. Cost: linear. */
  explicit BlockIndex(std::vector<std::uint64_t> codes);

  const std::vector<std::uint64_t>& codes() const { return this->Codes; }
  std::size_t size() const { return this->Codes.size(); }
  std::uint64_t operator[](std::size_t place) const { return this->Codes[place]; }
  /** Place of a code among them, or -1. Cost: a binary search in those that share all but a few low bits with it. */
  std::ptrdiff_t find(std::uint64_t code) const;
  /** The same for whoever knows the place of one that is near. Cost: where the code comes after that one, and shares all but three bits with it, a step for each between. */
  std::ptrdiff_t findNear(std::size_t place, std::uint64_t code) const
  {
    if (code <= this->Codes[place] || (this->Codes[place] ^ code) >> 3 != 0)
    {
      return this->find(code);
    }
    do
    {
      ++place;
    } while (place < this->Codes.size() && this->Codes[place] < code);
    return place < this->Codes.size() && this->Codes[place] == code ? std::ptrdiff_t(place) : -1;
  }
  /** How many of them are in [from, to). */
  std::size_t count(std::uint64_t from, std::uint64_t to) const;

private:
  std::size_t firstFrom(std::uint64_t code) const;

  std::vector<std::uint64_t> Codes;
  std::vector<std::uint32_t> First; ///< for what is left of a code without its `Shift` lowest bits, the first that has as much, and the end
  int Shift = 0;
};

} // namespace silhouette
