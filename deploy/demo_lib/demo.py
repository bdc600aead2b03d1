"""Runs the demo: starts the programs, waits for the visitors, gathers what they report. Standard library only."""

import argparse
import glob
import json
import os
import pathlib
import re
import shutil
import sys
import time
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "deploy/common_lib"))
import machine  # noqa: E402
import recording  # noqa: E402
from running import Programs  # noqa: E402

VILLAGE, SCREW, ODOMETER = (f"scenarios/{name}/{name}.x3d" for name in ("village", "archimedes-screw", "odometer"))
# Two visitors work the screw; a third goes through the village, whose two visits touch the screw's sign and the odometer's.
KIOSKS = {"kiosk-1": SCREW, "kiosk-2": SCREW, "village": VILLAGE}
# By name, as `mechane visitor --device` takes them, and in words.
DEVICES = {"phantom": ("virtual:kind=phantom", "a stylus"), "glove": ("virtual:kind=glove", "a glove"),
           "tracked": ("virtual:kind=tracked", "a hand before a camera"), "pointer": ("pointer", "a mouse")}
LINGER_S = 8  # at the exhibit that a sign opened: a display that draws on the processor needs some seconds to load it
VISIT_LIMIT_S = 240
TOUR_LIMIT_S = 1200
DRAW_LIMIT_S = 900
TOUR_TOLD_EACH_S = 15  # where there is no terminal
GATEWAY_LIMIT_S = 60


def read_json(path):
    try:
        return json.loads(path.read_text())
    except (OSError, ValueError):
        return {}


def has_screen():
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def makes_pictures(options):
    return options.headless or not has_screen()


def watch_visitors(programs, names):
    """Waits for the visitors, telling where they are."""
    started = time.monotonic()
    shown = ""
    while any(programs.running[n].poll() is None for n in names):
        if time.monotonic() - started > VISIT_LIMIT_S:
            return False
        lines = []
        for name in names:
            text = (programs.out / f"{name}.log").read_text(errors="replace").splitlines()
            lines.append(f"{name}: {text[-1][-60:] if text else 'starting'}")
        line = " | ".join(lines)
        if line != shown and sys.stdout.isatty():
            print(f"\r\033[K  {time.monotonic() - started:5.1f} s  {line}", end="", flush=True)
            shown = line
        time.sleep(0.2)
    if sys.stdout.isatty():
        print()
    return True


def replay_journals(programs, scenarios, records, times):
    """Replays every journal so many times; returns (replays that ended with the live hash, replays run)."""
    good = asked = 0
    for journal in sorted(glob.glob(str(records / "*.journal"))):
        for again in range(times):
            name = f"replay-{pathlib.Path(journal).stem}-{again}"
            programs.start(name, "replay", journal, "--scenario", *scenarios)
            asked += 1
            good += programs.wait(name, 120) == 0
    return good, asked


def scenarios_of(options):
    """Home first: where a kiosk begins that asks for nothing."""
    others = sorted(glob.glob("scenarios/*/*.x3d")) if options.all else [SCREW, ODOMETER]
    return [VILLAGE, *(file for file in others if file != VILLAGE)]


def start_server(programs, options, scenarios, out):
    """Starts the server and waits until it is ready: the first time it builds the collision parts, which takes minutes."""
    programs.start("server", "server", "--scenario", *scenarios, "--worlds", "8", "--records", out / "records",
                   "--report", out / "server.json", "--domain", options.domain)

    def tell(seconds):
        if sys.stdout.isatty():
            print(f"\r  {seconds:5.1f} s  the server reads the exhibits (the first time it fits their parts)", end="")

    programs.wait_ready(tell)
    if sys.stdout.isatty():
        print()


def start_gateway(programs, options, out):
    """Starts the gateway and prints the addresses for browsers, as it tells them; None, or why there is none."""
    shutil.rmtree(out / "gateway", ignore_errors=True)  # a new one tells the operator's password
    log, started = out / "gateway.log", time.monotonic()
    programs.start("gateway", "gateway", "--listen", "127.0.0.1:0", "--kiosk", *KIOSKS, "--state", out / "gateway",
                   "--records", out / "records",
                   "--domain", options.domain)
    while "\nready" not in log.read_text(errors="replace"):
        if programs.wait("gateway", 0.1) is not None or time.monotonic() - started > GATEWAY_LIMIT_S:
            return f"the gateway did not start: see {log}"
    print("  for browsers on this machine, while the demo runs:")
    for line in re.findall(r"^(?:kiosk \S+|console|operator's password).*", log.read_text(errors="replace"), re.MULTILINE):
        print(f"    {line}", flush=True)
    return None


def start_clients(programs, options, out):
    domain = ["--domain", str(options.domain)]
    for kiosk in KIOSKS:
        if makes_pictures(options):
            programs.start(f"record-{kiosk}", *recording.record(kiosk, out / f"{kiosk}.frames"), *domain)
        elif kiosk != "kiosk-2":
            programs.start(f"display-{kiosk}", "display", "--kiosk", kiosk, *domain)
    visitors = []
    for kiosk, scenario in KIOSKS.items():
        name = f"visitor-{kiosk}"
        programs.start(name, "visitor", "--kiosk", kiosk, "--scenario", scenario, "--linger", str(LINGER_S), "--report",
                       str(out / f"{name}.json"), *domain)
        visitors.append(name)
    programs.start("haptic", "haptic", "--device", "virtual", "--kiosk", "kiosk-1", "--user", "1", "--report",
                   str(out / "haptic.json"), *domain)
    return visitors


def draw_steps(programs, out):
    """A picture of each step of what was recorded, one kiosk after another; the kiosks that could not be drawn."""
    failed = []
    for kiosk in KIOSKS:
        print(f"  drawing the steps at {kiosk}", flush=True)
        programs.start(f"draw-{kiosk}", *recording.draw(out / f"{kiosk}.frames", out / "pictures" / kiosk, "1280x720", "--every-step", "--stereo",
                                                        "sbs" if kiosk == "kiosk-2" else "mono"))
        if programs.wait(f"draw-{kiosk}", DRAW_LIMIT_S) != 0:
            failed.append(kiosk)
    return failed


def clear_line():
    return "\r\033[K" if sys.stdout.isatty() else ""


def count_visits(scenarios):
    """The scripted visits in scenario files."""
    def named(parent, name):
        return [each for each in parent.iter("MetadataSet") if each.get("name") == name]

    roots = [xml.etree.ElementTree.parse(file).getroot() for file in scenarios]
    return sum(len(visits.findall("MetadataSet")) for root in roots for visits in named(root, "visits"))


def tour_progress(log, visits):
    """Of a tour's log so far: how many visits are over, of all, how many of them were not done, and where the visitors are now."""
    ended, failed, at = 0, 0, {}
    for line in log.splitlines():
        match = re.fullmatch(r"(\S+)  (\S+): (?:visit \S+: (done|not done), [\d.]+ s|(\S+))", line)
        if match is None:
            continue
        kiosk, activity, ending, step = match.groups()
        if ending is None:
            at[kiosk] = f"{kiosk} {activity}: {step}"
        else:
            ended += 1
            failed += ending != "done"
            at.pop(kiosk, None)
    words = f"{ended} of {visits} visits"
    if failed:
        words += f", {failed} not done"
    return words + "".join(f" | {place}" for place in at.values())


def tour(programs, options, out, device):
    """Every visit of every exhibit by one of DEVICES, some at a time, telling how far it is; the table that the visitor prints. None where
    one was not completed."""
    device_name, words = DEVICES[device]
    print(f"  every visit of every exhibit, by {words}: some minutes", flush=True)
    visits = count_visits(sorted(glob.glob("scenarios/*/*.x3d")))
    name = f"tour-{device}"
    programs.start(name, "visitor", "--all", "--at-once", "3", "--device", device_name, "--report", str(out / f"{name}.json"),
                   "--domain", str(options.domain))
    started = told = time.monotonic()
    while programs.wait(name, 0.5) is None and time.monotonic() - started < TOUR_LIMIT_S:
        if not sys.stdout.isatty() and time.monotonic() - told < TOUR_TOLD_EACH_S:
            continue
        told = time.monotonic()
        line = f"  {told - started:5.1f} s  {tour_progress((out / f'{name}.log').read_text(errors='replace'), visits)}"
        if sys.stdout.isatty():
            print(f"\r\033[K{line[:shutil.get_terminal_size().columns - 1]}", end="", flush=True)
        else:
            print(line, flush=True)
    log = (out / f"{name}.log").read_text(errors="replace")
    print(f"{clear_line()}  {time.monotonic() - started:5.1f} s  {tour_progress(log, visits)}", flush=True)
    if programs.stop(name, 20) != 0:  # otherwise it would go on beside the next one
        return None
    return [line for line in log.splitlines() if " steps " in line]


def gather(out, visitors, replays):
    server = read_json(out / "server.json")
    reports = [read_json(out / f"{name}.json") for name in visitors]
    activities = [a for r in reports for a in r.get("activities", [])]
    pictures = glob.glob(str(out / "pictures" / "**" / "*.png"), recursive=True)
    wanted = pictures_wanted(activities)
    missed = [(kiosk, name) for kiosk, name in wanted if not glob.glob(str(out / "pictures" / kiosk / f"{name}-*.png"))]
    metrics = {
        "activities.done": sum(1 for a in activities if a.get("done")),
        "activities.asked": sum(count_visits([ROOT / scenario]) for scenario in KIOSKS.values()),
        "steps.done": sum(len([s for s in a.get("steps", []) if s.get("done")]) for a in activities),
        "kiosks": len(visitors),
        **{count: server[count] for count in ("overruns", "late_wakeups", "preemptions") if count in server},
        "pictures": len(pictures),
        "pictures.wanted": len(wanted),
        "pictures.missed": len(missed),
        "replays.same_hash": replays[0],
        "replays.asked": replays[1],
    }
    if water_l := [r["water_l"] for r in reports if "water_l" in r]:
        metrics["water_l"] = round(sum(water_l), 2)
    if force_n := [r["force_n"]["max"] for r in reports if "max" in r.get("force_n", {})]:
        metrics["force_n.max"] = max(force_n)
    for key, value in server.get("tick_us", {}).items():
        metrics[f"tick_us.{key}"] = value
    for key in ("median", "p99", "p999", "max"):
        values = [r["rtt_us"][key] for r in reports if key in r.get("rtt_us", {})]
        if values:
            metrics[f"rtt_us.{key}"] = max(values)
    return metrics, activities, sorted(missed), server.get("simd")


def pictures_wanted(activities):
    """A picture of every step that was reached, and of each activity's end, by kiosk."""
    def steps_of(activity):
        steps = [step["name"] for step in activity.get("steps", [])]
        if activity.get("gone_on_to"):
            return steps[:-1]  # the last one is over as it begins
        return steps + (["done"] if activity.get("done") else [])

    return {(a["kiosk"], f"{a['name']}-{step}") for a in activities for step in steps_of(a)}


def print_summary(metrics, activities, missed, out):
    print("\nArchimedes' screw at two kiosks, the village at a third")
    for activity in activities:
        mark = f"on to {activity['gone_on_to']}" if activity.get("gone_on_to") else "done" if activity.get("done") else "NOT DONE"
        print(f"  {activity.get('kiosk', ''):<9} {activity.get('name', '?'):<10} {mark:<25} {activity.get('seconds', 0):6.1f} s")
        for step in activity.get("steps", []):
            print(f"            {step['name']:<16} {step['seconds']:6.1f} s")
    get = lambda key: metrics.get(key, float("nan"))
    print(f"  water lifted             {get('water_l'):8.1f} l")
    print(f"  strongest force          {get('force_n.max'):8.2f} N")
    print("  tick, own CPU time       median {:.0f} us, p99 {:.0f}, p99.9 {:.0f}, max {:.0f}".format(
        *(get(f"tick_us.{k}") for k in ("median", "p99", "p999", "max"))))
    print(f"  overruns of ours         {get('overruns'):8.0f}      late wake-ups {get('late_wakeups'):.0f}")
    print("  motion to force          median {:.0f} us, p99 {:.0f}, p99.9 {:.0f}, max {:.0f}".format(
        *(get(f"rtt_us.{k}") for k in ("median", "p99", "p999", "max"))))
    print(f"  journals replayed        {metrics['replays.same_hash']} of {metrics['replays.asked']} to the live hash")
    print(f"  pictures of steps        {metrics['pictures.wanted'] - metrics['pictures.missed']:8d}      of {metrics['pictures.wanted']}, in {out / 'pictures'}")
    for kiosk, name in missed:
        print(f"                           missed: {name} at {kiosk}")


def missing_assets(out):
    """What displays could not find, from the last line of their logs."""
    missing = set()
    for log in (*out.glob("display-*.log"), *out.glob("draw-*.log")):
        for line in reversed(log.read_text(errors="replace").splitlines()):
            if line.startswith("{"):
                missing.update(json.loads(line).get("missing_assets", []))
                break
    return sorted(missing)


def main():
    parser = argparse.ArgumentParser(description="Runs the demo: Archimedes' screw at two kiosks, the village at a third.")
    parser.add_argument("--bin", type=pathlib.Path, required=True)
    parser.add_argument("--out", type=pathlib.Path, required=True)
    parser.add_argument("--headless", action="store_true", help="pictures, no window")
    parser.add_argument("--all", action="store_true", help="afterwards every visit of every exhibit, by each simulated device")
    parser.add_argument("--domain", type=int, default=42)
    options = parser.parse_args()
    out = options.out.resolve()
    for stale in ("pictures", "records"):
        shutil.rmtree(out / stale, ignore_errors=True)
    for stale in (*out.glob("*.json"), *out.glob("*.log"), *out.glob("*.frames")):
        if stale.name != "build.log":
            stale.unlink()
    out.mkdir(parents=True, exist_ok=True)
    started = time.monotonic()
    programs = Programs("demo", options.bin.resolve(), out)
    problems = []
    try:
        print("demo: a server, three kiosks with a visitor and a display each, a second hand at the first kiosk")
        scenarios = scenarios_of(options)
        start_server(programs, options, scenarios, out)
        if failure := start_gateway(programs, options, out):
            problems.append(failure)
        visitors = start_clients(programs, options, out)
        if not watch_visitors(programs, visitors):
            problems.append(f"the visitors were not done after {VISIT_LIMIT_S} s")
        for name in [n for n in programs.running if n.startswith(("display", "record")) or n == "haptic"]:
            if programs.stop(name, 30) != 0:
                problems.append(f"{name} ended badly: see {out / (name + '.log')}")
        for kiosk in draw_steps(programs, out) if makes_pictures(options) else ():
            problems.append(f"the steps at {kiosk} could not be drawn: see {out / f'draw-{kiosk}.log'}")
        tables = {device: tour(programs, options, out, device) for device in DEVICES} if options.all else {}
        problems += [f"not every visit by {DEVICES[device][1]} was completed: see {out / f'tour-{device}.log'}"
                     for device, table in tables.items() if table is None]
        if programs.stop("gateway", 20) != 0:
            problems.append(f"the gateway ended badly: see {out / 'gateway.log'}")
        if programs.stop("server", 20) != 0:
            problems.append(f"the server ended badly: see {out / 'server.log'}")
        replays = replay_journals(programs, scenarios, out / "records", 1 if options.all else 2)
    finally:
        programs.stop_all()
    metrics, activities, missed, simd = gather(out, visitors, replays)
    if metrics["activities.done"] != metrics["activities.asked"]:
        problems.append("not every activity was completed: see out/demo/visitor-*.log")
    if replays[0] != replays[1] or replays[1] == 0:
        problems.append("a journal did not replay to its live hash: see out/demo/replay-*.log")
    if missed and makes_pictures(options):
        problems.append("not every step has its picture: see out/demo/draw-*.log")
    for asset in missing_assets(out):
        problems.append(f"a display showed a plain box instead of {asset}")
    metrics["failed"] = len(problems)
    report = {"name": "demo", "commit": machine.commit(ROOT), "cpu": machine.cpu(), "cores": machine.cores(), "simd": simd,
              "seconds": round(time.monotonic() - started, 1), "metrics": metrics, "activities": activities,
              "notes": problems}
    (out / "report.json").write_text(json.dumps(report, indent=2) + "\n")
    print_summary(metrics, activities, missed if makes_pictures(options) else [], out)
    for device, table in tables.items():
        for line in table or []:
            print(f"  {device:<9} {line}")
    for problem in problems:
        print(f"demo: {problem}", file=sys.stderr)
    if not problems:
        print("demo: passed")
    print(f"  report                   {out / 'report.json'}")
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
