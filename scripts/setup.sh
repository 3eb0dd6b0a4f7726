#!/bin/bash
# Installs the Debian packages of the given groups of scripts/packages.txt that are missing:
#   scripts/setup.sh GROUP ...
# Without root it names them and fails.
set -euo pipefail
list="$(dirname "$0")/packages.txt"

missing=()
while read -r group package _; do
  for wanted in "$@"; do
    [ "$group" = "$wanted" ] || continue
    status=$(dpkg-query -W -f='${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || missing+=("$package")
  done
done < <(grep -v '^#' "$list")

[ ${#missing[@]} -gt 0 ] || exit 0
if [ "$(id -u)" -ne 0 ]; then
  echo "These Debian packages are missing: ${missing[*]}" >&2
  echo "As root: apt-get install --no-install-recommends ${missing[*]}" >&2
  exit 1
fi
echo "Installing ${missing[*]}"
export DEBIAN_FRONTEND=noninteractive
apt-get update -q -o Acquire::Retries=3 >/dev/null
apt-get install -y -q -o Acquire::Retries=3 --no-install-recommends "${missing[@]}" >/dev/null
