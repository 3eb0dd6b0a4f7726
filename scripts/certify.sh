#!/bin/bash
# Proves what the pixels of all models show, has a second opinion on more than a million certificates of each, and writes
# docs/certify.md and its picture. Half an hour on two cores.
#   scripts/certify.sh [COUNT]     certificates of each of a model's four surfaces, default 300000
#   scripts/certify.sh --quick     1000 each, and smaller pictures: two minutes; docs stay as they are
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
size=800x600 side=320 count=300000 quick=
case ${1:-} in
  --quick) size=160x120 side=48 count=1000 quick=1 ;;
  "") ;;
  *) count=$1 ;;
esac
scripts/setup.sh build test docs
cmake --preset release -DBUILD_TESTING=ON >/dev/null
cmake --build --preset release --target trisect check-certificates
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
models=(sphere-20 sphere-80 sphere-320 torus capsule saddle relief cube teapot-1000 teapot)
name_drivers
wrong=0

# ends CODE: an answer that is proven wrong, or a certificate that is refuted, is told at the end; anything else ends it here.
ends() { [ "$1" = 0 ] || { [ "$1" = 1 ] && wrong=1; }; }

# pictures SURFACE SHELL: a row for each model.
pictures() {
  local model
  for model in "${models[@]}"; do
    on newer build/release/trisect certify "assets/$model.obj" --surface "$1" --shell "$2" --size $size --json "$work/a.json" >/dev/null || ends $?
    jq -r --arg model "$model" --arg surface "$1" --arg shell "$2" '.reasons as $r | "| \($model) | \($surface) | \($shell)"
      + " | \($r.nothing_near) | \($r.hulls) | \($r.contraction) | \($r.one_root) | \($r.border) | \($r.fold) | \($r.nonsmooth) | \($r.ray_start + $r.order)"
      + " | \(.wrong) |"' "$work/a.json"
  done
}

# opinions SURFACE SHELL: a row for each model.
opinions() {
  local model
  for model in "${models[@]}"; do
    build/release/check-certificates "assets/$model.obj" "$1" "$2" $side "$count" || ends $?
  done
}

{
  cat <<END
# What pixels show, proven

\`trisect certify MODEL\` renders a model, proves of each pixel what its ray hits, and holds the two against each other. Written by
\`scripts/certify.sh $count\`. Device: ${name[newer]}.

A proof is made in double precision by interval arithmetic on the baked numbers, which the kernels take. It rests on no sample
and on no tolerance that was tuned. It holds for a tube of rays: all that are parallel to the pixel's and no farther from it,
along either axis across, than 1e-7 of the camera's distance, which is what single precision may move it by. The search
(\`app/certify/patch_certifier.h\`) divides patches until each piece

- is off the tube by a hull of the surface over it (\`app/surface/patch_range.h\`): the convex hull of control points, or ranges of
  the displacement;
- or is contracted: with ranges of the tangents all over the piece (\`app/surface/tangent_range.h\`) Krawczyk's operator proves that
  there is no root in it, or one for every ray of the tube, and where;
- or is a 4096th of the patch, and stays open.

A pixel is then a miss because nothing is near, because all hulls are off the ray, or by hulls and contraction; or a hit on a
single root with nothing before it; or it is open: at the border of a patch, where some of the rays have their root in one
patch and some in the next; at a fold, where the surface turns away from the rays within the tube; where it is not smooth; at
the ray's start; or where two roots are as near as each other.

![The reasons of the teapot's pixels](certify-teapot.png)

## Pictures of $size pixels

Pixels by reason, and the answers of the robust solver that do not agree: a hit where a miss is proven or the other way round,
another root of the patch (farther off than a hundredth of the model's radius), or another patch (a millionth).

| model | surface | shell | nothing near | hulls | contraction | one root | border | fold | nonsmooth | start, order | wrong |
|---|---|---|---|---|---|---|---|---|---|---|---|
END
  pictures flat normal
  pictures phong normal
  pictures phong height
  pictures sphere normal
  cat <<END

## A second opinion

\`tests/certify\` looks at certificates once more in numbers of fifty digits (MPFR). It shares nothing with what made them but the
baked numbers: the surfaces are written anew there, from their definitions. Of what is on one side 16 points of the piece must
be there; where the coordinates are polynomials their Bernstein coefficients prove it, mostly. For a root, and for none, Newton's
method looks for that of the middle ray and of the four at the tube's edges, and from the piece's corners for a second root.

Of every proven pixel it is looked at, in exact arithmetic, whether its certificates leave a gap: whether they deal with all of
each patch whose ball the rays come into, whether each root lies inside its patch, and whether what is left out as lying behind
the answer lies there.

The pictures are of ${side}x$side pixels; of larger numbers of certificates every so many-th is looked at.

| model | surface | shell | proven pixels | with a gap | certificates | looked at: hull | before | behind | no root | one root | proven | supported | Newton without end | refuted |
|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|
END
  opinions flat normal
  opinions phong normal
  opinions phong height
  opinions sphere normal
} >"$work/certify.md"
on newer build/release/trisect certify assets/teapot.obj --size 640x480 -o "$work/certify-teapot.png" >/dev/null || ends $?
if [ -n "$quick" ]; then
  cat "$work/certify.md"
else
  mv "$work/certify.md" "$work/certify-teapot.png" docs/
fi
exit $wrong
