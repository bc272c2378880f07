#!/usr/bin/env bash
# sanitize.sh [PRESET...]: the unit tests under sanitizers, by default with the presets asan+ubsan and
# tsan: engine, physics, model, plan, files and meshes. What draws much on software Vulkan is left
# out (`cmake --build --preset tsan` and `ctest --preset tsan` are for all). The SPIR-V is that of the
# finished build that ALPENGLOW_SHADERS_FROM names (its folder shaders/generated), or compiled.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

presets=("$@")
if (( ${#presets[@]} == 0 )); then
  presets=(asan+ubsan tsan)
fi
scripts/packages.sh
tests=(engine_mock_test engine_gpu_test engine_net_test engine_headless_test physics_tests parameters_tests
  plan_tests io_tests table_file_tests mesh_tests)
for preset in "${presets[@]}"; do
  cmake --preset "$preset" -DALPENGLOW_BUILD_COST=OFF -DALPENGLOW_BUILD_VIEWER=OFF \
    "-DALPENGLOW_SHADERS_FROM=${ALPENGLOW_SHADERS_FROM:-}"
  cmake --build --preset "$preset" -j "$(scripts/jobs.sh)" --target "${tests[@]}"
  ctest --preset "$preset" -R "^($(IFS='|' && echo "${tests[*]}"))\\."
done
