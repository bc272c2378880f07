#!/usr/bin/env bash
# check_format.sh SOURCE_DIR: fails where clang-format 14 would lay out a C++ file differently.
# Exit status 77: skipped.
set -euo pipefail
cd "$1"

if ! command -v clang-format >/dev/null; then
  echo "Skipped: clang-format is not installed."
  exit 77
fi
if ! clang-format --version | grep -q 'version 14\.'; then
  echo "Skipped: the layout is that of clang-format 14; this is $(clang-format --version)."
  exit 77
fi
find atmosphere engine samples tests -name '*.h' -print0 -o -name '*.cpp' -print0 |
  xargs -0 clang-format --dry-run --Werror
