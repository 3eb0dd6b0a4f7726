#!/bin/bash
# Unpacks SwiftShader, another Vulkan driver for the CPU with subgroups of four, out of Debian's package of Chromium into
# build/swiftshader, and prints the environment that selects it:
#   env $(scripts/unpack-swiftshader.sh) build/release/trisect devices
# Does nothing but print if build/swiftshader is there.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/download.sh
target=$PWD/build/swiftshader

if [ ! -e "$target/swiftshader.json" ]; then
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  download bookworm "$work" chromium-common
  rm -rf "$target"
  mkdir -p "$target"
  dpkg --fsys-tarfile "$work"/*.deb | tar -x -C "$target" --wildcards '*/libvk_swiftshader.so' '*/vk_swiftshader_icd.json'
  driver_file "$(find "$target" -name vk_swiftshader_icd.json)" "$(find "$target" -name libvk_swiftshader.so)" \
    "$target/swiftshader.json"
fi
echo "VK_DRIVER_FILES=$target/swiftshader.json"
