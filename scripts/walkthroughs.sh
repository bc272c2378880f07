#!/usr/bin/env bash
# walkthroughs.sh [FLYTHROUGH...]: makes the pictures of docs/flythroughs again, of all sample flythroughs or
# of those named, with the built program. Needs oiiotool.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

# The frames that a page shows.
declare -A frames=(
  [dawn_to_night]="0,96,168,240,336,528,624,696,768,840,936"
  [summit_to_orbit]="0,96,144,192,240,288,348,408"
  [one_parameter]="0,36,84,132,180,228,276,324,336,372"
  [hard_cases]="0,36,60,84,96,132,168,180,204,228,240,276,300,324,336,372"
)
flythroughs=("$@")
if (( ${#flythroughs[@]} == 0 )); then
  flythroughs=(dawn_to_night summit_to_orbit one_parameter hard_cases)
fi

for flythrough in "${flythroughs[@]}"; do
  build/bin/alpenglow render --flythrough "$flythrough" --frames "${frames[$flythrough]}" --size 480x270 -o "out/$flythrough"
  for picture in "out/$flythrough"/frame_*.png; do
    name="$(basename "$picture" .png)"
    oiiotool "$picture" --compression jpeg:90 -o "docs/flythroughs/images/${flythrough}_${name#frame_}.jpg"
  done
done
