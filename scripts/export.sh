#!/bin/bash
# Exports models as flat triangles and writes docs/export.md, and docs/export.png, which f3d draws of one (two minutes).
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
ready build test docs
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# figures MODEL OPTION...: leaves them in $work/a.json; 1 is a bound that is larger than what was asked for.
figures() {
  local code=0
  build/release/trisect export "assets/$1.obj" -o "$work/a.ply" --json "$work/a.json" "${@:2}" >/dev/null || code=$?
  [ $code -le 1 ]
}
row() {
  figures "$1" --surface "$2" --subdivide 1
  local radius error
  radius=$(jq .radius "$work/a.json")
  error=$(jq -n "$radius * $3")
  figures "$1" --surface "$2" --error "$error"
  local fitted
  fitted=$(jq -r '"\(.triangles) | \(.vertices) | \(if .bound > .error then "\(.bound / .radius * 1e5 | round / 1e5) (\(.beyond_error) triangles)" else "as asked" end)"' "$work/a.json")
  # The least even division with the same bound, which falls as they grow: between one that has it not and one that has.
  local most=40 even="" low=0 high n
  [ "$2" = sphere ] || most=100
  high=$((most + 1))
  while [ $((high - low)) -gt 1 ]; do
    n=$(((low + high) / 2))
    figures "$1" --surface "$2" --subdivide $n
    if [ "$(jq --argjson error "$error" '.bound <= $error' "$work/a.json")" = true ]; then
      high=$n
      even=$(jq -r .triangles "$work/a.json")
    else
      low=$n
    fi
  done
  echo "| $1 | $2 | $3 | $fitted | ${even:-more than $most x $most each} |"
}

camera=(--eye=4,3,9 --target=0.3,1.5,0)
shown() {
  xvfb-run -a f3d --quiet --resolution 480,360 --camera-position 4,3,9 --camera-focal-point 0.3,1.5,0 --camera-view-up 0,1,0 \
    --camera-view-angle 32 --color 0.8,0.8,0.8 -e --output "$work/$2.png" "$1"
}
build/release/trisect render assets/teapot.obj --size 480x360 --spp 4 --fov 32 "${camera[@]}" -o "$work/0.png" >/dev/null
build/release/trisect export assets/teapot.obj --subdivide 1 -o "$work/coarse.glb" >/dev/null
build/release/trisect export assets/teapot.obj --error 0.01 -o "$work/fine.glb" >/dev/null
shown "$work/coarse.glb" 1
shown "$work/fine.glb" 2
convert "$work/1.png" "$work/2.png" "$work/0.png" +append -quality 90 "$work/export.png"

{
  cat <<END
# The surface as flat triangles

Written by \`scripts/export.sh\`. \`trisect export MODEL --error EPS -o FILE\` divides edges, each for both of its triangles, until no
point of the surface is farther than EPS from the triangles, nor they from it. The bound is proven for every triangle: for
phong by the Bezier points of the cubic, for sphere by the best of three bounds, on small triangles that by ranges of the second
derivatives (\`chord_bound\` in \`app/tessellation/chord_bound.h\`, \`sphere_chord_bound\` in \`app/surface/sphere_range.h\`);
roundings are in it, those of the file's numbers too. Vertices are shared, so a closed model stays closed, also where normals
differ in the last digits; where they split along an edge the two sides part, as they do in a picture. \`--subdivide N\` makes N x N triangles of each, and says how far off they are.

![The model, what is exported for an error of 0.01, and what trisect traces](export.png)

f3d $(dpkg-query -W -f '${Version}' f3d) shows the teapot's 304 triangles and $(build/release/trisect export assets/teapot.obj --error 0.01 -o "$work/fine.glb" |
    sed -nE 's/.*: ([0-9]+) triangles, [0-9]+ vertices, .*open edges; .*/\1/p') exported ones; on the right trisect's own picture.

Errors over the model's radius, half the diagonal of its bounding box. The last column: the fewest triangles of an even
division that has that bound as well.

| model | surface | error | triangles | vertices | bound | evenly |
|---|---|---|---|---|---|---|
END
  for surface in phong sphere; do
    for model in sphere-20 torus capsule teapot; do
      for error in 1e-2 1e-3 1e-4; do
        [ $model-$surface-$error = teapot-sphere-1e-4 ] || row $model $surface $error
      done
    done
  done
  cat <<END

The teapot's blended spheres are steep where lines begin to miss a vertex's sphere: there no bound is proven that falls with
the triangles, and the program ends with 1 and says for how many. The bounds of blended spheres are looser than those of
phong as long as triangles are large: that costs triangles, not correctness.
END
} >"$work/export.md"
mv "$work/export.md" "$work/export.png" docs/
