#!/bin/bash
# Installs build/package/trisect_*.deb, which scripts/package.sh makes, with what it depends on into a bare Debian 12 in a
# temporary folder, and does there what a user would. As root; packages come from where this machine's do.
set -euo pipefail
cd "$(dirname "$0")/.."

# What is done in the bare Debian, whose root is $1: mmdebstrap calls this script again for it.
try_in() {
  root=$1
  try() {
    echo "\$ $*"
    chroot "$root" /usr/bin/env -i PATH=/usr/bin:/bin HOME=/root "$@"
  }
  try trisect --version
  try trisect devices
  try trisect render /usr/share/trisect/assets/teapot.obj -o /tmp/teapot.png
  head -c 8 "$root/tmp/teapot.png" | cmp - <(printf '\x89PNG\r\n\x1a\n')
  try trisect export /usr/share/trisect/assets/torus.obj -o /tmp/torus.glb --subdivide 4
  try gzip -t /usr/share/man/man1/trisect.1.gz /usr/share/man/man1/trisect-render.1.gz
  offered=$(chroot "$root" bash -c '. /usr/share/bash-completion/completions/trisect
    COMP_WORDS=(trisect render --sur) COMP_CWORD=2
    _trisect
    echo "${COMPREPLY[@]}"')
  [ "$offered" = --surface ] || { echo "bash completes --sur by '$offered'" >&2; exit 1; }
  echo "trisect render --sur becomes $offered"
  chroot "$root" apt-get purge -y -q trisect >/dev/null
  left=$(find "$root/usr/bin" "$root/usr/share" -name '*trisect*')
  [ -z "$left" ] || { echo "Once removed the package leaves behind: $left" >&2; exit 1; }
}
if [ "${1-}" = --in ]; then
  try_in "$2" || exit 1
  exit 0
fi

package=$(echo build/package/trisect_*.deb)
[ -f "$package" ] || { echo "There is no build/package/trisect_*.deb: run scripts/package.sh" >&2; exit 1; }
[ "$(id -u)" -eq 0 ] || { echo "This needs root, for a system of its own in a folder" >&2; exit 1; }
scripts/setup.sh package

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
# Where packages come from, and how: what this machine's apt knows.
sources=()
for file in /etc/apt/sources.list /etc/apt/sources.list.d/*.list /etc/apt/sources.list.d/*.sources; do
  if [ -s "$file" ]; then sources+=("$file"); fi
done
apt-config dump | grep -E '^Acquire::(http|https|ftp|Retries|Check)' >"$folder/apt.conf" || true
touch "$folder/made"
echo "Making a bare Debian 12"
mmdebstrap --mode=root --variant=apt --format=null --quiet --aptopt="$folder/apt.conf" \
  --customize-hook="copy-in $package /tmp" \
  --customize-hook="rm $folder/made" \
  --customize-hook='chroot "$1" sh -c "apt-get install -y -q --no-install-recommends /tmp/trisect_*.deb" >/dev/null' \
  --customize-hook="'$PWD/scripts/try-package.sh' --in "'"$1"' \
  bookworm /dev/null "${sources[@]}" || {
  if [ -f "$folder/made" ]; then
    echo "A bare Debian 12 cannot be made on this machine, so the package was not tried" >&2
  else
    echo "The package does not do in a bare Debian 12 what it should" >&2
  fi
  exit 1
}
echo "The package does in a bare Debian 12 what it should"
