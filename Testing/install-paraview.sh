#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
#
# Puts Debian's ParaView, its headers and its Python into a folder of their own, beside what is installed.
#
#   bash Testing/install-paraview.sh PREFIX
#
# Debian's python3-paraview conflicts with python3-vtk9, so that the one cannot be installed where the other is
# tested. The packages of the section "paraview-extracted" of Testing/packages.txt are therefore downloaded and
# extracted into PREFIX; those of the section "paraview", with what they link, are installed. PREFIX is replaced
# as a whole, once everything is there; where it holds these packages already nothing is done, and neither root
# nor network are needed. To use it:
#
#   cmake -S Wrapping/ParaView -B build-paraview -DParaView_DIR=PREFIX/usr/lib/x86_64-linux-gnu/cmake/paraview-5.11
#   LD_LIBRARY_PATH=PREFIX/usr/lib/x86_64-linux-gnu PYTHONPATH=PREFIX/usr/lib/python3/dist-packages \
#     PREFIX/usr/bin/pvpython SCRIPT
#
# Exit code 0: all is there. 1: wrong arguments, or PREFIX cannot be written. 3: ParaView cannot be had here; the
# last line says why.
set -euo pipefail

readonly unavailable=3
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"

if [ $# -ne 1 ]; then
  echo "usage: $0 PREFIX" >&2
  exit 1
fi
prefix="$1"

cannot()
{
  echo "$*" >&2
  exit "$unavailable"
}

command -v dpkg >/dev/null && command -v apt-get >/dev/null ||
  cannot "this is not Debian: install ParaView 5.11 or later yourself and build Wrapping/ParaView against it"
bash "$here/install-packages.sh" paraview ||
  cannot "what ParaView needs could not be installed; the messages are above"

mapfile -t packages < <(bash "$here/install-packages.sh" --list paraview-extracted)
stamp="$prefix/extracted-packages"
if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "${packages[*]}" ]; then
  exit 0
fi

mkdir -p "$(dirname "$prefix")" || exit 1
work="$(mktemp -d "$prefix.XXXXXX")" || exit 1
trap 'rm -rf "$work"' EXIT
mkdir "$work/archives" "$work/prefix"
download()
{
  (cd "$work/archives" && apt-get -q -o APT::Sandbox::User=root download "${packages[@]}")
}
echo "Downloading: ${packages[*]}"
if ! download; then
  as_root=()
  [ "$(id -u)" -eq 0 ] || as_root=(sudo -n)
  "${as_root[@]}" apt-get -q -y update && download ||
    cannot "could not download ${packages[*]}; apt-get's own messages are above"
fi
for archive in "$work"/archives/*.deb; do
  dpkg -x "$archive" "$work/prefix" || cannot "could not extract $(basename "$archive") into $work/prefix"
done
echo "${packages[*]}" >"$work/prefix/extracted-packages"
rm -rf "$prefix"
mv "$work/prefix" "$prefix"
echo "Extracted into $prefix"
