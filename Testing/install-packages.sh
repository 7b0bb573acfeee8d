#!/bin/bash
# SPDX-License-Identifier: BSD-3-Clause
#
# Installs the Debian packages of Testing/packages.txt, those of the sections named.
#
#   bash Testing/install-packages.sh SECTION...      (sections: build, test, paraview, benchmarks)
#   bash Testing/install-packages.sh --list SECTION...      prints their names and installs nothing
#
# Does nothing, and needs neither root nor network, where everything is installed already. Otherwise it asks
# apt-get, with sudo where not root, and refreshes apt's lists only where a package is not in them.
# Exit code 0: all is there. 1: something is missing and could not be installed; the message says what.
set -euo pipefail

list="$(dirname "${BASH_SOURCE[0]}")/packages.txt"

# The packages of one section of the list.
packages_of()
{
  sed -e 's/#.*//' -e 's/[[:space:]]*$//' "$list" |
    awk -v wanted="$1:" '/:$/ { inside = ($0 == wanted); next } inside && NF { print $1 }'
}

# Of the packages named, those that are not installed.
missing_of()
{
  local package
  for package in "$@"; do
    dpkg-query --show --showformat='${db:Status-Status}\n' "$package" 2>/dev/null | grep -qx installed ||
      echo "$package"
  done
}

only_list=no
if [ "${1:-}" = --list ]; then
  only_list=yes
  shift
fi
if [ $# -eq 0 ]; then
  echo "usage: $0 [--list] SECTION...   (sections of $list)" >&2
  exit 1
fi
packages=()
for section in "$@"; do
  mapfile -t found < <(packages_of "$section")
  if [ ${#found[@]} -eq 0 ]; then
    echo "$list has no section '$section'" >&2
    exit 1
  fi
  packages+=("${found[@]}")
done
if [ "$only_list" = yes ]; then
  printf '%s\n' "${packages[@]}"
  exit 0
fi

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "This is not Debian: install the equivalents of these packages yourself." >&2
  echo "  ${packages[*]}" >&2
  exit 0 # the build says what it cannot find
fi

mapfile -t missing < <(missing_of "${packages[@]}")
if [ ${#missing[@]} -eq 0 ]; then
  exit 0
fi
echo "Installing: ${missing[*]}"

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  if ! command -v sudo >/dev/null; then
    echo "These packages are missing, and there is neither root nor sudo to install them:" >&2
    echo "  apt-get install ${missing[*]}" >&2
    exit 1
  fi
  as_root=(sudo)
fi

apt()
{
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 "$@"
}

# --no-remove: a package of the user's is never taken away for ours.
install_missing()
{
  apt install --no-install-recommends --no-remove "${missing[@]}"
}

# apt's lists may be empty (a fresh container) or old (a version that is no longer on the server).
if ! apt-cache show "${missing[@]}" >/dev/null 2>&1; then
  apt update || true
  refreshed=yes
fi
if ! install_missing; then
  [ "${refreshed:-no}" = yes ] || { apt update && install_missing; } || true
fi

mapfile -t missing < <(missing_of "${packages[@]}")
if [ ${#missing[@]} -ne 0 ]; then
  echo "Could not install: ${missing[*]}" >&2
  echo "Without a network, install them beforehand; apt-get's own messages are above." >&2
  exit 1
fi
