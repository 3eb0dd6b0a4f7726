#!/bin/bash
# Runs the unit tests, which need no device, under the address and undefined-behaviour sanitizers. About five minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh build test
cmake --preset asan >/dev/null
cmake --build --preset asan --target unit_tests
build/asan/unit_tests --gtest_brief=1
