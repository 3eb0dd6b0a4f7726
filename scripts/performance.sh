#!/bin/bash
# Measures what docs/performance.md and README's section on speed say, and writes docs/performance.md. Some ten minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh build docs
cmake --preset release >/dev/null
cmake --build --preset release --target trisect make-assets
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
models=(sphere-20 sphere-80 sphere-320 teapot teapot-1000 torus relief)

. scripts/measure.sh
ms() { figure '.gpu_ms.median | if . < 100 then (. * 10 | round / 10) else round end'; }

# One line: the thesis, the robust solver with all patches, with tiles and with the tree, and how much faster tiles are than
# the thesis.
row() {
  local driver=$1 model=$2 surface=$3 thesis list tiles bvh patches
  measure "$driver" "$model" 3 --surface "$surface" --preset thesis
  thesis=$(ms)
  measure "$driver" "$model" 3 --surface "$surface" --accel list
  list=$(ms)
  measure "$driver" "$model" 9 --surface "$surface" --accel tiles
  tiles=$(ms)
  patches=$(figure .patches)
  measure "$driver" "$model" 9 --surface "$surface" --accel bvh
  bvh=$(ms)
  echo "| $model | $patches | $surface | $thesis | $list | $tiles | $bvh | $(jq -n "$thesis / $tiles | . * 10 | round / 10") |"
}

# One line of the table of sizes.
large_row() {
  local newer
  build/release/make-assets "$work" "$1"
  measure newer "$work/$1.obj" 3 --accel bvh
  newer=$(ms)
  measure stock "$work/$1.obj" 3 --accel bvh
  echo "| $1 | $(figure .patches) | $(seconds .load_ms) | $(seconds .bake_ms) | $(seconds .bvh_ms) | $(seconds .upload_ms) |" \
    "$(figure '.scene_bytes / .patches | round') | $(ms) | $newer |"
}
seconds() { figure "$1 | . / 10 | round / 100"; }

scripts/unpack-mesa.sh >/dev/null
{
  declare -A name
  for driver in newer stock; do
    measure $driver sphere-20 1
    name[$driver]=$(figure .driver)
  done
  cat <<END
# Speed

Written by \`scripts/performance.sh\` on $(nproc) cores: milliseconds on the device for a frame of 800x600 with the default
camera, medians of 3 frames after a warm-up (tiles, bvh: 9). Device: $(figure .device).
The machine is shared: 20% either way means nothing.

- thesis: every triangle at every pixel, bisection at Rank 10, height shell (\`--preset thesis\`). It drops pixels and finds
  a root rather than the first one; the other two columns are exact
- list: every patch at every pixel, robust solver, normal shell
- tiles: the same picture from lists of the parts that 8x8 pixels touch
- bvh: the same picture by a tree over the parts' boxes
END
  for driver in newer stock; do
    printf '\n## %s\n\n' "${name[$driver]}"
    echo '| model | patches | surface | thesis | list | tiles | bvh | thesis / tiles |'
    echo '|---|---|---|---|---|---|---|---|'
    for model in "${models[@]}"; do row $driver "$model" phong; done
    for model in sphere-20 sphere-80 sphere-320; do row $driver "$model" sphere; done
  done
  cat <<END

## Size

The same teapot, divided ever more finely, by --accel bvh. Bake: triangles, cages and, in the next column, the tree.
Bytes: what a patch takes on the device, triangles, cages and tree. Frames: A ${name[stock]}, B ${name[newer]}.

| model | patches | read, s | bake, s | tree, s | upload, s | bytes | A, ms | B, ms |
|---|---|---|---|---|---|---|---|---|
END
  for model in teapot-1000 teapot-16k teapot-65k teapot-260k teapot-1m teapot-4m; do
    large_row "$model"
    rm -f "$work/$model.obj"
  done
} >"$work/performance.md"
mv "$work/performance.md" docs/performance.md
