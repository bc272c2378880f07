#!/usr/bin/env python3
"""check_includes.py [SOURCE_DIR] [--list] [--self-test]

Which room may include which: arrows run downwards only. Reads the include lines of every C++ and
GLSL file of the rooms; an include of a room that isn't listed below for the file's room fails.
Standard library, Vulkan and third-party headers are no rooms and are not looked at, but for those
in FOREIGN, which belong to some rooms alone."""

import os
import re
import sys

# Room: its folders, what it may use besides itself, and why where that is not plain.
# Longest prefix wins. "public" is atmosphere/include/alpenglow, the vocabulary of all rooms.
ROOMS = {
    # Programs. They see what a user sees: no header and no text of a room but the public ones.
    "samples/cli": (["samples/cli/"],
                    "samples/common samples/terrain samples/stars public headless.api io.api "
                    "cost.api"),
    "samples/view": (["samples/view/"],
                     "samples/common samples/terrain samples/stars public headless.api io.api glsl/alpenglow"),
    "samples/embed_minimal": (["samples/embed_minimal/"], "public"),
    "samples/terrain": (["samples/terrain/"],
                        "samples/common public headless.api io.api glsl/alpenglow"),
    "samples/stars": (["samples/stars/"], "samples/common public headless.api io.api glsl/alpenglow"),
    "samples/common": (["samples/common/"], "public headless.api io.api"),
    # Libraries beside the core.
    "cost": (["atmosphere/cost/"], "cost.api io.api headless.api public"),
    "io": (["atmosphere/io/"], "io.api public glsl/alpenglow"),
    "reference": (["atmosphere/reference/"], "parameters glsl/physics public"),
    # The core, from the top down.
    "api": (["atmosphere/api/"],
            "view passes camera baselines tables plan mesh parameters engine glsl/physics public"),
    "view": (["atmosphere/view/"], "passes camera tables engine parameters public"),
    "passes": (["atmosphere/passes/"], "tables camera engine parameters public"),
    "camera": (["atmosphere/camera/"], "parameters public"),
    "baselines": (["atmosphere/baselines/"], "tables parameters engine public"),
    "tables": (["atmosphere/tables/"], "parameters engine public"),
    "plan": (["atmosphere/plan/"], "parameters public"),
    "mesh": (["atmosphere/mesh/"], "parameters public"),
    "parameters": (["atmosphere/parameters/"], "glsl/physics public"),
    "engine": (["engine/"], "types.api"),
    "headless": (["engine/headless/"], "headless.api engine public"),
    # Headers for hosts.
    "public": (["atmosphere/include/alpenglow/"], "types.api"),
    "types.api": (["atmosphere/include/alpenglow/types.h", "atmosphere/include/alpenglow/export.h",
                   "engine/exceptions.h"], ""),
    "io.api": (["atmosphere/include/alpenglow/io/"], "public types.api"),
    "headless.api": (["engine/headless/include/"], "public types.api"),
    "cost.api": (["atmosphere/cost/include/"], "io.api public types.api"),
    # GLSL. Our passes draw with the very text that hosts include.
    "glsl/passes": (["shaders/glsl/passes/"], "glsl/alpenglow glsl/common glsl/physics"),
    "glsl/tables": (["shaders/glsl/tables/"], "glsl/baselines glsl/common glsl/physics"),
    "glsl/alpenglow": (["shaders/glsl/alpenglow/"], "glsl/baselines glsl/common glsl/physics"),
    "glsl/baselines": (["shaders/glsl/baselines/"], "glsl/common glsl/physics"),
    "glsl/common": (["shaders/glsl/common/"], "glsl/physics"),
    "glsl/physics": (["shaders/glsl/physics/"], ""),
}

# Known and wrong: (file, included file, why it is still so).
ALLOWED = []

# Third-party headers that not every room may have: a pattern, and the rooms.
FOREIGN = [
    (r"glm/", "parameters mesh api cost"),
    (r"OpenImageIO/", "io"),
    (r"nlohmann/", "io samples/cli samples/view"),
    (r"cairo", "cost"),
    (r"GLFW/|imgui", "samples/view"),
    (r"CLI/", "samples/cli samples/view"),
]

# Where "#include <alpenglow/x.h>" and "#include "x"" are looked for, after the file's own folder.
SEARCH = ["", "atmosphere/include/", "engine/headless/include/", "atmosphere/cost/include/",
          "shaders/glsl/", "samples/"]
GENERATED = "alpenglow/shaders/"  # Embedded SPIR-V: of whoever links it.
ENDINGS = (".h", ".cpp", ".glsl", ".comp", ".vert", ".geom", ".frag")
TOPS = ("engine", "atmosphere", "shaders", "samples")
INCLUDE = re.compile(r'^\s*#\s*include\s*([<"])([^>"]+)[>"]')


def room_of(path):
    best = max(((prefix, room) for room, (prefixes, _) in ROOMS.items() for prefix in prefixes
                if path.startswith(prefix)), key=lambda pair: len(pair[0]), default=None)
    return best[1] if best else None


def allowed(room):
    uses = ROOMS[room][1].split()
    if "public" in uses or room == "public":
        uses += ["types.api"]
    return set(uses) | {room}


def files(source):
    for top in TOPS:
        for folder, folders, names in os.walk(os.path.join(source, top)):
            folders.sort()
            for name in sorted(names):
                if name.endswith(ENDINGS):
                    yield os.path.relpath(os.path.join(folder, name), source).replace(os.sep, "/")


def find(source, path, name, quoted):
    places = ([os.path.dirname(path) + "/"] if quoted else []) + SEARCH
    for place in places:
        candidate = os.path.normpath(place + name).replace(os.sep, "/")
        if os.path.isfile(os.path.join(source, candidate)):
            return candidate
    return None


def violations_of(path, lines, locate):
    """Sentences for each include of a file that isn't allowed; `locate` finds a file by name."""
    room = room_of(path)
    if room is None:
        return [f"{path} is in no room: name its folder in check_includes.py."]
    found = []
    for number, line in enumerate(lines, 1):
        match = INCLUDE.match(line)
        if not match:
            continue
        quoted, name = match.group(1) == '"', match.group(2)
        if name.startswith(GENERATED):
            continue
        target = locate(path, name, quoted)
        if target is None:
            for pattern, rooms in FOREIGN:
                if re.match(pattern, name) and room not in rooms.split():
                    found.append(f"{path}:{number}: room {room} includes {name}, which only "
                                 f"{rooms} may.")
            if quoted and not any(re.match(p, name) for p, _ in FOREIGN):
                found.append(f"{path}:{number}: there is no file {name} in any room.")
            continue
        other = room_of(target)
        if other is None:
            found.append(f"{path}:{number}: {target} is in no room.")
        elif other not in allowed(room) and (path, target) not in [a[:2] for a in ALLOWED]:
            found.append(f"{path}:{number}: room {room} includes {target} of room {other}, but may "
                         f"use only: {' '.join(sorted(allowed(room) - {room})) or 'nothing'}.")
    return found


def cycle():
    """A loop in the table itself, or None: then it runs downwards."""
    state = {}

    def visit(room, trail):
        if state.get(room) == 2:
            return None
        if state.get(room) == 1:
            return trail[trail.index(room):] + [room]
        state[room] = 1
        for other in ROOMS[room][1].split():
            loop = visit(other, trail + [room])
            if loop:
                return loop
        state[room] = 2
        return None

    for room in ROOMS:
        loop = visit(room, [])
        if loop:
            return loop
    return None


def check(source):
    loop = cycle()
    if loop:
        return ["The rooms' table has a loop: " + " -> ".join(loop) + "."]
    found, stale, count = [], {a[:2] for a in ALLOWED}, 0
    for path in files(source):
        count += 1
        with open(os.path.join(source, path), encoding="utf-8") as file:
            lines = file.readlines()
        found += violations_of(path, lines, lambda p, n, q: find(source, p, n, q))
        for line in lines:
            match = INCLUDE.match(line)
            if match:
                stale.discard((path, find(source, path, match.group(2), match.group(1) == '"')))
    if count < 100:
        found.append(f"Only {count} files were found under {source}: is it the project's folder?")
    found += [f"{p} no longer includes {t}: take it off the list ALLOWED." for p, t in stale]
    return found


def self_test():
    def locate(path, name, quoted):
        if "/" not in name:
            return os.path.dirname(path) + "/" + name
        for prefix in ("alpenglow/",):
            if name.startswith(prefix) and name.endswith(".h"):
                return "atmosphere/include/" + name
        if name.startswith("alpenglow/") or name.startswith("physics/") or name.startswith("passes/"):
            return "shaders/glsl/" + name
        return name if name.split("/")[0] in TOPS else None

    cases = [  # path, include line, whether it must be refused
        ("engine/device.h", "#include <alpenglow/types.h>", False),
        ("engine/device.h", "#include <alpenglow/context.h>", True),
        ("engine/device.cpp", '#include "atmosphere/tables/table_set.h"', True),
        ("engine/device.cpp", '#include "engine/headless/impl.h"', True),
        ("atmosphere/tables/table_set.h", '#include "engine/pipeline.h"', False),
        ("atmosphere/tables/table_set.h", '#  include "atmosphere/passes/sky_pass.h"', True),
        ("atmosphere/tables/bake_graph.h", '#include "atmosphere/passes/sky_view_lut.h"', True),
        ("atmosphere/camera/camera.cpp", '#include "atmosphere/passes/sky_view_lut.h"', True),
        ("atmosphere/passes/sky_view_lut.cpp", '#include "atmosphere/camera/camera_math.h"', False),
        ("atmosphere/io/json.cpp", '#include "atmosphere/parameters/limits.h"', True),
        ("atmosphere/io/json.cpp", "#include <nlohmann/json.hpp>", False),
        ("atmosphere/plan/medium.cpp", "#include <nlohmann/json.hpp>", True),
        ("atmosphere/include/alpenglow/view.h", "#include <alpenglow/io/file.h>", True),
        ("samples/common/gpu.h", '#include "samples/terrain/landscape.h"', True),
        ("samples/view/tone.frag", '#include "alpenglow/tone_map.glsl"', False),
        ("samples/view/tone.frag", '#include "physics/types.glsl"', True),
        ("shaders/glsl/physics/ray_segment.glsl", '#include "medium.glsl"', False),
        ("shaders/glsl/physics/ray_segment.glsl", '#include "passes/sky.glsl"', True),
        ("shaders/glsl/common/ray_light.glsl", '#include "alpenglow/atmosphere.glsl"', True),
        ("samples/new/main.cpp", "", True),  # A folder that nobody has named.
    ]
    wrong = [f"{path} with {line!r} was {'accepted' if refused else 'refused'}."
             for path, line, refused in cases
             if bool(violations_of(path, [line], locate)) != refused]
    saved = ROOMS["engine"]
    ROOMS["engine"] = (saved[0], saved[1] + " passes")
    if cycle() is None:
        wrong.append("A loop in the table was not seen.")
    ROOMS["engine"] = saved
    return wrong


def main(arguments):
    if "--list" in arguments:
        for room, (_, uses) in ROOMS.items():
            print(f"{room}: {uses or 'nothing'}")
        return 0
    if "--self-test" in arguments:
        found = self_test()
    else:
        found = check(arguments[0] if arguments else ".")
    for sentence in found:
        print(sentence, file=sys.stderr)
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
