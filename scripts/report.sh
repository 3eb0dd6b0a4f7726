#!/bin/bash
# Writes docs/report: `trisect bench pareto` and `bench ablation` on both drivers, the hard cases and the stability. Some
# fifteen minutes on two quiet cores; with --quick two, into build/report, which is only for looking.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
ready build test docs
scripts/unpack-mesa.sh >/dev/null
quick=${1:-}
to=docs/report
phong=(sphere-20 sphere-80 sphere-320 relief teapot)
sphere=(sphere-20 sphere-320)
steps=(sphere-20 sphere-320 teapot)
if [ "$quick" = --quick ]; then
  to=build/report
  phong=(sphere-20 teapot)
  sphere=(sphere-20)
  steps=(sphere-20)
fi

# report NAME DRIVER: both surfaces, each into a folder of its own, and what the steps are worth.
report() {
  local more=(--size 320x240 --runs 3 "--hardcases=$to/hardcases.json")
  if [ "$quick" = --quick ]; then more=(--quick); fi
  # shellcheck disable=SC2046 # one word for each model
  on "$2" build/release/trisect bench pareto $(paths "${phong[@]}") --surface phong -o "$to/$1-phong" "${more[@]}"
  # shellcheck disable=SC2046
  on "$2" build/release/trisect bench pareto $(paths "${sphere[@]}") --surface sphere -o "$to/$1-sphere" "${more[@]}"
  # shellcheck disable=SC2046
  on "$2" build/release/trisect bench ablation $(paths "${steps[@]}") --surface phong --size 320x240 --runs 3 -o "$to/$1-steps"
}
rm -rf "$to"
mkdir -p "$to"
if [ "$quick" != --quick ]; then build/release/trisect hardcases --json "$to/hardcases.json"; fi
report mesa-25 newer
report mesa-22 stock
build/release/trisect bench stability -o "$to/stability"

# What all of them say, and the way to each.
{
  printf '# Speed against error\n\nWritten by `scripts/report.sh`. Each part has its own report, with plots and tables.\n\nThe thesis has a Rank to vary, flat triangles their number. The robust solver has nothing of that kind: it ends within\nroundings of the first root, or has proven that there is none.\n'
  for part in mesa-25-phong mesa-25-sphere mesa-22-phong mesa-22-sphere; do
    printf '\n## [%s](%s/report.md)\n\n' "$part" "$part"
    sed -nE '/^## Hard cases/d; s/^## (.*)/\n### \1\n/p; /^- /p' "$to/$part/report.md"
  done
  for part in mesa-25-steps mesa-22-steps; do
    printf '\n## [What each step is worth, %s](%s/ablation.md)\n' "${part%-steps}" "$part"
    for model in "${steps[@]}"; do printf '\n![Milliseconds and wrong pixels, %s](%s/%s-phong.svg)\n' "$model" "$part" "$model"; done
  done
  printf '\n## [Numerical stability](stability/stability.md)\n\n![Errors over what is varied](stability/stability.svg)\n'
} >"$to/report.md"
