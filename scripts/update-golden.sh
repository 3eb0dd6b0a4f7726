#!/bin/bash
# Renders the frames of tests/golden anew, after a change that is meant to change them. Look at the difference.
set -euo pipefail
cd "$(dirname "$0")/.."
for frame in sphere-20-phong sphere-20-sphere torus-phong saddle-flat; do
  build/release/trisect render "assets/${frame%-*}.obj" --preset thesis --surface "${frame##*-}" --size 48x36 --rank 24 \
    -o "tests/golden/$frame.exr"
done
