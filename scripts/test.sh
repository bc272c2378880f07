#!/usr/bin/env bash
# Builds everything, tests included, and runs them, but for those that take long (label "long").
# Arguments go to ctest.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

scripts/build.sh -DALPENGLOW_BUILD_TESTS=ON
cd build
# Software Vulkan starts a thread for each core, so more jobs would only be in each other's way.
ctest -LE long --output-on-failure --no-tests=error -j 2 "$@"
