// SPDX-License-Identifier: BSD-3-Clause
#include "BlockIndex.h"

#include <algorithm>

namespace silhouette
{

BlockIndex::BlockIndex(std::vector<std::uint64_t> codes)
  : Codes(std::move(codes))
{
  if (this->Codes.empty())
  {
    return;
  }
  // As many entries as codes at most: three bits more are as much as siblings share.
  while (this->Codes.back() >> this->Shift > this->Codes.size())
  {
    ++this->Shift;
  }
  const std::size_t entries = std::size_t(this->Codes.back() >> this->Shift) + 1;
  this->First.resize(entries + 1);
  std::size_t place = 0;
  for (std::size_t entry = 0; entry < entries; ++entry)
  {
    while (this->Codes[place] >> this->Shift < entry)
    {
      ++place;
    }
    this->First[entry] = std::uint32_t(place);
  }
  this->First[entries] = std::uint32_t(this->Codes.size());
}

/** Place of the first that is not less. */
std::size_t BlockIndex::firstFrom(std::uint64_t code) const
{
  const std::uint64_t entry = code >> this->Shift;
  if (entry + 1 >= this->First.size())
  {
    return this->Codes.size();
  }
  const auto begin = this->Codes.begin();
  return std::size_t(std::lower_bound(begin + this->First[entry], begin + this->First[entry + 1], code) - begin);
}

std::ptrdiff_t BlockIndex::find(std::uint64_t code) const
{
  const std::size_t place = this->firstFrom(code);
  return place < this->Codes.size() && this->Codes[place] == code ? std::ptrdiff_t(place) : -1;
}

std::size_t BlockIndex::count(std::uint64_t from, std::uint64_t to) const
{
  return this->firstFrom(to) - this->firstFrom(from);
}

} // namespace silhouette
