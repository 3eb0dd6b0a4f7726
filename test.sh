#!/bin/bash
# Sets up a Debian 12 machine, builds trisect and runs its tests but the slow ones. Arguments go to ctest.
set -euo pipefail
cd "$(dirname "$0")"
scripts/setup.sh build test
cmake --preset release -DBUILD_TESTING=ON >/dev/null
cmake --build --preset release
ctest --preset release --label-exclude slow "$@"
