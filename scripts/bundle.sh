#!/bin/bash
# Packs the program, the tests that need a device, the models and the libraries that they need into build/bundle/trisect
# and build/bundle/trisect.tar.xz, which run on another Linux machine of the same architecture where nothing can be
# installed. check.sh in it checks a device; run.sh runs one program. Not in it are what belongs to the machine or to its
# drivers: glibc, the Vulkan loader, drivers.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh build test
cmake --preset release -DBUILD_TESTING=ON >/dev/null
programs=(trisect gpu_tests program_tests make-assets)
cmake --build --preset release --target "${programs[@]}" assets

most=$((20 << 20))  # bytes, packed
bundle=build/bundle/trisect
rm -rf build/bundle
mkdir -p "$bundle/bin" "$bundle/lib/spare" "$bundle/share/trisect/assets"

for program in "${programs[@]}"; do strip -o "$bundle/bin/$program" "build/release/$program"; done
while read -r library path; do
  case $library in
    libc.so.* | libm.so.* | libpthread.so.* | libdl.so.* | librt.so.* | libvulkan.so.*) continue ;;
    # Drivers use these as well, maybe in a newer version: run.sh takes them only where the machine's own do not do.
    libstdc++.so.* | libgcc_s.so.* | libz.so.* | libX*.so.* | libxcb.so.* | libbsd.so.* | libmd.so.* | libEGL.so.* | \
      libOpenGL.so.* | libGLdispatch.so.*)
      folder=$bundle/lib/spare/$library ;;
    *) folder=$bundle/lib ;;
  esac
  mkdir -p "$folder"
  strip --strip-unneeded -o "$folder/$library" "$path"
done < <(for program in "${programs[@]}"; do ldd "build/release/$program"; done |
  sed -nE 's/^\t([^ ]+) => ([^ ]+) .*/\1 \2/p' | sort -u)

cp assets/*.obj build/release/assets/teapot-4000.obj "$bundle/share/trisect/assets"
cp -r shaders tests/golden "$bundle/share/trisect"
cp scripts/bundle/check.sh scripts/bundle/run.sh LICENSE "$bundle"
git describe --always --dirty --exclude '*' >"$bundle/commit"

archive=build/bundle/trisect.tar.xz
filters=(--lzma2=preset=9)
# xz packs x86's machine code more closely if told that it is some.
[ "$(uname -m)" != x86_64 ] || filters=(--x86 "${filters[@]}")
tar -C build/bundle --owner=0 --group=0 -cf - trisect | xz "${filters[@]}" -T0 >"$archive"
bytes=$(stat -c %s "$archive")
echo "$archive: $(awk "BEGIN { printf \"%.1f\", $bytes / 1048576 }") MiB, unpacked $(du -sm "$bundle" | cut -f1) MiB"
if [ "$bytes" -ge "$most" ]; then
  echo "That is more than $((most >> 20)) MiB" >&2
  exit 1
fi
