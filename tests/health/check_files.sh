#!/usr/bin/env bash
# check_files.sh SOURCE_DIR: habits that a compiler doesn't check. A file has one concept and so at
# most 450 lines, a test 500; the sample host stays under 240; the public headers bring no STL containers along
# (but for the headless and io ones, which are no part of the boundary to a host).
set -euo pipefail
cd "$1"

failed=0
complain() {
  echo "$1" >&2
  failed=1
}

while IFS= read -r file; do
  lines="$(wc -l <"$file")"
  most=450
  if [[ "$file" == tests/* ]]; then
    most=500
  fi
  if (( lines > most )); then
    complain "$file has $lines lines, at most $most are allowed."
  fi
done < <(find atmosphere engine shaders samples tests cmake scripts -type f \
  \( -name '*.h' -o -name '*.cpp' -o -name '*.glsl' -o -name '*.comp' -o -name '*.vert' \
     -o -name '*.frag' -o -name '*.cmake' -o -name '*.sh' -o -name CMakeLists.txt \))

lines="$(wc -l <samples/embed_minimal/main.cpp)"
if (( lines >= 240 )); then
  complain "samples/embed_minimal/main.cpp has $lines lines, under 240 are promised."
fi

if grep -HnE '#include <(string|vector|map|memory|functional|optional|glm)' \
    atmosphere/include/alpenglow/*.h; then
  complain "A header of the core includes what has no place in its interface, see above."
fi
exit "$failed"
