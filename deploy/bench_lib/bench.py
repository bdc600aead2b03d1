"""Runs benchmarks by name and writes what they found: JSON, a table, plots. Run by deploy/bench; see there."""

import argparse
import json
import os
import subprocess
import sys
import time
from dataclasses import dataclass, replace
from pathlib import Path

import against
import aims
import collision
import display
import fields
import gateway
import haptics
import machine
import path
import studio
import worlds
from peers import Measured
from plots import number

ROOT = Path(__file__).resolve().parents[2]
BENCHMARKS = {"path": path, "collision": collision, "fields": fields, "haptics": haptics, "worlds": worlds, "display": display,
              "gateway": gateway, "studio": studio}


@dataclass
class Context:
    root: Path
    bin: Path
    out: Path
    seconds: float
    seed: int | None


def build(root: Path, out: Path) -> None:
    log = out / "build.log"
    print(f"bench: building {machine.commit(root)} for release", flush=True)
    with log.open("w") as file:
        for command in (["cmake", "--preset", "release"],
                        ["cmake", "--build", "build/release", "-j", str(os.cpu_count()), "--target", "benchmarks", "mechane_programs"]):
            if subprocess.run(command, cwd=root, stdout=file, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL).returncode:
                file.flush()
                print("\n".join(log.read_text().splitlines()[-30:]), file=sys.stderr)
                raise SystemExit(f"bench: the build failed; its log is {log.relative_to(ROOT)}")


def table(name: str, metrics: dict[str, float]) -> str:
    width = max((len(metric) for metric in metrics), default=0)
    return "\n".join([f"\n{name}", *(f"  {metric:<{width}}  {number(value):>12}" for metric, value in sorted(metrics.items()))])


def write(name: str, result: Measured, judged: dict[str, aims.Judged], seconds: float, out: Path) -> Path:
    file = out / f"{name}.json"
    file.write_text(json.dumps({
        "name": name, "commit": machine.commit(ROOT), "cpu": machine.cpu(), "cores": machine.cores(), "simd": machine.simd(),
        "seconds": round(seconds, 1), "metrics": {key: float(f"{value:.6g}") for key, value in sorted(result.metrics.items())},
        "aims": {key: {"aim": one.aim, "met": one.met} for key, one in judged.items()},
        "notes": result.notes}, indent=1, ensure_ascii=False) + "\n")
    return file


def earlier(revision: str, context: Context, no_build: bool) -> Context:
    """The same for an earlier revision, in a checkout of its own under build/against, which stays for the next time."""
    try:
        tree = against.checkout(context.root, revision)
    except against.NoRevision as reason:
        raise SystemExit(f"bench: {reason}") from None
    out = context.out / "against"
    out.mkdir(exist_ok=True)
    if not no_build:
        build(tree, out)
    return replace(context, root=tree, bin=tree / "build/release/bin", out=out)


def run_one(name: str, context: Context, before: Context | None) -> bool:
    print(f"bench {name}", flush=True)
    began = time.monotonic()
    benchmark = BENCHMARKS[name]
    result, missing = against.measure(benchmark, context, before) if before else benchmark.measure(context)
    result.notes += [f"not measured: {reason}" for reason in missing]
    judged = aims.judge(result.metrics, benchmark.AIMS)
    file = write(name, result, judged, time.monotonic() - began, context.out)
    made = benchmark.plot(result, context.out, f"{machine.cpu()}, {machine.cores()} cores")
    if hasattr(benchmark, "table"):
        print(benchmark.table(name, result.metrics))
    else:
        print(table(name, {metric: value for metric, value in result.metrics.items() if metric not in judged}))
    print(aims.table(result.metrics, judged))
    for note in result.notes:
        print(f"  note: {note}")
    print(f"  written: {', '.join(str(written.relative_to(ROOT)) for written in [file, *made])}\n", flush=True)
    for reason in missing:
        print(f"bench {name}: {reason}", file=sys.stderr)
    return not missing


def main() -> int:
    parser = argparse.ArgumentParser(prog="deploy/bench")
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"of {', '.join(BENCHMARKS)}; none: all")
    parser.add_argument("--seconds", type=float, default=15, help="how long each part is measured")
    parser.add_argument("--seed", type=int, help="collision: other objects of the same kinds, and other grasps")
    parser.add_argument("--against", metavar="REV", help="build this revision too, measure both in turn, and compare")
    parser.add_argument("--no-build", action="store_true", help="measure what build/release holds")
    arguments = parser.parse_args()
    unknown = [name for name in arguments.names if name not in BENCHMARKS]
    if unknown:
        parser.error(f"no benchmark '{unknown[0]}': there is {', '.join(BENCHMARKS)}")
    out = ROOT / "out/bench"
    out.mkdir(parents=True, exist_ok=True)
    if not arguments.no_build:
        build(ROOT, out)
    context = Context(ROOT, ROOT / "build/release/bin", out, arguments.seconds, arguments.seed)
    before = earlier(arguments.against, context, arguments.no_build) if arguments.against else None
    good = [run_one(name, context, before) for name in arguments.names or BENCHMARKS]
    return 0 if all(good) else 1


if __name__ == "__main__":
    sys.exit(main())
