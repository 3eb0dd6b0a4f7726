#!/bin/bash
# The largest pictures and models: what they take, or in what sentence they are refused. Writes docs/limits.md; some twenty
# minutes and 20 GB of memory. Ends with 1 if a command ends in any way but a whole result or one sentence.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
ready build docs
cmake --build --preset release --target make-assets
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
name_drivers

# row WHAT COMMAND...: a row of what trisect takes for it. What it writes is $work/a.*.
row() {
  local what=$1 code=0 kilobytes seconds result
  shift
  rm -f "$work"/a.*
  on newer /usr/bin/time -q -o "$work/time" -f '%M %e' build/release/trisect "$@" >/dev/null 2>"$work/errors" || code=$?
  read -r kilobytes seconds <"$work/time"
  case $code in
    0)
      result=$({ cat "$work"/a.* 2>/dev/null || true; } | wc -c)
      if [ "$result" = 0 ]; then result="read"; else result="written, $(jq -n "$result / 1e6 | . * 10 | round / 10") MB"; fi
      ;;
    2 | 4 | 6) # more pixels than there may be, more than the device can hold, or out of memory
      [ "$(wc -l <"$work/errors")" = 1 ] || { echo "$what: $(cat "$work/errors")" >&2; exit 1; }
      result="refused: $(sed "s|$work/||g" "$work/errors")"
      ;;
    *) echo "$what: ended with $code: $(cat "$work/errors")" >&2; exit 1 ;;
  esac
  echo "| $what | $(jq -n "$seconds * 10 | round / 10") | $(jq -n "$kilobytes * 1024 / 1e7 | round / 100") | $result |"
}

# triangles SHAPE: a million triangles in binary PLY on standard output: `identical`, all the same; `slivers`, a fan around a
# middle, each 160,000 times as long as wide.
triangles() {
  /usr/bin/python3 - "$1" <<'END'
import sys
import numpy

count = 1000000
if sys.argv[1] == "identical":
    corners = numpy.tile(numpy.float32([[0, 0, 0], [1, 0, 0], [0, 1, 0]]), (count, 1, 1))
else:
    angles = numpy.arange(count) * (2 * numpy.pi / count)
    ends = numpy.stack([numpy.cos(angles), numpy.sin(angles), 0.2 * numpy.sin(5 * angles)], axis=1)
    corners = numpy.stack([numpy.zeros_like(ends), ends, numpy.roll(ends, -1, axis=0)], axis=1)
faces = numpy.zeros(count, dtype=[("corners", "u1"), ("vertices", "<i4", 3)])
faces["corners"] = 3
faces["vertices"] = numpy.arange(3 * count).reshape(count, 3)
header = ["ply", "format binary_little_endian 1.0", f"element vertex {3 * count}"]
header += [f"property float {axis}" for axis in "xyz"]
header += [f"element face {count}", "property list uchar int vertex_indices", "end_header", ""]
sys.stdout.buffer.write("\n".join(header).encode() + corners.astype("<f4").tobytes() + faces.tobytes())
END
}

{
  cat <<END
# Limits

The largest pictures and models, by \`scripts/limits.sh\` on $(nproc) cores. Seconds and memory (the most that the process held)
are those of a whole command, the driver's part among them. Device: ${name[newer]}.

A picture has up to 16384 pixels a side. What needs more memory than is free is refused before it is taken.

| what | seconds | memory, GB | |
|---|---|---|---|
END
  for size in 8192 16384; do
    row "sphere-20, ${size}x$size, .png" render assets/sphere-20.obj --size "${size}x$size" -o "$work/a.png"
    for ending in exr pfm; do
      row "sphere-20, ${size}x$size, .$ending" render assets/sphere-20.obj --size "${size}x$size" --aov color -o "$work/a.$ending"
    done
  done
  row "sphere-20, 16384x16384, .exr with all channels" render assets/sphere-20.obj --size 16384x16384 \
    --aov color,Z,N,G,patch,uv,P,evals -o "$work/a.exr"
  row "sphere-20, 16385x16384" render assets/sphere-20.obj --size 16385x16384 -o "$work/a.png"
  build/release/make-assets "$work" sphere-5242880 >/dev/null
  row "a sphere of 5,242,880 patches in OBJ" render "$work/sphere-5242880.obj" -o "$work/a.png"
  row "its patches tried one by one, 4x4" render "$work/sphere-5242880.obj" --accel list --size 4x4 -o "$work/a.png"
  rm "$work/sphere-5242880.obj"
  for shape in identical slivers; do
    triangles $shape >"$work/$shape.ply"
    row "a million ${shape/identical/identical triangles}, facts" info "$work/$shape.ply"
    row "the same, phong, 16x12" render "$work/$shape.ply" --size 16x12 -o "$work/a.png"
    row "the same, flat with shadows, 16x12" render "$work/$shape.ply" --size 16x12 --surface flat --shadows -o "$work/a.png"
    rm "$work/$shape.ply"
  done
} >"$work/limits.md"
mv "$work/limits.md" docs/limits.md
