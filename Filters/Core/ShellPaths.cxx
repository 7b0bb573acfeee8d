// SPDX-License-Identifier: BSD-3-Clause
#include "ShellPaths.h"

namespace silhouette
{

bool isBesideCentre(int n)
{
  const int differing = (n % 3 != 1) + (n / 3 % 3 != 1) + (n / 9 != 1);
  return differing == 1 || differing == 2;
}

ShellPaths::ShellPaths(const CornerShell& shell, const std::vector<std::uint8_t>& taken)
  : Shell(shell)
  , Taken(taken)
  , Seen(shell.corners.size(), 0)
{
}

bool ShellPaths::meet(std::uint32_t a, std::uint32_t b, int steps)
{
  ++this->Call;
  std::vector<std::uint32_t> now = { a }, next;
  this->Seen[a] = this->Call;
  for (int step = 0; step <= steps && !now.empty(); ++step)
  {
    next.clear();
    for (const std::uint32_t corner : now)
    {
      if (corner == b)
      {
        return true;
      }
      const LatticePoint p = fromMorton(this->Shell.corners[corner]);
      for (int n = 0; n < 27; ++n)
      {
        const std::ptrdiff_t other = isBesideCentre(n) ? this->Shell.find(mortonCode(neighbourOf(p, n))) : -1;
        if (other >= 0 && this->Taken[other] && this->Seen[other] != this->Call)
        {
          this->Seen[other] = this->Call;
          next.push_back(std::uint32_t(other));
        }
      }
    }
    now.swap(next);
  }
  return false;
}

} // namespace silhouette
