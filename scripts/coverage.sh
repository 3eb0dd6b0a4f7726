#!/bin/bash
# Which lines of app/ and vk/ the tests run: all but the slow ones, on the driver that is installed. Writes docs/coverage.md.
# Ends with 1 if a test fails or less than 85% of the lines run. Half an hour.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh build test docs
cmake --preset coverage >/dev/null
cmake --build --preset coverage
find build/coverage -name '*.gcda' -delete
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# What gcov says would be in the program's standard error.
export GCOV_ERROR_FILE=$work/gcov.txt
# Not those that build or pack the program anew; nor those that kill it after a time, for it is slow here; nor those in which
# each write fails, or one beyond a file's limit: gcov's own are among them.
ctest --preset coverage --label-exclude slow \
  --exclude-regex '^(Consumer|Package|Farm|FailingFiles)|LeavesNothingHowever'
if [ -s "$GCOV_ERROR_FILE" ]; then
  cat "$GCOV_ERROR_FILE" >&2
  exit 1
fi

gcovr --root . --filter 'app/' --filter 'vk/' --json-summary "$work/lines.json" build/coverage >/dev/null
# rows WHAT: a row for each folder, file or `all` of what jq's filter WHAT leaves of the files.
rows() {
  jq -r "[$1]"' | group_by(.name)[] | (map(.line_total) | add) as $lines | (map(.line_covered) | add) as $run
    | "| \(.[0].name) | \($lines) | \(1000 * $run / $lines | round / 10)% |"' "$work/lines.json"
}
{
  cat <<END
# Lines that the tests run

Written by \`scripts/coverage.sh\`: all tests but the slow ones, under g++ $(g++ -dumpfullversion) and gcov. The shaders'
surfaces and solvers, which the tests run as C++ too, are not counted.

| folder | lines | run |
|---|---|---|
END
  rows '.files[] | .name = (.filename | split("/") | if .[0] == "vk" then "vk" else .[0:2] | join("/") end)'
  rows '.files[] | .name = "all"'
  cat <<END

Files of which less than 85% runs:

| file | lines | run |
|---|---|---|
END
  rows '.files[] | select(.line_total > 0 and .line_percent < 85) | .name = .filename'
} >"$work/coverage.md"
mv "$work/coverage.md" docs/coverage.md
jq -e '.line_percent >= 85' "$work/lines.json" >/dev/null || { echo "less than 85% of the lines run" >&2; exit 1; }
