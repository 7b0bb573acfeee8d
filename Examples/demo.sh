#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
#
# From nothing to a mesh: installs what is needed, builds Release, photographs a jug that does not exist,
# reconstructs it from the silhouettes and measures how far the mesh is from the truth.
#
#   bash Examples/demo.sh
#
# BUILD_DIR (default: build, beside this folder's parent) is where it builds, OUTPUT_DIR (default: demo-output,
# in the same place) what it leaves: capture, mesh, preview and metrics. JOBS (default: all processors) is how
# many compilers run at once. Exit code 0: everything is there.
set -euo pipefail

source_dir="$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)"
build_dir="${BUILD_DIR:-$source_dir/build}"
output_dir="${OUTPUT_DIR:-$source_dir/demo-output}"
jobs="${JOBS:-$(nproc)}"

step()
{
  printf '\n== %s\n' "$*"
}

# Shows a command as one would type it, then runs it.
show()
{
  printf '$'
  printf ' %q' "$(basename "$1")" "${@:2}"
  printf '\n'
  "$@"
}

step "Packages"
bash "$source_dir/Testing/install-packages.sh" build
echo "all there"

step "Build: $build_dir"
# A build tree that is there already keeps its generator and its tests.
options=(-DCMAKE_BUILD_TYPE=Release)
if [ ! -f "$build_dir/CMakeCache.txt" ]; then
  options+=(-G Ninja -DSILHOUETTE_BUILD_TESTING=OFF)
fi
cmake -S "$source_dir" -B "$build_dir" "${options[@]}"
cmake --build "$build_dir" --parallel "$jobs" --target vtksilhouette
program="$build_dir/bin/vtksilhouette"

mkdir -p "$output_dir"
cd "$output_dir"

step "A capture: 36 views of a jug"
show "$program" synthesize jug --views 36 --force

step "Its mesh"
show "$program" reconstruct jug -o jug.ply --image jug.png --metrics jug.json

step "The mesh and the truth"
show "$program" evaluate jug.ply --capture jug --truth jug/truth.ply --sample-spacing 0.02 --metrics evaluation.json

step "Done"
echo "In $output_dir are"
echo "  jug/             the capture: photographs, silhouettes, cameras and the true mesh"
echo "  jug.ply          the mesh made of it"
echo "  jug.png          a picture of the mesh"
echo "  jug.json         what the reconstruction counted"
echo "  evaluation.json  how far the mesh is from the silhouettes and from the truth"
