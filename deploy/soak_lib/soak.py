"""Runs the programs for long; see deploy/soak. Standard library only."""

import argparse
import json
import os
import re
import subprocess
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "common_lib"))
from growth import LEAST_GROWTH_MIB, LIMIT_MIB_PER_H, growth_of  # noqa: E402
from running import ROOT, Programs, memory_mib  # noqa: E402

SCREW, ODOMETER, VILLAGE = (ROOT / f"scenarios/{name}/{name}.x3d" for name in ("archimedes-screw", "odometer", "village"))
EXHIBITS = (SCREW, ODOMETER)
SAMPLE_EVERY_S = 2
VISIT_LIMIT_S = 300
STOP_LIMIT_S = 30
GATEWAY_LIMIT_S = 60


class Soak(Programs):
    def __init__(self, out: Path, seconds: float):
        super().__init__("soak", ROOT / "build/release/bin", out, cwd=out)
        self.end, self.began = time.monotonic() + seconds, time.monotonic()
        self.samples: dict[str, list[tuple[float, float]]] = {}
        self.visits = {"done": 0, "failed": 0}
        self.faults: list[str] = []
        self.started = 0
        self.next_sample = 0.0

    def start(self, name: str, *words) -> subprocess.Popen:
        self.started += 1
        return super().start(name, *words)

    def stop(self, name: str) -> None:
        ended = self.running[name].poll()
        if ended is not None:
            self.fault(f"{name} ended by itself with status {ended}")
        elif super().stop(name, STOP_LIMIT_S) is None:
            self.fault(f"{name} did not stop within {STOP_LIMIT_S} s")
        del self.running[name]

    def fault(self, text: str) -> None:
        self.faults.append(f"{time.monotonic() - self.began:.0f} s: {text}")
        print(f"soak: {self.faults[-1]}", file=sys.stderr, flush=True)

    def sample(self, names: tuple[str, ...]) -> None:
        now = time.monotonic()
        if now < self.next_sample:
            return
        self.next_sample = now + SAMPLE_EVERY_S
        for name in names:
            process = self.running.get(name)
            held = memory_mib(process.pid) if process and process.poll() is None else None
            if held is not None:
                self.samples.setdefault(name, []).append((now - self.began, held))

    def display(self, name: str, kiosk: str) -> None:
        self.start(name, "display", "--offscreen", "--kiosk", kiosk, "--name", name, "--size", "320x180", "--fps", "5")

    def gateway(self, kiosk: str) -> None:
        """A gateway, and its readers: see readers.py."""
        self.start("gateway", "gateway", "--listen", "127.0.0.1:0", "--kiosk", kiosk, "--state", self.out / "gateway")
        log, end = self.out / "gateway.log", time.monotonic() + GATEWAY_LIMIT_S
        while "\nready" not in log.read_text(errors="replace"):
            if self.wait("gateway", 0.1) is not None or time.monotonic() > end:
                sys.exit(f"soak: the gateway did not start: see {log}")
        port, token = re.search(r"^kiosk \S+: http://[^:]+:(\d+)/\S+\?token=(\S+)", log.read_text(), re.MULTILINE).groups()
        with open(self.out / "readers.log", "w") as said:
            self.running["readers"] = subprocess.Popen(
                [sys.executable, "-B", str(Path(__file__).with_name("readers.py")), "--port", port,
                 "--path", f"/ws/kiosk/{kiosk}?token={token}"],
                stdout=said, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL)

    def kiosk(self, name: str, kiosk: str, guest: bool):
        """One kiosk's day, in steps: a visit after the other, with a display that comes and goes where it is a guest's."""
        count = 0
        while True:
            visitor, display = f"visitor-{name}", f"guest-{name}"
            if guest:
                self.display(display, kiosk)
            scenario = EXHIBITS[count % len(EXHIBITS)]
            if not guest:  # the display that stays goes through all exhibits
                subprocess.run([str(self.bin_dir / "mechane"), "open", scenario.stem, "--kiosk", kiosk], env=self.environment,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, timeout=60)
            count += 1
            process = self.start(visitor, "visitor", "--kiosk", kiosk, "--scenario", scenario)
            limit = time.monotonic() + VISIT_LIMIT_S
            while process.poll() is None and time.monotonic() < limit:
                yield
            if process.poll() is None:
                self.stop(visitor)
                self.fault(f"the visit of {scenario.stem} at {kiosk} did not end")
            else:
                del self.running[visitor]
            self.visits["done" if process.returncode == 0 else "failed"] += 1
            if process.returncode != 0:
                self.fault(f"the visit of {scenario.stem} at {kiosk} failed: see visitor-{name}.log")
                os.replace(self.out / f"{visitor}.log", self.out / f"{visitor}-failed-{count}.log")
            if guest:
                self.stop(display)

    def run(self) -> None:
        self.start("server", "server", "--scenario", VILLAGE, *EXHIBITS, "--worlds", "4", "--records", self.out / "records")
        self.wait_ready()
        self.began = time.monotonic()
        self.display("wall", "kiosk-1")
        self.gateway("kiosk-1")
        days = [self.kiosk("one", "kiosk-1", False), self.kiosk("two", "kiosk-2", True)]
        lasting, measured = ("server", "wall", "gateway", "readers"), ("server", "wall", "gateway")
        shown = self.began
        while time.monotonic() < self.end:
            for day in days:
                next(day)
            self.sample(measured)
            for name in lasting:
                if self.running[name].poll() is not None:
                    return self.fault(f"{name} ended by itself with status {self.running[name].returncode}")
            if time.monotonic() - shown >= 60:
                shown = time.monotonic()
                held = ", ".join(f"{name} {self.samples[name][-1][1]:.1f} MiB" for name in measured if name in self.samples)
                print(f"  {(shown - self.began) / 60:5.1f} min  {held}; {self.visits['done']} visits", flush=True)
            time.sleep(0.1)

    def stop_all(self) -> None:
        for name in reversed(list(self.running)):
            process = self.running[name]
            if name.startswith("visitor") and process.poll() is None:
                process.kill()
                process.wait()
                del self.running[name]
            else:
                self.stop(name)


def report(soak: Soak, minutes: float) -> bool:
    rows, good = {}, not soak.faults
    for name, samples in soak.samples.items():
        if len(samples) < 10:
            soak.fault(f"{name}: too short a run to judge")
            good = False
            continue
        growth = growth_of(samples)
        good = good and growth.good
        rows[name] = {"first_mib": round(growth.first_mib, 2), "last_mib": round(growth.last_mib, 2), "peak_mib": round(max(m for _, m in samples), 2),
                      "slope_mib_per_h": round(growth.slope_mib_per_h, 2), "grown_mib": round(growth.grown_mib, 2),
                      "allowed_mib": round(growth.allowed_mib, 2), "judged_h": round(growth.judged_h, 3), "good": growth.good}
    good = good and bool(rows) and soak.visits["done"] > 0
    (soak.out / "soak.json").write_text(json.dumps({
        "minutes": minutes, "limit_mib_per_h": LIMIT_MIB_PER_H, "least_growth_mib": LEAST_GROWTH_MIB, "programs_started": soak.started,
        "visits": soak.visits, "faults": soak.faults, "memory": rows, "samples": soak.samples, "good": good}, indent=1) + "\n")
    print(f"\n{'':8}{'first MiB':>11}{'last':>9}{'peak':>9}{'MiB/h':>9}{'grown':>9}{'allowed':>9}")
    for name, row in rows.items():
        print(f"{name:8}{row['first_mib']:11.1f}{row['last_mib']:9.1f}{row['peak_mib']:9.1f}{row['slope_mib_per_h']:9.1f}{row['grown_mib']:9.2f}"
              f"{row['allowed_mib']:9.2f}{'' if row['good'] else '  GROWS'}")
    print(f"{soak.visits['done']} visits done, {soak.visits['failed']} failed; {soak.started} programs started; {len(soak.faults)} faults; "
          f"written: {soak.out.relative_to(ROOT)}/soak.json")
    return good


def main() -> int:
    parser = argparse.ArgumentParser(prog="deploy/soak")
    parser.add_argument("--minutes", type=float, default=60)
    minutes = parser.parse_args().minutes
    out = ROOT / "out/soak"
    out.mkdir(parents=True, exist_ok=True)
    soak = Soak(out, 60 * minutes)
    try:
        soak.run()
    except KeyboardInterrupt:
        print("soak: interrupted; what there is, is judged")
    finally:
        soak.stop_all()
    return 0 if report(soak, minutes) else 1


if __name__ == "__main__":
    sys.exit(main())
