// SPDX-License-Identifier: BSD-3-Clause
/**
 * The edges of a mesh with the triangles on either side. Triangles that share an edge are mostly near one another in a mesh: edges are looked for among
 * those of few triangles first, whose table stays in the processor's cache, then among what these leave, and so on.
 */
#pragma once

#include "Execution.h"
#include "Mesh.h"

#include <algorithm>
#include <cstdint>
#include <mutex>
#include <vector>

namespace silhouette
{

/** A triangle's way along an edge: to its later point, or back. */
struct EdgeUse
{
  std::int32_t from = 0; ///< the edge's earlier point
  std::int32_t to = 0;
  std::uint32_t triangle = 0;
  bool forwards = false; ///< from `from` to `to`
};

/** Uses of edges that wait for the opposite one. */
class EdgeTable
{
public:
  /** For up to so many uses between two calls of leave(). */
  explicit EdgeTable(std::size_t most)
  {
    std::size_t slots = 16;
    for (this->Shift = 60; slots < 2 * most; slots *= 2)
    {
      --this->Shift;
    }
    this->Slots.resize(slots);
  }

  /** Calls `work(from, to, forwards, backwards)` with the triangles where the opposite use was waiting; keeps it where not. */
  template <typename Work> void add(const EdgeUse& use, Work& work)
  {
    const std::uint64_t key = std::uint64_t(std::uint32_t(use.from)) << 32 | std::uint32_t(use.to);
    std::size_t slot = std::size_t((key * 0x9e3779b97f4a7c15ULL) >> this->Shift);
    for (; this->Slots[slot].state != State::Free; slot = (slot + 1) & (this->Slots.size() - 1))
    {
      Slot& there = this->Slots[slot];
      if (there.key == key && there.state == (use.forwards ? State::Backwards : State::Forwards))
      {
        there.state = State::Done;
        use.forwards ? work(use.from, use.to, use.triangle, there.triangle) : work(use.from, use.to, there.triangle, use.triangle);
        return;
      }
    }
    this->Slots[slot] = { key, use.triangle, use.forwards ? State::Forwards : State::Backwards };
  }

  /** Append the uses that still wait, and forget all. */
  void leave(std::vector<EdgeUse>& left)
  {
    for (Slot& slot : this->Slots)
    {
      if (slot.state == State::Forwards || slot.state == State::Backwards)
      {
        left.push_back({ std::int32_t(slot.key >> 32), std::int32_t(slot.key & 0xffffffffu), slot.triangle, slot.state == State::Forwards });
      }
      slot.state = State::Free;
    }
  }

private:
  enum class State : std::uint8_t
  {
    Free,
    Forwards,
    Backwards,
    Done
  };

  struct Slot
  {
    std::uint64_t key = 0;
    std::uint32_t triangle = 0;
    State state = State::Free;
  };

  std::vector<Slot> Slots; ///< by open addressing
  int Shift = 0;
};

/**
 * Call `worker(from, to, forwards, backwards)` for each edge, perhaps side by side, each range of them by a worker that `makeWorker` makes: the triangle
 * that goes along it to its later point, and the one that goes back; the number of triangles for none. Each use of an edge by a triangle is told of once.
 * Where more than two triangles meet, who is whose partner is left open, and so is the order. Cost: linear.
 */
template <typename MakeWorker>
void forEdges(const Mesh& mesh, Execution& execution, const MakeWorker& makeWorker)
{
  constexpr std::size_t Together = 2048, Grain = 8 * Together; // triangles
  std::vector<EdgeUse> left;
  std::mutex leaving;
  execution.forRanges(mesh.triangles.size(), Grain,
    [&](std::size_t first, std::size_t last)
    {
      auto worker = makeWorker();
      EdgeTable table(2 * std::min(Together, last - first)); // an edge for two triangles at least, where they are apart three
      std::vector<EdgeUse> ofRange;
      for (std::size_t n = first; n < last; ++n)
      {
        for (int c = 0; c < 3; ++c)
        {
          const std::int32_t a = mesh.triangles[n][c], b = mesh.triangles[n][(c + 1) % 3];
          table.add({ std::min(a, b), std::max(a, b), std::uint32_t(n), a < b }, worker);
        }
        if ((n - first) % Together == Together - 1 || n + 1 == last)
        {
          table.leave(ofRange);
        }
      }
      EdgeTable wider(ofRange.size());
      for (const EdgeUse& use : ofRange)
      {
        wider.add(use, worker);
      }
      ofRange.clear();
      wider.leave(ofRange);
      const std::lock_guard<std::mutex> lock(leaving);
      left.insert(left.end(), ofRange.begin(), ofRange.end());
    });
  auto worker = makeWorker();
  EdgeTable widest(left.size());
  for (const EdgeUse& use : left)
  {
    widest.add(use, worker);
  }
  left.clear();
  widest.leave(left);
  const auto none = std::uint32_t(mesh.triangles.size());
  for (const EdgeUse& use : left)
  {
    use.forwards ? worker(use.from, use.to, use.triangle, none) : worker(use.from, use.to, none, use.triangle);
  }
}

} // namespace silhouette
