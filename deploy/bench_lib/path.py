"""The motion-to-force path: what a tick costs, how long a movement takes to become a force, how late the loop wakes; each against
its peer in the same run, in rounds, so that a slow minute of the machine falls on both."""

import contextlib
import os
import shutil
import time
from pathlib import Path

from peers import LOOP_PRIORITY, Measured, Missing, cyclictest, ddsperf, over_rounds, own
from plots import bars, tails
from running import Programs, network

AIMS = {"ratio.rtt_udp.median": (("under", 1.5),)}
ROUNDS = 3
WIRE_PRIORITY = 50  # who asks and who answers in a round trip
SCENARIO = "scenarios/archimedes-screw/archimedes-screw.x3d"
PHASES = ["take_inputs", "move_hands", "find_contacts", "run_agents", "render_forces", "run_machines", "step_dynamics", "publish"]


@contextlib.contextmanager
def _server(context):
    """mechane-server with the screw's scenario, for as long as a round trip is measured."""
    if not (context.bin / "mechane").exists():
        raise Missing(f"mechane missing in {context.bin}: it was not built")
    records = context.out / "path-records"
    shutil.rmtree(records, ignore_errors=True)
    programs = Programs("bench", context.bin, context.out)
    server = programs.start("path-server", "server", "--scenario", SCENARIO, "--worlds", 1, "--records", records,
                            "--fifo-priority", LOOP_PRIORITY)
    try:
        time.sleep(0.2)  # long enough to see one that ends at once; a client waits for the server by itself
        if server.poll() is not None:
            raise Missing(f"mechane-server ended with {server.returncode}: {(context.out / 'path-server.log').read_text()[-400:]}")
        yield
    finally:
        programs.stop_all()


def measure_tick(context) -> Measured:
    return own(context.bin, "bench_tick", ["--scenario", SCENARIO, "--seconds", str(context.seconds), "--priority", str(LOOP_PRIORITY)],
               context.seconds)


def measure_wake(context) -> Measured:
    cpu, each = max(os.sched_getaffinity(0)), context.seconds / ROUNDS
    ours, theirs = [], []
    for _ in range(ROUNDS):
        ours.append(own(context.bin, "bench_wake", ["--priority", str(LOOP_PRIORITY), "--cpu", str(cpu), "--seconds", str(each)], each))
        theirs.append(cyclictest(each, LOOP_PRIORITY, cpu))
    return _join(over_rounds(ours), over_rounds(theirs))


def measure_round_trip(context) -> Measured:
    each = context.seconds / ROUNDS
    ours, udp, perf = [], [], []
    for _ in range(ROUNDS):
        with _server(context):
            ours.append(own(context.bin, "bench_rtt", ["--priority", str(WIRE_PRIORITY), "--seconds", str(each)], each, network("bench")))
        sizes = ours[-1].metrics
        udp.append(own(context.bin, "udp_pingpong", ["--priority", str(WIRE_PRIORITY), "--seconds", str(each), "--out",
                                                     str(int(sizes["bytes.input"])), "--back", str(int(sizes["bytes.output"]))], each))
        perf.append(ddsperf(each, WIRE_PRIORITY, int(sizes["bytes.input"]), 77, network("bench")))
    result = _join(_join(over_rounds(ours), over_rounds(udp)), over_rounds(perf))
    numbers = result.metrics
    numbers["ratio.rtt_udp.median"] = numbers["rtt_us.median"] / numbers["udp_us.median"]
    numbers["ratio.rtt_udp.p99"] = numbers["rtt_us.p99"] / numbers["udp_us.p99"]
    numbers["ratio.rtt_ddsperf.median"] = numbers["rtt_us.median"] / numbers["ddsperf_us.median"]
    result.notes.append(f"ddsperf sends {int(sizes['bytes.input'])} bytes both ways; its figures are the median of its seconds")
    return result


def _join(one: Measured, other: Measured) -> Measured:
    return Measured({**one.metrics, **other.metrics}, {**one.curves, **other.curves}, list(dict.fromkeys(one.notes + other.notes)))


def measure(context) -> tuple[Measured, list[str]]:
    """Everything that could be measured, and what could not."""
    result, missing = Measured(), []
    for name, part in (("tick", measure_tick), ("round trip", measure_round_trip), ("wake-up", measure_wake)):
        print(f"  {name} ...", flush=True)
        try:
            result = _join(result, part(context))
        except Missing as reason:
            missing.append(f"{name}: {reason}")
    return result, missing


def plot(result: Measured, out: Path, machine: str) -> list[Path]:
    made = []
    phases = [(name, result.metrics[f"phase_us.{name}.median"]) for name in PHASES if f"phase_us.{name}.median" in result.metrics]
    if phases:
        made.append(out / "path-phases.svg")
        whole = result.metrics["tick_us.median"]
        bars(made[-1], "Where a tick's time goes", f"median of each phase; the whole tick {whole:.1f} µs. {machine}", phases, "µs")
    trips = {"Mechane, motion to force": "rtt_us", "raw UDP": "udp_us"}
    wakes = {"Mechane's loop": "wake_us", "cyclictest": "wake_us.cyclictest"}
    for file, title, names in (("path-round-trip.svg", "Round trip between two processes", trips),
                               ("path-wake.svg", "How late a 1 kHz thread wakes", wakes)):
        series = {label: result.curves[name] for label, name in names.items() if name in result.curves}
        if series:
            made.append(out / file)
            tails(made[-1], title, machine, series)
    return made
