"""The examples of the manuals held against the programs: each command line uses subcommands, options and words that --help knows.
What needs nothing but the tree, and no time to speak of, is run; of the rest the programs are asked for nothing but their help."""

import functools
import os
import pathlib
import re
import shlex
import subprocess
import unittest
from dataclasses import dataclass, field

ROOT = pathlib.Path(__file__).resolve().parents[2]
BIN = pathlib.Path(os.environ.get("MECHANE_BIN", ROOT / "build/release/bin"))
HISTORY = {"CHANGELOG.md"}  # what a command was once called stays there

_PROGRAM = re.compile(r"(?:\./)?(?:build/[\w-]+/bin/)?mechane(?:-(?P<name>[a-z]+))?$")
_SCRIPT = re.compile(r"(?:\./)?deploy/(?P<name>[a-z-]+)$")
_OPTION = re.compile(r"(?<![\w-])(--[a-z][a-z0-9-]*|-[a-zA-Z])(?![\w-])")
_PLACEHOLDER = re.compile(r"[A-Z][A-Z_.]*\b|[\[(<$]")


@dataclass
class Help:
    """What a command's --help knows."""

    options: set[str] = field(default_factory=set)
    choices: dict[str, set[str]] = field(default_factory=dict)  # of an option that takes one of some words
    commands: set[str] = field(default_factory=set)
    positionals: bool = False


def parse_help(text):
    found, section = Help(), ""
    for line in text.splitlines():
        if re.match(r"[A-Z]\w*:$", line):
            section = line
        elif section == "Subcommands:" and (match := re.match(r"  ([a-z][\w-]*)\s", line)):
            found.commands.add(match[1])
        elif section == "Options:" and (match := re.match(r"  (-[^\s]+)\s*(?:\w+:\{([^}]+)\})?", line)):
            names = [name.partition("=")[0] for name in match[1].split(",")]
            found.options.update(names)
            if match[2]:
                found.choices.update({name: set(match[2].split(",")) for name in names})
        found.positionals |= section == "Positionals:" or line.startswith("Usage:") and line.rstrip().endswith("...")
    return found


@functools.cache
def help_of(*command):
    program = [str(ROOT / command[0])] if command[0].startswith("deploy/") else [str(BIN / "mechane"), *command[1:]]
    done = subprocess.run([*program, "--help"], capture_output=True, text=True, timeout=30, stdin=subprocess.DEVNULL, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{' '.join(command)} --help ended with {done.returncode}: {done.stderr.strip()}")
    if command[0].startswith("deploy/"):
        return Help(options=set(_OPTION.findall(done.stdout)) | {"--help"}, positionals=True)
    return parse_help(done.stdout)


def option_fault(name, value, known):
    """`known`: the helps of the command and of those it stands under."""
    if not any(name in one.options for one in known):
        return f"no option {name}"
    for one in known:
        words = one.choices.get(name)
        if words and value and not _PLACEHOLDER.match(value) and not set(value.split("|")) <= words:
            return f"{name} does not take '{value}', but one of {', '.join(sorted(words))}"
    return None


def command_faults(words):
    """What is wrong with a command line, or nothing where it is not a command of ours."""
    script, program = _SCRIPT.match(words[0]), _PROGRAM.match(words[0])
    if script and (ROOT / "deploy" / script["name"]).is_dir():
        return []
    if script:
        if not (ROOT / "deploy" / script["name"]).exists():
            return [f"there is no deploy/{script['name']}"]
        path, rest = [f"deploy/{script['name']}"], words[1:]
    elif program:
        path, rest = ["mechane"], ([program["name"]] if program["name"] else []) + words[1:]
    else:
        return []
    known = [help_of(*path)]
    while rest and rest[0] in known[-1].commands:
        path.append(rest.pop(0))
        known.append(help_of(*path))
    if rest and known[-1].commands and not known[-1].positionals and not rest[0].startswith("-") and not _PLACEHOLDER.match(rest[0]):
        return [f"'{' '.join(path)}' has no command '{rest[0]}'"]
    faults = []
    for word, following in zip(rest, [*rest[1:], ""]):
        if re.match(r"--?[a-zA-Z]", word):
            name, _, value = word.strip("[]").partition("=")
            faults.append(option_fault(name, value or following, known))
    return [fault for fault in faults if fault]


def command_lines(text):
    """(line number, words) of all that stands as code: lines of code blocks, and code within a sentence."""
    fenced = False
    for number, line in enumerate(text.splitlines(), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
            continue
        for code in [line] if fenced else re.findall(r"(?<!`)`([^`]+)`(?!`)", line):
            for part in re.split(r"&&|\|(?=\s)|;", code):
                try:
                    words = shlex.split(part, comments=True)
                except ValueError:  # an apostrophe of a language that is not a shell
                    continue
                while words and re.match(r"[A-Z_]+=", words[0]):
                    words.pop(0)
                if words:
                    yield number, words


def pages():
    command = ["git", "-C", str(ROOT), "ls-files", "-co", "--exclude-standard", "*.md"]
    listed = subprocess.run(command, capture_output=True, text=True, check=False)
    found = listed.stdout.split() if listed.returncode == 0 else [str(path.relative_to(ROOT)) for path in ROOT.rglob("*.md")]
    return [ROOT / name for name in sorted(set(found)) if name not in HISTORY and not name.startswith(("build", "out", "tests/fuzz"))]


class Manuals(unittest.TestCase):
    def faults(self, name, text):
        return [f"{name}:{number}: {' '.join(words)}: {fault}" for number, words in command_lines(text) for fault in command_faults(words)]

    def test_each_example_is_known_to_its_program(self):
        faults, examples = [], 0
        for page in pages():
            text = page.read_text()
            faults += self.faults(page.relative_to(ROOT), text)
            examples += sum(1 for _, words in command_lines(text) if _PROGRAM.match(words[0]) or _SCRIPT.match(words[0]))
        self.assertEqual(faults, [])
        self.assertGreater(examples, 100, "the manuals' examples were not found")

    def test_examples_that_need_nothing_but_the_tree_run(self):
        lines = {tuple(words[1:]) for page in pages() for _, words in command_lines(page.read_text()) if _PROGRAM.match(words[0])}
        checks = [line for line in lines if line[0:1] == ("check",) and line[1:]
                  and not any(_PLACEHOLDER.match(word) or re.search(r"^-|\*", word) for word in line)]
        references = [line[:1] for line in lines if line[0:1] == ("reference",)]  # without what takes it up
        self.assertTrue(checks and references, "the manuals' examples were not found")
        for line in sorted({*checks, *references}):
            with self.subTest(line):
                done = subprocess.run([str(BIN / "mechane"), *line], cwd=ROOT, capture_output=True, text=True, timeout=60,
                                      stdin=subprocess.DEVNULL, check=False)
                self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
                self.assertTrue(done.stdout)

    def test_each_option_in_a_sentence_is_known_to_some_program(self):
        commands = [("mechane",), *(("mechane", name) for name in help_of("mechane").commands)]
        commands += [(*command, name) for command in commands[1:] for name in help_of(*command).commands]
        known = [help_of(*command) for command in commands]
        known += [help_of(f"deploy/{path.name}") for path in (ROOT / "deploy").iterdir() if path.is_file() and os.access(path, os.X_OK)]
        for page in pages():
            for number, words in command_lines(page.read_text()):
                if re.match(r"--[a-z]", words[0]):
                    name, _, value = words[0].partition("=")
                    with self.subTest(page=str(page.relative_to(ROOT)), line=number):
                        able = [one for one in known if name in one.options]
                        self.assertIsNone(option_fault(name, value or " ".join(words[1:2]), able))

    def test_each_command_stands_in_the_table_of_commands(self):
        table = (ROOT / "client-sdk/cli/README.md").read_text()
        self.assertEqual([name for name in sorted(help_of("mechane").commands) if f"| `mechane {name}" not in table], [])

    def test_planted_faults_are_found(self):
        planted = ["mechane sever --scenario x.x3d", "mechane server --scenarios x.x3d", "mechane display --stereo cross-eyed",
                   "mechane-display --fullscreen", "build/release/bin/mechane visits --until 2026-11-01", "mechane content ad scenarios",
                   "mechane displays set --volum=1", "./deploy/demo --headles", "deploy/demonstration",
                   "CYCLONEDDS_URI=file:///a.xml mechane haptic --devices virtual"]
        for line in planted:
            for page in (f"```\n{line}  # a remark\n```\n", f"Write `{line}` and see.\n"):
                with self.subTest(page):
                    self.assertEqual(len(self.faults("planted", page)), 1)

    def test_what_only_looks_like_a_fault_is_not(self):
        sound = ["mechane echo TOPIC", "mechane open [SCENARIO] --kiosk KIOSK", "mechane display --stereo sbs", "mechane visits --records out/records",
                 "mechane displays set --kiosk kiosk-1 volume=0.5", "cmake --preset release && cmake --build --preset release", "deploy/decisions",
                 'mechane visits remark k7m2 "laughed aloud"', "auto that's = mechane::client::Client::connect({});"]
        for line in sound:
            with self.subTest(line):
                self.assertEqual(self.faults("sound", f"```\n{line}\n```\n"), [])


if __name__ == "__main__":
    unittest.main(verbosity=2)
