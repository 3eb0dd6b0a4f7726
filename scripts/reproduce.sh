#!/bin/bash
# Whether the same command gives the same picture: twice, on one, two and four threads, compiled by g++ and by clang++, and
# on two drivers; writes docs/reproducible.md. Ends with 1 if pictures differ that must not. Ten minutes.
set -euo pipefail
cd "$(dirname "$0")/.."
. scripts/measure.sh
ready build lint docs
cmake -S . -B build/reproduce -G Ninja -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF \
  -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=6 >/dev/null
cmake --build build/reproduce --target trisect
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
models=(cube sphere-20 torus relief teapot)
gcc=build/release/trisect
clang=build/reproduce/trisect
vulkan=("--accel tiles" "--accel list" "--accel bvh" "--accel bvh --shadows" "--surface sphere" "--preset thesis")
opengl=("--backend opengl")
host=("--backend cpu" "--backend cpu --surface sphere" "--backend cpu --preset thesis" "--backend oracle")

# render PROGRAM FILE MODEL OPTIONS [DRIVER]
render() {
  # shellcheck disable=SC2086  # the options are words
  on "${5:-stock}" "$1" render "assets/$3.obj" --size 128x96 $4 -o "$2" >/dev/null
}

# Whether the files hold the same bits: same FIRST SECOND. Texts of EXR headers may differ, which name the device.
same() { "$gcc" compare "$1" "$2" --exact >/dev/null; }

failed=0
begin() { pictures=0 apart=0; }
count() { # WHAT TEST WORD...
  pictures=$((pictures + 1))
  "${@:2}" || { apart=$((apart + 1)); echo "$1" >&2; }
}
row() { # WORDS [MUST]
  echo "| $1 | $pictures | $apart |"
  if [ "${2:-must}" = must ] && [ $apart -gt 0 ]; then failed=1; fi
}

twice() {
  begin
  for model in "${models[@]}"; do
    for options in "${vulkan[@]}" "${opengl[@]}" "${host[@]}"; do
      for format in exr png; do
        for n in 1 2; do render "$gcc" "$work/$n.$format" "$model" "$options"; done
        count "$model $options: not the same twice" cmp -s "$work/1.$format" "$work/2.$format"
      done
    done
  done
  row "twice, files of the same bytes, EXR and PNG"
}

threads() {
  begin
  for model in "${models[@]}"; do
    for options in "${vulkan[@]}" "${host[@]}"; do
      for n in 1 2 4; do
        LP_NUM_THREADS=$n TRISECT_THREADS=$n render "$gcc" "$work/$n.exr" "$model" "$options"
      done
      for n in 2 4; do count "$model $options: $n threads" same "$work/1.exr" "$work/$n.exr"; done
    done
  done
  row "one thread and two, one and four"
}

compilers() {
  begin
  for model in "${models[@]}"; do
    for options in "${host[@]}"; do
      render "$gcc" "$work/1.exr" "$model" "$options"
      render "$clang" "$work/2.exr" "$model" "$options"
      count "$model $options: another compiler" same "$work/1.exr" "$work/2.exr"
    done
  done
  row "compiled by g++ and by clang++, on the CPU"
}

# They may round differently.
drivers() {
  begin
  for model in "${models[@]}"; do
    for options in "${vulkan[@]}"; do
      render "$gcc" "$work/1.exr" "$model" "$options" stock
      render "$gcc" "$work/2.exr" "$model" "$options" newer
      count "$model $options: another driver" same "$work/1.exr" "$work/2.exr"
    done
  done
  row "${name[stock]} and ${name[newer]}" may
}

name_drivers
{
  cat <<END
# The same picture again

Written by \`scripts/reproduce.sh\`: $(echo "${models[@]}" | sed 's/ /, /g'); with Vulkan by tiles, list, tree, with shadows, the sphere surface and
the thesis's preset, with OpenGL, and on the CPU in single precision and by the oracle; 128x96. Apart are pictures that are not
the same in every bit of every channel (\`compare --exact\`).
Device: $(figure .device), on $(nproc) cores, driver ${name[stock]}; g++ $(g++ -dumpfullversion), clang++ $(clang++ -dumpversion).

| | pictures | apart |
|---|---|---|
END
  twice
  threads
  compilers
  drivers
} >"$work/reproducible.md"
mv "$work/reproducible.md" docs/reproducible.md
exit $failed
