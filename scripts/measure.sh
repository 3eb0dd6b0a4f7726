# For scripts that measure; sourced. They set `work`, a folder of their own.

# measure DRIVER MODEL RUNS OPTIONS...: renders at 800x600, leaving the figures for figure(). DRIVER is `stock` or
# `newer`, the one that unpack-mesa.sh unpacks. MODEL is the name of an asset or the path of a file.
measure() {
  local driver=$1 model=$2 runs=$3 environment=()
  shift 3
  case $model in */*) ;; *) model=assets/$model.obj ;; esac
  if [ "$driver" = newer ]; then read -ra environment < <(scripts/unpack-mesa.sh); fi
  env "${environment[@]}" build/release/trisect render "$model" --runs "$runs" -o "$work/a.png" \
    --stats "$work/a.json" "$@" >/dev/null
}

# figure PATH: a figure of the last measurement, such as .hits or .gpu_ms.median.
figure() { jq -r "$1" "$work/a.json"; }

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
