#!/usr/bin/env python3
"""The checks checked: each rule must pass a sound little tree and fail the same tree with one violation planted in it."""

import contextlib
import io
import json
import shutil
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import ceilings
import includes
import manuals
import tidy
import unity
from functions import functions
from results import read_junit  # tidy.py knows where it lies

def short(rooms) -> str:
    return ", ".join(room.rsplit("/", 1)[-1] for room in rooms) or "-"


# ARCHITECTURE.md with the tables that includes.py holds, in its form.
PAGE = "## Rooms and who may include whom\n\n```\n" + "".join(
    f"{'proto/' if room == 'proto' else room.replace('/', '/ ')}  what it is,\n            and what for  -> {short(arrows)}\n"
    for room, arrows in includes.ARROWS.items()) + "```\n\n| library | rooms |\n|---|---|\n" + "".join(
    f"| {library} | {short(rooms)} |\n" for library, (_, rooms) in includes.LIBRARIES.items()) + (
    "\n| room | its folders, each may include those before it |\n|---|---|\n") + "".join(
    f"| {short([room])} | {', '.join(folders).replace('.', short([room]))} |\n" for room, folders in includes.FOLDERS.items())

SOUND = {
    "ARCHITECTURE.md": PAGE,
    "server/base/CMakeLists.txt": "mechane_room(NAME base)\n",
    "server/base/a.hpp": "#pragma once\n\nnamespace mechane {\nint a();\n}  // namespace mechane\n",
    "server/base/a.cpp": '#include "server/base/a.hpp"\n\nint mechane::a() { return 1; }\n',
    "server/dynamics/CMakeLists.txt": "mechane_room(NAME dynamics)\n",
    "server/dynamics/d.cpp": '#include <btBulletDynamicsCommon.h>\n#include <vector>\n#include "server/state/s.hpp"\n',
    "server/state/CMakeLists.txt": "mechane_room(NAME state)\n",
    "server/state/s.hpp": '#pragma once\n#include "server/base/a.hpp"\n',
    "server/world/CMakeLists.txt": "mechane_room(NAME world)\n",
    "server/world/w.cpp": '#include "server/dynamics/d.hpp"\n#include "server/base/a.hpp"\n',
    "server/world/v.hpp": "#pragma once\nstruct V {\n};\n",
    "server/world/v.cpp": "namespace {\nstruct E {};\nconstexpr int kE = 1;\nint e(const int& x) {\n  return x;\n}\n}  // namespace\n",
    "proto/CMakeLists.txt": "\n",
    "proto/mechane/proto/p.hpp": "#pragma once\n#include <dds/dds.h>\n",
    "client-sdk/client/CMakeLists.txt": "mechane_room(NAME client)\n",
    "client-sdk/client/c.cpp": "#include <mechane/proto/p.hpp>\n#include <mechane/client/client.hpp>\n",
    "server/geometry/CMakeLists.txt": "mechane_room(NAME geometry)\n",
    "server/geometry/solid/s.cpp": '#include "server/geometry/g.hpp"\n',
    "server/content/CMakeLists.txt": "mechane_room(NAME content)\n",
    "server/content/c.cpp": '#include "server/log/log.hpp"\n',
    "server/content/importer/io.hpp": "#pragma once\n#include <assimp/scene.h>\n",
    "tests/unit/base/CMakeLists.txt": "mechane_test_folder(NAME base)\n",
    "tests/unit/base/a_test.cpp": '#include "server/base/a.hpp"\n',
    "tests/architecture/exceptions.txt": "# none\n",
    "README.md": "# House\n\n## The *first* room, `a.hpp`\n\nSee [below](#the-first-room-ahpp) and [deploy](deploy/README.md#one).\n",
    "deploy/README.md": "# One\n\n`deploy/run`: [up](../README.md), [there](https://example.org/x.md), `[no](link)`.\n\n```\n[no](link)\n```\n",
    "deploy/run": "#!/bin/sh\n",
}


def long_function(lines: int) -> str:
    return "int f(int x) {\n" + "  x += 1;\n" * (lines - 3) + "  return x;\n}\n"


# rule, file, its whole new text
PLANTED = [
    ("arrow", "server/base/a.cpp", '#include "server/state/s.hpp"\n'),
    ("arrow", "server/state/s.hpp", '#pragma once\n#include "server/world/w.hpp"\n'),
    ("arrow", "server/dynamics/d.cpp", '#include "server/haptics/hand_model.hpp"\n'),
    ("arrow", "server/dynamics/d.cpp", '#include "server/log/log.hpp"\n'),
    ("arrow", "server/dynamics/d.cpp", '#include "server/garden/rose.hpp"\n'),
    ("arrow", "server/garden/rose.hpp", "#pragma once\n"),
    ("arrow", "server/world/w.cpp", '#include "server/transport/t.hpp"\n'),
    ("arrow", "client-sdk/client/c.cpp", '#include "server/state/s.hpp"\n'),
    ("arrow", "server/geometry/g.hpp", '#pragma once\n#include "server/geometry/pieces/p.hpp"\n'),
    ("arrow", "server/geometry/rest/r.cpp", '#include "server/geometry/g.hpp"\n'),
    ("arrow", "server/world/w.cpp", "#include <mechane/proto/p.hpp>\n"),
    ("arrow", "server/content/c.cpp", '#include "server/content/importer/io.hpp"\n'),
    ("third-party", "server/dynamics/d.hpp", "#pragma once\n#include <btBulletDynamicsCommon.h>\n"),
    ("third-party", "server/state/s.hpp", "#pragma once\n#include <expat.h>\n"),
    ("third-party", "server/x3d/x.hpp", "#pragma once\n#include <expat.h>\n"),
    ("third-party", "server/world/w.cpp", "#include <dds/dds.h>\n"),
    ("third-party", "server/content/c.hpp", "#pragma once\n#include <assimp/scene.h>\n"),
    ("third-party", "client-sdk/draw/w.hpp", "#pragma once\n#include <epoxy/gl.h>\n"),
    ("third-party", "server/base/a.cpp", "#include <spdlog/spdlog.h>\n"),
    ("third-party", "server/record/r.hpp", "#pragma once\n#include <sqlite3.h>\n"),
    ("include-path", "server/dynamics/d.cpp", '#include "d.hpp"\n'),
    ("function-length", "server/base/a.cpp", long_function(71)),
    ("function-length", "deploy/tool.py", "def f(x):\n" + "    x += 1\n" * 71),
    ("header-length", "server/base/a.hpp", "#pragma once\n" + "int a();\n" * 350),
    ("source-length", "server/base/a.cpp", "int a();\n" * 601),
    ("pragma-once", "server/base/a.hpp", "int a();\n"),
    ("pragma-once", "server/base/a.hpp", "// #pragma once\nint a();\n"),
    ("using-namespace", "server/base/a.hpp", "#pragma once\nusing namespace std;\n"),
    ("last-newline", "README.md", "no end"),
    ("machine-path", "deploy/run.sh", "cd /wo" + "rk/main\n"),
    ("machine-path", "tests/unit/base/a_test.cpp", 'auto p = "/ro' + 'ot/x";\n'),
    ("machine-path", "README.md", "see /ho" + "me/somebody/mechane\n"),
    ("machine-path", "server/base/a.cpp", 'auto p = "/t' + 'mp/x";\n'),
    ("unfinished", "server/base/a.cpp", "// TO" + "DO: the rest\n"),
    ("unfinished", "README.md", "FIX" + "ME\n"),
    ("sleep", "tests/unit/base/a_test.cpp", "std::this_thread::sleep_" + "for(1ms);\n"),
    ("sleep", "tests/unit/base/a_test.cpp", "clock.sleep_until(end);  // sleeps:\n"),
    ("sleep", "tests/integration/a_e2e.py", "time.sleep(1)  # until it is there\n"),
    ("pointer-mutex", "client-sdk/pointer/p.cpp", "std::mutex m;\n"),
    ("pointer-mutex", "client-sdk/pointer/p.hpp", "#pragma once\nstd::condition_variable_any changed;\n"),
    ("folder-cmake", "server/agents/a.cpp", "int a();\n"),
    ("folder-cmake", "tests/property/p_test.cpp", "int a();\n"),
    ("fuzz-corpus", "tests/fuzz/wire_fuzz.cpp", "int a();\n"),
    ("unity-name", "server/world/w.cpp", "namespace {\nenum class E { a };\n}  // namespace\n"),
    ("unity-name", "server/world/w.cpp", "namespace {\nconstexpr double kE = 1;\n}  // namespace\n"),
    ("unity-name", "server/world/w.cpp", "namespace {\nint e(const int& y) {\n  return y;\n}\n}  // namespace\n"),
    ("unity-name", "server/world/w.cpp", "int f() {\n  constexpr int kE = 2;\n  return kE;\n}\n"),
    ("unity-name", "server/world/w.cpp", "namespace {\nstruct V {\n};\n}  // namespace\n"),
    ("page", "ARCHITECTURE.md", "# Nothing of rooms\n"),
    ("page", "ARCHITECTURE.md", PAGE.replace("-> haptic, pointer, scene, scenario\n", "-> haptic, pointer, scene\n")),
    ("page", "ARCHITECTURE.md", PAGE.replace("-> state, realtime\n", "-> state, realtime, log\n", 1)),
    ("page", "ARCHITECTURE.md", PAGE.replace("server/ log  what it is,\n            and what for  -> base\n", "")),
    ("page", "ARCHITECTURE.md", PAGE.replace("```\n\n|", "server/ garden  roses  -> base\n```\n\n|")),
    ("page", "ARCHITECTURE.md", PAGE.replace("```\n\n|", "server/ garden  roses and no arrow\n```\n\n|")),
    ("page", "ARCHITECTURE.md", PAGE.replace("| Bullet | dynamics |", "| Bullet | dynamics, world |")),
    ("page", "ARCHITECTURE.md", PAGE.replace("| SDL | display |\n", "")),
    ("path", "README.md", "See `server/base/gone.hpp`.\n"),
    ("manual-length", "README.md", "word\n" * 151),
    ("manual-length", "deploy/README.md", "`deploy/run`\n" * 201),
    ("manual-width", "deploy/README.md", "`deploy/run`" + " word" * 30 + "\n"),
    ("manual-script", "deploy/README.md", "# One\n\nNothing of deploy/run as a command.\n"),
    ("link", "README.md", "See [it](server/base/b.hpp).\n"),
    ("link", "README.md", "See [it](../else/where.md).\n"),
    ("link", "README.md", "See [a place](deploy/README.md#two).\n"),
    ("link", "README.md", "See [a place](#two).\n```\n## Two\n```\n"),
    ("link", "README.md", "![a picture](deploy/picture.jpg)\n"),
    ("exceptions", "tests/architecture/exceptions.txt", "function-length | server/base/a.cpp:f | 90 | long ago\n"),
    ("exceptions", "tests/architecture/exceptions.txt", "function-length | server/base/a.cpp:f | 90\n"),
]


class Tree(unittest.TestCase):
    def faults(self, changes: dict[str, str]):
        with tempfile.TemporaryDirectory() as folder:
            root = Path(folder)
            for name, text in {**SOUND, **changes}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text)
            return includes.check(root) + ceilings.check(root) + unity.check(root) + manuals.check(root)

    def test_sound_tree_has_no_faults(self):
        self.assertEqual([], [str(fault) for fault in self.faults({})])

    def test_each_planted_violation_is_found(self):
        for rule, name, text in PLANTED:
            with self.subTest(rule=rule, file=name, text=text[:60]):
                found = self.faults({name: text})
                self.assertIn((rule, name.rsplit("/", 1)[0] if rule == "folder-cmake" else name),
                              {(fault.rule, fault.path) for fault in found}, [str(fault) for fault in found])

    def test_what_only_looks_like_a_violation_is_not(self):
        innocent = {
            "server/base/a.cpp": '// #include "server/world/w.hpp"\n/* #include <dds/dds.h> */\nauto s = "using namespace";\n' + long_function(70),
            "server/base/a.hpp": "#pragma once\n// using namespace std;\n" + "int a();\n" * 348,
            "server/world/w.cpp": "namespace {\nint e(double y) {\n  struct E {};\n  int kE = 2;\n  return kE;\n}\n}  // namespace\n",
            "server/state/e.cpp": "namespace {\nstruct E {};\n}  // namespace\n",
            "tests/unit/base/a_test.cpp": "// sleep_" + "for(1ms) would hide a race\nauto p = \"server/root/x\";\n"
                                          "void sleep_until(int wake);\nvoid f() {\n  clock.sleep_until(next);  // sleeps: the pace\n}\n",
            "tests/integration/a_e2e.py": "time.sleep(1)  # sleeps: a second is the subject\n",
            "tests/integration/harness.py": "time.sleep(1)\n",
            "client-sdk/pointer/CMakeLists.txt": "\n",
            "client-sdk/pointer/p.cpp": "// no std::mutex\n",
        }
        self.assertEqual([], [str(fault) for fault in self.faults(innocent)])

    def test_an_exception_raises_one_ceiling_for_one_place(self):
        listed = {"tests/architecture/exceptions.txt": "function-length | server/base/a.cpp:f | 75 | one table, read top to bottom\n"}
        self.assertEqual([], self.faults({**listed, "server/base/a.cpp": long_function(75)}))
        self.assertEqual(["function-length"], [fault.rule for fault in self.faults({**listed, "server/base/a.cpp": long_function(76)})])


class Functions(unittest.TestCase):
    def test_names_and_lengths(self):
        source = """
namespace n {
struct P {
  Vec3 p{1, 2, 3};
  std::function<int()> g = [] { return 1; };
  [[nodiscard]] int a() const { return 1; }

 private:
  int b() {
    if (true) {
      for (;;) {}
    }
    auto f = [](int x) {
      return x;
    };
  }
};
template <class T>
P::P(T x)
    : a_{x},
      b_(2) {
  const char* brace = "{";
  char other = '{';
}
constexpr std::array<int, 2> kTable = {1, 2};
#define OPEN {
bool operator==(const P& a, const P& b) {
  return true;
}
}  // namespace n
"""
        found = {f.name: f.lines for f in functions(source)}
        self.assertEqual(1, found["a"])
        self.assertEqual(8, found["b"])
        self.assertEqual(7, found["P::P"])
        self.assertEqual(3, found["operator=="])


class Table(unittest.TestCase):
    def test_the_page_is_read_whole(self):
        self.assertEqual(set(includes.ARROWS), set(includes.rooms_of_page(PAGE)))
        self.assertEqual(includes.FOLDERS, includes.folders_of_page(PAGE))

    def test_the_four_rooms_of_the_tick_never_meet(self):
        four = {"server/dynamics", "server/haptics", "server/machines", "server/agents"}
        for room in four:
            self.assertEqual(set(), includes.reachable(room) & four)

    def test_no_room_reaches_itself(self):
        for room in includes.ARROWS:
            self.assertNotIn(room, includes.reachable(room))


@unittest.skipUnless(shutil.which(tidy.TIDY), "no clang-tidy")
class TidyTogether(unittest.TestCase):
    """Rooms are looked through several at a time; what is found, and where, must be what each alone would show."""

    def setUp(self):
        self.root = Path(self.enterContext(tempfile.TemporaryDirectory())).resolve()
        (self.root / "tests").mkdir()
        for name in (".clang-tidy", "tests/.clang-tidy"):
            shutil.copy(tidy.ROOT / name, self.root / name)
        self.enterContext(mock.patch.multiple(tidy, ROOT=self.root, CLEAN=self.root / ".cache/tidy"))
        tidy._includes.cache_clear()

    def check(self, *options: str, **rooms: str) -> dict[str, str]:
        """The outcome of each room."""
        tidy._content.cache_clear()
        commands = []
        for name, text in rooms.items():
            file = self.root / f"server/{name}/{name}.cpp"
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text)
            commands.append({"directory": str(self.root), "file": str(file), "command": f"clang++ -std=c++20 -I{self.root} -c {file} -o {name}.o"})
        (self.root / "compile_commands.json").write_text(json.dumps(commands))
        arguments = ["tidy.py", "--build", str(self.root), "--junit", str(self.root / "tidy.xml"), *options]
        with mock.patch.object(sys, "argv", arguments), contextlib.redirect_stdout(io.StringIO()):
            tidy.main()
        return {case.name.split("/")[1]: case.outcome for case in read_junit(self.root / "tidy.xml").cases}

    def test_a_fault_is_laid_to_the_room_that_has_it(self):
        good, bad = "int three() {\n  return 3;\n}\n", "int* nothing() {\n  return 0;\n}\n"
        with mock.patch.object(tidy, "GROUP", 3), mock.patch.dict(tidy.os.environ, MECHANE_JOBS="1"):
            self.assertEqual(self.check(a=good, b=bad, c="int c();\n"), {"a": "passed", "b": "failed", "c": "passed"})

    def test_names_that_clash_only_together_are_no_fault(self):
        one = "namespace {\nint one() {\n  return 1;\n}\n}  // namespace\nint %s() {\n  return one();\n}\n"
        with mock.patch.dict(tidy.os.environ, MECHANE_JOBS="1"):
            self.assertEqual(self.check(a=one % "a", b=one % "b"), {"a": "passed", "b": "passed"})

    def test_clean_rooms_are_looked_through_once_and_together(self):
        rooms = {"a": "int a();\n", "b": "int b();\n", "c": "int c();\n"}
        with mock.patch.object(tidy, "_look_through", wraps=tidy._look_through) as looks, mock.patch.dict(tidy.os.environ, MECHANE_JOBS="1"):
            self.check(**rooms)
            self.assertEqual(looks.call_count, 1)
            self.assertEqual(set(self.check(**rooms).values()), {"passed"})
            self.assertEqual(looks.call_count, 1)
            self.assertEqual(self.check(**rooms | {"b": "int* b = 0;\n"}), {"a": "passed", "b": "failed", "c": "passed"})

    def test_when_the_time_is_up_what_is_not_known_to_be_clean_is_left_out(self):
        self.check(a="int a();\n")
        self.assertEqual(self.check("--seconds", "0", a="int a();\n", b="int b();\n"), {"a": "passed", "b": "too late"})


if __name__ == "__main__":
    sys.exit(unittest.main())
