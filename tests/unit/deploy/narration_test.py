"""deploy/narration: every step that has a narration is spoken in each of its languages, at one level, as long as its text is; a recording
takes its draft's place; and what is wrong is said with a remedy. Needs espeak-ng; without it the test is skipped."""

import json
import os
import random
import shutil
import subprocess
import sys
import tempfile
import unittest
import wave
from pathlib import Path

ROOT = Path(__file__).resolve().parents[3]
SKIPPED = 77  # CTest's SKIP_RETURN_CODE
sys.path.insert(0, str(ROOT / "deploy/narration_lib"))

from scenario_texts import Trouble, read_scenario  # noqa: E402
from sound import facts  # noqa: E402

# A voice takes some 60 to 110 ms for a letter, its pauses included; short texts have relatively more silence around them.
LEAST_S_PER_CHARACTER, MOST_S_PER_CHARACTER, SILENCE_S = 0.045, 0.13, 0.6


def scenario(steps: str, languages: str = "en") -> str:
    return f"""<?xml version="1.0" encoding="UTF-8"?>
<X3D version="4.0"><Scene><WorldInfo><MetadataSet name="mechane:scenario">
  <MetadataString containerField="value" name="id" value='"little"'/>
  <MetadataString containerField="value" name="languages" value='"{languages}"'/>
  <MetadataSet containerField="value" name="activities"><MetadataSet containerField="value" name="use">
    <MetadataSet containerField="value" name="steps">{steps}</MetadataSet>
  </MetadataSet></MetadataSet>
</MetadataSet></WorldInfo></Scene></X3D>"""


def step(name: str, **texts: str) -> str:
    lines = "".join(f"""<MetadataString containerField="value" name="{key.replace("__", ".")}" value='"{value}"'/>""" for key, value in texts.items())
    return f'<MetadataSet containerField="value" name="{name}"><MetadataSet containerField="value" name="text">{lines}</MetadataSet></MetadataSet>'


def tone(path: Path, amplitude: int = 9000, seconds: float = 0.5) -> None:
    with wave.open(str(path), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(22050)
        half = 25  # samples of a square wave's half: 441 Hz
        file.writeframes(b"".join((amplitude if (i // half) % 2 else -amplitude).to_bytes(2, "little", signed=True) for i in range(int(22050 * seconds))))


OGG = (b"OggS" + bytes(2) + (0).to_bytes(8, "little") + bytes(14) + b"\x01vorbis" + bytes(4) + b"\x01" + (44100).to_bytes(4, "little")
       + b"OggS" + bytes(2) + (88200).to_bytes(8, "little") + bytes(14))  # the pages that tell a length


def damaged(data: bytes, draw: random.Random) -> bytes:
    """Some bytes changed, most of them near the start, where headers are; or cut short."""
    changed = bytearray(data[:draw.randrange(len(data) + 1)] if draw.random() < 0.4 else data)
    for _ in range(draw.randrange(1, 6) if changed else 0):
        changed[draw.randrange(min(len(changed), draw.choice((48, len(changed)))))] = draw.randrange(256)
    return bytes(changed)


def run(*arguments: object, **environment: str) -> subprocess.CompletedProcess:
    return subprocess.run([ROOT / "deploy/narration", *map(str, arguments)], capture_output=True, text=True, check=False,
                          env={**os.environ, **environment})


class Shipped(unittest.TestCase):
    """What the build's own target makes, or has made."""

    @classmethod
    def setUpClass(cls):
        cls.out = Path(os.environ["MECHANE_NARRATION"])
        done = run("--out", cls.out)
        assert done.returncode == 0, done.stderr

    def test_every_narration_has_a_file_that_is_as_long_as_its_text_and_as_loud_as_the_others(self):
        count = 0
        for file in sorted(ROOT.glob("scenarios/*/*.x3d")):
            read = read_scenario(file)
            self.assertTrue(read.lines, file)
            listed = {(entry["step"], entry["language"]): entry for entry in json.loads((self.out / read.id / "narration.json").read_text())["files"]}
            self.assertEqual(len(listed), len(read.lines))
            for line in read.lines:
                entry = listed[line.step, line.language]
                with self.subTest(f"{read.id} {line.name}"):
                    self.assertGreater((self.out / read.id / entry["file"]).stat().st_size, 10000)
                    if entry["kind"] == "draft":
                        self.assert_spoken(self.out / read.id / f"{line.name}.wav", line.text, entry)
                    count += 1
        self.assertGreaterEqual(count, 2 * 9, "nine exhibits, two languages")

    def assert_spoken(self, path: Path, text: str, entry: dict):
        with wave.open(str(path), "rb") as file:
            self.assertEqual((file.getnchannels(), file.getsampwidth(), file.getframerate()), (1, 2, 22050))
            seconds = file.getnframes() / file.getframerate()
        self.assertAlmostEqual(seconds, entry["seconds"], delta=0.01)
        self.assertGreater(seconds - SILENCE_S, LEAST_S_PER_CHARACTER * len(text))
        self.assertLess(seconds - SILENCE_S, MOST_S_PER_CHARACTER * len(text) + 1)
        self.assertLessEqual(entry["peak_dbfs"], -2.9)
        self.assertGreater(entry["level_dbfs"], -28)
        self.assertLess(entry["level_dbfs"], -24)

    def test_each_language_of_a_scenario_speaks_in_every_step_that_speaks(self):
        for file in sorted(ROOT.glob("scenarios/*/*.x3d")):
            steps: dict[str, set[str]] = {}
            for line in read_scenario(file).lines:
                steps.setdefault(line.step, set()).add(line.language)
            for name, languages in steps.items():
                self.assertEqual(languages, {"el", "en"}, f"{file.name} {name}")


class Little(unittest.TestCase):
    def setUp(self):
        self.folder = Path(self.enterContext(tempfile.TemporaryDirectory()))
        self.file, self.audio, self.out = self.folder / "little.x3d", self.folder / "audio", self.folder / "out"
        self.made = self.out / "little"
        self.write(step("turn", narration__en="Turn the crank, and the water rises."))

    def write(self, steps: str):
        self.file.write_text(scenario(steps))

    def make(self, *arguments: object, **environment: str) -> subprocess.CompletedProcess:
        done = run(self.file, "--out", self.out, *arguments, **environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def refuse(self, *said: str, arguments: tuple = (), **environment: str):
        done = run(self.file, "--out", self.out, *arguments, **environment)
        self.assertEqual(done.returncode, 1, done.stdout)
        self.assertNotIn("Traceback", done.stderr)
        for text in said:
            self.assertIn(text, done.stderr)

    def files(self) -> set[str]:
        return {path.name for path in self.made.iterdir()} - {"narration.json"}

    def entry(self, number: int = 0) -> dict:
        return json.loads((self.made / "narration.json").read_text())["files"][number]

    def test_only_what_changed_is_spoken_again(self):
        second = step("fill", narration__en="It fills.")
        self.write(step("turn", narration__en="Turn the crank.") + second)
        self.make()
        draft = self.made / "turn.en.wav"
        before, other = draft.read_bytes(), (self.made / "fill.en.wav").stat().st_mtime_ns
        draft.touch()
        touched = draft.stat().st_mtime_ns
        self.make()
        self.assertEqual(draft.stat().st_mtime_ns, touched, "nothing changed")
        self.write(step("turn", narration__en="Turn the crank quickly, please.") + second)
        self.make()
        self.assertNotEqual(draft.read_bytes(), before)
        self.assertEqual((self.made / "fill.en.wav").stat().st_mtime_ns, other)
        self.make("--voice", "en=en-us")
        self.assertNotEqual((self.made / "fill.en.wav").stat().st_mtime_ns, other, "another voice speaks all anew")

    def test_a_recording_takes_the_drafts_place_and_gives_it_back(self):
        self.make()
        draft = (self.made / "turn.en.wav").read_bytes()
        self.audio.mkdir()
        tone(self.audio / "turn.en.wav")
        self.make()
        self.assertEqual((self.made / "turn.en.wav").read_bytes(), (self.audio / "turn.en.wav").read_bytes())
        self.assertEqual(self.entry()["kind"], "recording")
        (self.audio / "turn.en.wav").unlink()
        self.make()
        self.assertEqual((self.made / "turn.en.wav").read_bytes(), draft)
        self.assertEqual(self.entry()["kind"], "draft")

    def test_a_compressed_recording_takes_the_drafts_place_under_its_own_name(self):
        self.make()
        self.audio.mkdir()
        (self.audio / "turn.en.ogg").write_bytes(OGG)
        self.make()
        self.assertEqual(self.files(), {"turn.en.ogg"}, "the draft is gone")
        self.assertEqual(self.entry()["seconds"], 2)

    def test_a_key_of_the_scenario_may_name_the_recording(self):
        self.audio.mkdir()
        tone(self.audio / "take-three.wav")
        self.write(step("turn", narration__en="Turn.", audio__en="audio/take-three.wav"))
        self.make()
        self.assertEqual((self.made / "turn.en.wav").read_bytes(), (self.audio / "take-three.wav").read_bytes())
        self.write(step("turn", narration__en="Turn.", audio__en="../take-three.wav"))
        self.refuse("../take-three.wav", "beside the scenario")

    def test_what_belongs_to_a_step_that_is_gone_goes_and_what_others_put_there_stays(self):
        self.make()
        (self.made / "notes.txt").write_text("mine")
        self.write(step("pull", narration__en="Pull."))
        self.make()
        self.assertEqual(self.files(), {"pull.en.wav", "notes.txt"})

    def test_a_recording_that_nobody_would_hear_is_named_with_what_it_may_be(self):
        self.audio.mkdir()
        tone(self.audio / "trun.en.wav")
        self.refuse("trun.en", "is it turn.en.wav?")
        (self.audio / "trun.en.wav").rename(self.audio / "turn.en.mp3")
        self.refuse("turn.en.mp3", ".ogg or .wav")

    def test_damaged_silent_and_double_recordings_are_refused(self):
        self.audio.mkdir()
        wav = self.audio / "turn.en.wav"
        wav.write_bytes(b"RIFF....WAVEnothing")
        self.refuse("turn.en.wav", "not a wave file")
        tone(wav, amplitude=10)
        self.refuse("turn.en.wav", "silent")
        tone(wav)
        (self.audio / "turn.en.ogg").write_bytes(b"OggS")
        self.refuse("recorded twice")
        wav.unlink()
        self.refuse("turn.en.ogg", "not a whole Ogg file")

    def test_a_missing_voice_is_named_with_the_remedy_and_a_recording_needs_none(self):
        self.write(step("turn", narration__grc="Στρέφε."))
        self.refuse("no voice 'tlh-nowhere'", "espeak-ng --voices", arguments=("--voice", "grc=tlh-nowhere"))
        self.audio.mkdir()
        tone(self.audio / "turn.grc.wav")
        self.make("--voice", "grc=tlh-nowhere")

    def test_without_espeak_the_package_list_is_the_remedy(self):
        tools = self.folder / "tools"
        tools.mkdir()
        for name in ("bash", "python3", "dirname"):
            (tools / name).symlink_to(shutil.which(name))
        self.refuse("no espeak-ng", "deploy/install-deps", PATH=str(tools))

    def test_a_step_cannot_write_elsewhere(self):
        self.write(step("../turn", narration__en="Turn."))
        self.refuse("'../turn' is not a step")
        self.file.write_text(self.file.read_text().replace('"little"', '"../little"'))
        self.refuse("'../little' is not a scenario")

    def test_faulty_files_are_told(self):
        self.write(step("turn", narration__en="Turn.") * 2)
        self.refuse("two steps would speak as turn.en")
        self.write(step("turn", narration__en="a" * 2001))
        self.refuse("2001 characters")
        self.file.write_text("<X3D>")
        self.refuse("not XML", "mechane check")
        self.file.unlink()
        self.refuse("cannot be read")
        self.file.mkdir()
        self.refuse("this is a folder", "no scenario (.x3d) is in it")
        (self.file / "b.x3d").write_text("<X3D/>")
        self.refuse("this is a folder", "*.x3d")

    def test_whatever_the_bytes_a_fault_is_told_and_nothing_else_is_raised(self):
        draw = random.Random(20261121)
        whole = {"a.x3d": scenario(step("turn", narration__en="Turn.", audio__en="audio/a.wav")).encode(), "a.ogg": OGG}
        tone(self.folder / "a.wav", seconds=0.05)
        whole["a.wav"] = (self.folder / "a.wav").read_bytes()
        reads = {".x3d": read_scenario, ".wav": facts, ".ogg": facts}
        told = 0
        for _ in range(600):
            for name, data in whole.items():
                path = self.folder / name
                path.write_bytes(damaged(data, draw))
                try:
                    reads[path.suffix](path)
                except Trouble:
                    told += 1
        self.assertGreater(told, 600)

    def test_quotes_and_lists_of_strings_read_as_one_text(self):
        self.file.write_text(scenario(step("turn", narration__en="Q")).replace("""'"Q"'""", """'"Say \\"now\\"," "and\n turn."'"""))
        self.assertEqual(read_scenario(self.file).lines[0].text, 'Say "now", and turn.')
        self.write(step("", narration__en="Turn."))
        with self.assertRaises(Trouble):
            read_scenario(self.file)


if __name__ == "__main__":
    if not shutil.which("espeak-ng"):
        print("no espeak-ng: deploy/install-deps brings it")
        sys.exit(SKIPPED)
    unittest.main()
