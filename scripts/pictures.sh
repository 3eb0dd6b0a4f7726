#!/bin/bash
# Makes the pictures of README anew that no measurement makes (a minute).
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh build docs
cmake --preset release >/dev/null
cmake --build --preset release --target trisect
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

picture() { # file, model, options
  build/release/trisect render "assets/$2.obj" --quiet --size 480x360 --spp 16 -o "$1.png" "${@:3}"
}
# Flat triangles with smooth normals beside the same ones curved: the outline, and where the light ends.
picture "$work/torus-flat" torus --surface flat --shadows
picture "$work/torus-curved" torus --surface phong --shadows
picture "$work/sphere-flat" sphere-80 --surface flat --shadows --light 0.9,0.5,0.1
picture "$work/sphere-curved" sphere-80 --surface sphere --shadows --light 0.9,0.5,0.1
montage "$work"/torus-{flat,curved}.png "$work"/sphere-{flat,curved}.png -tile 2x2 -geometry +0+0 -strip "$work/why.png"
mv "$work/why.png" docs/why.png
picture docs/teapot teapot
picture docs/sphere-20 sphere-20
picture docs/sphere-20-rank-10 sphere-20 --preset thesis --spp 1
