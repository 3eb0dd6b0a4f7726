#!/bin/bash
# Breaks the program in the ways of tests/mutations/mutations.json, one at a time, in copies of the sources under
# build/mutations, and sees whether a test fails; writes docs/mutations.md. Ends with 1 if no test does and the file gives no
# reason why none should. Half an hour to build and two hours to run on two cores.
#   scripts/mutate.sh            # all
#   scripts/mutate.sh NAME...    # these anew; what is known of the others stays as it is
#   scripts/mutate.sh --resume   # those of which nothing is known yet, by docs/mutations.md where build/ does not say
#
# A mutation: `name`; `file`, in which the text `from`, which it has once, becomes `to`; `tests`, those that should notice, as
# PROGRAM:FILTER of googletest with unit_tests or gpu_tests for program, separated by |. Where they do not, all tests of both
# programs run. `reason`: why no test need notice; then no tests run but those named.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh build test docs
list=tests/mutations/mutations.json
# Lines of a name, a tab, and what noticed it, or nothing if nothing did.
results=build/mutations/results
mkdir -p build/mutations
# What this started, and what that did: builds and tests too.
stop() { # PID
  local child
  for child in $(pgrep -P "$1"); do
    stop "$child"
    kill "$child" 2>/dev/null || true
  done
}
trap 'stop $$' EXIT
trap 'exit 130' INT TERM
# The results that are in the document.
known_by_document() { sed -nE 's/^\| ([a-z-]+) \| `[^`]*` \| (none.*|\*\*none\*\*|`(.*)`) \|$/\1\t\3/p' docs/mutations.md 2>/dev/null || true; }

mapfile -t names < <(jq -r '.[].name' $list)
if [ $# = 0 ]; then
  wanted=("${names[@]}")
  rm -f $results
elif [ "$1" = --resume ]; then
  [ -f $results ] || known_by_document >$results
  mapfile -t wanted < <(printf '%s\n' "${names[@]}" | grep -vxFf <(cut -f1 $results) || true)
else
  wanted=("$@")
fi
touch $results
for name in "${wanted[@]}"; do
  grep -qxF "$name" < <(printf '%s\n' "${names[@]}") || { echo "$list has no mutation $name" >&2; exit 2; }
  sed -i "/^$name\t/d" $results
done

# field NAME FIELD: of the mutation, or nothing.
field() { jq -r --arg name "$1" ".[] | select(.name == \$name) | .$2 // empty" $list; }

# The sources as they are here, which may change meanwhile.
sources=build/mutations/sources
rm -rf $sources
mkdir -p $sources
git ls-files -z --cached --others --exclude-standard | xargs -0 cp --parents --preserve=timestamps -t $sources

# A copy of them, with a build.
copy() { # FOLDER
  mkdir -p "$1"
  find $sources -type f -printf '%P\0' | while IFS= read -rd '' file; do
    cmp -s "$sources/$file" "$1/$file" || install -D -m "$(stat -c %a "$sources/$file")" "$sources/$file" "$1/$file"
  done
  cmake -S "$1" --preset release -DBUILD_TESTING=ON >/dev/null
}
build() { # FOLDER PROGRAM...
  cmake --build "$1/build/release" --parallel "$jobs" --target "${@:2}" >"$1/build.log" 2>&1
}

# All tests in one process, but those that measure or limit what a process of their own takes.
all_tests=('unit_tests:*-FailingAllocations.*:ModelFile.ReadsInSixTimesItsSize:Memory.*' 'gpu_tests:*')

# Whether tests of a program pass in so many seconds, several times what they take where nothing is broken. $failed is left as
# the name of the first that fails, or how they ended.
passes() { # FOLDER PROGRAM FILTER SECONDS
  local code=0
  timeout "$4" "$1/build/release/$2" --gtest_fail_fast --gtest_brief=1 --gtest_filter="$3" >"$1/test.log" 2>&1 || code=$?
  [ $code -ne 0 ] || return 0
  failed=$(sed -n 's/^\[  FAILED  \] \([^ ,]*\).*/\1/p' "$1/test.log" | head -n 1)
  if [ $code = 124 ]; then failed="no end"; elif [ -z "$failed" ]; then failed="ended with $code"; fi
  return 1
}

# Adds to the results what a mutation comes to.
mutate() { # FOLDER NAME
  local folder=$1 name=$2 file failed="" tests named test seconds i
  file=$(field "$name" file)
  FROM=$(field "$name" from) TO=$(field "$name" to) perl -0777 -pe '
    my $count = () = /\Q$ENV{FROM}\E/g;
    die "$ARGV has the text $count times, not once\n" unless $count == 1;
    s/\Q$ENV{FROM}\E/$ENV{TO}/' "$sources/$file" >"$folder/$file"
  IFS='|' read -ra tests <<<"$(field "$name" tests)"
  named=${#tests[@]}
  [ -n "$(field "$name" reason)" ] || tests+=("${all_tests[@]}")
  for ((i = 0; i < ${#tests[@]}; ++i)); do
    test=${tests[i]}
    seconds=$([ $i -lt "$named" ] && echo 600 || echo 1800)
    if ! build "$folder" "${test%%:*}"; then
      if ! grep -q 'static assertion' "$folder/build.log"; then
        echo "$name does not compile: $(grep -m 1 'error:' "$folder/build.log")" >&2
        cp "$sources/$file" "$folder/$file"
        return
      fi
      failed="a static assertion"
      break
    fi
    passes "$folder" "${test%%:*}" "${test#*:}" "$seconds" || break
  done
  printf '%s\t%s\n' "$name" "$failed" | tee -a $results
  cp "$sources/$file" "$folder/$file"
}

# Runs the wanted ones, in one copy for each core.
run() {
  workers=$(nproc)
  jobs=1
  for ((k = 0; k < workers; ++k)); do copy build/mutations/$k; done
  jobs=$workers
  for ((k = 0; k < workers; ++k)); do
    build build/mutations/$k unit_tests gpu_tests || { echo "the sources do not compile: build/mutations/$k/build.log" >&2; exit 1; }
  done
  jobs=1
  for ((k = 0; k < workers; ++k)); do
    for ((w = k; w < ${#wanted[@]}; w += workers)); do mutate build/mutations/$k "${wanted[w]}"; done &
  done
  wait
  # What noticed them must pass where nothing is broken.
  local noticing
  noticing=$(cut -f2 $results | grep -E '^[^ ]+\.[^ ]+$' | sort -u | paste -sd: || true)
  jobs=$workers
  build build/mutations/0 unit_tests gpu_tests
  for program in unit_tests gpu_tests; do
    passes build/mutations/0 $program "$noticing" 1800 || { echo "$failed fails in what is not broken" >&2; exit 1; }
  done
  # And what did not end must end.
  local name test
  while read -r name; do
    IFS='|' read -ra tests <<<"$(field "$name" tests)"
    for test in "${tests[@]}"; do
      passes build/mutations/0 "${test%%:*}" "${test#*:}" 600 || { echo "$test fails in what is not broken" >&2; exit 1; }
    done
  done < <(sed -n 's/\tno end$//p' $results)
}
[ ${#wanted[@]} = 0 ] || run

survivors=0
unexplained=0
unknown=0
table=""
for name in "${names[@]}"; do
  noticed=$(sed -n "s/^$name\t//p" $results)
  if ! grep -q "^$name"$'\t' $results; then
    unknown=$((unknown + 1))
    noticed="not run"
  elif [ -n "$noticed" ]; then
    noticed="\`$noticed\`"
  else
    survivors=$((survivors + 1))
    noticed="none: $(field "$name" reason)"
    if [ "$noticed" = "none: " ]; then
      unexplained=$((unexplained + 1))
      noticed="**none**"
      echo "no test notices $name" >&2
    fi
  fi
  table+="| $name | \`$(field "$name" file)\` | $noticed |"$'\n'
done
{
  cat <<END
# What the tests notice

Written by \`scripts/mutate.sh\`, which breaks the program in ${#names[@]} ways, one at a time: margins left out, bounds made
smaller, signs and operators changed, in the solvers, traversals, bake, proofs and loaders
([mutations.json](../tests/mutations/mutations.json) has the texts). For each the test that failed first; the other tests were
not run then. $survivors of them no test notices, $unexplained of those without a reason; of those with one the tests named for them
were run.$([ $unknown = 0 ] || echo " $unknown have not been run yet.")

| what is broken | where | first test that fails |
|---|---|---|
END
  printf '%s' "$table"
} >docs/mutations.md
for name in "${wanted[@]}"; do
  grep -q "^$name"$'\t' $results || exit 1
done
[ $unexplained = 0 ]
