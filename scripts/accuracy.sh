#!/bin/bash
# Measures the solvers against the oracle and on the hard cases, and writes docs/accuracy.md. The argument is the
# image size, 800x600 without one (half an hour, most of it the oracle on the sphere surface).
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
ready build docs
size=${1:-800x600}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
all=(sphere-20 sphere-80 sphere-320 torus relief capsule cube saddle teapot teapot-1000)

# The table of `trisect accuracy` without its column of milliseconds, which the oracle's threads disturb.
accuracy() { checked accuracy "$@" | awk -F'|' -v OFS='|' 'NF > 10 { for (i = 19; i < NF; ++i) $i = $(i + 1); --NF } 1'; }

# Median milliseconds of a model's frame with these options.
milliseconds() {
  build/release/trisect render "assets/$1.obj" --size 400x300 --runs 5 -o "$work/a.png" --stats "$work/a.json" \
    "${@:2}" >/dev/null
  jq -r '.gpu_ms.median | round' "$work/a.json"
}

# A broken promise is a line of the table; the exit code 1 that says so is for others.
checked() { build/release/trisect "$@" || [ $? = 1 ]; }
{
  cat <<END
# Accuracy

Every pixel against the double-precision oracle, written by \`scripts/accuracy.sh $size\`. \`undecidable\`: pixels where the
oracle's own answer flips when the ray moves by one part in 1e7; the other columns leave them out. \`off\`: depth error
times |n.v| over the scene's radius. \`ulp\`: depth error in units in the last place of the depth. \`normal p99\`: degrees.
\`evals\`: evaluations of the surface for each candidate, the median over pixels. \`cpu differs\`: pixels whose patch, Z, U or
V has other bits on the CPU back end. \`pass\`: nothing wrong or missed, off p99 <= 2.5e-7, off max
<= 2e-6, normal p99 <= 0.05 degrees, at most 0.02% undecidable. bisect is at Rank 10.

## Phong Tessellation

END
  # shellcheck disable=SC2046 # one word for each model
  accuracy --size "$size" --surface phong $(paths "${all[@]}")
  cat <<END

## The sphere surface

END
  # shellcheck disable=SC2046
  accuracy --size "$size" --surface sphere $(paths "${all[@]}")
  cat <<END

## Beside the bisection

Milliseconds on the device, the median of 5 frames of 400x300; the bisection is at Rank 10.

| model | surface | robust, normal shell | robust, height shell | bisect, normal shell | bisect, height shell |
|---|---|---|---|---|---|
END
  for surface in phong sphere; do
    for model in "${all[@]}"; do
      printf '| %s | %s ' "$model" "$surface"
      for solver in robust bisect; do
        for shell in normal height; do
          printf '| %s ' "$(milliseconds "$model" --surface "$surface" --solver "$solver" --shell "$shell")"
        done
      done
      echo '|'
    done
  done
  cat <<END

## Hard cases

\`trisect hardcases\`: the errors are across the surface, in units of 2^-23 of the scene's radius.

\`\`\`
END
  checked hardcases
  echo '```'
} > "$work/accuracy.md"
mv "$work/accuracy.md" docs/accuracy.md
