"""Starts and stops Mechane's programs, on a DDS network of their own."""

import os
import re
import subprocess
import sys
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
START_LIMIT_S = 1200


def network(tag: str) -> dict[str, str]:
    """The environment of programs that talk among themselves alone, over this machine's loopback."""
    return {**os.environ, "CYCLONEDDS_URI": f"file://{ROOT}/deploy/cyclonedds/test.xml", "CYCLONEDDS_TEST_TAG": f"{tag}-{os.getpid()}"}


def stop(process: subprocess.Popen, limit_s: float = 10) -> int | None:
    """The exit status, or None when the process had to be killed."""
    process.terminate()
    try:
        return process.wait(limit_s)
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        return None


def memory_mib(pid: int) -> float | None:
    """What a process holds that is its own: files that are mapped come and go with the system's cache. None where it has ended."""
    try:
        found = re.search(r"^RssAnon:\s+(\d+) kB", Path(f"/proc/{pid}/status").read_text(), re.MULTILINE)
    except OSError:
        return None
    return int(found.group(1)) / 1024 if found else None


class Programs:
    """Running programs, each with a log in `out`; stop_all() at the end, whatever happens."""

    def __init__(self, script: str, bin_dir: Path, out: Path, cwd: Path | None = None):
        self.script, self.bin_dir, self.out, self.cwd, self.environment = script, bin_dir, out, cwd, network(script)
        self.running: dict[str, subprocess.Popen] = {}

    def start(self, name: str, *arguments) -> subprocess.Popen:
        with open(self.out / f"{name}.log", "w") as log:
            self.running[name] = subprocess.Popen([str(self.bin_dir / "mechane"), *map(str, arguments)], env=self.environment, cwd=self.cwd,
                                                  stdout=log, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)
        return self.running[name]

    def wait_ready(self, tell=lambda seconds: None) -> None:
        """Until "server" is ready: the first time it fits the exhibits' parts, which takes minutes. `tell` hears how long it has been."""
        log, started = self.out / "server.log", time.monotonic()
        while " ready: " not in log.read_text(errors="replace"):
            waited = time.monotonic() - started
            if self.running["server"].poll() is not None or waited > START_LIMIT_S:
                sys.exit(f"{self.script}: the server did not start: see {log}\n" + log.read_text(errors="replace")[-2000:])
            tell(waited)
            time.sleep(0.2)

    def wait(self, name: str, limit_s: float) -> int | None:
        """The exit status, or None when the program was still running at the limit."""
        try:
            return self.running[name].wait(limit_s)
        except subprocess.TimeoutExpired:
            return None

    def stop(self, name: str, limit_s: float = 10) -> int | None:
        return stop(self.running[name], limit_s)

    def stop_all(self) -> None:
        for name in self.running:
            self.stop(name)
