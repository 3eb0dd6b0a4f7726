#!/bin/bash
# Measures what shadows of flat triangles do to smooth surfaces, with and without what renderers do about it, and writes
# docs/terminator. A minute; with --quick some seconds, into build/terminator, which is only for looking.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
ready build test docs
to=docs/terminator
# The spider, of Debian's assimp-testmodels, is as people model and export them.
models=(assets/{sphere-80,sphere-320,torus,capsule,teapot}.obj /usr/share/assimp/models/OBJ/spider.obj)
more=(--size 240x180 --runs 5)
if [ "${1:-}" = --quick ]; then
  to=build/terminator
  models=(assets/sphere-20.obj)
  more=(--size 80x60 --runs 1 --lights 90)
fi
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
on newer build/release/trisect bench terminator "${models[@]}" "${more[@]}" -o "$work/report"
# The page with all pictures in it repeats what is beside it.
rm "$work/report/terminator.html"
rm -rf "$to"
mkdir -p "$(dirname "$to")"
mv "$work/report" "$to"
