#!/bin/bash
# Unpacks the Mesa Vulkan drivers of Debian's bookworm-backports into build/mesa, beside the system's and without
# touching them, and prints the environment that selects its lavapipe:
#   env $(scripts/unpack-mesa.sh) build/release/trisect devices
# Takes the package source from the machine's own list. Does nothing but print if build/mesa is there.
set -euo pipefail
cd "$(dirname "$0")/.."
target=$PWD/build/mesa

if [ ! -e "$target/lavapipe.json" ]; then
  work=$(mktemp -d)
  trap 'rm -rf "$work"' EXIT
  # Where the machine gets bookworm from, in either of apt's formats.
  source=$(cat /etc/apt/sources.list.d/*.sources /etc/apt/sources.list 2>/dev/null |
    sed -n 's/^URIs: *\([^ ]*\).*/\1/p; s/^deb *\(\[[^]]*\] *\)\{0,1\}\([^ ]*\) *bookworm .*/\2/p' | head -n 1 || true)
  if [ -z "$source" ]; then
    echo "unpack-mesa.sh: no source of bookworm in /etc/apt" >&2
    exit 1
  fi
  echo "deb $source bookworm-backports main" > "$work/sources.list"
  mkdir -p "$work/lists/partial" "$work/cache/archives/partial" "$work/packages"
  options=(-q -o Acquire::Retries=3 -o "Dir::Etc::sourcelist=$work/sources.list" -o Dir::Etc::sourceparts=/nonexistent
    -o "Dir::State::lists=$work/lists" -o "Dir::Cache=$work/cache" -o APT::Sandbox::User=root)
  apt-get "${options[@]}" update >/dev/null
  (cd "$work/packages" && apt-get "${options[@]}" download \
    mesa-vulkan-drivers mesa-libgallium libgbm1 libdrm2 libdrm-amdgpu1 libdrm-common >/dev/null)
  rm -rf "$target"
  mkdir -p "$target"
  for package in "$work"/packages/*.deb; do dpkg -x "$package" "$target"; done
  libraries=$(dirname "$(find "$target" -name libvulkan_lvp.so)")
  sed "s|\"library_path\": *\"[^\"]*\"|\"library_path\": \"$libraries/libvulkan_lvp.so\"|" \
    "$target"/usr/share/vulkan/icd.d/lvp_icd*.json > "$target/lavapipe.json"
fi
libraries=$(dirname "$(find "$target" -name libvulkan_lvp.so)")
echo "VK_DRIVER_FILES=$target/lavapipe.json LD_LIBRARY_PATH=$libraries"
