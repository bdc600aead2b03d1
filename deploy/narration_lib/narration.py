"""Makes the narration of scenarios: recordings where there are some, drafts of espeak-ng elsewhere. Run by deploy/narration; see there."""

import argparse
import hashlib
import json
import shutil
import sys
from dataclasses import astuple, dataclass, field
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common_lib"))
import sound  # noqa: E402
from scenario_texts import Line, Scenario, Trouble, read_scenario  # noqa: E402
from text import clock, grid  # noqa: E402

ROOT = Path(__file__).resolve().parents[2]
LIST = "narration.json"
FORM = 1  # of what is written; another makes everything anew


@dataclass
class Speaker:
    manner: sound.Manner
    chosen: dict[str, str]  # language -> voice, as asked for
    known: dict[str, str] | None = None  # asked of espeak-ng when the first draft is wanted

    def voice(self, language: str) -> str:
        if self.known is None:
            self.known = sound.voices()
        wanted = self.chosen.get(language, language)
        if wanted not in self.known:
            raise Trouble(f"espeak-ng has no voice '{wanted}'", f"language {language}",
                          f"choose one of `espeak-ng --voices`: --voice {language}=VOICE; or record its narrations")
        return wanted

    def made_of(self, line: Line) -> str:
        voice = self.voice(line.language)
        return _hash(repr((FORM, sound.TREATMENT, self.known[""], voice, astuple(self.manner), line.text)).encode())


@dataclass
class Tally:
    drafts: int = 0
    recordings: int = 0
    made: int = 0
    entries: list[dict] = field(default_factory=list)


def _hash(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()[:32]


def _known_files(folder: Path) -> dict[str, dict]:
    """What the last run left. A damaged list is not a list: all is made anew."""
    try:
        entries = json.loads((folder / LIST).read_text())["files"]
        return {entry["file"]: entry for entry in entries}
    except (OSError, ValueError, KeyError, TypeError):
        return {}


def _entry(line: Line, path: Path, kind: str, made_of: str) -> dict:
    facts = sound.facts(path)
    rounded = {"peak_dbfs": facts.peak_dbfs, "level_dbfs": facts.level_dbfs}
    return {"step": line.step, "language": line.language, "file": path.name, "kind": kind, "seconds": round(facts.seconds, 2),
            **{key: None if value is None else round(value, 1) for key, value in rounded.items()}, "characters": len(line.text),
            "bytes": path.stat().st_size, "made_of": made_of}


def _make(line: Line, folder: Path, speaker: Speaker, known: dict[str, dict], tally: Tally) -> dict:
    kind = "recording" if line.recording else "draft"
    path = folder / (line.name + (line.recording.suffix if line.recording else ".wav"))
    made_of = _hash(line.recording.read_bytes()) if line.recording else speaker.made_of(line)
    entry = known.get(path.name, {})
    if entry.get("made_of") == made_of and entry.get("kind") == kind and path.is_file() and path.stat().st_size == entry.get("bytes"):
        return entry | {"characters": len(line.text)}
    if line.recording:
        sound.facts(line.recording)
        shutil.copyfile(line.recording, path)
    else:
        sound.speak(line, speaker.voice(line.language), speaker.manner, path)
    tally.made += 1
    return _entry(line, path, kind, made_of)


def make_scenario(scenario: Scenario, out: Path, speaker: Speaker) -> Tally:
    folder, tally = out / scenario.id, Tally()
    folder.mkdir(parents=True, exist_ok=True)
    known = _known_files(folder)
    try:
        for line in scenario.lines:
            entry = _make(line, folder, speaker, known, tally)
            tally.entries.append(entry)
            known.pop(entry["file"], None)
            tally.recordings += entry["kind"] == "recording"
            tally.drafts += entry["kind"] == "draft"
        for name in list(known):  # of a step that is gone, or a draft that was recorded; nothing that somebody else put there
            (folder / Path(name).name).unlink(missing_ok=True)
            del known[name]
    finally:  # after a fault, what was there before is still there
        listed = {"scenario": scenario.id, "files": tally.entries + list(known.values())}
        (folder / LIST).write_text(json.dumps(listed, indent=1, ensure_ascii=False) + "\n")
    return tally


def _decibels(value: float | None) -> str:
    return "-" if value is None else f"{value:.1f}"


def _summary(tallies: dict[str, Tally]) -> str:
    rows = [["", "drafts", "recordings", "made now", "min:s", "longest s", "peak dBFS"]]
    for name, tally in tallies.items():
        longest = max((entry["seconds"] for entry in tally.entries), default=0)
        peaks = [entry["peak_dbfs"] for entry in tally.entries if entry["peak_dbfs"] is not None]
        rows.append([name, str(tally.drafts), str(tally.recordings), str(tally.made),
                     clock(sum(entry["seconds"] for entry in tally.entries)), f"{longest:.1f}", _decibels(max(peaks, default=None))])
    every = [entry for tally in tallies.values() for entry in tally.entries]
    if len(tallies) > 1:
        rows.append(["all", *(str(sum(getattr(tally, name) for tally in tallies.values())) for name in ("drafts", "recordings", "made")),
                     clock(sum(entry["seconds"] for entry in every)), f"{max((entry['seconds'] for entry in every), default=0):.1f}", ""])
    return "\n".join(grid(rows, indent=""))


def _listing(tallies: dict[str, Tally]) -> str:
    rows = [["", "kind", "s", "characters/s", "speech dBFS", "peak dBFS"]]
    for name, tally in tallies.items():
        rows += [[f"{name}/{entry['file']}", entry["kind"], f"{entry['seconds']:.1f}", f"{entry['characters'] / entry['seconds']:.1f}",
                  _decibels(entry["level_dbfs"]), _decibels(entry["peak_dbfs"])] for entry in tally.entries]
    return "\n".join(grid(rows, indent=""))


def _voice(text: str) -> tuple[str, str]:
    language, equals, voice = text.partition("=")
    if not (language and equals and voice):
        raise argparse.ArgumentTypeError(f"'{text}' is not LANGUAGE=VOICE, like en=en-us")
    return language, voice


def main() -> int:
    parser = argparse.ArgumentParser(prog="deploy/narration")
    parser.add_argument("scenarios", nargs="*", type=Path, metavar="FILE.x3d", help="none: all that are shipped")
    parser.add_argument("--out", type=Path, default=ROOT / "build/release/narration", help="a folder for each scenario is made there")
    parser.add_argument("--voice", type=_voice, action="append", default=[], metavar="LANGUAGE=VOICE", help="another voice of espeak-ng")
    parser.add_argument("--rate", type=int, default=sound.Manner.rate_wpm, choices=range(80, 451), metavar="80..450", help="words a minute")
    parser.add_argument("--pitch", type=int, default=sound.Manner.pitch, choices=range(100), metavar="0..99", help="of the voice")
    parser.add_argument("--list", action="store_true", help="a line for each file")
    arguments = parser.parse_args()
    speaker = Speaker(sound.Manner(arguments.rate, arguments.pitch), dict(arguments.voice))
    tallies: dict[str, Tally] = {}
    try:
        for file in arguments.scenarios or sorted(ROOT.glob("scenarios/*/*.x3d")):
            scenario = read_scenario(file)
            if scenario.id in tallies:
                raise Trouble(f"another scenario is '{scenario.id}', too", file, "name one of them")
            tallies[scenario.id] = make_scenario(scenario, arguments.out, speaker)
    except Trouble as trouble:
        print(f"narration: {trouble}", file=sys.stderr)
        return 1
    except OSError as error:
        print(f"narration: {error.filename}: {error.strerror}", file=sys.stderr)
        return 1
    print(_listing(tallies) if arguments.list else _summary(tallies))
    return 0


if __name__ == "__main__":
    sys.exit(main())
