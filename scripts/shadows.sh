#!/bin/bash
# Measures shadows and writes docs/shadows.md and the pictures in it (a few minutes).
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh build test docs
cmake --preset release -DBUILD_TESTING=ON >/dev/null
cmake --build --preset release --target trisect gpu_tests
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
source scripts/measure.sh
name_drivers
side=(--light=1,0.2,0.4)

picture() { build/release/trisect render "assets/$1.obj" --size 400x300 --spp 4 --shadows "${side[@]}" -o "docs/$2.png" "${@:3}" >/dev/null; }
picture sphere-20 shadows-flat --surface flat
picture sphere-20 shadows-sphere --surface sphere
picture teapot-1000 shadows-teapot

# The table of what the test of the terminator prints.
terminator() {
  build/release/gpu_tests --gtest_filter='Terminator.*' |
    sed -nE 's/^terminator: (.*), (.*): (.*) of (.*) pixels .*/| \1 | \2 | \3 | \4 |/p'
}

time_of() {
  measure "$1" "$2" 5 "${side[@]}" "${@:3}"
  figure '.gpu_ms.median | round'
}

{
  cat <<END
# Shadows

Written by \`scripts/shadows.sh\`. A shadow ray starts from the point of the curved surface that the pixel's ray met, above it by
four times what roundings may put that point below (\`departure\` in shaders/surface.glsl), and is tried against the curved
triangles; the first one on its way ends it. There is no length to tune: the tests find the same shadows at scales of 1e-3, 1
and 1e3, and those of the oracle at every pixel that it can decide.

| ![A sphere of 20 flat triangles](shadows-flat.png) | ![Of 20 blended spheres](shadows-sphere.png) | ![A teapot](shadows-teapot.png) |
|---|---|---|
| 20 flat triangles with smooth normals | the same 20 as blended spheres | teapot-1000, Phong Tessellation |

## The terminator

Flat triangles with smooth normals lie below the surface that they stand for and shade each other where the light comes in
low. Pixels of 400x300 that are dark though light reaches the true surface there by a cosine of more than 0.02: of the sphere
as it is; of the teapot as 4000 curved triangles have it. [terminator](terminator/terminator.md) has what renderers do about
it, with the curved surface of the same triangles for the truth.

| model | surface | dark though lit | pixels hit |
|---|---|---|---|
$(terminator)

## Time

800x600, milliseconds on the device without and with shadows, the median of 5 frames, --accel tiles; shadow rays go by the
tree. ${name[newer]}; ${name[stock]}.

| model | surface | Mesa 25.0.7 | with shadows | Mesa 22.3.6 | with shadows |
|---|---|---|---|---|---|
END
  for model in sphere-20 sphere-320 torus teapot teapot-1000; do
    line="| $model | phong"
    for driver in newer stock; do
      line+=" | $(time_of $driver $model --accel tiles) | $(time_of $driver $model --accel tiles --shadows)"
    done
    echo "$line |"
  done
} >"$work/shadows.md"
mv "$work/shadows.md" docs/
