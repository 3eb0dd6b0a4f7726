#!/bin/bash
# Has a window without a screen show 20,000 frames under the validation layer while its model, surface, acceleration and size
# change every five seconds and its shaders every twenty. Writes docs/soak.md. Ends with 1 if Vulkan is misused or memory grows.
# Ten minutes.
#   scripts/soak.sh [FRAMES]
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
ready build test docs
frames=${1:-20000}
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

on newer build/release/trisect view assets/sphere-20.obj --size 320x240 --frame-ms 10 --validation --watch \
  --shaders "$work/shaders" --script "$work/script" --frames "$frames" >"$work/output" 2>&1 &
program=$!
SECONDS=0
compiled=0
# Kilobytes in memory, every second.
while sleep 1; do
  process=$(pgrep -x -P $program trisect) || break
  ps -o rss= -p "$process" >>"$work/memory" || break
  if [ $((SECONDS / 20)) -gt $compiled ]; then
    compiled=$((compiled + 1))
    echo "const float Edit$compiled = $compiled.0;" >>"$work/shaders/shading.glsl"
  fi
done
seconds=$SECONDS
code=0
wait $program || code=$?
program=
[ $code = 0 ] || { cat "$work/output" >&2; echo "the window ended with $code" >&2; exit 1; }

# The least and the most mebibytes in quarter N of the time. The least is without the driver's compiler at work.
quarter() { jq -r -s "(length / 4 | floor) as \$n | .[($1 - 1) * \$n : $1 * \$n] | map(. / 1024 | round) | \"\(min) \(max)\"" "$work/memory"; }
{
  cat <<END
# A window for long

Written by \`scripts/soak.sh\`: $frames frames in $((seconds / 60)) minutes on $(nproc) cores, in which model, surface, acceleration and size
changed $((seconds / 5)) times and the shaders $compiled times, under the Vulkan validation layer, which said nothing. The most is
while the driver compiles. Device: ${name[newer]}.

| quarter of the time | memory in use, MiB, least | most |
|---|---|---|
END
  for n in 1 2 3 4; do
    read -r least most < <(quarter $n)
    echo "| $n | $least | $most |"
  done
} >"$work/soak.md"
mv "$work/soak.md" docs/soak.md
read -r early _ < <(quarter 2)
read -r late _ < <(quarter 4)
# What is used and given back need not be laid out the same.
[ "$late" -le $((early * 11 / 10)) ] || { echo "memory grows: docs/soak.md" >&2; exit 1; }
