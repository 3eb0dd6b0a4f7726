#!/bin/bash
# Renders sequences by GNU parallel and by a Slurm of this machine, and holds both to losing, tearing and repeating no frame.
# Installs Slurm, whose Debian packages begin services.
set -euo pipefail
cd "$(dirname "$0")/.."
scripts/setup.sh build test farm
cmake --preset release -DBUILD_TESTING=ON >/dev/null
cmake --build --preset release
ctest --preset release --tests-regex '^Farm[.]' "$@"
