#!/bin/bash
# Measures how near coarse models come to the shapes that they stand for, by flat triangles and by curved ones, and writes
# docs/shape. Seven minutes; with --quick one, into build/shape, which is only for looking.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
ready build test docs
cmake --build --preset release --target make-assets
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
to=docs/shape
more=(--error 3e-5 --runs 3)
# A shape, its finest model, others, and options. The teapot's blended spheres are steep: for an error of 3e-5 it would take more
# than 16 million triangles to stand for them.
shapes=(
  "sphere sphere-327680 sphere-20 sphere-80 sphere-320 sphere-1280 sphere-5120"
  "torus torus-262144 torus torus-1024 torus-4096"
  "capsule capsule-261120 capsule capsule-960 capsule-3968"
  "saddle saddle-131072 saddle saddle-128 saddle-512 saddle-2048"
  "relief relief-327680 relief relief-320 relief-1280 relief-5120"
  "teapot teapot-260k teapot teapot-1000 teapot-4000 --error=3e-4"
)
if [ "${1:-}" = --quick ]; then
  to=build/shape
  more=(--error 1e-3 --runs 1 --size 160x120)
  shapes=("sphere sphere-20480 sphere-20 sphere-80")
fi

# model NAME: makes it, if it is not an asset, and prints its path.
model() {
  if [ -f "assets/$1.obj" ]; then
    echo "assets/$1.obj"
  else
    [ -f "$work/$1.obj" ] || build/release/make-assets "$work" "$1" >/dev/null
    echo "$work/$1.obj"
  fi
}

# Models of which curved triangles should make nothing good; the report says which.
spoilt() {
  /usr/bin/python3 - "$work" <<'END'
import pathlib
import sys
import numpy

folder = pathlib.Path(sys.argv[1])
random = numpy.random.default_rng(1)


def read(name):
    lines = [line.split() for line in pathlib.Path(f"assets/{name}.obj").read_text().splitlines()]
    numbers = lambda word: numpy.array([[float(x) for x in line[1:]] for line in lines if line[:1] == [word]])
    return numbers("v"), numbers("vn"), [line[1:] for line in lines if line[:1] == ["f"]]


def write(name, positions, normals, faces):
    with open(folder / f"{name}.obj", "w") as file:
        for word, rows in (("v", positions), ("vn", normals)):
            file.writelines(f"{word} {x:.9g} {y:.9g} {z:.9g}\n" for x, y, z in rows)
        file.writelines(f"f {' '.join(face)}\n" for face in faces)


def alone(faces):
    return [[corner.split("/")[0] for corner in face] for face in faces]


positions, normals, faces = read("sphere-320")
write("sphere-320-noisy", positions + 0.01 * random.normal(size=positions.shape), [], alone(faces))
turned = normals + 0.2 * random.normal(size=normals.shape)
write("sphere-320-turned", positions, turned / numpy.linalg.norm(turned, axis=1)[:, None], faces)
positions, normals, faces = read("cube")
write("cube-smooth", positions, [], alone(faces))
END
}

mkdir "$work/report"
parts=()
# measured NAME REFERENCE MODEL|OPTION...: of paths. The last of an option counts.
measured() {
  on newer build/release/trisect bench shape "${more[@]}" "${@:3}" --reference "$2" -o "$work/report/$1" >/dev/null
  parts+=("$1")
}
for shape in "${shapes[@]}"; do
  read -ra names <<<"$shape"
  words=()
  for name in "${names[@]:2}"; do
    case $name in --*) words+=("$name") ;; *) words+=("$(model "$name")") ;; esac
  done
  measured "${names[0]}" "$(model "${names[1]}")" "${words[@]}"
done
if [ "$to" = docs/shape ]; then
  spoilt
  measured spoilt-sphere "$(model sphere-327680)" "$work/sphere-320-noisy.obj" "$work/sphere-320-turned.obj"
  measured spoilt-cube assets/cube.obj "$work/cube-smooth.obj"
fi

{
  cat <<END
# How near curved triangles come to a shape

Written by \`scripts/shape.sh\`: the distances between the surfaces of coarse models and a fine one of the same shape, by
\`trisect bench shape\`. Lengths are over half the diagonal of the shape's bounding box. Each part has the tables, with the largest
distances both ways, bounds that no point exceeds, normals, outlines, pictures, time and memory. The fine models are flat
triangles themselves: where one stands for a smooth shape, a surface that is exactly that shape is some 1e-5 off it.
Device: $(jq -r '.facts[0]' "$work/report/sphere/shape.json").
END
  if [ "$to" = docs/shape ]; then
    cat <<END

Of three models curved triangles should make nothing good. sphere-320-noisy: every coordinate of its vertices is moved by chance,
with a standard deviation of a hundredth of the radius, and normals are made from the faces. sphere-320-turned: the same with
its normals and a deviation of 0.2, which turns half of them by more than 13 degrees. cube-smooth: a cube's eight corners have
one normal each.
END
  fi
  for part in "${parts[@]}"; do
    printf '\n## [%s](%s/shape.md)\n\n![Distances over triangles and time, %s](%s/shape.svg)\n\n' "$part" "$part" "$part" "$part"
    grep '^- .*triangles: ' "$work/report/$part/shape.md"
  done
} >"$work/report/report.md"
rm -rf "$to"
mkdir -p "$(dirname "$to")"
mv "$work/report" "$to"
