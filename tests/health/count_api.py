#!/usr/bin/env python3
"""count_api.py [SOURCE_DIR]

How much there is to learn: counts the functions and structs of the core's public headers,
atmosphere/include/alpenglow/*.h (those of its folders and of the reference are apart), and prints
both numbers. Fails where there are too many, or where a function lacks ALPENGLOW_API."""

import pathlib
import re
import sys

LESS_THAN = {"functions": 45, "structs": 40}
# Apart from the core, as mesh/, io/ and the folders of other libraries are.
APART = {"mesh.h", "terrain.h", "reference.h"}
FUNCTION = re.compile(r"\b([a-z]\w*)\(")


def declarations(text):
    """The statements outside of all braces but those of namespaces, without comments."""
    text = re.sub(r"//[^\n]*|^\s*#(?:[^\n]*\\\n)*[^\n]*", "", text, flags=re.M)
    text = re.sub(r"\b(?:inline )?namespace \w+ \{", "", text)
    found, depth, start = [], 0, 0
    for i, c in enumerate(text):
        depth += {"{": 1, "}": -1}.get(c, 0)
        if c == ";" and depth <= 0 or c == "}" and depth == 0:
            found.append(" ".join(text[start:i + 1].split()))
            start = i + 1
    return found


def main():
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    names = {"functions": set(), "structs": set()}
    bad = []
    for path in sorted((root / "atmosphere/include/alpenglow").glob("*.h")):
        for line in declarations(path.read_text()):
            struct = re.match(r"struct (\w+)(?: : [\w:]+)? \{", line)
            if struct and path.name not in APART:
                names["structs"].add(struct[1])
            exported = line.startswith("ALPENGLOW_API ")
            if re.match(r"(inline |constexpr |template|using |struct |enum |static)", line):
                continue
            function = FUNCTION.search(line)
            if exported and function and path.name not in APART:
                names["functions"].add(function[1])
            elif function and not exported:
                bad.append(f"{path.name}: {function[1]} has no ALPENGLOW_API.")
    for kind, found in names.items():
        print(f"{len(found)} {kind}, less than {LESS_THAN[kind]} are wanted: "
              + ", ".join(sorted(found)))
        if not 0 < len(found) < LESS_THAN[kind]:
            bad.append(f"The core has {len(found)} {kind}.")
    print(*bad, sep="\n", file=sys.stderr, end="\n" if bad else "")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
