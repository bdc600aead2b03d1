"""Speech of espeak-ng, at one level; and what is known of a sound file."""

import math
import operator
import os
import shutil
import subprocess
import sys
import tempfile
import wave
from array import array
from dataclasses import dataclass
from pathlib import Path

from scenario_texts import Line, Trouble

PROGRAM = "espeak-ng"
LIMIT_S = 60  # for one text
MAX_FILE_BYTES, MAX_S = 64 << 20, 300  # of a recording
RATES = range(8000, 192001)
FULL = 32768
SPEECH_DBFS = -25.0  # what is spoken, pauses left out: nearly every draft gets there before its peaks reach the limit
PEAK_DBFS = -3.0  # never above: headroom for whatever plays it
SILENT_DBFS = -50.0
WINDOW_S = 0.05
LEAD_S, TAIL_S = 0.2, 0.4  # of silence, so that nothing begins with a click or runs into the next
TREATMENT = (SPEECH_DBFS, PEAK_DBFS, SILENT_DBFS, WINDOW_S, LEAD_S, TAIL_S)  # what is done to speech: other values make other drafts


@dataclass(frozen=True)
class Manner:
    """How a draft is spoken: slower than espeak-ng by itself, lower, with a breath between words."""
    rate_wpm: int = 145
    pitch: int = 42  # 0 to 99, 50 is the voice's own
    gap: int = 1  # between words, in hundredths of a second


@dataclass
class Facts:
    seconds: float
    peak_dbfs: float | None  # None: not known, the file is compressed
    level_dbfs: float | None


def _dbfs(value: float) -> float:
    return 20 * math.log10(max(value, 1) / FULL)


def _peak(samples: array) -> int:
    return max(max(samples), -min(samples)) if samples else 0


def _speech_rms(samples: array, rate: int) -> float:
    """Of the windows that are not pauses."""
    size = max(1, int(WINDOW_S * rate))
    powers = [sum(map(operator.mul, window, window)) / len(window)
              for window in (samples[i:i + size] for i in range(0, len(samples), size))]
    loud = [power for power in powers if power > max(powers) * 1e-3]
    return math.sqrt(sum(loud) / len(loud)) if loud else 0


def voices() -> dict[str, str]:
    """Every name by which espeak-ng knows a voice, and its version under ''. Errors: Trouble, when it is not here."""
    if not shutil.which(PROGRAM):
        raise Trouble("there is no espeak-ng on this machine", "narration", "run deploy/install-deps")
    listed = subprocess.run([PROGRAM, "--voices"], capture_output=True, text=True, timeout=LIMIT_S, check=False).stdout
    version = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, timeout=LIMIT_S, check=False).stdout
    found = {"": " ".join(version.split()[:4])}
    for row in listed.splitlines()[1:]:
        columns = row.split(None, 4)
        found[columns[1]] = columns[1]
        for other in columns[4].partition("(")[2].replace("(", " ").split() if len(columns) > 4 else ():
            if other[0].isalpha():
                found[other] = columns[1]
    return found


def _read(path: Path) -> tuple[array, int]:
    """The first channel, and its rate. Errors: Trouble."""
    try:
        with wave.open(str(path), "rb") as file:
            rate, channels, width = file.getframerate(), file.getnchannels(), file.getsampwidth()
            data = file.readframes(file.getnframes())
    except (wave.Error, EOFError, RuntimeError, ValueError) as error:  # wave.py tells a damaged chunk by any of these
        raise Trouble(f"not a wave file: {error or 'it ends too early'}", path, "export it once more, as PCM with 16 bits") from None
    if width != 2 or rate not in RATES:
        raise Trouble(f"{8 * width} bits a sample, {rate} samples a second", path, "export it once more, as PCM with 16 bits and some 8 to 192 kHz")
    samples = array("h", data[:len(data) - len(data) % 2])
    if sys.byteorder == "big":
        samples.byteswap()
    return samples[::channels], rate


def _write(path: Path, samples: array, rate: int) -> None:
    """Whole or not at all."""
    beside = path.with_name(f".{path.name}.{os.getpid()}")
    with wave.open(str(beside), "wb") as file:
        file.setnchannels(1)
        file.setsampwidth(2)
        file.setframerate(rate)
        if sys.byteorder == "big":
            samples.byteswap()
        file.writeframes(samples.tobytes())
    beside.replace(path)


def _trimmed(samples: array, rate: int) -> array:
    size, quiet = max(1, int(0.01 * rate)), FULL * 10 ** (SILENT_DBFS / 20)
    loud = [i for i in range(0, len(samples), size) if _peak(samples[i:i + size]) > quiet]
    if not loud:
        return array("h")
    silence = array("h", [0])
    return silence * int(LEAD_S * rate) + samples[loud[0]:loud[-1] + size] + silence * int(TAIL_S * rate)


def speak(line: Line, voice: str, manner: Manner, path: Path) -> None:
    """Writes a draft: mono, 22 kHz, speech at SPEECH_DBFS where its peaks allow. Errors: Trouble."""
    with tempfile.TemporaryDirectory(dir=path.parent, prefix=".speaking-") as folder:
        raw = Path(folder) / "raw.wav"
        done = subprocess.run([PROGRAM, "-v", voice, "-s", str(manner.rate_wpm), "-p", str(manner.pitch), "-g", str(manner.gap), "-b", "1", "--stdin", "-w",
                               str(raw)], input=line.text.encode(), capture_output=True, timeout=LIMIT_S, check=False)
        if done.returncode or not raw.is_file():
            raise Trouble(f"espeak-ng ended with {done.returncode}: {done.stderr.decode(errors='replace').strip()}", path.name,
                          f"try: {PROGRAM} -v {voice} 'a word'")
        samples, rate = _read(raw)
    samples = _trimmed(samples, rate)
    if not samples:
        raise Trouble("espeak-ng gave silence", path.name, f"try: {PROGRAM} -v {voice} 'a word'")
    gain = min(FULL * 10 ** (SPEECH_DBFS / 20) / _speech_rms(samples, rate), FULL * 10 ** (PEAK_DBFS / 20) / _peak(samples))
    _write(path, array("h", (round(gain * sample) for sample in samples)), rate)


def _ogg_seconds(path: Path) -> float:
    """From the last page's count of samples; Vorbis tells its rate, Opus counts at 48 kHz."""
    data = path.read_bytes()
    first, last = data[:4096], data.rfind(b"OggS")
    vorbis = first.find(b"\x01vorbis")
    rate = int.from_bytes(first[vorbis + 12:vorbis + 16], "little") if vorbis >= 0 else 48000 if b"OpusHead" in first else 0
    samples = int.from_bytes(data[last + 6:last + 14], "little") if last >= 0 else 0
    if not data.startswith(b"OggS") or not rate or not samples:
        raise Trouble("not a whole Ogg file with Vorbis or Opus", path, "export it once more")
    return samples / rate


def facts(path: Path) -> Facts:
    """Length and levels. Errors: Trouble for a file that is not what its name says, is silent or far too long."""
    if path.stat().st_size > MAX_FILE_BYTES:
        raise Trouble("too large for a step's narration", path, f"keep it under {MAX_FILE_BYTES >> 20} MB")
    if path.suffix == ".ogg":
        found = Facts(_ogg_seconds(path), None, None)
    else:
        samples, rate = _read(path)
        if _dbfs(_peak(samples)) < SILENT_DBFS:
            raise Trouble("silent", path, "record it once more, or remove it: then the narration is spoken")
        found = Facts(len(samples) / rate, _dbfs(_peak(samples)), _dbfs(_speech_rms(samples, rate)))
    if found.seconds > MAX_S:
        raise Trouble(f"{found.seconds:.0f} s long", path, f"a step's narration is under {MAX_S} s")
    return found
