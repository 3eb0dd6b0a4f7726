#!/bin/bash
# Measures what the Vulkan drivers that can be had without a GPU do differently, and writes docs/devices.md. The argument
# is the size of the compared images, 160x120 without one (some ten minutes, most of them SwiftShader's compiler).
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
ready build docs
size=${1:-160x120}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
models=(sphere-320 torus saddle)
drivers=(stock newer swiftshader)

program() { on "$1" build/release/trisect "${@:2}"; }

# The seconds until a driver has drawn a small picture with these options, its cache of pipelines being empty.
seconds_at_first() {
  local driver=$1 start
  shift
  on "$driver" true
  start=$(date +%s%N)
  XDG_CACHE_HOME=$(mktemp -d -p "$work") program "$driver" render assets/sphere-20.obj -o "$work/first.png" --size 16x16 \
    "$@" >/dev/null
  echo $((($(date +%s%N) - start) / 100000000)) | sed 's/\(.\)$/.\1/; s/^\./0./'
}

# picture DRIVER MODEL SURFACE SHELL ACCEL: its file, drawn if it is not there.
picture() {
  local file=$work/$1-$2-$3-$4-$5.exr
  [ -e "$file" ] || program "$1" render "assets/$2.obj" -o "$file" --size "$size" --surface "$3" --shell "$4" \
    --accel "$5" >/dev/null
  echo "$file"
}

# All pictures of a driver beside stock's by the list: "hits patches z", the sums of what differs, and of Z's pixels.
differences() {
  local model surface shell accel
  : >"$work/all.json"
  for model in "${models[@]}"; do
    for surface in phong sphere; do
      for shell in normal height; do
        for accel in list tiles bvh; do
          build/release/trisect compare "$(picture stock "$model" $surface $shell list)" \
            "$(picture "$1" "$model" $surface $shell $accel)" --json "$work/pair.json" >/dev/null || [ $? = 1 ]
          cat "$work/pair.json" >>"$work/all.json"
        done
      done
    done
  done
  jq -rs '[.[] | .pairs[0] // .] | "\(length) | \(map(.hit_mismatches) | add) | \(map(.patch_mismatches) | add) | \(
    (map(.z_pixels) | add) - (map(.z_bit_equal) | add)) of \(map(.z_pixels) | add)"' "$work/all.json"
}

{
  cat <<END
# Devices

Written by \`scripts/devices.sh $size\`, at $(git rev-parse --short HEAD). Vulkan leaves much to a driver: how it rounds, how many invocations a subgroup
has, what it does with denormals. These are the drivers that can be had without a GPU; [gpu/](gpu/README.md) has what
\`check.sh\` of the bundle found on GPUs. \`scripts/test-on.sh stock\`, \`newer\` and \`swiftshader\` run the GPU tests on each.

## Pictures

${models[*]}, both curved surfaces and shells, by the list, tiles and the tree, $size pixels, beside those of the first
driver by the list: pixels that are hit in one of them only, pixels with another triangle, and Z of other bits. \`first picture\`: seconds
of a program with an empty cache of pipelines, tiles and list, most of it the driver's compilation.

| driver | first picture, tiles | list | pictures | hits differ | patches differ | Z of other bits |
| --- | ---: | ---: | ---: | ---: | ---: | ---: |
END
  for driver in "${drivers[@]}"; do
    name=$(program "$driver" devices | sed -n '1s/.*driver \(.*\): usable/\1/p')
    echo "| $name | $(seconds_at_first "$driver" --accel tiles) | $(seconds_at_first "$driver" --accel list) | $(differences "$driver") |"
  done
  cat <<END

## Arithmetic

What \`trisect devices --floats\` measures. The kernels carry NoContraction on every operation that rounds, and declare
what a device has of the rounding, NaN and denormal modes. Divisions and roots are left as the device has them where a
residual or a tolerance forgives them; those that make up a ray are corrected (shaders/division.glsl). Denormals do not
matter: SwiftShader flushes them. Tests repeat pictures and accuracy on devices that a Vulkan layer makes worse than any
of these: quotients and roots off by 2 ulp, sums with a product fused at random, subgroups with fewer lanes than are
reported (tests/cli/other_devices_test.cpp).
END
  for driver in "${drivers[@]}"; do
    printf '\n'
    program "$driver" devices --floats | sed '1s/^[0-9]* */### /'
  done
} >"$work/devices.md"
mv "$work/devices.md" docs/devices.md
