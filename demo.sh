#!/bin/bash
# Sets up a Debian 12 machine, builds trisect and renders a teapot into out/.
set -euo pipefail
cd "$(dirname "$0")"
scripts/setup.sh build
cmake --preset release -DBUILD_TESTING=OFF >/dev/null
cmake --build --preset release
mkdir -p out
build/release/trisect render assets/teapot.obj -o out/teapot.png --stats out/teapot.json
