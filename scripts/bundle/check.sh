#!/bin/bash
# Checks trisect on this machine's Vulkan device: its floats, the tests, the hard cases, accuracy, speed, sizes.
#   check.sh [--quick] [--minutes N] [FOLDER]
# Writes FOLDER (./check-DEVICE without one) and nothing else: report.md, figures.json (every figure), log.txt (every
# command with all that it printed), pictures, and check.tar.gz, all of it in one file. Takes N minutes at most, 8.5
# without one: what there is no time for is left out, and the report says so. --quick: small images and models, for
# devices that are slow, such as a CPU. Ends with 1 if something failed, with 4 if there is no usable device.
# Needs bash and coreutils. The steps are in the order of their worth.
set -u
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
usage() {
  echo "usage: check.sh [--quick] [--minutes N] [FOLDER]" >&2
  exit 2
}
quick=""
seconds=510
out=""
while [ $# -gt 0 ]; do
  case $1 in
    --quick) quick=yes ;;
    --minutes)
      [[ ${2:-} =~ ^[1-9][0-9]*$ ]] || usage
      seconds=$((60 * $2))
      shift ;;
    -*) usage ;;
    *)
      [ -z "$out" ] || usage
      out=$1 ;;
  esac
  shift
done
named=$out
[ -n "$named" ] || out=check-$$
mkdir -p "$out" || exit 2
out=$(cd "$out" && pwd)

assets=$here/share/trisect/assets
work=$out/work
rm -rf "$work"
mkdir -p "$work/tmp" "$work/json" "$work/report" || exit 2
trap 'rm -rf "$work"' EXIT
# Caches of the program and of drivers, and the tests' files.
export HOME=$work XDG_CACHE_HOME=$work/cache TMPDIR=$work/tmp TRISECT_TEST_VALIDATION=0
trisect() { "$here/run.sh" trisect "$@"; }

# ---- Steps ----

start=$SECONDS
failures=0
log=$out/log.txt
: >"$log"
: >"$work/steps"

# note NAME OUTCOME SECONDS REMARK: a line of the report's table of steps.
note() {
  echo "| $1 | $2 | $3 | $4 |" >>"$work/steps"
  printf '%4d s  %s: %s%s\n' $((SECONDS - start)) "$1" "$2" "${4:+, $4}"
  case $2 in FAILED*) failures=$((failures + 1)) ;; esac
  write_report
}

# without_here FILE: a file's text without the bundle's own folder in paths.
without_here() {
  local line
  while IFS= read -r line; do printf '%s\n' "${line//"$here/"/}"; done <"$1"
}

# run LIMIT COMMAND...: runs a command for LIMIT seconds at most, and for as long as the check has. Its output goes to
# the log and to $work/text; $code is its exit code, 124 if it was stopped, 125 if there was no time to start it.
run() {
  local limit=$1 left=$((seconds - (SECONDS - start))) begun=$SECONDS
  shift
  [ "$limit" -le "$left" ] || limit=$left
  : >"$work/text"
  code=125
  [ "$limit" -ge 3 ] || return 0
  printf '\n$ %s\n' "${*//"$here/"/}" >>"$log"
  { timeout -k 5 "$limit" "$@" >"$work/text"; } 2>"$work/errors"
  code=$?
  # Not stopped by the signal that it may catch, but by the one that it cannot.
  [ $code != 137 ] || [ $((SECONDS - begun)) -lt "$limit" ] || code=124
  local text
  for text in "$work/text" "$work/errors"; do without_here "$text" >"$work/line" && mv "$work/line" "$text"; done
  cat "$work/text" "$work/errors" >>"$log"
  echo "exit code $code" >>"$log"
}

# The last line that a command wrote to standard error, for a remark.
last_error() {
  local line last=""
  while IFS= read -r line; do [ -z "$line" ] || last=$line; done <"$work/errors"
  echo "${last//|/,}"
}

# outcome: what an exit code means.
outcome() {
  case $1 in
    0) echo passed ;;
    124) echo "cut short" ;;
    125) echo skipped ;;
    *) echo "FAILED, code $1" ;;
  esac
}
remark() {
  case $1 in
    0) ;;
    124) echo "its time was over" ;;
    125) echo "no time was left" ;;
    1[23]?) echo "ended by signal $(($1 - 128))" ;;
    *) last_error ;;
  esac
}

# step NAME LIMIT COMMAND...: one command that passes with 0.
step() {
  local name=$1 begun=$SECONDS
  shift
  run "$@"
  note "$name" "$(outcome $code)" $((SECONDS - begun)) "$(remark $code)"
}

# ---- What commands print ----

# cells LINE: the cells of a row of a Markdown table, into the array `cells`.
cells() {
  local i
  IFS='|' read -ra cells <<<"$1"
  for i in "${!cells[@]}"; do read -r "cells[$i]" <<<"${cells[i]}"; done
}

# cell HEADER NAME: what the row in `cells` has under that name, into `cell`.
cell() {
  local names i name
  IFS='|' read -ra names <<<"$1"
  for i in "${!names[@]}"; do
    read -r name <<<"${names[i]}"
    if [ "$name" = "$2" ]; then
      cell=${cells[i]}
      return
    fi
  done
  echo "check.sh: no column of this table is called $2: $1" >&2
  exit 70
}

# The tables among what the last command printed.
table() {
  local line
  while IFS= read -r line; do [[ $line != '|'* ]] || echo "$line"; done <"$work/text"
}

# Of a JSON file of one object, figure NAME FILE: a number; text NAME FILE: a text; median NAME FILE: of several runs.
figure() { [[ $(<"$2") =~ \"$1\":\ *([0-9.e+-]+) ]] && echo "${BASH_REMATCH[1]}"; }
text() { [[ $(<"$2") =~ \"$1\":\ *\"([^\"]*)\" ]] && echo "${BASH_REMATCH[1]}"; }
median() { [[ $(<"$2") =~ \"$1\":\ *\{[^}]*\"median\":\ *([0-9.e+-]+) ]] && echo "${BASH_REMATCH[1]}"; }

# rounded MS: one decimal below a hundred, none from there on.
rounded() {
  local text
  printf -v text '%.1f' "$1"
  [ ${#text} -le 4 ] || printf -v text '%.0f' "$1"
  echo "$text"
}

# ---- The report ----

device="" driver="" vulkan="" opengl="not tried"
declare -A speed      # milliseconds by "model, contender"
declare -A patches    # by model
declare -A wrong      # robust pixels by surface: wrong hits, missed, wrong patches; and frames compared
hardcases_line="not run"

section() { printf '\n## %s\n\n' "$1"; }

# part NAME: appends standard input to a part of the report, written after the tables of steps and key figures.
part() { cat >>"$work/report/$1"; }

key_figures() {
  local model thesis contender row
  echo "Milliseconds of the device, $size, phong. The thesis's are those of its table 3.1: a GPU of 2020, 800x600."
  printf '\n| thesis | here | patches | thesis, its GPU | thesis'\''s way here | list, robust | tiles, robust | tree, robust | ray queries, robust |\n'
  echo '|---|---|---|---|---|---|---|---|---|'
  while read -r thesis model row; do
    row="| $thesis | $model | ${patches[$model]:-} | $row |"
    for contender in "thesis (list, bisect, Rank 10)" "list, robust" "tiles, robust" "bvh, robust" "rayquery, robust"; do
      row+=" ${speed[$model, $contender]:-} |"
    done
    echo "$row"
  done <<<$'SphereHigh sphere-20 15\nFresko relief 25\nTeapot teapot 51'
  echo
  echo '| robust against the oracle | frames | wrong hits | missed | wrong patches | pixels of other bits on the CPU |'
  echo '|---|---|---|---|---|---|'
  for surface in phong sphere; do
    [ "${wrong[$surface, frames]:-0}" != 0 ] || continue
    echo "| $surface, both shells | ${wrong[$surface, frames]} | ${wrong[$surface, hits]:-} | ${wrong[$surface, missed]:-} | ${wrong[$surface, patches]:-} | ${wrong[$surface, cpu]:-} |"
  done
  printf '\nHard cases: %s.\n' "$hardcases_line"
}

write_report() {
  local name
  {
    echo "# trisect on ${device:-this machine}"
    echo
    echo "- device: ${device:-none}, $vulkan"
    echo "- driver: $driver"
    echo "- OpenGL: $opengl"
    echo "- machine: $(uname -srm), $(nproc) CPUs"
    echo "- $version, commit $(<"$here/commit"), as a bundle; $(date -u '+%Y-%m-%d %H:%M') UTC"
    echo "- check.sh${quick:+ --quick}: $((SECONDS - start)) s of $seconds s, $failures steps failed"
    section "Steps"
    echo '| step | outcome | seconds | |'
    echo '|---|---|---|---|'
    cat "$work/steps"
    section "Key figures"
    key_figures
    for name in devices floats speed hardcases tests accuracy crosscheck sizes pareto pictures; do
      [ ! -s "$work/report/$name" ] || cat "$work/report/$name"
    done
  } >"$work/report.md"
  mv "$work/report.md" "$out/report.md"
  {
    printf '{'
    local separator="" file
    for file in "$work"/json/*.json; do
      [ -s "$file" ] || continue
      name=${file##*/}
      printf '%s"%s": ' "$separator" "${name%.json}"
      cat "$file"
      separator=","
    done
    echo '}'
  } >"$out/figures.json"
}

# ---- The check ----

size=800x600 runs=5 error=1e-6 longest=150
models=(sphere-20 sphere-80 sphere-320 torus relief teapot teapot-1000 capsule cube saddle)
crossed=(sphere-20 torus relief teapot cube saddle)
sizes=(20 80 320 1280 5120 20480 81920 327680 1310720 5242880)
pareto=(sphere-320 teapot)
if [ -n "$quick" ]; then
  size=160x120 runs=3 error=1e-4 longest=100
  models=(sphere-20 torus teapot cube)
  crossed=(sphere-20 teapot)
  sizes=(20 320 5120 81920)
  pareto=(sphere-20)
fi

version=$(trisect --version 2>&1)
run 60 "$here/run.sh" trisect devices
begun=$SECONDS
if [ $code != 0 ]; then
  note devices "$(outcome $code)" 0 "$(remark $code)"
  echo "check.sh: $(remark $code)" >&2
  exit 4
fi
{ section Devices; echo '```'; cat "$work/text"; echo '```'; } | part devices
run 120 "$here/run.sh" trisect render "$assets/cube.obj" --size 64x48 -o "$work/cube.png" --stats "$work/cube.json"
if [ $code != 0 ]; then
  note devices "$(outcome $code)" 0 "$(remark $code)"
  echo "check.sh: $(remark $code)" >&2
  exit 4
fi
device=$(text device "$work/cube.json")
driver=$(text driver "$work/cube.json")
# Of devices of that name the first is taken.
number=""
while IFS= read -r line; do
  [[ $line == [0-9]*"  $device ("* && -z $number ]] || continue
  number=${line%%  *}
  [[ ! $line =~ Vulkan\ [0-9.]+ ]] || vulkan=${BASH_REMATCH[0]}
done <<<"$(trisect devices)"
if [ -z "$named" ]; then
  # Letters and digits of the device's name, with a dash for the rest.
  name=${device,,}
  name=${name//[^a-z0-9]/-}
  while [[ $name == *--* ]]; do name=${name//--/-}; done
  target=${out%/*}/check-${name%-}
  if [ -e "$target" ]; then
    echo "check.sh: $target is there already" >&2
    rm -rf "$out"
    exit 2
  fi
  mv "$out" "$target"
  out=$target work=$target/work log=$target/log.txt
  export HOME=$work XDG_CACHE_HOME=$work/cache TMPDIR=$work/tmp
fi
echo "$device, $driver; into $out"
note devices passed $((SECONDS - begun)) ""

step "devices --floats" 60 "$here/run.sh" trisect devices --floats --device "$number" --json "$work/json/devices.json"
{ section "Floats"; cat "$work/text"; } | part floats

# paths MODEL...: the files of assets, into the array `paths`.
paths() {
  paths=("${@/#/$assets/}")
  paths=("${paths[@]/%/.obj}")
}

# Milliseconds of every way to draw the thesis's three scenes.
paths sphere-20 relief teapot
step "bench speed" 150 "$here/run.sh" trisect bench speed "${paths[@]}" --surface phong --size $size --runs $runs \
  --error $error --json "$work/json/speed.json"
header=""
while IFS= read -r line; do
  [ -n "$header" ] || { header=$line; continue; }
  [[ $line != '|---'* && -n $line ]] || continue
  cells "$line"
  cell "$header" model && model=$cell
  cell "$header" contender && contender=$cell
  cell "$header" ms && speed[$model, $contender]=$cell
done <<<"$(table)"
{ section "Speed, $size"; table; } | part speed

# Pictures, and what a model has of patches.
picture() { # NAME MODEL OPTION...
  local name=$1 model=$2
  shift 2
  run 60 "$here/run.sh" trisect render "$assets/$model.obj" --size $size -o "$out/$name.png" --stats "$work/picture.json" "$@"
  if [ $code = 0 ]; then
    patches[$model]=$(figure patches "$work/picture.json")
    printf '![%s](%s.png)\n\n' "$model${*:+ $*}" "$name" | part pictures
  elif [ $drawn = 0 ]; then
    drawn=$code
  fi
}
begun=$SECONDS drawn=0
section Pictures | part pictures
picture teapot teapot --shadows
picture relief relief
picture sphere-20-thesis sphere-20 --preset thesis
note pictures "$(outcome $drawn)" $((SECONDS - begun)) "$(remark $drawn)"

step "hard cases" $longest "$here/run.sh" trisect hardcases --json "$work/json/hardcases.json"
rows=0 passed=0 all=""
{
  section "Hard cases"
  echo 'Rows of the robust solver in the normal shell that do not pass:'
  printf '\n```\n'
  while IFS= read -r line; do
    [[ $line != *"rows of the robust solver"* ]] || all=${line%.}
    read -ra words <<<"$line"
    [ "${words[2]:-} ${words[3]:-}" = "normal robust" ] || continue
    rows=$((rows + 1))
    case " $line " in
      *' pass '*) passed=$((passed + 1)) ;;
      *) echo "$line" ;;
    esac
  done <"$work/text"
  [ $rows -gt $passed ] || echo none
  echo '```'
} >"$work/report/hardcases"
hardcases_line=${all:-$passed of $rows rows of the robust solver in the normal shell pass, of the rows that there was time for}
[ $rows -gt 0 ] || hardcases_line="no row was done in time"

# OpenGL through EGL, where there is one: one small frame tells.
run 60 "$here/run.sh" trisect render "$assets/cube.obj" --size 64x48 --backend opengl -o "$work/cube.png" --stats "$work/cube.json"
if [ $code = 0 ]; then
  opengl="$(text device "$work/cube.json"), $(text driver "$work/cube.json")"
else
  opengl="none: $(last_error)"
fi

# tests NAME LIMIT PROGRAM FILTER: GoogleTest's, without the tests that are left out, of which the report says why.
tests() {
  local name=$1 begun=$SECONDS line passed=0 failed=() said=() result text
  rm -f "$work/failed"
  run "$2" "$here/run.sh" "$3" --gtest_filter="$4"
  while IFS= read -r line; do
    case $line in
      '[       OK ]'*) passed=$((passed + 1)) ;;
      '[  FAILED  ] '*' ms)')
        line=${line#'[  FAILED  ] '}
        failed+=("${line%%[, ]*}")
        [ ${#failed[@]} -gt 3 ] || printf '%s\n' "${failed[-1]}" "${said[@]:0:20}" >>"$work/failed" ;;
      '[ RUN      ]'*) said=() ;;
      # Of a source's path, what is in the project.
      */tests/*:\ Failure) said+=("  tests/${line#*/tests/}") ;;
      *) said+=("  $line") ;;
    esac
  done <"$work/text"
  result=$(outcome $code)
  [ ${#failed[@]} = 0 ] || result="FAILED, ${#failed[@]} tests"
  text=""
  [ $code != 124 ] && [ $code != 125 ] || text=$(remark $code)
  note "$name" "$result" $((SECONDS - begun)) "$passed passed${failed[*]:+, failed: ${failed[*]}}${text:+, $text}"
}
filter="*"
[ -z "$quick" ] || filter='Trace.*:Acceleration.*:Queue.*:GpuLayer.*:Assets/GoldenFrame.*'
of_opengl='*Crosscheck*:OpenglContender.*'
without=('GpuLayer.*Validation*' 'GpuAssisted.*' 'HardCases.*' "$of_opengl")
reasons=("those of the validation layer, which is not asked for" "the hard cases, which are a step of their own")
if [[ $opengl == none:* ]]; then
  reasons+=("those of OpenGL, of which there is none")
else
  # A driver may take minutes to compile its shaders.
  reasons+=("those of OpenGL, which come last")
fi
tests "GPU tests" $longest gpu_tests "$filter-$(IFS=:; echo "${without[*]}")"
{
  section Tests
  echo 'Left out:'
  echo
  printf -- '- %s\n' "${reasons[@]}"
  [ -z "$quick" ] || echo '- with --quick all but traces, accelerations, queues, golden frames and the Vulkan layer'
  [ ! -s "$work/failed" ] || { printf '\nWhat the first of those that failed said:\n\n```\n'; cat "$work/failed"; echo '```'; }
} | part tests

# accurate SURFACE LIMIT: every model, both shells, both solvers; adds up what robust has wrong.
accurate() {
  local surface=$1 limit=$2 begun=$SECONDS model worst=0 header="" line left text pair key
  for key in frames hits missed patches cpu; do wrong[$surface, $key]=0; done
  section "Accuracy, $surface, $size" | part accuracy
  for model in "${models[@]}"; do
    left=$((limit - (SECONDS - begun)))
    run $left "$here/run.sh" trisect accuracy "$assets/$model.obj" --size $size --surface "$surface" \
      --json "$work/json/accuracy-$model-$surface.json"
    [ $worst != 0 ] || worst=$code
    [ $code != 125 ] || break
    while IFS= read -r line; do
      if [[ $line == '| model'* ]]; then
        [ -n "$header" ] || echo "$line" | part accuracy
        header=$line
      elif [[ $line == '|---'* ]]; then
        [ "${wrong[$surface, frames]}" != 0 ] || echo "$line" | part accuracy
      elif [ -n "$line" ]; then
        echo "$line" | part accuracy
        cells "$line"
        cell "$header" solver
        [ "$cell" = robust ] || continue
        wrong[$surface, frames]=$((${wrong[$surface, frames]} + 1))
        for pair in hits:'wrong hit' missed:missed patches:'wrong patch' cpu:'cpu differs'; do
          cell "$header" "${pair#*:}"
          wrong[$surface, ${pair%%:*}]=$((${wrong[$surface, ${pair%%:*}]} + cell))
        done
      fi
    done <<<"$(table)"
  done
  text=$(remark $worst)
  note "accuracy, $surface" "$(outcome $worst)" $((SECONDS - begun)) \
    "${wrong[$surface, frames]} of $((2 * ${#models[@]})) robust frames${text:+, $text}"
}
accurate phong 150

# Vulkan against OpenGL, and a picture of both.
if [[ $opengl == none:* ]]; then
  note crosscheck skipped 0 "no OpenGL: ${opengl#none: }"
else
  begun=$SECONDS worst=0
  section "Vulkan against OpenGL, $size" | part crosscheck
  for model in "${crossed[@]}"; do
    run 20 "$here/run.sh" trisect crosscheck "$assets/$model.obj" --size $size --json "$work/json/crosscheck-$model.json" \
      --diff "$out/crosscheck.png"
    [ $worst != 0 ] || worst=$code
    { printf '%s:\n\n```\n' "$model"; cat "$work/text"; printf '```\n\n'; } | part crosscheck
  done
  note crosscheck "$(outcome $worst)" $((SECONDS - begun)) "${#crossed[@]} models"
fi

# Spheres of more and more patches.
begun=$SECONDS worst=0
{
  section "Sizes, 800x600, phong"
  echo '| patches | accel | read, ms | bake, ms | tree, ms | upload, ms | MB on the device | ms a frame |'
  echo '|---|---|---|---|---|---|---|---|'
} | part sizes
for count in "${sizes[@]}"; do
  run 60 "$here/run.sh" make-assets "$work/tmp" "sphere-$count"
  run 60 "$here/run.sh" trisect render "$work/tmp/sphere-$count.obj" --runs 3 -o "$work/sphere.png" \
    --stats "$work/json/sphere-$count.json"
  rm -f "$work/tmp/sphere-$count.obj"
  [ $worst != 0 ] || worst=$code
  [ $code = 0 ] || break
  file=$work/json/sphere-$count.json
  row="| $count | $(text accel "$file") |"
  for name in load_ms bake_ms bvh_ms upload_ms; do
    value=$(figure $name "$file")
    row+=" $(rounded "${value:-0}") |"
  done
  echo "$row $(($(figure scene_bytes "$file") / 1000000)) | $(rounded "$(median gpu_ms "$file")") |" | part sizes
done
note sizes "$(outcome $worst)" $((SECONDS - begun)) "$([ $worst = 0 ] || echo "at $count patches: $(remark $worst)")"

# Time against error.
paths "${pareto[@]}"
options=(--quick --no-plots --surface phong -o "$work/pareto")
[[ $opengl != none:* ]] || options+=(--no-opengl)
step "bench pareto --quick" 120 "$here/run.sh" trisect bench pareto "${paths[@]}" "${options[@]}"
if [ -s "$work/pareto/report.json" ]; then
  mv "$work/pareto/report.json" "$work/json/pareto.json"
  {
    section "Speed against error, 160x120"
    while IFS= read -r line; do
      case $line in
        '# '* | '!['* | 'The truth in'* | '') ;;
        '|---'* | '| '[^c]* | '- '*) echo "$line" ;;
        '## '*) printf '\n#%s\n\n' "$line" ;;
        *) printf '\n%s\n' "$line" ;;
      esac
    done <"$work/pareto/report.md"
  } | part pareto
fi

[ -n "$quick" ] || tests "tests of the program" 60 program_tests 'Program.*'
accurate sphere 300
[ -n "$quick" ] || [[ $opengl == none:* ]] || tests "tests of OpenGL" $longest gpu_tests "$of_opengl"

write_report
if command -v tar >/dev/null && command -v gzip >/dev/null; then
  tar -C "$out" -czf "$work/check.tar.gz" --exclude=./work --exclude=./check.tar.gz . && mv "$work/check.tar.gz" "$out"
else
  echo "There is no tar or gzip here: nothing is packed."
fi
echo "$out/report.md: $((SECONDS - start)) s, $failures steps failed"
[ $failures = 0 ]
