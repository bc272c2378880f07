#!/usr/bin/env bash
# check_headers.sh SOURCE_DIR VULKAN_INCLUDE_DIR COMPILER...: compiles each public header alone, twice
# in a row, as C++17, and those of the core without exceptions and RTTI.
set -euo pipefail
cd "$1"
# As a system's folder, but /usr/include is one already, and in a place of its own.
vulkan=()
if [[ "$2" != /usr/include ]]; then
  vulkan=(-isystem "$2")
fi
shift 2

failed=0
# compile COMPILER HEADER [flag...]
compile() {
  local compiler="$1" header="$2"
  shift 2
  if ! printf '#include <alpenglow/%s>\n#include <alpenglow/%s>\n' "$header" "$header" |
      "$compiler" -std=c++17 -Wall -Wextra -Wpedantic -Werror -fsyntax-only \
        -Iatmosphere/include -Iengine/headless/include "${vulkan[@]}" "$@" -x c++ -; then
    echo "alpenglow/$header does not compile with $compiler as C++17 $*, see above." >&2
    failed=1
  fi
}
bare=(-fno-exceptions -fno-rtti)
if (( $# == 0 )); then
  echo "No compiler was named." >&2
  exit 1
fi
for compiler in "$@"; do
  for path in atmosphere/include/alpenglow/*.h; do
    compile "$compiler" "${path##*/}" "${bare[@]}"
  done
  compile "$compiler" alpenglow.h "${bare[@]}" -DALPENGLOW_SHARED
  for path in atmosphere/include/alpenglow/io/*.h engine/headless/include/alpenglow/*.h; do
    compile "$compiler" "${path#*/include/alpenglow/}"
  done
done
exit "$failed"
