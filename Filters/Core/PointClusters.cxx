// SPDX-License-Identifier: BSD-3-Clause
#include "PointClusters.h"

#include "BlockBits.h"
#include "BlockIndex.h"
#include "ConcurrentUnionFind.h"

#include <algorithm>
#include <array>
#include <numeric>

namespace silhouette
{
namespace
{

constexpr int FirstAhead = 14; ///< of the 27 blocks around and including one, in neighbourOf()'s order, those after the middle one

/** A neighbouring block, and which points of a block and of that one may be two apart. */
struct BlockBeside
{
  LatticePoint step;
  std::uint64_t own = ~std::uint64_t(0);
  std::uint64_t others = ~std::uint64_t(0);

  explicit BlockBeside(int n = 13)
    : step(neighbourOf({ 0, 0, 0 }, n))
  {
    const int steps[3] = { this->step.i, this->step.j, this->step.k };
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::uint64_t low = blockSlab(axis, 0) | blockSlab(axis, 1);
      this->own &= steps[axis] == 0 ? ~std::uint64_t(0) : steps[axis] < 0 ? low : ~low;
      this->others &= steps[axis] == 0 ? ~std::uint64_t(0) : steps[axis] < 0 ? ~low : low;
    }
  }
};

std::array<BlockBeside, 13> blocksAhead()
{
  std::array<BlockBeside, 13> ahead;
  for (int n = 0; n < 13; ++n)
  {
    ahead[std::size_t(n)] = BlockBeside(FirstAhead + n);
  }
  return ahead;
}

class Clustering
{
public:
  explicit Clustering(const std::vector<std::uint64_t>& points)
  {
    std::vector<std::uint64_t> blocks;
    for (std::size_t n = 0; n < points.size(); ++n)
    {
      if (blocks.empty() || blocks.back() != points[n] >> 6)
      {
        blocks.push_back(points[n] >> 6);
        this->Bits.push_back(0);
        this->First.push_back(std::uint32_t(n));
      }
      this->Bits.back() |= std::uint64_t(1) << (points[n] & 63);
    }
    this->First.push_back(std::uint32_t(points.size()));
    this->Blocks = BlockIndex(std::move(blocks));
  }

  PointClusters clusters(Execution& execution)
  {
    ConcurrentUnionFind sets = this->joined(execution);
    PointClusters clusters;
    std::vector<std::uint32_t> number(this->Bits.size()), at; // of each block its cluster, of each cluster how far it is filled
    for (std::size_t b = 0; b < this->Bits.size(); ++b)
    {
      const std::uint32_t root = sets.find(std::uint32_t(b));
      number[b] = root == b ? std::uint32_t(at.size()) : number[root];
      at.resize(std::max(at.size(), std::size_t(number[b]) + 1), 0);
      at[number[b]] += this->First[b + 1] - this->First[b];
    }
    clusters.first.resize(at.size() + 1, 0);
    std::partial_sum(at.begin(), at.end(), clusters.first.begin() + 1);
    std::copy(clusters.first.begin(), clusters.first.end() - 1, at.begin());
    clusters.members.resize(this->First.back());
    for (std::size_t b = 0; b < this->Bits.size(); ++b)
    {
      for (std::uint32_t n = this->First[b]; n < this->First[b + 1]; ++n)
      {
        clusters.members[at[number[b]]++] = n;
      }
    }
    return clusters;
  }

private:
  ConcurrentUnionFind joined(Execution& execution) const
  {
    static const std::array<BlockBeside, 13> ahead = blocksAhead();
    ConcurrentUnionFind sets(this->Bits.size(), execution);
    execution.forRanges(this->Bits.size(), 512,
      [&](std::size_t first, std::size_t last)
      {
        for (std::size_t b = first; b < last; ++b)
        {
          const LatticePoint own = fromMorton(this->Blocks[b]);
          for (const BlockBeside& beside : ahead)
          {
            const LatticePoint q = own + beside.step;
            const bool mayMeet = (this->Bits[b] & beside.own) != 0 && std::min({ q.i, q.j, q.k }) >= 0;
            const std::ptrdiff_t other = mayMeet ? this->Blocks.findNear(b, mortonCode(q)) : -1;
            if (other >= 0 && (this->Bits[std::size_t(other)] & beside.others) != 0)
            {
              sets.unite(std::uint32_t(b), std::uint32_t(other));
            }
          }
        }
      });
    return sets;
  }

  BlockIndex Blocks;
  std::vector<std::uint64_t> Bits;  ///< of each block
  std::vector<std::uint32_t> First; ///< of each block, the number of its first point, and the end
};

} // namespace

PointClusters clustersOf(const std::vector<std::uint64_t>& points, Execution& execution)
{
  return Clustering(points).clusters(execution);
}

} // namespace silhouette
