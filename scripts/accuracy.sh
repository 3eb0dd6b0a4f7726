#!/bin/bash
# Measures the solvers against the oracle and on the hard cases, and writes docs/accuracy.md. The arguments are the
# image sizes for Phong Tessellation and for the sphere surface, on which the oracle is slow: 800x600 and 200x150
# without them (some thirty minutes).
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh build
cmake --preset release >/dev/null
cmake --build --preset release --target trisect
phong_size=${1:-800x600}
sphere_size=${2:-200x150}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
smooth=(sphere-20 sphere-80 sphere-320 torus relief capsule cube saddle)
paths() { printf 'assets/%s.obj ' "$@"; }

# A broken promise is a line of the table; the exit code 1 that says so is for others.
measure() { build/release/trisect "$@" || [ $? = 1 ]; }
{
  cat <<END
# Accuracy

Every pixel against the double-precision oracle, written by \`scripts/accuracy.sh $phong_size $sphere_size\`. \`undecidable\`: pixels where the
oracle's own answer flips when the ray moves by one part in 1e7; the other columns leave them out. \`off\`: depth error
times |n.v| over the scene's radius. \`ulp\`: depth error in units in the last place of the depth. \`normal p99\`: degrees.
\`evals\`: evaluations of the surface for each candidate, the median over pixels. \`cpu differs\`: pixels whose patch, Z, U or
V has other bits on the CPU back end. \`ms\`: on the device. \`pass\`: nothing wrong or missed, off p99 <= 2.5e-7, off max
<= 2e-6, normal p99 <= 0.05 degrees, at most 0.02% undecidable. bisect is at Rank 10.

## Phong Tessellation

END
  # shellcheck disable=SC2046 # one word for each model
  measure accuracy --size "$phong_size" --surface phong $(paths "${smooth[@]}" teapot teapot-1000)
  cat <<END

## The sphere surface

Without the teapots: their normals behind the faces tear this surface, and the oracle takes milliseconds a ray there.

END
  # shellcheck disable=SC2046
  measure accuracy --size "$sphere_size" --surface sphere $(paths "${smooth[@]}")
  cat <<END

## Hard cases

\`trisect hardcases\`: the errors are across the surface, in units of 2^-23 of the scene's radius.

\`\`\`
END
  measure hardcases
  echo '```'
} > "$work/accuracy.md"
mv "$work/accuracy.md" docs/accuracy.md
