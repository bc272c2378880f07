#!/usr/bin/env bash
# Builds everything, Release, into build/; the program is build/bin/alpenglow. Arguments go to the
# configuring cmake.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/packages.sh
# A compiler takes up to a gigabyte.
jobs="$(nproc)"
memory_jobs="$(awk '/MemAvailable/ { jobs = int($2 / 1048576); print jobs < 1 ? 1 : jobs }' /proc/meminfo)"
if (( memory_jobs < jobs )); then
  jobs="$memory_jobs"
fi
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release "$@"
cmake --build build -j "$jobs"
