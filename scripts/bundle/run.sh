#!/bin/bash
# Runs a program of this bundle, from any folder: run.sh trisect devices
# The libraries in lib/ are the bundle's own. Those in lib/spare, which drivers use too, are taken only where the machine
# has none or one that is too old. Needs bash and coreutils.
set -u
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
if [ $# -lt 1 ] || [ ! -x "$here/bin/$1" ]; then
  echo "usage: run.sh PROGRAM ARGUMENT ... ($(cd "$here/bin" && echo *))" >&2
  exit 2
fi
program=$here/bin/$1
shift
export LD_LIBRARY_PATH=$here/lib${LD_LIBRARY_PATH:+:$LD_LIBRARY_PATH}

# What a spare library needs may be missing in its turn.
taken=yes
while [ $taken = yes ]; do
  taken=no
  # What the dynamic linker finds, and its complaints.
  found=$(LD_TRACE_LOADED_OBJECTS=1 "$program" 2>&1)
  for folder in "$here"/lib/spare/*; do
    library=${folder##*/}
    [[ :$LD_LIBRARY_PATH: != *":$folder:"* ]] || continue
    if [[ $found == *"$library => not found"* || $found == *"/$library: version "*" not found"* ]]; then
      LD_LIBRARY_PATH=$folder:$LD_LIBRARY_PATH
      taken=yes
    fi
  done
done
if [[ $found == *"libvulkan.so.1 => not found"* ]]; then
  echo "run.sh: there is no Vulkan loader, libvulkan.so.1; LD_LIBRARY_PATH may name the folder of one" >&2
  exit 4
fi
exec "$program" "$@"
