#!/bin/bash
# Runs the tests that need a device, but the slow ones, on one driver: `stock`, Debian 12's lavapipe; `newer`, that of
# bookworm-backports; `swiftshader`. The rest of the arguments goes to ctest.
#   scripts/test-on.sh swiftshader --tests-regex Acceleration
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -ge 1 ] || { echo "usage: scripts/test-on.sh stock|newer|swiftshader [argument of ctest ...]" >&2; exit 2; }
. scripts/measure.sh
driver=$1
shift
scripts/setup.sh build test
cmake --preset release -DBUILD_TESTING=ON >/dev/null
cmake --build --preset release
devices=$(on "$driver" build/release/trisect devices)
echo "$devices"
if [ "$driver" != stock ] && [ "$devices" = "$(on stock build/release/trisect devices)" ]; then
  echo "The driver $driver was not taken" >&2
  exit 1
fi
on "$driver" ctest --preset release --label-regex gpu --label-exclude slow "$@"
