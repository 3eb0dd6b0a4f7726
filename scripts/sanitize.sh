#!/bin/bash
# Runs tests under g++'s sanitizers, on the driver that is installed:
#   scripts/sanitize.sh [address|thread] [ctest's arguments]
# address: memory and undefined behaviour; every test but those named below and the slow ones. thread: those in which several
# threads work. Without a word both. About an hour; what they say goes to standard output, and a report fails its test.
set -euo pipefail
cd "$(dirname "$0")/.."
kinds=(address thread)
if [ "${1:-}" = address ] || [ "${1:-}" = thread ]; then
  kinds=("$1")
  shift
fi
scripts/setup.sh build test

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
  esac
  cmake --preset $preset >/dev/null
  cmake --build --preset $preset
  ctest --preset $preset --label-exclude slow "${choice[@]}" "$@"
done
