#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
#
# Installs what is needed, builds Release and runs all tests, with no display; then the same for the ParaView plugin.
#
#   bash Testing/run.sh [CTEST-OPTION...]
#
# BUILD_DIR (default: build, beside this folder's parent) is where it builds; JOBS (default: all processors)
# how many compilers run at once. Options go to ctest, for both: -L Python runs one kind, -R NAME one test, -L ParaView
# the plugin's. Tests of real photographs skip, and say so, where the photographs are not beside the checkout.
#
# The plugin is built in BUILD_DIR/paraview against the ParaView in PARAVIEW_PREFIX (default:
# BUILD_DIR/paraview-prefix, where Testing/install-paraview.sh puts it). Where ParaView cannot be had, or with
# WITH_PARAVIEW=no, this is left out, and the summary says so.
# Exit code 0: everything passed.
set -euo pipefail

source_dir="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build_dir="${BUILD_DIR:-$source_dir/build}"
jobs="${JOBS:-$(nproc)}"
paraview_prefix="${PARAVIEW_PREFIX:-$build_dir/paraview-prefix}"
unset DISPLAY WAYLAND_DISPLAY

step()
{
  printf '\n== %s\n' "$*"
}

# ctest in the build tree $1, with the other arguments; the log is $1/Testing/run.log. That a filter selects none of
# one tree's tests is no failure; that it selects none of both is, see the summary.
run_tests()
{
  local tree="$1" log="$1/Testing/run.log"
  shift
  mkdir -p "$(dirname "$log")"
  ctest --test-dir "$tree" --output-on-failure --parallel 2 --no-tests=ignore "$@" 2>&1 | tee "$log"
}

# What ctest said in the end, and which tests failed or did not run.
summarize()
{
  local log="$2/Testing/run.log"
  printf '%s: ' "$1"
  if ! grep -E '^ *[0-9]+% tests passed' "$log"; then
    echo "no test was selected"
    return
  fi
  grep -E '^Total Test time' "$log" || true
  sed -n '/^The following tests did not run/,/^$/p; /^The following tests FAILED/,/^Errors while/p' "$log" |
    grep -v '^Errors while' || true
}

# Sets why_no_paraview where ParaView cannot be had.
install_paraview()
{
  why_no_paraview=
  if [ "${WITH_PARAVIEW:-yes}" = no ]; then
    why_no_paraview="WITH_PARAVIEW=no"
    return
  fi
  local code=0 log="$build_dir/Testing/install-paraview.log"
  bash "$source_dir/Testing/install-paraview.sh" "$paraview_prefix" 2>&1 | tee "$log" || code=$?
  case "$code" in
    0) echo "all there: $paraview_prefix" ;;
    3) why_no_paraview="$(tail -n 1 "$log")" ;;
    *) return "$code" ;;
  esac
}

build_plugin()
{
  local config
  config="$(find "$paraview_prefix" -name paraview-config.cmake -print -quit)"
  cmake -S "$source_dir/Wrapping/ParaView" -B "$build_dir/paraview" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    -DParaView_DIR="$(dirname "$config")" -DSILHOUETTE_PROGRAM="$build_dir/bin/vtksilhouette" &&
    cmake --build "$build_dir/paraview" --parallel "$jobs"
}

rm -f "$build_dir"{,/paraview}/Testing/run.log # those of an earlier run

step "Packages"
bash "$source_dir/Testing/install-packages.sh" build test
echo "all there"

step "Configure: $build_dir"
cmake -S "$source_dir" -B "$build_dir" -G Ninja -DCMAKE_BUILD_TYPE=Release -DSILHOUETTE_BUILD_TESTING=ON

step "Build with $jobs jobs"
cmake --build "$build_dir" --parallel "$jobs"

step "Test"
status=0
run_tests "$build_dir" "$@" || status=$?

step "ParaView"
paraview_status=0
install_paraview || paraview_status=$?
if [ -z "$why_no_paraview" ] && [ "$paraview_status" -eq 0 ]; then
  step "Build the plugin: $build_dir/paraview"
  build_plugin || paraview_status=$?
  if [ "$paraview_status" -eq 0 ]; then
    step "Test the plugin"
    run_tests "$build_dir/paraview" "$@" || paraview_status=$?
  else
    why_not_tested="the plugin could not be built"
  fi
elif [ -z "$why_no_paraview" ]; then
  why_not_tested="ParaView could not be installed"
fi

step "Summary"
summarize "Library" "$build_dir"
if [ -n "$why_no_paraview" ]; then
  echo "ParaView: skipped: $why_no_paraview"
elif [ -n "${why_not_tested:-}" ]; then
  echo "ParaView: FAILED: $why_not_tested"
else
  summarize "ParaView" "$build_dir/paraview"
fi
if ! grep -qsE '^ *[0-9]+% tests passed' "$build_dir"{,/paraview}/Testing/run.log; then
  echo "No test was run." >&2
  exit 1
fi
if [ "$status" -eq 0 ] && [ "$paraview_status" -eq 0 ]; then
  echo "All tests passed."
  exit 0
fi
echo "Tests failed; pictures that differ are in $build_dir/Testing/Temporary and" \
  "$build_dir/paraview/Testing/Temporary." >&2
exit 1
