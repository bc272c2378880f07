#!/usr/bin/env bash
# Builds the libraries and the program build/bin/alpenglow, Release, into build/. Arguments go to the
# configuring cmake.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/packages.sh
cmake -S . -B build -G Ninja -DCMAKE_BUILD_TYPE=Release -DALPENGLOW_BUILD_TESTS=OFF "$@"
cmake --build build -j "$(scripts/jobs.sh)"
