#!/bin/bash
# Unpacks the Mesa Vulkan drivers of Debian's bookworm-backports into build/mesa, beside the system's and without
# touching them, and prints the environment that selects its lavapipe:
#   env $(scripts/unpack-mesa.sh) build/release/trisect devices
# Does nothing but print if build/mesa is there.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/download.sh
target=$PWD/build/mesa

if [ ! -e "$target/lavapipe.json" ]; then
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  download bookworm-backports "$work" \
    mesa-vulkan-drivers mesa-libgallium libgbm1 libdrm2 libdrm-amdgpu1 libdrm-common
  rm -rf "$target"
  mkdir -p "$target"
  for package in "$work"/*.deb; do dpkg -x "$package" "$target"; done
  libraries=$(dirname "$(find "$target" -name libvulkan_lvp.so)")
  sed "s|\"library_path\": *\"[^\"]*\"|\"library_path\": \"$libraries/libvulkan_lvp.so\"|" \
    "$target"/usr/share/vulkan/icd.d/lvp_icd*.json > "$target/lavapipe.json"
fi
libraries=$(dirname "$(find "$target" -name libvulkan_lvp.so)")
echo "VK_DRIVER_FILES=$target/lavapipe.json LD_LIBRARY_PATH=$libraries"
