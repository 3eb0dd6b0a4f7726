#!/bin/bash
# Measures the same teapot from a thousand to four million patches, and writes docs/sizes.md. Some six minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh build docs
cmake --preset release >/dev/null
cmake --build --preset release --target trisect make-assets
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
models=(teapot-1000 teapot-16k teapot-65k teapot-260k teapot-1m teapot-4m)

. scripts/measure.sh
ms() { figure '.gpu_ms.median | round'; }
seconds() { figure "$1 | . / 10 | round / 100"; }

# One line: a model on both drivers.
row() {
  local newer
  build/release/make-assets "$work" "$1"
  measure newer "$work/$1.obj" 3 --accel bvh
  newer=$(ms)
  measure stock "$work/$1.obj" 3 --accel bvh
  echo "| $1 | $(figure .patches) | $(seconds .load_ms) | $(seconds .bake_ms) | $(seconds .bvh_ms) | $(seconds .upload_ms)" \
    "| $(figure '.scene_bytes / .patches | round') | $(ms) | $newer |"
  rm "$work/$1.obj"
}

name_drivers
{
  cat <<END
# Size

Newell's teapot, divided ever more finely, in the same view: 800x600, phong, robust solver, \`--accel bvh\`. Written by
\`scripts/sizes.sh\` on $(nproc) cores; medians of 3 frames after a warm-up, milliseconds on the device.
Device: $(figure .device); A is ${name[stock]}, B ${name[newer]}.
The machine is shared: 20% either way means nothing.

Read is the OBJ file, bake the triangles and their cages, bytes what a patch takes on the device: triangle, cages, tree.

| model | patches | read, s | bake, s | tree, s | upload, s | bytes | A, ms | B, ms |
|---|---|---|---|---|---|---|---|---|
END
  for model in "${models[@]}"; do row "$model"; done
} >"$work/sizes.md"
mv "$work/sizes.md" docs/sizes.md
