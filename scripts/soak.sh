#!/bin/bash
# Has a window without a screen show many frames while its model, surface, acceleration and size change every five seconds and its
# shaders every twenty: 40,000 frames, in which its memory must not grow, and 20,000 under the validation layer, which must say
# nothing. (The layer keeps records of what was made; its memory is told, not limited.) Writes docs/soak.md. Ends with 1 if Vulkan is
# misused or memory grows. Eighteen minutes.
#   scripts/soak.sh [FRAMES]     without the layer; half as many with it
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
ready build test docs
frames=${1:-40000}
work=$(mktemp -d)
server=
program=
trap 'kill $server $program 2>/dev/null || true; rm -rf "$work"' EXIT
open_display
name_drivers
cp -r shaders "$work/shaders"

models=(sphere-20 torus relief teapot capsule cube saddle sphere-320)
flags=("--surface phong --accel tiles" "--surface sphere --accel bvh" "--surface flat --accel list" "--preset thesis"
  "--surface phong --shadows --spp 4" "--surface flat --accel bvh --shadows --light 1,0.8,0.4" "--surface sphere --shading grid")
sizes=(320x240 480x320 240x240 400x300 333x217)
keys=(w a s d e q)
# Four hours of it: the number of frames ends it. Something moves all the time, or no frames would be traced.
for ((k = 0; k < 2880; ++k)); do
  at=$((5 * k))
  echo "$at open $PWD/assets/${models[k % ${#models[@]}]}.obj"
  echo "$at.4 flags ${flags[k % ${#flags[@]}]}"
  echo "$at.6 size ${sizes[k % ${#sizes[@]}]}"
  echo "$at.6 shown $([ $((k % 3)) = 0 ] && echo evaluations || echo colour)"
  echo "$at hold ${keys[k % ${#keys[@]}]} 5"
done >"$work/script"

declare -A took
# watch RUN FRAMES [OPTIONS]: has them shown. $work/RUN.memory gets the kilobytes in memory, a number each second; $work/RUN.given those
# of every twenty seconds when glibc has given back what is free (malloc_trim).
watch() {
  local run=$1 count=$2 compiled=0 code=0 process
  shift 2
  on newer build/release/trisect view assets/sphere-20.obj --size 320x240 --frame-ms 10 --watch \
    --shaders "$work/shaders" --script "$work/script" --frames "$count" "$@" >"$work/output" 2>&1 &
  program=$!
  SECONDS=0
  while sleep 1; do
    process=$(pgrep -x -P $program trisect) || break
    ps -o rss= -p "$process" >>"$work/$run.memory" || break
    if [ $((SECONDS / 20)) -gt $compiled ]; then
      compiled=$((compiled + 1))
      gdb -p "$process" -batch -ex 'call (int)malloc_trim(0)' >/dev/null 2>&1 || true
      ps -o rss= -p "$process" >>"$work/$run.given" || break
      echo "const float ${run}Edit$compiled = $compiled.0;" >>"$work/shaders/shading.glsl"
    fi
  done
  wait $program || code=$?
  program=
  [ $code = 0 ] || { cat "$work/output" >&2; echo "the window ended with $code" >&2; exit 1; }
  took[$run]="$count frames in $((SECONDS / 60)) minutes, with $((SECONDS / 5)) changes and $compiled times new shaders"
}
watch Alone "$frames"
watch Layer $((frames / 2)) --validation

# quarter FILE N WHAT: the min or max of mebibytes in quarter N of the time.
quarter() { jq -r -s "(length / 4 | floor) as \$n | .[($2 - 1) * \$n : $2 * \$n] | $3 / 1024 | round" "$work/$1"; }
{
  cat <<END
# A window for long

A window shows frames while model, surface, acceleration and size change every five seconds and the shaders every twenty, on
$(nproc) cores. Written by \`scripts/soak.sh\`. Device: ${name[newer]}.

- Alone: ${took[Alone]}.
- Under the Vulkan validation layer, which said nothing: ${took[Layer]}. The layer keeps records of its own of what was made.

Memory in use, MiB: the least of what is left once glibc has given back what is free, every twenty seconds; and the most, which is
while the driver compiles.

| quarter of the time | alone, given back, least | alone, most | with the layer, given back, least | with the layer, most |
|---|---|---|---|---|
END
  for n in 1 2 3 4; do
    echo "| $n | $(quarter Alone.given $n min) | $(quarter Alone.memory $n max) | $(quarter Layer.given $n min) | $(quarter Layer.memory $n max) |"
  done
} >"$work/soak.md"
mv "$work/soak.md" docs/soak.md
# Models and surfaces differ, and there are more of them in a quarter than in another.
[ "$(quarter Alone.given 4 min)" -le $(($(quarter Alone.given 2 min) * 11 / 10)) ] || { echo "memory grows: docs/soak.md" >&2; exit 1; }
