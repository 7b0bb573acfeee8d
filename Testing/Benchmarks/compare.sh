#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
#
# Ours beside Open3D, VTK on a dense volume and a numpy script: time, memory, faces, XOR, error, as ratios in one run.
#
#   bash Testing/Benchmarks/compare.sh [OPTION...]       (--help: the options)
#
# BUILD_DIR (default: build, beside Testing) holds the programs, built by Testing/run.sh. Peers that are not installed are left out;
# `bash Testing/install-packages.sh benchmarks` installs them. Open3D at 512 cells takes minutes and 14 GB.
set -euo pipefail
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
build_dir="${BUILD_DIR:-$here/../../build}"
python="$(sed -n 's/^Python3_EXECUTABLE:[A-Z]*=//p' "$build_dir/CMakeCache.txt")"
exec "${python:-python3}" "$here/compare.py" --program "$build_dir/bin/vtksilhouette" --stages "$build_dir/bin/silhouette-stages" "$@"
