#!/usr/bin/env bash
# truth.sh [NAME...]: makes the truth data of tests/data/truth again: atmospheres and queries by
# tests/reference/make_queries.py, answers by `alpenglow probe --method reference`. Without names all
# sets. The answers depend on nothing but the queries and the program, not on the number of cores.
# ALPENGLOW names the program (default: build/bin/alpenglow). Costs and errors: docs/reference-solution.md.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

export ALPENGLOW="${ALPENGLOW:-$PWD/build/bin/alpenglow}"
folder=tests/data/truth
mkdir -p "$folder"
python3 tests/reference/make_queries.py "$folder"
names=("$@")
if (( ${#names[@]} == 0 )); then
  names=(earth earth-fig6 earth-clear earth-hazy mars haze85 haze93 thick5 planet60km
         rayleigh-only mie-only evening)
fi
for name in "${names[@]}"; do
  case "$name" in
    earth | earth-fig6 | earth-hazy | evening) samples=() ;;  # Until the targets.
    haze*) samples=(--samples 262144) ;;
    earth-* | mars) samples=(--samples 131072) ;;
    *) samples=(--samples 65536) ;;
  esac
  start=$SECONDS
  nice -n 19 "$ALPENGLOW" probe "$folder/$name.atmosphere.json" --method reference \
    "${samples[@]}" --queries "$folder/$name.queries.json" -o "$folder/$name.answers.json"
  echo "$name: $((SECONDS - start)) s"
done
