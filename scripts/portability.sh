#!/usr/bin/env bash
# portability.sh [STEP...]: what scripts/test.sh doesn't show. Steps, all by default:
#   clang      everything compiles with clang 14 without a warning, not optimised
#   shared     shared libraries export the interface alone and serve the package's users
#   plain      the core compiles without exceptions and RTTI and draws the sky
#   mingw      core and headless for Windows; embed_minimal under Wine on software Vulkan writes the
#              native program's picture, byte for byte
# Each has a folder of its own, build-portability/STEP. The SPIR-V is that of build/, which
# scripts/build.sh makes where it is missing, or of the finished build that ALPENGLOW_SHADERS_FROM
# names (its folder shaders/generated). Installs what it needs from Debian's packages.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
root="$PWD"
work="$root/build-portability"

scripts/packages.sh
scripts/packages.sh portability
if [[ -z "${ALPENGLOW_SHADERS_FROM:-}" ]]; then
  scripts/build.sh -DALPENGLOW_BUILD_TESTS=ON
  ALPENGLOW_SHADERS_FROM="$root/build/shaders/generated"
fi
jobs="$(scripts/jobs.sh)"
export VK_DRIVER_FILES="${VK_DRIVER_FILES:-/usr/share/vulkan/icd.d/lvp_icd.x86_64.json}"

# build STEP [cmake argument...]
build() {
  local folder="$work/$1"
  shift
  cmake -S . -B "$folder" -G Ninja -DCMAKE_BUILD_TYPE=Release \
    "-DALPENGLOW_SHADERS_FROM=$ALPENGLOW_SHADERS_FROM" "$@"
  cmake --build "$folder" -j "$jobs"
}

# embed FOLDER PREFIX [cmake argument...]: the sample host of an installed package.
embed() {
  local folder="$1" prefix="$2"
  shift 2
  cmake -S samples/embed_minimal -B "$folder" -G Ninja "-DCMAKE_PREFIX_PATH=$prefix" \
    -DCMAKE_CXX_STANDARD=17 "$@"
  cmake --build "$folder" -j "$jobs"
}

core=(-DALPENGLOW_BUILD_IO=OFF -DALPENGLOW_BUILD_COST=OFF -DALPENGLOW_BUILD_SAMPLES=OFF
  -DALPENGLOW_BUILD_VIEWER=OFF -DALPENGLOW_BUILD_TESTS=OFF)

# The standard library's and GoogleTest's headers are read once for all files, which halves the time.
step_clang() {
  local headers="$work/headers" gtest=-DGTEST_HAS_PTHREAD=1
  mkdir -p "$work"
  grep -rhoE '^#include <([a-z_]+|gtest/gtest\.h)>' atmosphere engine samples tests \
    --include='*.cpp' --include='*.h' | grep -vE '<(dlfcn|volk)' | sort -u >"$headers.h"
  clang++ -O0 -std=c++20 -fPIC -fvisibility=hidden -fvisibility-inlines-hidden "$gtest" \
    -x c++-header "$headers.h" -o "$headers.pch"
  build clang -DCMAKE_CXX_COMPILER=clang++ -DALPENGLOW_BUILD_TESTS=ON \
    "-DCMAKE_CXX_FLAGS_RELEASE=-O0 $gtest -include-pch $headers.pch"
}

step_shared() {
  build shared -DALPENGLOW_SHARED=ON -DCMAKE_CXX_FLAGS_RELEASE=-O0 -DALPENGLOW_BUILD_VIEWER=OFF \
    -DALPENGLOW_BUILD_TESTS=ON
  # Not as a subdirectory: that builds everything once more, and scripts/test.sh has shown it.
  (cd "$work/shared" && ctest --output-on-failure --no-tests=error -j 2 -E 'consumer\.subdirectory')
}

# What Wine's picture is compared with comes from here.
step_plain() {
  build plain "${core[@]}" -DALPENGLOW_CORE_WITHOUT_EXCEPTIONS=ON -DCMAKE_CXX_FLAGS_RELEASE=-O0
  cmake --install "$work/plain" --prefix "$work/plain/prefix" >/dev/null
  embed "$work/plain/embed" "$work/plain/prefix" "-DCMAKE_CXX_FLAGS=-fno-exceptions -fno-rtti"
  "$work/plain/embed/embed_minimal" "$work/plain/sky.ppm" --small
}

step_mingw() {
  [[ -e "$work/plain/sky.ppm" ]] || step_plain
  local toolchain=(--toolchain "$root/cmake/mingw-w64.cmake"
    "-DALPENGLOW_MINGW_ROOT=$work/mingw-root")
  scripts/mingw_root.sh "$work/mingw-root"
  build mingw "${core[@]}" "${toolchain[@]}" -DCMAKE_CXX_FLAGS_RELEASE=-O0
  cmake --install "$work/mingw" --prefix "$work/mingw-root" >/dev/null
  # Once linked to vulkan-1.dll, once by volk.
  embed "$work/mingw/linked" "$work/mingw-root" "${toolchain[@]}"
  embed "$work/mingw/embed" "$work/mingw-root" "${toolchain[@]}" -DEMBED_USE_VOLK=ON
  for program in linked embed; do
    (
      cd "$work/mingw/$program"
      # Wine's Vulkan needs a display. A folder of its own, and no questions about Mono and Gecko.
      WINEPREFIX="$work/wine" WINEDEBUG=-all WINEDLLOVERRIDES="mscoree,mshtml=" \
        timeout 300 xvfb-run -a wine ./embed_minimal.exe sky.ppm --small
      cmp sky.ppm "$work/plain/sky.ppm"
    )
  done
  echo "The pictures of Windows' and the native program are equal."
}

steps=("$@")
if (( ${#steps[@]} == 0 )); then
  steps=(clang shared plain mingw)
fi
times=()
for step in "${steps[@]}"; do
  if ! declare -F "step_$step" >/dev/null; then
    echo "'$step' was given, but a step is clang, shared, plain or mingw." >&2
    exit 2
  fi
  echo "== $step"
  start=$SECONDS
  "step_$step"
  times+=("$step $((SECONDS - start)) s")
done
printf '%s\n' "${times[@]}"
