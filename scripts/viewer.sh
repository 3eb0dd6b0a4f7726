#!/bin/bash
# Walks around the thesis's three models in a window without a screen, on both drivers, and writes docs/viewer.md with
# its pictures. Two minutes or three.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
ready build test docs
work=$(mktemp -d)
server=
trap 'kill $server; rm -rf "$work"' EXIT
open_display
name_drivers

# walk DRIVER MODEL: from side to side before the model.
walk() {
  printf '0.2 hold d 1.5\n1.7 hold a 3\n4.7 hold d 1.5\n6.2 quit\n' >"$work/walk"
  on "$1" build/release/trisect view "assets/$2.obj" --script "$work/walk" --stats "$work/a.json" >/dev/null
}

# picture NAME FLAGS: the window, at rest after the script on standard input.
picture() {
  cat >"$work/script"
  echo '13 quit' >>"$work/script"
  on newer build/release/trisect view "${@:2}" --script "$work/script" >/dev/null &
  local program=$! window
  window=$(xdotool search --sync --name '^trisect: ' | head -1)
  sleep 11
  import -window "$window" "docs/$1.png"
  wait $program
}

{
  cat <<END
# The window

\`trisect view\` in a window of 800x600 pixels, walking from side to side before the model. Written by \`scripts/viewer.sh\`.
Frames may take 33 ms (\`--frame-ms\`), and the resolution gives way: the part is that of the window's pixels that are traced.
Medians; a frame is all from the look at the input until the picture is handed over. What is pressed is in the next picture.
Device: $(figure .device), on $(nproc) cores that also draw the window; A is ${name[newer]}, B ${name[stock]}.

| model | A, ms a frame | A, part | B, ms a frame | B, part |
|---|---|---|---|---|
END
  for model in sphere-20 relief teapot; do
    row="| $model"
    for driver in newer stock; do
      walk $driver $model
      row+=" | $(jq -r '.moving_ms.median * 10 | round / 10' "$work/a.json") | $(jq -r '.moving_part.median * 100 | round' "$work/a.json")%"
    done
    echo "$row |"
  done
  cat <<END

Standing still, the picture comes to full resolution, then to \`--spp\` rays a pixel; then nothing is computed until something
changes.

| ![The teapot with its panel](viewer.png) | ![Evaluations on the torus](viewer-evaluations.png) | ![The error of the bisection](viewer-error.png) |
|---|---|---|
| shadows, four rays a pixel, the list of keys | evaluations of the surface | the bisection's error against the oracle: magenta pixels are missed |
END
} >"$work/viewer.md"
picture viewer assets/teapot.obj --shadows --light 1,0.8,0.4 --spp 4 <<<'0 press h'
picture viewer-evaluations assets/torus.obj <<<'0 shown evaluations'
picture viewer-error assets/sphere-20.obj --preset thesis <<<'0 error'
mv "$work/viewer.md" docs/viewer.md
