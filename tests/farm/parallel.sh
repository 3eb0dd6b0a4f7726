#!/bin/bash
# Renders a sequence by GNU parallel, kills it and its workers in the middle, and lets it do the rest. All frames must be there,
# whole, and none rendered twice.
#   parallel.sh PROGRAM MODEL
set -euo pipefail
program=$1
model=$2
frames=8

folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
fail() {
  echo "parallel.sh: $1" >&2
  exit 1
}
work() { # log of what is said
  seq 0 $((frames - 1)) | parallel --will-cite -j 2 "$program" render "$model" --turntable $frames --size 320x240 \
    --backend oracle --spp 4 --resume --frames '{}' -o "'frames/{frame}.png'" >> said 2>&1
}
finished() { find frames -name '????.png' 2>/dev/null | wc -l; }

# setsid makes a group of processes of its own, which is killed as a whole, without a chance to clean up.
export -f work
export program model frames
setsid bash -c work &
group=$!
for _ in $(seq 600); do
  [ "$(finished)" -ge 2 ] && break
  sleep 0.1
done
kill -KILL -- -$group
wait $group 2>/dev/null || true
before=$(finished)
[ "$before" -ge 2 ] && [ "$before" -lt $frames ] || fail "$before of $frames frames were there when it was killed"
work || fail "the rest was not rendered"
[ "$(cd frames && ls)" = "$(seq -f %04g.png 0 $((frames - 1)))" ] || fail "the folder holds $(ls frames | tr '\n' ' ')"
for frame in frames/????.png; do
  "$program" compare "$frame" "$frame" --quiet || fail "$frame is torn"
  # Of a frame that was finished just before the kill nothing may have been said.
  [ "$(grep -c "^$frame: .*pixels hit" said)" -le 1 ] || fail "$frame was rendered twice"
done
[ "$(grep -c "is there" said)" -ge "$before" ] || fail "a finished frame was rendered again"
echo "$frames frames, $before of them before the kill: all there, whole, none rendered twice"
