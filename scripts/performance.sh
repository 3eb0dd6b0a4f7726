#!/bin/bash
# Measures what docs/performance.md and README's section on speed say, and writes docs/performance.md. Some ten minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh build docs
cmake --preset release >/dev/null
cmake --build --preset release --target trisect
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
models=(sphere-20 sphere-80 sphere-320 teapot teapot-1000 torus relief)

. scripts/measure.sh
ms() { figure '.gpu_ms.median | if . < 100 then (. * 10 | round / 10) else round end'; }

# One line: the thesis, the robust solver with all patches and with tiles, and how much faster the last is than the first.
row() {
  local driver=$1 model=$2 surface=$3 thesis list tiles patches
  measure "$driver" "$model" 3 --surface "$surface" --preset thesis
  thesis=$(ms)
  measure "$driver" "$model" 3 --surface "$surface" --accel list
  list=$(ms)
  measure "$driver" "$model" 9 --surface "$surface" --accel tiles
  tiles=$(ms)
  patches=$(figure .patches)
  echo "| $model | $patches | $surface | $thesis | $list | $tiles | $(jq -n "$thesis / $tiles | . * 10 | round / 10") |"
}

name_drivers
{
  cat <<END
# Speed

Written by \`scripts/performance.sh\` on $(nproc) cores: milliseconds on the device for a frame of 800x600 with the default
camera, medians of 3 frames after a warm-up (tiles: 9). Device: $(figure .device).
The machine is shared: 20% either way means nothing.

- thesis: every triangle at every pixel, bisection at Rank 10, height shell (\`--preset thesis\`). It drops pixels and finds
  a root rather than the first one; the other two columns are exact
- list: every patch at every pixel, robust solver, normal shell
- tiles: the same picture from lists of the parts that 8x8 pixels touch
END
  for driver in newer stock; do
    printf '\n## %s\n\n' "${name[$driver]}"
    echo '| model | patches | surface | thesis | list | tiles | thesis / tiles |'
    echo '|---|---|---|---|---|---|---|'
    for model in "${models[@]}"; do row $driver "$model" phong; done
    for model in sphere-20 sphere-80 sphere-320; do row $driver "$model" sphere; done
  done
} >"$work/performance.md"
mv "$work/performance.md" docs/performance.md
