#!/bin/bash
# Runs tests under g++'s sanitizers and under valgrind, on the driver that is installed:
#   scripts/sanitize.sh [address|thread|unset] [ctest's arguments]
# address: memory and undefined behaviour; every test but those named below and the slow ones. thread: those in which several
# threads work. unset: values that nothing has set, by valgrind, in what reads files that others make; five minutes, without
# ctest. Without a word all three. About an hour; what they say goes to standard output, and a report fails its test.
set -euo pipefail
cd "$(dirname "$0")/.."
kinds=(address thread unset)
if [[ " ${kinds[*]} " == *" ${1:-none} "* ]]; then
  kinds=("$1")
  shift
fi
scripts/setup.sh build test memory

# Of libraries of Debian; the drivers among them, and what they leave.
export LSAN_OPTIONS=suppressions=$PWD/tests/sanitizers/leaks.txt:print_suppressions=0
export TSAN_OPTIONS=suppressions=$PWD/tests/sanitizers/races.txt:history_size=4
export UBSAN_OPTIONS=print_stacktrace=1

for kind in "${kinds[@]}"; do
  case $kind in
    address)
      preset=asan
      # Not those that measure memory or time, allow a process little memory, or build with another compiler's flags; nor
      # those in which each write fails, the sanitizer's own among them; nor GPU-assisted checks, which take the sanitizer
      # ten times as long as everything else.
      choice=(--exclude-regex '^(Consumer|Package|Docs|Farm|GpuAssisted|FailingFiles|Memory)|TakesMemory|LeavesNothingHowever')
      ;;
    thread)
      preset=tsan
      # LLVM's compiler in the driver has races of its own: what has no driver.
      choice=(--tests-regex '^(Threads|ParallelRows|OracleFrame|SubpatchBounds|PatchBounds|LoadedModelTest|KernelCompiler|ErrorOverlayTest|TemporaryNames|FlatMesh|BuildMesh)\.')
      ;;
    unset)
      cmake --preset release -DBUILD_TESTING=ON >/dev/null
      cmake --build --preset release --target unit_tests
      # Not what measures memory. The tests have an operator new of their own, which fails when it is told to, and whose
      # memory the libraries free.
      valgrind --quiet --error-exitcode=1 --leak-check=no --track-origins=yes --show-mismatched-frees=no \
        build/release/unit_tests --gtest_filter="$(printf '%s.*:' FuzzRegressions GltfFile ObjFile ModelFile BuildMesh \
          Triangulate ImageChannels ReadAttributes ExrPixels OpenExr WriteExr WritePng RayFile HitFile \
          CameraPath Document ReadFile)-ModelFile.ReadsInSixTimesItsSize"
      continue
      ;;
  esac
  cmake --preset $preset >/dev/null
  cmake --build --preset $preset
  ctest --preset $preset --label-exclude slow "${choice[@]}" "$@"
done
