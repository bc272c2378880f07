#!/usr/bin/env bash
# Builds the libraries and the program build/bin/alpenglow, Release, into build/. Arguments go to the
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
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DALPENGLOW_BUILD_TESTS=OFF "$@"
cmake --build build -j "$jobs"
