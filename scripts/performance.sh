#!/bin/bash
# Measures what docs/performance.md and README's section on speed say, and writes docs/performance.md. Some fifteen
# minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
ready build docs
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
phong=(sphere-20 sphere-80 sphere-320 relief torus teapot teapot-1000)
sphere=(sphere-20 sphere-80 sphere-320)

# Tables of both surfaces, under the driver's name; the figures stay in $work.
tables() {
  # shellcheck disable=SC2046 # one word for each model
  on "$1" build/release/trisect bench speed $(paths "${phong[@]}") --surface phong --json "$work/$1-phong.json" >"$work/phong"
  # shellcheck disable=SC2046
  on "$1" build/release/trisect bench speed $(paths "${sphere[@]}") --surface sphere --json "$work/$1-sphere.json" >"$work/sphere"
  printf '\n## %s\n\n' "$(jq -r .driver "$work/$1-phong.json")"
  grep '^|' "$work/phong"
  grep '^|' "$work/sphere" | tail -n +3
}

# For every scene: how many times as fast the tiles are as something else.
ratios() {
  jq -rs --arg other "$2" '[.[].rows[]] | group_by([.surface, .patches, .model])[] |
    (map(select(.contender == "tiles, robust"))[0]) as $tiles | map(select(.contender == $other))[0] as $other |
    "\($tiles.surface), \($tiles.model | split("/")[-1] | rtrimstr(".obj")): \($other.ms.median / $tiles.ms.median * 10 | round / 10)"' \
    "$work/$1-phong.json" "$work/$1-sphere.json" | paste -sd';' | sed 's/;/; /g'
}

{
  cat <<END
# Speed

Written by \`scripts/performance.sh\` on $(nproc) cores: \`trisect bench speed\`, frames of 800x600 with the default camera.
Contenders take turns; ms, least and most are of 5 turns after a warm-up, on a Vulkan device by its clock. The machine is
shared: 20% either way means nothing.

- image only: a kernel that writes an image and nothing else, what no frame can undercut
- thesis: every triangle at every pixel, bisection at Rank 10, height shell (\`--preset thesis\`)
- list, tiles, bvh: the robust solver against every patch, against those that 8x8 pixels touch, against those that a tree
  finds; the same picture
- Embree: the same rays, pixels and shading on both cores against flat triangles that are off the surface by at most 1e-6 of
  the scene's radius (or, where that takes more than sixteen million of them, as fine as sixteen million are)

\`wrong\` \`of\`: pixels of a grid that the oracle decides and the contender has otherwise, hit or colour. KB: what a scene takes,
images aside. build: bake, tree, tessellation.
END
  for driver in newer stock; do tables $driver; done
  cat <<END

## Ratios

How many times as fast the tiles are, on Mesa 25.0.7, then on 22.3.6:

- as the thesis: $(ratios newer "thesis (list, bisect, Rank 10)").
- as the thesis: $(ratios stock "thesis (list, bisect, Rank 10)").
- as Embree's packets: $(ratios newer "Embree, packets of 16").
- as Embree's packets: $(ratios stock "Embree, packets of 16").
END
} >"$work/performance.md"
mv "$work/performance.md" docs/performance.md
