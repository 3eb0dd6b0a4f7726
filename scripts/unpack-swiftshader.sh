#!/bin/bash
# Unpacks SwiftShader, another Vulkan driver for the CPU with subgroups of four, out of Debian's package of Chromium into
# build/swiftshader, and prints the environment that selects it:
#   env $(scripts/unpack-swiftshader.sh) build/release/trisect devices
# Does nothing but print if build/swiftshader is there.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/download.sh
target=$PWD/build/swiftshader

driver=$target/usr/lib/chromium/vk_swiftshader_icd.json
if [ ! -e "$driver" ]; then
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  download bookworm "$work" chromium-common
  rm -rf "$target"
  mkdir -p "$target"
  # The one names the other by its place beside it.
  dpkg --fsys-tarfile "$work"/*.deb |
    tar -x -C "$target" ./usr/lib/chromium/libvk_swiftshader.so ./usr/lib/chromium/vk_swiftshader_icd.json
fi
echo "VK_DRIVER_FILES=$driver"
