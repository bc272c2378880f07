#!/usr/bin/env bash
# check_exports.sh SOURCE_DIR NM LIBRARY...: the shared libraries together export each function that
# the public headers of the core declare, nothing else, and neither define nor import one of Vulkan.
set -euo pipefail
cd "$1"
nm="$2"
shift 2

# Declarations begin in column 0 there: `ALPENGLOW_API Status createView(`, and so does what lacks
# its ALPENGLOW_API.
declared="$(cat atmosphere/include/alpenglow/*.h atmosphere/include/alpenglow/{mesh,reference}/*.h |
  sed -nE '/^(using|constexpr|inline|struct|enum|namespace|template|extern|static)/d
           s/^[A-Za-z][^()]*[ *&]([A-Za-z_][A-Za-z_0-9]*)\(.*/\1/p' | sort -u)"
exported=""
failed=0
for library in "$@"; do
  symbols="$("$nm" -D --defined-only -C "$library" | sed -E 's/^[0-9a-f]* . //' | sort -u)"
  foreign="$(grep -vE '^alpenglow::v1_0::[A-Za-z_0-9]+\(' <<<"$symbols" || true)"
  if [[ -n "$foreign" ]]; then
    printf '%s exports what is no function of the interface:\n%s\n' "$library" "$foreign" >&2
    failed=1
  fi
  vulkan="$("$nm" -D "$library" | grep -E ' [A-Za-z] vk[A-Z]' || true)"
  if [[ -n "$vulkan" ]]; then
    printf '%s has symbols of Vulkan:\n%s\n' "$library" "$vulkan" >&2
    failed=1
  fi
  exported+="$(sed -nE 's/^alpenglow::v1_0::([A-Za-z_0-9]+)\(.*/\1/p' <<<"$symbols")"$'\n'
done
exported="$(sort -u <<<"$exported" | sed '/^$/d')"

if [[ -z "$declared" ]]; then
  echo "No declaration was found in atmosphere/include/alpenglow." >&2
  exit 1
fi
missing="$(comm -23 <(echo "$declared") <(echo "$exported"))"
unknown="$(comm -13 <(echo "$declared") <(echo "$exported"))"
if [[ -n "$missing" ]]; then
  printf 'Declared but not exported (ALPENGLOW_API lacks, or a definition):\n%s\n' "$missing" >&2
  failed=1
fi
if [[ -n "$unknown" ]]; then
  printf 'Exported but in no public header:\n%s\n' "$unknown" >&2
  failed=1
fi
echo "$(wc -l <<<"$exported") functions are exported, $(wc -l <<<"$declared") are declared."
exit "$failed"
