#!/bin/bash
# Fetches the models of the WebXR Input Profiles (npm's package @webxr-input-profiles/assets, MIT licence, 94 MB) into
# build/gallery, renders a dozen of them, and writes docs/gallery.md and its pictures (a minute). By npm, Debian's where
# there is none.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
ready build docs
command -v npm >/dev/null || scripts/setup.sh gallery
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
version=1.0.20
models=$PWD/build/gallery/package/dist/profiles
if [ ! -d "$models" ]; then
  (cd "$work" && npm pack --silent "@webxr-input-profiles/assets@$version" >/dev/null)
  mkdir -p build/gallery
  tar -xzf "$work"/*.tgz -C build/gallery
fi

render() { build/release/trisect render "$models/$1.glb" --spp 4 "${@:2}" --stats "$work/a.json"; }
render generic-hand/left --size 600x450 --fov 40 --eye=0.31,-0.01,0.05 --target=-0.02,-0.025,-0.01 --up=0,-1,0.2 \
  --light=0.5,-0.6,0.5 -o "$work/gallery-hand.png" >/dev/null
render pico-neo2/left --size 600x450 -o "$work/gallery-controller.png" >/dev/null

pictures=()
number=0
{
  cat <<END
# Models of others

Written by \`scripts/gallery.sh\`: a dozen of the models of the WebXR Input Profiles, version $version, as web pages show them. Each is
curved as its own normals say (phong), nothing else is done to it. Hard edges are where a model's normals split: there curved
triangles part, which shows as hairlines where faces bulge differently. \`trisect info\` says what of each.

![A dozen models](gallery.jpg)

|  | model | triangles | parts | what trisect says |
|---|---|---|---|---|
END
  for model in google-daydream/none pico-neo2/left generic-hand/left pico-g2/none generic-button/left oculus-touch-v2/left \
    pico-neo3/left samsung-gearvr/none meta-quest-touch-pro/left valve-index/left oculus-touch/left magicleap-two/none; do
    number=$((number + 1))
    picture=$work/$(printf %02d $number).png
    render "$model" --size 400x300 -o "$picture" >"$work/out"
    build/release/trisect info "$models/$model.glb" --json "$work/info.json" >/dev/null
    said=$(head -1 "$work/out" | sed -E 's/^.*: [0-9]+ triangles, //')
    echo "| $number | $model | $(jq .patches "$work/a.json") | $(jq .surface.parts "$work/info.json") | $said |"
    pictures+=(-label "$number" "$picture")
  done
} >"$work/gallery.md"
montage "${pictures[@]}" -tile 4x -geometry 300x225+3+3 -quality 85 "$work/gallery.jpg"
mv "$work"/gallery* docs/
