#!/bin/bash
# Lets `trisect judge` judge Embree, OpenGL's rasteriser and trisect itself, and writes docs/judge.md. Four minutes.
#   scripts/judge.sh [COUNT]     rays of each kind and model, default 500
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
count=${1:-500}
scripts/setup.sh build test docs
cmake --preset release -DBUILD_TESTING=ON >/dev/null
cmake --build --preset release --target trisect other-tracers
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
models=(teapot torus sphere-320)
trisect=build/release/trisect
others=build/release/other-tracers

# judged SURFACE MODEL: adds the figures for a.rays and a.hits to $work/judged.
judged() {
  $trisect judge "$work/a.rays" "$work/a.hits" "assets/$2.obj" --surface "$1" --json "$work/one.json" >/dev/null || [ $? = 1 ]
  cat "$work/one.json" >>"$work/judged"
}

# row WORDS: sums up what judged() has added, over the models.
row() {
  jq -rs --arg words "$1" 'def sum(f): map(f) | add; def most(f): map(f) | max * 1000 | round / 1000;
    "| \($words) | \(sum(.rays)) | \(sum(.undecidable)) | \(sum(.missed)) | \(sum(.invented)) | \(sum(.wrong_patch + .wrong_root))"
    + " | \(sum(.not_a_number)) | \(sum(.at_edge)) | \(sum(.at_vertex)) | \(most(.ulp.p50)) | \(most(.ulp.p99)) |"' "$work/judged"
  rm "$work/judged"
}

kinds=(random vertex edge along grazing far axis leaving)

# by TRACER SURFACE WORDS: a row for each kind of rays.
by() {
  local kind model
  for kind in "${kinds[@]}"; do
    for model in "${models[@]}"; do
      $trisect rays "assets/$model.obj" --surface "$2" --kind "$kind" --count "$count" -o "$work/a.rays" >/dev/null
      case $1 in
        trisect) $trisect cast "$work/a.rays" "assets/$model.obj" --surface "$2" -o "$work/a.hits" >/dev/null ;;
        *) $others "$1" "$work/a.rays" "assets/$model.obj" "$work/a.hits" ;;
      esac
      judged "$2" "$model"
    done
    row "$3 | $kind"
  done
}

header="| tracer | rays at | rays | undecidable | missed | invented | wrong place | NaN | at an edge | at a vertex | ulp p50 | ulp p99 |
|---|---|---|---|---|---|---|---|---|---|---|---|"
list=$(printf ", %s" "${models[@]}")
isa=SSE4.2
for flag in AVX2 AVX512F; do ! grep -qw "${flag,,}" /proc/cpuinfo || isa=$flag; done
measure stock sphere-20 1
driver=$(figure .driver)
device=$(figure .device)
measure stock sphere-20 1 --backend opengl
{
  cat <<END
# What ray tracers do wrong

\`trisect judge RAYS HITS MODEL\` takes the rays of a file and the hits that any program found for them ([formats.md](formats.md) has
both), and compares every hit with the first root that an independent search in double precision finds, on flat triangles or on curved
ones. \`trisect rays MODEL\` writes rays on which ray tracers fail. \`tests/judge/other_tracers.cpp\` is an example of how to take
part: it has Embree's triangles and OpenGL's rasteriser answer.

Written by \`scripts/judge.sh $count\`: $count rays of each kind at each of ${list:2}. Embree $(dpkg-query -W -f='${Version}' libembree3-3), on a CPU with
$isa; the rasteriser: $(figure .driver), $(figure .device); trisect on $device, $driver.

- Undecidable: the answer changes when the ray is moved by one part in 1e7 of the model's radius, or of the distance to its middle
  if that is larger. Such rays count for nothing else.
- Missed, invented: no hit where there is one, a hit where there is none. Wrong place: another triangle, farther off than a unit in
  the last place of t and a millionth of the radius, or another root of the same, such as one behind the first. At an edge, at a vertex: where the missed root lies, within a thousandth of its weights.
- ulp: the error of t of the right hits, in units in the last place of single precision, the largest of the models' medians and
  of the values that one in a hundred exceeds.

## Flat triangles

$header
END
  by embree flat Embree
  by embree-robust flat 'Embree, robust'
  by trisect flat trisect
  for model in "${models[@]}"; do
    $others opengl "assets/$model.obj" "$work/a.rays" "$work/a.hits"
    judged flat "$model"
  done
  row "OpenGL's rasteriser | image of 400x300"
  cat <<END

Without its robust flag Embree lets rays through between triangles: they are in the wrong place, on the far side of the model, most at
edges and vertices. With the flag few do. Ten thousand radii away a unit in the last place of t is a thousandth of the radius.
trisect moves rays to the middle of the model before it rounds them, and a ray that passes a border by less than a rounding meets it.
The rasteriser rounds vertices to parts of a pixel, which moves outlines. Rays that leave the surface may come back to it at a t that is
nearly 0, whose last places are finer than those of a position.

## Curved triangles

$header
END
  by trisect phong 'trisect, phong'
  by trisect sphere 'trisect, sphere'
} >"$work/judge.md"
mv "$work/judge.md" docs/judge.md
