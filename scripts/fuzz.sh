#!/bin/bash
# Builds the fuzzers of tests/fuzz and runs them one after the other, each for so many seconds (default 60):
#   scripts/fuzz.sh [SECONDS_EACH [FUZZER ...]]
# FUZZER: model, path, picture, text, solver; without any all of them. Begins with what earlier runs have kept in
# build/fuzz/corpus. At a finding ends with 1 and names the input. docs/reliability.md says what the fuzzers do.
set -euo pipefail
cd "$(dirname "$0")/.."
seconds=${1:-60}
[[ "$seconds" =~ ^[0-9]+$ ]] || { echo "usage: scripts/fuzz.sh [SECONDS_EACH [FUZZER ...]]" >&2; exit 2; }
fuzzers=("${@:2}")
[ ${#fuzzers[@]} -gt 0 ] || fuzzers=(model path picture text solver)
scripts/setup.sh build test fuzz
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz --target fuzzers

# Inputs are files; in memory they are faster.
TMPDIR=$(mktemp -d /dev/shm/trisect-fuzz-XXXXXX)
export TMPDIR LSAN_OPTIONS=suppressions=tests/sanitizers/leaks.txt:print_suppressions=0
trap 'rm -rf "$TMPDIR"' EXIT
corpus=build/fuzz/corpus
mkdir -p build/fuzz/findings
folders=(assets)
[ ! -d /usr/share/assimp/models ] || folders+=(/usr/share/assimp/models)  # of the package assimp-testmodels
build/fuzz/make-seeds $corpus "${folders[@]}"

declare -A longest=([model]=16384 [path]=4096 [picture]=8192 [text]=2048 [solver]=1024)
# OpenEXR asks for up to 2 GiB for an attribute before it finds that the file has ended, and does not touch them.
declare -A most_at_once=([picture]=2304)
table=""
found=()
for fuzzer in "${fuzzers[@]}"; do
  echo "== $fuzzer: $seconds s"
  log=build/fuzz/$fuzzer.log
  words=()
  [ ! -f tests/fuzz/$fuzzer.dict ] || words=(-dict=tests/fuzz/$fuzzer.dict)
  # On one core the program starts one thread in place of many. Its own output is not wanted.
  end=0
  taskset -c $(($(nproc) - 1)) build/fuzz/fuzz_$fuzzer -max_total_time="$seconds" -max_len="${longest[$fuzzer]}" \
    -timeout=20 -rss_limit_mb=3072 -malloc_limit_mb="${most_at_once[$fuzzer]:-1024}" -close_fd_mask=1 -print_final_stats=1 "${words[@]}" \
    -artifact_prefix=build/fuzz/findings/$fuzzer- $corpus/$fuzzer tests/fuzz/regressions/$fuzzer 2> $log || end=$?
  executions=$(sed -n 's/^stat::number_of_executed_units: *//p' $log)
  # A crash leaves the figure in the last line of the progress.
  [ -n "$executions" ] || executions=$(sed -n 's/^#\([0-9]*\)\t.*/\1/p' $log | tail -n 1)
  input=$(sed -n 's/.*Test unit written to //p' $log | tail -n 1)
  [ $end = 0 ] || found+=("${input:-$log}")
  table+="$fuzzer $executions ${input:-none}"$'\n'
done

printf '%-10s %12s  %s\n' fuzzer executions finding
while read -r fuzzer executions input; do
  printf '%-10s %12s  %s\n' "$fuzzer" "$executions" "$input"
done < <(printf '%s' "$table")
[ ${#found[@]} = 0 ] || { printf 'Finding: %s\n' "${found[@]}" >&2; exit 1; }
