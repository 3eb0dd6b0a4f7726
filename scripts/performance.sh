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
sphere=(sphere-20 sphere-80 sphere-320 teapot)

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

# How many times as fast the tiles are as another contender, on a driver, with a surface, on a model; or, with a word more, as
# long.
against_tiles() {
  jq -rs --arg surface "$2" --arg model "/$3.obj" --arg other "$4" --arg inverse "${5:-}" '
    [.[].rows[] | select(.surface == $surface and (.model | endswith($model)))] |
    (map(select(.contender == "tiles, robust"))[0].ms.median) as $tiles |
    (map(select(.contender == $other))[0].ms.median / $tiles) |
    if $inverse == "" then . else 1 / . end | . * 10 | round / 10' "$work/$1-phong.json" "$work/$1-sphere.json"
}

image="image only"
thesis="thesis (list, bisect, Rank 10)"
embree="Embree, packets of 16"

# For every scene: how many times as fast the tiles are as a contender, on a driver.
ratios() {
  {
    for model in "${phong[@]}"; do echo "phong, $model: $(against_tiles "$1" phong "$model" "$2")"; done
    for model in "${sphere[@]}"; do echo "sphere, $model: $(against_tiles "$1" sphere "$model" "$2")"; done
  } | paste -sd';' | sed 's/;/; /g'
}

# A row: what is compared, with which contender, the surface, the model, the goal; inverse: how long, not how fast.
goal() {
  echo "| $1 | $4 | $3 | $5 | $(against_tiles newer "$3" "$4" "$2" "${6:-}") | $(against_tiles stock "$3" "$4" "$2" "${6:-}") |"
}

goals() {
  local long="as long as an image only, at most" packets="as fast as Embree's packets, at least"
  local way="as fast as the thesis, at least"
  echo '| tiles | model | surface | goal | Mesa 25.0.7 | Mesa 22.3.6 |'
  echo '|---|---|---|---|---|---|'
  goal "$long" "$image" phong relief 4 inverse
  goal "$long" "$image" phong sphere-20 5 inverse
  goal "$long" "$image" phong sphere-320 5 inverse
  goal "$long" "$image" phong teapot 7 inverse
  goal "$long" "$image" sphere sphere-20 10 inverse
  goal "$long" "$image" sphere sphere-320 10 inverse
  goal "$long" "$image" sphere teapot 10 inverse
  goal "$packets" "$embree" phong sphere-20 3
  goal "$packets" "$embree" phong relief 3
  goal "$packets" "$embree" phong teapot 3
  goal "$packets" "$embree" phong teapot-1000 1.5
  goal "$packets" "$embree" sphere sphere-20 1.5
  goal "$packets" "$embree" sphere sphere-320 1.5
  goal "$packets" "$embree" sphere teapot 1.5
  goal "$way" "$thesis" phong sphere-20 "10; 8 on 22.3.6"
  goal "$way" "$thesis" phong sphere-80 "18; 20 on 22.3.6"
  goal "$way" "$thesis" phong sphere-320 "35; 80 on 22.3.6"
}

# One line: what a frame by tiles does. What an image takes that has nothing else, of the same size, is not counted to it.
limit() {
  local model=$1 surface=$2 all none pixels
  measure newer "$model" 9 --surface "$surface" --accel tiles
  all=$(figure .gpu_ms.median)
  none=$(jq "[.rows[] | select(.contender == \"$image\") | .ms.median] | add / length" "$work/newer-phong.json")
  measure newer "$model" 1 --surface "$surface" --accel tiles --evals
  pixels=$(figure '.width * .height')
  jq -r --argjson all "$all" --argjson none "$none" --argjson pixels "$pixels" --argjson cores "$(nproc)" \
    '"| '"$model"' | '"$surface"' | \($all | . * 10 | round / 10) | \($none | . * 10 | round / 10) | \(.evals_total / $pixels | . * 100 | round / 100) | \(.candidates_total / $pixels | . * 100 | round / 100) | \(.bytes_read / $pixels | round) | \(.bytes_read / $all / 1e6 | . * 10 | round / 10) | \(($all - $none) * $cores * 1e6 / .evals_total | round) |"' \
    "$work/a.json"
}

limits() {
  echo '| model | surface | ms | image only, ms | evaluations a pixel | candidates a pixel | bytes a pixel | GB/s | ns of a core an evaluation |'
  echo '|---|---|---|---|---|---|---|---|---|'
  for model in sphere-20 sphere-320 relief teapot; do limit "$model" phong; done
  for model in sphere-20 sphere-320 teapot; do limit "$model" sphere; done
}

{
  cat <<END
# Speed

Written by \`scripts/performance.sh\` on $(nproc) cores: \`trisect bench speed\`, frames of 800x600 with the default camera.
Contenders take turns; ms, least and most are of 5 turns after a warm-up, on a Vulkan device by its clock. The machine is
shared: 20% either way means nothing.

- image only: a kernel that writes an image and nothing else, what no frame can undercut
- thesis: every triangle at every pixel, bisection at Rank 10, height shell (\`--preset thesis\`)
- list, tiles, bvh, rayquery: the robust solver against every patch, against those that 8x8 pixels touch, against those that
  a tree finds, against those that the device's own structure finds, where it has one; the same picture
- Embree: the same rays, pixels and shading on both cores against flat triangles that are off the surface by at most 1e-6 of
  the scene's radius (or, where that takes more than sixteen million of them, as fine as sixteen million are)

\`wrong\` \`of\`: pixels of a grid that the oracle decides and the contender has otherwise, hit or colour. KB: what a scene takes,
images aside. build: bake, tree, tessellation. CPU ms: of all threads of the process.
END
  for driver in newer stock; do tables $driver; done
  cat <<END

## Ratios

How many times as fast the tiles are, on Mesa 25.0.7, then on 22.3.6:

- as the thesis: $(ratios newer "$thesis").
- as the thesis: $(ratios stock "$thesis").
- as Embree's packets: $(ratios newer "$embree").
- as Embree's packets: $(ratios stock "$embree").

## Goals

What was aimed at, and what is there.

$(goals)

Faster than Embree's packets it is by what was aimed at (half of it on 22.3.6, whose loads are slower), or nearly, but for the
teapot's sphere surface. What an image only takes
depends on the machine's memory, and what a frame takes hardly: the same machine has shown 1.1 and 2.4 ms for it. Before anything
is searched, each ray is set up, and each hit shaded and stored. Tried for it in vain: one kernel for the sky and the rest,
reductions by shuffles, loads of projections by address, three steps of Newton's method on the bounds' quadratic instead of two,
cones tested a ray at a time. The teapot's sphere surface took ten times as long as the others while its heights went like 1 / (D.N)
up to a clamp ([surfaces](surfaces.md)). What it takes more now goes with its steep rims: 47,000 subpatches, a fifth
of which see no direction from which they could not fold.

## What limits it

Frames by tiles on Mesa 25.0.7, and what their rays do. The scene is read at one or two GB a second, and lies in the cores' own
caches: memory is not the limit. The time goes with the evaluations of the surface and what leads to them. Newton's method takes
two or three for each subpatch that a ray comes near, few enough that tenfold faster frames would need cheaper ones, and not fewer.
The column \`of the image\` above says how far that is from an image that has nothing but the sky's colour.

END
  limits
} >"$work/performance.md"
mv "$work/performance.md" docs/performance.md
