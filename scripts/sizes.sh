#!/bin/bash
# Measures the same sphere from 20 to five million patches, and writes docs/sizes.md and its plot. Some ten minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh build test docs
cmake --preset release >/dev/null
cmake --build --preset release --target trisect make-assets
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
sizes=(20 80 320 1280 5120 20480 81920 327680 1310720 5242880)

. scripts/measure.sh
ms() { figure '.gpu_ms.median | if . < 100 then (. * 10 | round / 10) else round end'; }
seconds() { figure "$1 | . / 10 | round / 100"; }

# One line: a sphere on both drivers. The figures of the plot go into $work/data.
row() {
  local model=$work/sphere-$1.obj newer work_done runs=3
  if [ "$1" -gt 1000000 ]; then runs=1; fi
  if [ -f "assets/sphere-$1.obj" ]; then model=assets/sphere-$1.obj; else build/release/make-assets "$work" "sphere-$1"; fi
  measure newer "$model" $runs
  newer=$(ms)
  measure newer "$model" 1 --evals
  work_done=$(figure '"\(.evals_total / .width / .height | . * 100 | round / 100) | \(.bytes_read / .width / .height | round)"')
  measure stock "$model" $runs
  echo "$1 $newer $(ms)" >>"$work/data"
  echo "| $1 | $(figure .accel) | $(seconds .load_ms) | $(seconds .bake_ms) | $(seconds '(.bvh_ms // 0)') | $(seconds .upload_ms)" \
    "| $(figure '.scene_bytes / .patches | round') | $work_done | $newer | $(ms) |"
  rm -f "$work/sphere-$1.obj"
}

name_drivers
{
  cat <<END
# Size

The sphere, divided ever more finely, in the same view: 800x600, phong, robust solver, \`--accel auto\`. Written by
\`scripts/sizes.sh\` on $(nproc) cores; medians of 3 frames after a warm-up (of more than a million patches: 1), milliseconds
on the device. Device: $(figure .device); A is ${name[newer]}, B ${name[stock]}. The machine is shared: 20% either way
means nothing.

![Milliseconds over patches](sizes.svg)

Read is the OBJ file, bake the triangles and the bounds of their subpatches, bytes what a patch takes on the device: triangle, bounds, tree.
Evaluations of the surface and bytes read are those of a pixel. With a hundred thousand patches in view their sides are
of two pixels, and the rays of a packet have hardly a patch in common: from 150,000 subpatches on each goes down the tree
by itself.

| patches | accel | read, s | bake, s | tree, s | upload, s | bytes | evaluations | bytes read | A, ms | B, ms |
|---|---|---|---|---|---|---|---|---|---|---|
END
  for size in "${sizes[@]}"; do row "$size"; done
} >"$work/sizes.md"
gnuplot <<END
set terminal svg size 800,420 dynamic background rgb "white"
set output "$work/sizes.svg"
set logscale xy
set grid
set xlabel "patches"
set ylabel "milliseconds a frame"
set format x "10^{%L}"
set key left top noenhanced
plot "$work/data" using 1:2 with linespoints pt 7 title "${name[newer]}", \
     "$work/data" using 1:3 with linespoints pt 5 title "${name[stock]}"
END
mv "$work/sizes.md" "$work/sizes.svg" docs/
