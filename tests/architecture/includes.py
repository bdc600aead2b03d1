#!/usr/bin/env python3
"""Holds the table of rooms against the #include lines: a new arrow between rooms fails. ARCHITECTURE.md shows the same tables."""

import re
import sys
from pathlib import Path

from source_tree import HEADER_SUFFIXES, Fault, cpp_files, line_of, read, run, without_comments

# room -> the rooms that it may include. Arrows are transitive: a room may include what its rooms may include.
ARROWS = {
    "server/base": [],
    "server/log": ["server/base"],
    "server/database": ["server/base"],
    "server/geometry": ["server/base"],
    "server/collision": ["server/geometry"],
    "server/collision_build": ["server/collision"],
    "server/realtime": ["server/base"],
    "server/hand": ["server/base"],
    "server/state": ["server/collision", "server/hand"],
    "server/dynamics": ["server/state"],
    "server/haptics": ["server/state"],
    "server/machines": ["server/state"],
    "server/agents": ["server/state"],
    "server/world": ["server/dynamics", "server/haptics", "server/machines", "server/agents", "server/realtime"],
    "server/content": ["server/collision_build", "server/database", "server/x3d"],
    "server/x3d": ["server/base"],
    "server/scenario": ["server/content", "server/agents", "server/machines"],  # agents and machines: their parameters' tables
    "server/record": ["server/state", "server/realtime"],
    "server/visits": ["server/state", "server/realtime", "server/database"],
    "server/transport": ["proto", "server/state", "server/realtime"],
    "server/app": ["server/world", "server/scenario", "server/record", "server/visits", "server/transport"],
    "proto": ["server/hand"],
    "client-sdk/client": ["proto", "server/realtime", "server/hand"],
    "client-sdk/drivers": [],
    "client-sdk/haptic": ["client-sdk/client", "client-sdk/drivers"],
    "client-sdk/picture": ["server/base"],
    "client-sdk/recording": ["client-sdk/client"],
    "client-sdk/assets": ["server/content"],
    "client-sdk/sound": ["client-sdk/client"],
    "client-sdk/visit": ["client-sdk/client", "client-sdk/picture"],
    "client-sdk/pointer": ["client-sdk/client", "client-sdk/picture"],
    "client-sdk/scene": ["client-sdk/visit", "client-sdk/assets"],
    "client-sdk/draw": ["client-sdk/picture"],
    "client-sdk/display": ["client-sdk/draw", "client-sdk/scene", "client-sdk/sound", "client-sdk/pointer", "client-sdk/recording"],
    "client-sdk/visitor": ["client-sdk/haptic", "client-sdk/pointer", "client-sdk/scene", "server/scenario"],  # a person at a device
    "client-sdk/fit": ["server/content"],
    "client-sdk/authoring": ["server/scenario"],
    "client-sdk/studio": ["client-sdk/authoring"],
    "client-sdk/gateway": ["client-sdk/visit", "client-sdk/pointer", "client-sdk/haptic", "client-sdk/studio", "server/content",
                           "server/visits"],
    "client-sdk/cli": ["client-sdk/recording", "client-sdk/studio", "server/content", "server/visits"],
    "client-sdk/examples": ["client-sdk/client"],
}

# The folders within a room, "." being the room's own. A folder may include those before it. Other rooms may include any of them.
FOLDERS = {
    "server/geometry": [".", "solid", "fitting", "pieces"],
    "client-sdk/studio": ["edits", "draft", "view", "shelf"],
    "client-sdk/gateway": ["http", "sign_in", "browsers", "operations", "drafts", "."],
}

# No log here: what runs in the tick or is read by what does, and rooms whose callers say what went wrong. Every other room may use it.
NO_LOG = {"server/base", "server/geometry", "server/collision", "server/collision_build", "server/state", "server/dynamics",
          "server/haptics", "server/machines", "server/agents", "server/hand", "server/realtime", "server/world", "server/x3d",
          "server/scenario", "server/database", "client-sdk/picture", "client-sdk/authoring", "client-sdk/studio",
          "client-sdk/drivers"}

# A third-party library: its headers, and the rooms that may know it. In those rooms it stays in .cpp files.
LIBRARIES = {
    "Bullet": (re.compile(r"(bt\w+\.h|(bullet|BulletDynamics|BulletCollision|LinearMath)/.*)$"), {"server/dynamics"}),
    "assimp": (re.compile(r"assimp/"), {"server/content"}),
    "expat": (re.compile(r"expat"), {"server/x3d"}),
    "SQLite": (re.compile(r"(sqlite3|SQLiteCpp)"), {"server/database", "server/content", "server/visits"}),
    "Cyclone DDS": (re.compile(r"(dds/|ddsc/)"), {"proto", "server/transport", "client-sdk/client", "client-sdk/cli"}),
    "spdlog": (re.compile(r"spdlog/"), {"server/log"}),
    "OpenGL": (re.compile(r"(epoxy|EGL|GL|GLES\d?|KHR)/"), {"client-sdk/draw", "client-sdk/display"}),
    "SDL": (re.compile(r"(SDL2/|SDL\w*\.h$)"), {"client-sdk/display"}),
    "Boost.Beast": (re.compile(r"boost/(asio|beast|system)\b"), {"client-sdk/drivers", "client-sdk/gateway"}),
    "OpenSSL": (re.compile(r"openssl/"), {"client-sdk/gateway"}),
    "libsodium": (re.compile(r"sodium"), {"proto", "client-sdk/gateway"}),
    "libzip": (re.compile(r"zip\.h$"), {"client-sdk/studio"}),
    "libcurl": (re.compile(r"curl/"), {"client-sdk/assets"}),
    "OpenAL": (re.compile(r"AL/"), {"client-sdk/sound"}),
    "meshoptimizer": (re.compile(r"meshoptimizer"), {"client-sdk/scene"}),
    "libsndfile": (re.compile(r"sndfile"), {"client-sdk/sound"}),
    "libqrencode": (re.compile(r"qrencode"), {"client-sdk/display"}),
}
# proto is the wrapper: its headers are where Cyclone DDS becomes typed topics.
IN_HEADERS = {("proto", "Cyclone DDS")}
# The sources of a program of its own inside a room: free among themselves, and nobody else's to include.
OWN_PROGRAMS = ("server/content/importer/",)

_INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*(?:"(?P<quoted>[^"]+)"|<(?P<angled>[^>]+)>)', re.MULTILINE)


def reachable(room: str) -> set[str]:
    seen: set[str] = set()
    todo = list(ARROWS[room])
    while todo:
        other = todo.pop()
        if other not in seen:
            seen.add(other)
            todo += ARROWS[other]
    return seen


def room_of_file(path: Path) -> str:
    return "proto" if path.parts[0] == "proto" else "/".join(path.parts[:2])


def room_of_include(name: str) -> str | None:
    """The room that an include names, or None for a header from elsewhere."""
    if name.startswith("mechane/client/"):
        return "client-sdk/client"
    if name == "mechane/driver.h":
        return "client-sdk/drivers"
    if name.startswith(("mechane/proto/", "proto/")):
        return "proto"
    if name.startswith(("server/", "client-sdk/")):
        return "/".join(name.split("/")[:2])
    return None


def folder_fault(room: str, path: Path, name: str) -> str | None:
    """What is wrong when a file of a room includes another of the same room."""
    order = FOLDERS.get(room)
    if order is None:
        return None
    own, other = (str(Path(file).parent.relative_to(room)) for file in (path, name))
    for folder in (own, other):
        if folder not in order:
            return f"{room} has no folder '{folder}' in the table of folders in includes.py"
    if order.index(other) > order.index(own):
        return f"{room}/{own} comes before {room}/{other}, so it may not include \"{name}\": see the table of folders in ARCHITECTURE.md"
    return None


def may_include(room: str, other: str) -> bool:
    if other == room or other in reachable(room):
        return True
    return other == "server/log" and room not in NO_LOG


def library_fault(room: str, path: Path, name: str) -> str | None:
    for library, (headers, rooms) in LIBRARIES.items():
        if not headers.match(name):
            continue
        if room not in rooms:
            return f"{library} belongs to {', '.join(sorted(rooms))} alone; use what that room offers"
        own = str(path).startswith(OWN_PROGRAMS)
        if path.suffix in HEADER_SUFFIXES and (room, library) not in IN_HEADERS and not own:
            return f"<{name}> in a header: keep {library} in .cpp files, behind a forward declaration or a pimpl"
    return None


def include_fault(room: str, path: Path, name: str, quoted: bool) -> tuple[str, str] | None:
    other = room_of_include(name)
    if other is not None:
        if other not in ARROWS:
            return "arrow", f"{other} is not a room in the table of includes.py"
        if name.startswith(OWN_PROGRAMS) and not str(path).startswith(OWN_PROGRAMS):
            return "arrow", f'"{name}" belongs to a program of its own, which runs apart from this one'
        if not may_include(room, other):
            return "arrow", f"{room} may not include {other} (\"{name}\"): see the table of rooms in ARCHITECTURE.md"
        wrong = folder_fault(room, path, name) if other == room else None
        return ("arrow", wrong) if wrong else None
    library = library_fault(room, path, name)
    if library:
        return "third-party", library
    if quoted and room != "proto":
        return "include-path", f'"{name}": include by the path from the repository root, or with <> what is not ours'
    return None


def full_name(name: str) -> str:
    """A room by its folder's name alone, as ARCHITECTURE.md calls it; unknown names stay as they are."""
    found = [room for room in ARROWS if room.rsplit("/", 1)[-1] == name]
    return found[0] if len(found) == 1 else name


def rooms_of_page(text: str) -> dict[str, list[str]]:
    """The table of rooms in ARCHITECTURE.md: a line is 'FOLDER/ ROOM what it is -> ROOMS', the folder where it begins; what has no arrow
    goes on in the next line."""
    found: dict[str, list[str]] = {}
    block = re.search(r"^## Rooms.*?^```\n(.*?)^```", text, re.MULTILINE | re.DOTALL)
    folder = ""
    for line in re.sub(r"\n {10,}", " ", block[1]).splitlines() if block else []:
        row = re.match(r"(?P<folder>\S+/)?\s*(?P<room>[\w-]*)\s.*?\s->\s*(?P<arrows>[\w, -]+)$", line)
        if not row:
            found[line.strip()] = []
            continue
        folder = row["folder"] or folder
        room = "proto" if folder == "proto/" else folder + row["room"]
        found[room] = sorted(full_name(name.strip()) for name in row["arrows"].split(",") if name.strip() != "-")
    return found


def table_of_page(text: str, head: str) -> dict[str, list[str]]:
    block = re.search(rf"^\| {head} \|\n\|[-|]+\|\n((?:\|.*\n)+)", text, re.MULTILINE)
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in block[1].splitlines()] if block else []
    return {row[0]: [name.strip() for name in row[1].split(",")] for row in rows}


def libraries_of_page(text: str) -> dict[str, list[str]]:
    return {library: sorted(map(full_name, rooms)) for library, rooms in table_of_page(text, r"library \| rooms").items()}


def folders_of_page(text: str) -> dict[str, list[str]]:
    """The table's rows name a room's own folder by the room."""
    rows = table_of_page(text, r"room \| its folders, each may include those before it")
    return {full_name(room): ["." if folder == room else folder for folder in folders] for room, folders in rows.items()}


def page_faults(root: Path) -> list[Fault]:
    """ARCHITECTURE.md shows the tables of this file, room for room."""
    page = root / "ARCHITECTURE.md"
    text = read(page) if page.exists() else ""
    faults = []
    for what, shown, held in (
            ("rooms", rooms_of_page(text), {room: sorted(others) for room, others in ARROWS.items()}),
            ("folders", folders_of_page(text), FOLDERS),
            ("libraries", libraries_of_page(text), {name: sorted(rooms) for name, (_, rooms) in LIBRARIES.items()})):
        for name in sorted(shown.keys() | held.keys()):
            if shown.get(name) != held.get(name):
                faults.append(Fault("page", "ARCHITECTURE.md", 1, f"table of {what}: '{name}' has {shown.get(name, 'no row')}, "
                                    f"in includes.py {held.get(name, 'no row')}: make them equal"))
    return faults


def check(root: Path) -> list[Fault]:
    faults = page_faults(root)
    for path in cpp_files(root, "server", "proto", "client-sdk"):
        room = room_of_file(path)
        if room not in ARROWS:
            faults.append(Fault("arrow", str(path), 1, f"{room} is not a room: add it to the table in includes.py and to ARCHITECTURE.md"))
            continue
        text = without_comments(read(root / path))
        for match in _INCLUDE.finditer(text):
            name = match["quoted"] or match["angled"]
            found = include_fault(room, path, name, match["quoted"] is not None)
            if found:
                faults.append(Fault(found[0], str(path), line_of(text, match.start("quoted" if match["quoted"] else "angled")), found[1]))
    return faults


if __name__ == "__main__":
    sys.exit(run("includes", __doc__, check))
