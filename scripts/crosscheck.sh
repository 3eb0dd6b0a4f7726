#!/bin/bash
# Compares Vulkan with OpenGL on every model, surface, shell and solver, and writes docs/crosscheck.md and the picture
# in it. The argument is the image size, 320x240 without one (some ten minutes).
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
ready build docs
size=${1:-320x240}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
models=(sphere-20 sphere-80 sphere-320 torus relief capsule cube saddle teapot teapot-1000)

# Too far apart is a line of the table; the exit code 1 that says so is for others.
check() { build/release/trisect crosscheck "$@" --size "$size" --json "$work/pair.json" >"$work/text" || [ $? = 1 ]; }

# One line for these options: the sums over all models, the worst of the rest.
row() {
  local path=$1 surface=$2 shell=$3 solver=$4
  : >"$work/all.json"
  for model in "${models[@]}"; do
    check "assets/$model.obj" --gl-path "$path" --surface "$surface" --shell "$shell" --solver "$solver"
    cat "$work/pair.json" >>"$work/all.json"
  done
  jq -rs --arg h "| $path | $surface | $shell | $solver" '[.[].pairs[0]] | [$h, length,
    (map(.pixels) | add), (map(.hit_mismatches) | add), (map(.patch_mismatches) | add),
    "\(map(.z_bit_equal) | add) of \(map(.z_pixels) | add)", (map(.z_ulp.p99) | max | .*10 | round / 10),
    (map(.color_rmse) | max | .*1000 | round / 1000), (map(.color_max) | max | .*1000 | round / 1000),
    (map(select(.excesses | length > 0)) | length), ""] | join(" | ") | rtrimstr(" ")' "$work/all.json"
}

{
  check assets/sphere-20.obj
  cat <<END
# Vulkan against OpenGL

Written by \`scripts/crosscheck.sh $size\`: \`trisect crosscheck\` on ${#models[@]} models. $(sed -n '2,3p' "$work/text" | paste -sd'|' | sed 's/|/; /'). Both run on
the same llvmpipe, Vulkan's robust frames by tiles, OpenGL's by the list: agreement proves the front ends and the plumbing, not hardware.

\`compute\` is the kernel of Vulkan, \`fragment\` the thesis's full-screen quad, whose rays the rasteriser interpolates.
Mismatches and Z are sums over the models, the rest is the worst model's: Z in units in the last place, colour in steps of
8 bits. \`too far\`: models beyond the tolerance (compute: no mismatch, Z of other bits in 1e-4 of the hits, colours 1 step;
fragment: 1e-4 of the pixels hit by one only, RMSE 0.25). The bisection at Rank 10 keeps or drops a pixel by the last bit of
its ray; that is what is too far below.

| path | surface | shell | solver | models | pixels | hit mismatches | patch mismatches | Z of the same bits | Z p99 | RMSE | largest | too far |
|---|---|---|---|---|---|---|---|---|---|---|---|---|
END
  for path in compute fragment; do
    for solver in robust bisect; do
      row "$path" flat normal "$solver"
      for surface in phong sphere; do
        for shell in normal height; do row "$path" "$surface" "$shell" "$solver"; done
      done
    done
  done
  cat <<END

Vulkan, OpenGL's quad, their difference so amplified that the largest is white, and where they differ (red: hit by one only;
blue: Z of other bits), of the relief by the thesis's bisection:

![Four pictures of a relief](crosscheck.png)
END
} >"$work/crosscheck.md"
check assets/relief.obj --gl-path fragment --preset thesis --diff "$work/crosscheck.png"
mv "$work/crosscheck.md" "$work/crosscheck.png" docs/
