"""Runs one command at a time, with its output in a log, and leaves no process of it behind."""

import ctypes
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common_lib"))
from text import clock  # noqa: E402

_PR_SET_CHILD_SUBREAPER = 36
PAST_LIMIT = 124  # as timeout(1) has it


def adopt_orphans() -> None:
    """From now on a grandchild whose parent dies becomes our child, so that it can be found and ended."""
    ctypes.CDLL(None, use_errno=True).prctl(_PR_SET_CHILD_SUBREAPER, 1, 0, 0, 0)


def _children(spared: int) -> dict[int, str]:
    """Our living children but for one, by process id, with their command names."""
    found = {}
    for entry in Path("/proc").iterdir():
        if not entry.name.isdigit():
            continue
        try:
            stat = (entry / "stat").read_text()
        except OSError:
            continue
        name = stat[stat.index("(") + 1:stat.rindex(")")]
        state, parent = stat[stat.rindex(")") + 2:].split()[:2]
        if int(parent) == os.getpid() and state != "Z" and int(entry.name) != spared:
            found[int(entry.name)] = name
    return found


def _reap() -> None:
    try:
        while os.waitpid(-1, os.WNOHANG)[0]:
            pass
    except ChildProcessError:
        pass


def end_leftovers(grace_s: float = 3.0, spared: int = 0) -> list[str]:
    """Ends what a finished command left running, but for the process `spared`, and returns the names; gives each a moment to end by itself
    first."""
    deadline = time.monotonic() + grace_s
    while _children(spared) and time.monotonic() < deadline:
        _reap()
        time.sleep(0.05)
    left: list[str] = []
    while children := _children(spared):  # the children of those that we end become ours in turn
        left += children.values()
        for pid in children:
            try:
                os.kill(pid, signal.SIGKILL)
            except ProcessLookupError:
                pass
        time.sleep(0.05)
        _reap()
    return left


def _last_line(log: Path) -> str:
    with log.open("rb") as file:
        file.seek(max(0, log.stat().st_size - 400))
        lines = [line.strip() for line in file.read().decode(errors="replace").splitlines() if line.strip()]
    return lines[-1][:90] if lines else ""


def _show_progress(log: Path, started: float, shown: float) -> float:
    """On a terminal the newest line of the log, in place; in a file a line a minute."""
    now = time.monotonic()
    elapsed = clock(now - started)
    if sys.stdout.isatty():
        print(f"\r\033[K      {elapsed}  {_last_line(log)}", end="", flush=True)
        return now
    if now - shown >= 60:
        print(f"      {elapsed}  {_last_line(log)}", flush=True)
        return now
    return shown


def _end_group(process: subprocess.Popen) -> None:
    try:
        os.killpg(process.pid, signal.SIGKILL)
    except ProcessLookupError:
        pass
    process.wait()


def _leave_time_to_others() -> None:
    """In the new process: it runs when nobody else wants to. Each session is a scheduling group of its own where the kernel groups them."""
    os.sched_setscheduler(0, os.SCHED_IDLE, os.sched_param(0))
    try:
        Path("/proc/self/autogroup").write_text("19")
    except OSError:
        pass


class Beside:
    """A command that runs beside others, on the time that they leave, until it is ended."""

    def __init__(self, command: list[str], log: Path):
        with log.open("a") as out:
            out.write(f"$ {' '.join(command)}\n")
            out.flush()
            self._process = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                             start_new_session=True, preexec_fn=_leave_time_to_others)

    @property
    def pid(self) -> int:
        return self._process.pid

    def end(self) -> None:
        """As an interrupt by hand: a build ends its compilers and removes what they had half written. When idle, it takes its time."""
        deadline = time.monotonic() + 60
        try:
            os.killpg(self._process.pid, signal.SIGTERM)
            while time.monotonic() < deadline:
                _reap()
                os.killpg(self._process.pid, 0)
                time.sleep(0.05)
        except ProcessLookupError:
            pass  # all of it has ended
        _end_group(self._process)


def run(command: list[str], log: Path, limit_s: float, env: dict[str, str] | None = None) -> int:
    """Returns the exit status; PAST_LIMIT where the command ran past its limit and was ended. Appends to the log."""
    with log.open("a") as out:
        out.write(f"$ {' '.join(command)}\n")
        out.flush()
        process = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL,
                                   start_new_session=True, env={**os.environ, **(env or {})})
        started = shown = time.monotonic()
        try:
            while True:
                try:
                    return process.wait(timeout=1.0)
                except subprocess.TimeoutExpired:
                    shown = _show_progress(log, started, shown)
                if time.monotonic() - started > limit_s:
                    out.write(f"\nended after {limit_s:.0f} s\n")
                    return PAST_LIMIT
        finally:
            if process.poll() is None:
                _end_group(process)
            if sys.stdout.isatty():
                print("\r\033[K", end="", flush=True)
