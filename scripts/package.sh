#!/bin/bash
# Makes the Debian packages build/package/trisect_VERSION_ARCH.deb, the program, and libtrisect-dev_VERSION_ARCH.deb, the
# library.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh build package
cmake --preset release >/dev/null
cmake --build --preset release --target trisect trisect_library manual documents
rm -rf build/package
(umask 022 && cpack --config build/release/CPackConfig.cmake) >build/release/package.log || {
  cat build/release/package.log >&2
  exit 1
}
rm -rf build/package/_CPack_Packages
lintian --allow-root --fail-on error build/package/*.deb
ls -sh build/package/*.deb
