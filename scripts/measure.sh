# For scripts that measure; sourced. Those that use measure() set `work`, a folder of their own.

# ready GROUP...: installs these groups of packages and builds the program.
ready() {
  scripts/setup.sh "$@"
  cmake --preset release >/dev/null
  cmake --build --preset release --target trisect
}

# on DRIVER COMMAND...: runs a command with a Vulkan driver: `stock`, the one that is installed; `newer`, which
# unpack-mesa.sh unpacks; `swiftshader`, which unpack-swiftshader.sh unpacks.
on() {
  local variables=() text=""
  case $1 in
    stock) ;;
    newer) text=$(scripts/unpack-mesa.sh) ;;
    swiftshader) text=$(scripts/unpack-swiftshader.sh) ;;
    *) echo "$1 is no driver: stock, newer or swiftshader" >&2; return 2 ;;
  esac
  read -ra variables <<<"$text"
  env "${variables[@]}" "${@:2}"
}

# paths MODEL...: the files of assets.
paths() { printf 'assets/%s.obj ' "$@"; }

# measure DRIVER MODEL RUNS OPTIONS...: renders at 800x600, leaving the figures for figure(). MODEL is the name of an
# asset or the path of a file.
measure() {
  local driver=$1 model=$2 runs=$3
  shift 3
  case $model in */*) ;; *) model=assets/$model.obj ;; esac
  on "$driver" build/release/trisect render "$model" --runs "$runs" -o "$work/a.png" \
    --stats "$work/a.json" "$@" >/dev/null
}

# figure PATH: a figure of the last measurement, such as .hits or .gpu_ms.median.
figure() { jq -r "$1" "$work/a.json"; }

# open_display: a screen that nobody sees. DISPLAY names it; `server` is the process, for the caller to end.
open_display() {
  local number
  exec {number}< <(exec Xvfb -displayfd 1 -screen 0 1280x1024x24 -nolisten tcp -noreset 2>/dev/null)
  server=$!
  read -ru "$number" DISPLAY
  export DISPLAY=:$DISPLAY
}

# name_drivers: unpacks the newer driver, and sets name[newer] and name[stock].
declare -A name
name_drivers() {
  local driver
  scripts/unpack-mesa.sh >/dev/null
  for driver in newer stock; do
    measure $driver sphere-20 1
    name[$driver]=$(figure .driver)
  done
}
