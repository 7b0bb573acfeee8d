// SPDX-License-Identifier: BSD-3-Clause
/**
 * SILHOUETTE_VECTORISED before a function: the compiler makes it once for any 64-bit x86 and once for processors with
 * AVX2, and the loader takes the one that fits. The results are the same to the last bit, since nothing is
 * contracted (-ffp-contract=off) or reordered. Elsewhere, and under sanitizers, whose start-up code does not bear it,
 * the function is made once.
 */
#pragma once

#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define SILHOUETTE_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define SILHOUETTE_SANITIZED
#endif

#if defined(__x86_64__) && defined(__linux__) && defined(__GNUC__) && !defined(__clang__) &&                             \
  !defined(SILHOUETTE_SANITIZED)
#define SILHOUETTE_VECTORISED __attribute__((target_clones("avx2", "default")))
#else
#define SILHOUETTE_VECTORISED
#endif
