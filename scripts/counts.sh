#!/bin/bash
# Counts the work of a frame of some models, and writes tests/counts.tsv: evaluations of the surface, candidates, bytes read
# of the scene, rays that a kernel leaves to a later one. With --check compares with what is written there, and fails if a
# figure has grown by more than 3%. Counts do not depend on how busy the machine is: on stock Mesa, with eight lanes in a
# subgroup, and with one thread, for the order of a tile's list is that in which threads fill it.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
[ $# = 0 ] || [ "$*" = --check ] || { echo "usage: scripts/counts.sh [--check]" >&2; exit 2; }
ready build docs
export LP_NATIVE_VECTOR_WIDTH=256 LP_NUM_THREADS=1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

count_all() {
  printf 'model\tsurface\taccel\tevaluations\tcandidates\tbytes\tqueued\n'
  local model surface accel
  for model in sphere-20 sphere-320 torus relief teapot; do
    for surface in phong sphere; do
      for accel in tiles bvh; do
        measure stock $model 1 --size 400x300 --surface $surface --accel $accel --evals
        figure "[\"$model\", .surface, .accel, .evals_total, .candidates_total, .bytes_read, .queued_rays] | @tsv"
      done
    done
  done
}

count_all > "$work/counts.tsv"
if [ $# = 0 ]; then
  mv "$work/counts.tsv" tests/counts.tsv
else
  paste tests/counts.tsv "$work/counts.tsv" | awk -F'\t' '
    NR == 1 { split($0, name); next }
    { for (i = 4; i <= 7; ++i) if ($(i + 7) > 1.03 * $i) {
        printf "%s, surface %s, accel %s: %d %s in place of %d\n", $1, $2, $3, $(i + 7), name[i], $i; grown = 1 } }
    END { if (grown) { print "Work has grown by more than 3%. Where that is worth it, scripts/counts.sh writes the figures anew."; exit 1 }
          printf "%d frames take no more work than tests/counts.tsv says.\n", NR - 1 }'
fi
