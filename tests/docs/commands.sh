#!/bin/bash
# Runs the commands of README and of the pages in docs as they are printed, one after the other, in a folder that looks like the
# source tree. A command must exit with 0; `compare` may find its pictures different (1).
#   commands.sh SOURCES BUILD
set -euo pipefail
sources=$1
build=$2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
mkdir -p build out
ln -s "$build" build/release
ln -s "$sources"/{assets,docs,shaders,scripts,README.md} .

# Commands that are not run here begin with one of these, for the reason beside it.
not_run() {
  case $1 in
    './demo.sh'* | './test.sh'*) echo "installs, builds and tests" ;;
    'scripts/'*) echo "measures or packs for minutes" ;;
    'apt-get '* | 'cmake '* | 'cpack '*) echo "installs; tests/consumer does that in a folder" ;;
    'tar '* | 'trisect/'*) echo "on another machine" ;;
    'sbatch '*) echo "tests/farm/slurm.sh does it" ;;
    'build/release/trisect view '*) echo "needs a display; view_tests do it" ;;
    'build/release/trisect hardcases') echo "minutes; HardCases.TheRobustSolverPassesThem does it" ;;
    'build/release/trisect bench '*) echo "minutes; Reports and BenchSpeed do it with less" ;;
    *) return 1 ;;
  esac
}

run=0
for page in README.md docs/*.md; do
  in_commands=false
  while IFS= read -r line; do
    case $line in
      '```sh') in_commands=true && continue ;;
      '```'*) in_commands=false && continue ;;
    esac
    command=${line%%    #*}
    if ! $in_commands || [ -z "$command" ] || not_run "$command" >/dev/null; then continue; fi
    code=0
    PATH="$PATH" bash -c "$command" >said 2>&1 </dev/null || code=$?
    case $code:$command in
      0:* | 1:*' compare '*) run=$((run + 1)) ;;
      *)
        echo "commands.sh: in $page: exit code $code of: $command" >&2
        cat said >&2
        exit 1
        ;;
    esac
  done <"$page"
done
echo "$run commands of README and docs run as printed"
[ "$run" -ge 25 ]
