#!/bin/bash
# Whether this tree's pictures are those of another revision, bit for bit: every model, surface and shell, by tiles, list,
# tree with shadows, bisection, CPU and OpenGL. Hits, triangles, Z and colours must be the same everywhere, to the last
# bit. Prints a line for each way and ends with 1 if a picture is another one.
#   scripts/same-pictures.sh REVISION [MODEL.obj ...]      without models all in assets/, in half an hour
set -euo pipefail
cd "$(dirname "$0")/.."
[ $# -ge 1 ] || { echo "usage: scripts/same-pictures.sh REVISION [MODEL.obj ...]" >&2; exit 2; }
revision=$(git rev-parse --verify "$1^{commit}")
shift
models=("$@")
[ $# -gt 0 ] || models=(assets/*.obj)
scripts/setup.sh build
cmake --preset release >/dev/null 2>&1
cmake --build --preset release --target trisect >/dev/null

folder=build/same-pictures
rm -rf "$folder/pictures"
git worktree remove --force "$folder/tree" 2>/dev/null || true
git worktree add --quiet --detach "$folder/tree" "$revision"
trap 'git worktree remove --force "$folder/tree"' EXIT
(cd "$folder/tree" && cmake --preset release -DBUILD_TESTING=OFF >/dev/null 2>&1 &&
  cmake --build --preset release --target trisect >/dev/null)
before="$folder/tree/build/release/trisect"
after=build/release/trisect
mkdir -p "$folder/pictures"

status=0
compare() { # NAME OPTION ...
  local name=$1 pictures=0 apart=0
  shift
  for model in "${models[@]}"; do
    for surface in flat phong sphere; do
      for shell in normal height; do
        for program in "$before" "$after"; do
          "$program" render "$model" --surface "$surface" --shell "$shell" "$@" \
            -o "$folder/pictures/$([ "$program" = "$after" ] && echo after || echo before).exr" >/dev/null
        done
        pictures=$((pictures + 1))
        if ! cmp -s "$folder/pictures/before.exr" "$folder/pictures/after.exr" &&
          ! figures=$("$after" compare "$folder/pictures/before.exr" "$folder/pictures/after.exr" \
            --threshold z_differs=0 --threshold color_max=0); then
          apart=$((apart + 1))
          echo "$name, $model, $surface, $shell: $figures"
        fi
      done
    done
  done
  echo "$name: $pictures pictures, $apart of them another one"
  [ "$apart" -eq 0 ] || status=1
}

echo "this tree against $(git log -1 --format='%h, %s' "$revision")"
compare "tiles, 800x600" --accel tiles
compare "list, 160x120" --accel list --size 160x120
compare "tree with shadows, 400x300" --accel bvh --shadows --size 400x300
compare "bisection at Rank 10, 200x150" --solver bisect --size 200x150
compare "CPU, 80x60" --backend cpu --size 80x60
compare "OpenGL, 160x120" --backend opengl --size 160x120
exit $status
