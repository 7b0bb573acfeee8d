// SPDX-License-Identifier: BSD-3-Clause
/**
 * Runs a fuzzer's entry point on random inputs of fixed seeds: an ordinary test, without libFuzzer.
 * Arguments: the number of inputs (default 150) and the first seed (default 0).
 */
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int main(int argc, char** argv)
{
  const int count = argc > 1 ? std::atoi(argv[1]) : 150;
  const int first = argc > 2 ? std::atoi(argv[2]) : 0;
  for (int seed = first; seed < first + count; ++seed)
  {
    std::uint64_t state = std::uint64_t(seed) * 0x9e3779b97f4a7c15ULL + 1;
    std::vector<std::uint8_t> bytes(std::size_t(40 + seed * 37 % 3000));
    for (auto& byte : bytes)
    {
      state ^= state << 13;
      state ^= state >> 7;
      state ^= state << 17;
      byte = std::uint8_t(state >> 32);
    }
    LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
  }
  std::printf("%d inputs\n", count);
  return 0;
}
