#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
#
# Installs what is needed, builds Release and runs all tests, with no display.
#
#   bash Testing/run.sh [CTEST-OPTION...]
#
# BUILD_DIR (default: build, beside this folder's parent) is where it builds; JOBS (default: all processors)
# how many compilers run at once. Options go to ctest: -L Python runs one kind, -R NAME one test. Tests of
# real photographs skip, and say so, where the photographs are not beside the checkout.
# Exit code 0: everything passed.
set -euo pipefail

source_dir="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build_dir="${BUILD_DIR:-$source_dir/build}"
jobs="${JOBS:-$(nproc)}"
unset DISPLAY WAYLAND_DISPLAY

step()
{
  printf '\n== %s\n' "$*"
}

step "Packages"
bash "$source_dir/Testing/install-packages.sh" build test
echo "all there"

step "Configure: $build_dir"
cmake -S "$source_dir" -B "$build_dir" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSILHOUETTE_BUILD_TESTING=ON

step "Build with $jobs jobs"
cmake --build "$build_dir" --parallel "$jobs"

step "Test"
log="$build_dir/Testing/run.log"
mkdir -p "$(dirname "$log")"
status=0
ctest --test-dir "$build_dir" --output-on-failure --parallel 2 --no-tests=error "$@" 2>&1 |
  tee "$log" || status=$?

step "Summary"
grep -E '^ *[0-9]+% tests passed|^Total Test time' "$log" || true
sed -n '/^The following tests did not run/,/^$/p; /^The following tests FAILED/,/^Errors while/p' "$log" |
  grep -v '^Errors while' || true
if [ "$status" -eq 0 ]; then
  echo "All tests passed."
else
  echo "Tests failed (ctest says $status); pictures that differ are in $build_dir/Testing/Temporary." >&2
fi
exit "$status"
