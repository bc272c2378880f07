#!/usr/bin/env bash
# Builds the program, bakes the sample atmospheres with the defaults and renders every sample scene
# into out/. Ends with a table of what took how long.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

names=()
times=()
# step NAME COMMAND...: runs it and notes the wall time.
step() {
  local name="$1" start="$EPOCHREALTIME"
  shift
  echo "== $name"
  "$@"
  names+=("$name")
  times+=("$(awk -v a="$start" -v b="$EPOCHREALTIME" 'BEGIN { printf "%.1f", b - a }')")
}

step "build" scripts/build.sh
mkdir -p out

for scene in samples/scenes/*.json; do
  atmosphere="$(sed -n 's/.*"atmosphere": *"\([^"]*\)".*/\1/p' "$scene")"
  tables="out/$atmosphere.exr"
  # The tables don't depend on camera or sun: one bake is reused by all scenes of an atmosphere.
  if [[ " ${names[*]} " != *" bake $atmosphere "* ]]; then
    step "bake $atmosphere" build/bin/alpenglow bake "$atmosphere" -o "$tables"
  fi
  name="$(basename "$scene" .json)"
  step "render $name" build/bin/alpenglow render "$scene" --tables "$tables" -o "out/$name.png"
done

echo
printf '%-36s %9s\n' "step" "seconds"
for i in "${!names[@]}"; do
  printf '%-36s %9s\n' "${names[i]}" "${times[i]}"
done
printf '%-36s %9s\n' "all" "$(printf '%s\n' "${times[@]}" | awk '{ s += $1 } END { printf "%.1f", s }')"
echo
echo "The pictures are in $PWD/out."
