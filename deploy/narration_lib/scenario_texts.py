"""What a scenario's steps say aloud, and where somebody recorded it. Reads X3D with the standard library; `mechane check` says more."""

import difflib
import re
import xml.etree.ElementTree as ElementTree
from dataclasses import dataclass, field
from pathlib import Path

MAX_FILE_BYTES = 16 << 20
MAX_CHARACTERS = 2000  # of one text: two minutes of speech
SOUNDS = (".wav", ".ogg")
NOT_SOUNDS = (".md", ".txt")  # may lie beside recordings: who speaks, under which licence
_NAME = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_-]{0,63}")
_LANGUAGE = re.compile(r"[a-z]{2,3}(-[A-Za-z0-9]{2,8})*")
_QUOTED = re.compile(r'"((?:[^"\\]|\\.)*)"')


class Trouble(Exception):
    """What went wrong, where, and what to do about it."""

    def __init__(self, what: str, where: object, remedy: str):
        super().__init__(f"{where}: {what}\n  {remedy}")


@dataclass
class Line:
    """One step's narration in one language."""
    step: str
    language: str
    text: str
    recording: Path | None = None

    @property
    def name(self) -> str:
        return f"{self.step}.{self.language}"


@dataclass
class Scenario:
    id: str
    file: Path
    lines: list[Line] = field(default_factory=list)


def _string(element: ElementTree.Element) -> str:
    """X3D writes a list of strings, each in quotes; a person may have left them out."""
    value = element.get("value") or ""
    found = _QUOTED.findall(value)
    text = " ".join(re.sub(r"\\(.)", r"\1", part) for part in found) if found else value
    return " ".join(text.split())


def _child(element: ElementTree.Element | None, name: str) -> ElementTree.Element | None:
    return next((child for child in element if child.get("name") == name), None) if element is not None else None


def _steps(root: ElementTree.Element) -> list[ElementTree.Element]:
    settings = next((node for node in root.iter("MetadataSet") if node.get("name") == "mechane:scenario"), None)
    activities = _child(settings, "activities")
    return [step for activity in (activities if activities is not None else ()) for step in (_child(activity, "steps") or ())]


def _fitting(name: str, pattern: re.Pattern, kind: str, file: Path) -> str:
    if not pattern.fullmatch(name):
        raise Trouble(f"'{name}' is not a {kind} that a file can be named by", file, "use letters, digits, '-' and '_'")
    return name


def _step_lines(scenario: Scenario, step: ElementTree.Element) -> list[Line]:
    lines, texts, file = [], _child(step, "text"), scenario.file
    for element in texts if texts is not None else ():
        kind, _, language = (element.get("name") or "").partition(".")
        text = _string(element)
        if kind != "narration" or not text:
            continue
        if len(text) > MAX_CHARACTERS:
            raise Trouble(f"the narration of step {step.get('name')} has {len(text)} characters", file, f"keep it under {MAX_CHARACTERS}")
        line = Line(_fitting(step.get("name") or "", _NAME, "step", file), _fitting(language, _LANGUAGE, "language", file), text)
        written = _child(texts, f"audio.{language}")
        if written is not None and _string(written):
            line.recording = _named_recording(_string(written), line, file)
        lines.append(line)
    return lines


def _named_recording(uri: str, line: Line, file: Path) -> Path:
    path = (file.parent / uri).resolve()
    if not path.is_relative_to(file.parent.resolve()) or path.suffix not in SOUNDS or not path.is_file():
        raise Trouble(f"audio.{line.language} of step {line.step} names '{uri}', which is not a sound beside the scenario", file,
                      "put an .ogg or .wav file there, or remove the key: then the narration is spoken")
    return path


def _add_recordings(scenario: Scenario) -> None:
    """Files of audio/ by their names; one that nobody would play is a mistake."""
    folder = scenario.file.parent / "audio"
    by_name = {line.name: line for line in scenario.lines}
    named = {line.recording for line in scenario.lines}
    for path in sorted(folder.iterdir()) if folder.is_dir() else ():
        if path.name.startswith(".") or path.suffix in NOT_SOUNDS or path.resolve() in named:
            continue
        if path.suffix not in SOUNDS:
            raise Trouble("a recording is an .ogg or .wav file", path, "convert it, or keep it elsewhere")
        line = by_name.get(path.stem)
        if line is None:
            near = difflib.get_close_matches(path.stem, by_name, 1)
            raise Trouble(f"no step of {scenario.id} has a narration '{path.stem}'", path,
                          f"is it {near[0]}{path.suffix}?" if near else "name it STEP.LANGUAGE, as in the scenario")
        if line.recording is not None:
            raise Trouble(f"{line.name} is recorded twice, here and in {line.recording.name}", path, "keep one")
        line.recording = path


def read_scenario(file: Path) -> Scenario:
    """Errors: Trouble."""
    if file.is_dir():
        found = next((pattern for pattern in ("*.x3d", "*/*.x3d") if any(file.glob(pattern))), None)
        raise Trouble("this is a folder", file, f"name its scenarios: {file}/{found}" if found else "no scenario (.x3d) is in it")
    try:
        if file.stat().st_size > MAX_FILE_BYTES:
            raise Trouble("too large for a scenario", file, "meshes belong into files of their own")
        root = ElementTree.parse(file).getroot()
    except OSError as error:
        raise Trouble(f"cannot be read: {error.strerror}", file, "check the path") from None
    except (ElementTree.ParseError, ValueError, LookupError) as error:  # the latter two: encodings
        raise Trouble(f"not XML: {error}", file, "run: mechane check") from None
    settings = next((node for node in root.iter("MetadataSet") if node.get("name") == "mechane:scenario"), None)
    written = _child(settings, "id")
    scenario = Scenario(_fitting(_string(written) if written is not None else file.stem, _NAME, "scenario", file), file)
    for step in _steps(root):
        scenario.lines += _step_lines(scenario, step)
    names = [line.name for line in scenario.lines]
    twice = next((name for name in names if names.count(name) > 1), None)
    if twice:
        raise Trouble(f"two steps would speak as {twice}", file, "give one of the steps another name")
    _add_recordings(scenario)
    return scenario
