// SPDX-License-Identifier: BSD-3-Clause
#include "LargePages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>
#include <vector>

using namespace silhouette;

namespace
{

/** What the system notes of the mapping that an address is in ("VmFlags"), or nothing where it notes no such thing. */
std::string flagsOf(const void* address)
{
  std::ifstream maps("/proc/self/smaps");
  const auto at = reinterpret_cast<std::uintptr_t>(address);
  bool isIn = false;
  for (std::string line; std::getline(maps, line);)
  {
    std::istringstream text(line);
    std::uintptr_t first = 0, last = 0;
    char dash = 0;
    if (text >> std::hex >> first >> dash >> last && dash == '-')
    {
      isIn = first <= at && at < last;
    }
    else if (isIn && line.rfind("VmFlags:", 0) == 0)
    {
      return line + " ";
    }
  }
  return {};
}

bool hasLargePages()
{
  return bool(std::ifstream("/sys/kernel/mm/transparent_hugepage/enabled"));
}

} // namespace

TEST(LargePages, VectorsAreThoseOfTheLibrary)
{
  for (const std::size_t n : { std::size_t(0), std::size_t(1), std::size_t(1000), LeastLargeBytes / 4, LeastLargeBytes })
  {
    EXPECT_EQ(largeVector<std::uint32_t>(n), std::vector<std::uint32_t>(n)) << n;
    EXPECT_EQ(largeVector<std::int32_t>(n, -7), std::vector<std::int32_t>(n, -7)) << n;
    std::vector<double> values;
    resizeLarge(values, n);
    EXPECT_EQ(values, std::vector<double>(n)) << n;
  }
}

TEST(LargePages, AreAskedForWhatIsLarge)
{
  if (!hasLargePages() || flagsOf(&std::cout).empty())
  {
    GTEST_SKIP() << "this system has no transparent huge pages, or does not tell what it notes of memory";
  }
  const auto large = largeVector<std::uint64_t>(std::size_t(1) << 23); // more than any allocator keeps in a heap
  EXPECT_NE(flagsOf(&large[large.size() / 2]).find(" hg "), std::string::npos) << flagsOf(&large[large.size() / 2]);
  const std::vector<std::uint64_t> usual(std::size_t(1) << 23);
  EXPECT_EQ(flagsOf(&usual[usual.size() / 2]).find(" hg "), std::string::npos);
}

/** Whatever is advised, what was there before and around it is left alone. */
TEST(LargePages, ChangeNoMemory)
{
  std::vector<std::uint8_t> bytes(3 * LeastLargeBytes, 5);
  adviseLargePages(bytes.data() + 12345, LeastLargeBytes + 6789);
  adviseLargePages(bytes.data(), 0);
  adviseLargePages(nullptr, 0);
  EXPECT_EQ(std::count(bytes.begin(), bytes.end(), 5), std::ptrdiff_t(bytes.size()));
}
