#!/bin/bash
# Measures the baseline that README quotes, and writes docs/baseline.md. Two minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
ready build docs
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# thesis DRIVER MODEL SURFACE RANK RUNS
thesis() { measure "$1" "$2" "$5" --preset thesis --surface "$3" --rank "$4"; }

name_drivers
{
  cat <<END
# The baseline

The thesis's algorithm as it stands: every triangle at every pixel, bisection. 800x600, default camera. Written by
\`scripts/baseline.sh\` on $(nproc) cores:

- device $(figure .device)
- driver A: ${name[stock]}, Debian 12's own
- driver B: ${name[newer]}, from bookworm-backports

## Time at Rank 10

Milliseconds on the device, medians of 5 frames after a warm-up. The last column is the thesis's table 3.1, a GPU of
2020. The machine is shared and noisy: 20% either way means nothing.

| thesis | here | triangles | phong, A | phong, B | sphere, A | sphere, B | thesis |
|---|---|---|---|---|---|---|---|
END
  while read -r name model milliseconds; do
    row=""
    for surface in phong sphere; do
      for driver in stock newer; do
        thesis "$driver" "$model" "$surface" 10 5
        row+=" $(printf '%.0f' "$(figure .gpu_ms.median)") |"
      done
    done
    echo "| $name | $model | $(figure .patches) |$row $milliseconds |"
  done <<< $'SphereHigh sphere-20 15\nFresko relief 25\nTeapot teapot 51'
  cat <<END

## Pixels that the bisection drops

sphere-20 on driver A: pixels hit, and which part of those hit at Rank 30 is missing.

| Rank | phong | missing | sphere | missing |
|---|---|---|---|---|
END
  thesis stock sphere-20 phong 30 1
  phong=$(figure .hits)
  thesis stock sphere-20 sphere 30 1
  sphere=$(figure .hits)
  for rank in 6 8 10 12 14 16 18 20 30; do
    thesis stock sphere-20 phong "$rank" 1
    p=$(figure .hits)
    thesis stock sphere-20 sphere "$rank" 1
    s=$(figure .hits)
    awk -v r="$rank" -v p="$p" -v P="$phong" -v s="$s" -v S="$sphere" \
      'function missing(n, N) { return n < N ? 100 * (N - n) / N : 0 }
       BEGIN { printf "| %d | %d | %.1f%% | %d | %.1f%% |\n", r, p, missing(p, P), s, missing(s, S) }'
  done
} > "$work/baseline.md"
mv "$work/baseline.md" docs/baseline.md
