"""The gateway and the page: how soon a browser shows the village, what two hundred moving things cost for twenty of them, how old a frame
is when it comes, what one that reads nothing does to the others, and a thousand connections at once. The stream is held against a plain
loop that sends the same bytes, in the same run."""

import contextlib
import json
import math
import re
import resource
import selectors
import shutil
import socket
import subprocess
import sys
import time
from pathlib import Path
from statistics import median

from peers import Measured, Missing
from plots import bars, lines, tails
from running import Programs, memory_mib, stop

AIMS = {
    "first_load.gzip_kb": (("under", 1024),),
    "first_load.s": (("under", 5),),
    "first_load.shell_s": (("under", 2),),
    "stream.cpu_pct.20": (("under", 10),),
    "frame_age_ms.p99": (("under", 50),),
    "connections.refused_politely": (("at least", 1000),),
    "stalled.gap_ratio.p99": (("under", 1.2),),
}
CLIENTS = (1, 5, 10, 20)  # at a kiosk
MANY = 50  # one of which reads nothing
OBJECTS = 200
ROUNDS = 3
LOADS = 3
KIOSK = "kiosk-1"
CONNECTIONS = 1000  # that find no room
TOLD_WITHIN_S = 60
BEYOND = [0.5, 0.3, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001]
HERE = Path(__file__).resolve().parent


def scene_of_moving_things(file: Path) -> None:
    """They float and turn for ever. They have no shapes: fitting those would take the server's first start minutes, and frames have poses
    only."""
    across = math.ceil(OBJECTS ** 0.5)
    bodies = [f"<RigidBody DEF='B{k}' containerField='bodies' mass='1' inertia='1 0 0 0 1 0 0 0 1' useGlobalGravity='false' "
              f"position='{k % across} 1 {k // across}' angularVelocity='0 {0.5 + k % 7} 0'/>" for k in range(OBJECTS)]
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text("<X3D version='4.0' profile='Full'><Scene><RigidBodyCollection gravity='0 -9.81 0'>\n" + "\n".join(bodies) +
                    "\n</RigidBodyCollection></Scene></X3D>\n")


class Running:
    """A server with one scenario, and a gateway beside it."""

    def __init__(self, programs: Programs, gateway: subprocess.Popen, told: str):
        self.programs, self.pid = programs, gateway.pid
        self.address = re.search(rf"kiosk {KIOSK}: (\S+)", told).group(1)
        self.port, self.token = int(re.search(r":(\d+)/", self.address).group(1)), self.address.partition("token=")[2]
        self.path = f"/ws/kiosk/{KIOSK}?token={self.token}"

    def memory_mib(self) -> float:
        return memory_mib(self.pid)


def start_gateway(programs: Programs, *arguments) -> tuple[subprocess.Popen, str]:
    """A gateway, once it is ready, and what it has said; its state is in a folder beside its log."""
    gateway = programs.start("gateway", "gateway", "--listen", "127.0.0.1:0", "--state", programs.out / "state", *arguments)
    log, end = programs.out / "gateway.log", time.monotonic() + 60
    while "\nready" not in log.read_text():
        if gateway.poll() is not None or time.monotonic() > end:
            raise Missing(f"mechane-gateway did not start: {log.read_text()[-400:]}")
        time.sleep(0.05)
    return gateway, log.read_text()


@contextlib.contextmanager
def running(context, scenario: Path, name: str):
    for program in ("mechane", "mechane-server", "mechane-gateway"):
        if not (context.bin / program).exists():
            raise Missing(f"{program} missing in {context.bin}: it was not built")
    folder = context.out / f"gateway-{name}"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir()
    programs = Programs("bench", context.bin, folder)
    try:
        programs.start("server", "server", "--scenario", scenario, "--worlds", 1, "--records", "")
        programs.wait_ready()
        yield Running(programs, *start_gateway(programs, "--kiosk", KIOSK))
    finally:
        programs.stop_all()
        shutil.rmtree(folder / "state", ignore_errors=True)


def measure_load(context) -> Measured:
    """Each time a new browser; the median of some loads, because a slow minute of the machine falls on one."""
    script, loads = context.root / "client-sdk/web/tests/browser/load.mjs", []
    with running(context, context.root / "scenarios/village/village.x3d", "load") as gateway:
        for _ in range(LOADS):
            try:
                done = subprocess.run(["node", str(script), gateway.address, str(context.out / "gateway-village.png")], capture_output=True,
                                      text=True, timeout=360, stdin=subprocess.DEVNULL)
            except (FileNotFoundError, subprocess.TimeoutExpired) as reason:
                raise Missing(f"the page could not be loaded: {reason}") from None
            if done.returncode:
                raise Missing(f"the page could not be loaded: {done.stderr.strip()[-600:]}")
            loads.append(json.loads(done.stdout))
    metrics = {f"first_load.{name}": median(load[name] for load in loads) for name in ("gzip_kb", "app_kb", "meshes_kb", "s", "shell_s")}
    metrics["first_load.s.max"] = max(load["s"] for load in loads)
    return Measured(metrics, notes=[f"Chromium draws by the processor, 480x360; {LOADS} loads, each by a new browser"])


def clients(port: int, path: str, pid: int, count: int, seconds: float, stalled: int = 0) -> dict:
    """What so many clients, in a process of their own, saw of one sender."""
    done = subprocess.run([sys.executable, "-B", str(HERE / "stream_clients.py"), "--port", str(port), "--path", path,
                           "--clients", str(count),
                           "--stalled", str(stalled), "--seconds", str(seconds), "--process", str(pid)], capture_output=True, text=True,
                          timeout=seconds + 180, stdin=subprocess.DEVNULL)
    if done.returncode:
        raise Missing(f"the clients ended with {done.returncode}: {done.stderr.strip()[-400:]}")
    return json.loads(done.stdout)


@contextlib.contextmanager
def peer(frame_bytes: int, per_second: float):
    process = subprocess.Popen([sys.executable, "-B", str(HERE / "stream_peer.py"), "--bytes", str(frame_bytes), "--per-second",
                                str(per_second)], stdout=subprocess.PIPE, stdin=subprocess.DEVNULL, text=True)
    try:
        yield process.pid, int(process.stdout.readline())
    finally:
        stop(process)
        process.stdout.close()


def quantile(values: list[float], share: float) -> float:
    ranked = sorted(values)
    return ranked[min(len(ranked) - 1, math.ceil(share * len(ranked)) - 1)]


def tail(values: list[float]) -> list[list[float]]:
    """Pairs (share that is slower, microseconds)."""
    return [[beyond, 1e6 * quantile(values, 1 - beyond)] for beyond in BEYOND if beyond * len(values) >= 1]


def add_ages(result: Measured, name: str, ages_s: list[float]) -> None:
    for word, share in (("median", 0.5), ("p99", 0.99), ("p999", 0.999), ("max", 1.0)):
        result.metrics[f"{name}.{word}"] = 1000 * quantile(ages_s, share)
    result.curves[name] = tail(ages_s)


def measure_stream(context) -> Measured:
    result, each = Measured(), context.seconds / ROUNDS
    scenario = context.out / "gateway-scene/moving-things.x3d"
    scene_of_moving_things(scenario)
    most = CLIENTS[-1]
    cpu: dict[str, list[float]] = {}
    ages: dict[str, list[float]] = {"frame_age_ms": [], "frame_age_ms.peer": []}
    gaps: dict[str, list[list[float]]] = {"steady": [], "stalled": []}
    with running(context, scenario, "stream") as gateway:
        for _ in range(ROUNDS):
            for count in CLIENTS:
                seen = clients(gateway.port, gateway.path, gateway.pid, count, each)
                cpu.setdefault(str(count), []).append(seen["cpu_pct"])
            per_second = seen["frames"] / most / seen["seconds"]
            ages["frame_age_ms"] += seen["ages_s"]
            frame = round(seen["bytes"] / seen["frames"])
            with peer(frame, per_second) as (pid, port):
                other = clients(port, "/", pid, most, each)
            cpu.setdefault("peer", []).append(other["cpu_pct"])
            ages["frame_age_ms.peer"] += other["ages_s"]
            for name, stalled in (("steady", 0), ("stalled", 1)):
                gaps[name].append(clients(gateway.port, gateway.path, gateway.pid, MANY - stalled, each, stalled)["gaps_s"])
        result.metrics["stream.memory_mib"] = gateway.memory_mib()
    result.metrics |= {f"stream.cpu_pct.{count}": median(values) for count, values in cpu.items()}
    result.metrics["stream.cpu_ratio"] = median([ours / theirs for ours, theirs in zip(cpu[str(most)], cpu["peer"])])
    result.metrics |= {"stream.frames_per_s": per_second, "stream.frame_bytes": frame, "stream.mb_per_s": frame * per_second * most / 1e6,
                       "stream.skipped": seen["skipped"]}
    for name, values in ages.items():
        add_ages(result, name, values)
    result.metrics["frame_age_ratio.p99"] = result.metrics["frame_age_ms.p99"] / result.metrics["frame_age_ms.peer.p99"]
    for name, rounds in gaps.items():
        result.metrics[f"{name}.gap_ms.p99"] = median([1000 * quantile(one, 0.99) for one in rounds])
        result.curves[f"{name}.gap"] = tail([gap for one in rounds for gap in one])
    result.metrics["stalled.gap_ratio.p99"] = median(
        [quantile(b, 0.99) / quantile(a, 0.99) for a, b in zip(gaps["steady"], gaps["stalled"])])
    result.notes.append("ages are of frames as a client's process reads them, so its own waits for a processor count")
    return result


def knock(port: int, count: int) -> tuple[list[bytes], float]:
    """So many connections at once; what each was told, and how long that took, in seconds."""
    began, selector, told = time.monotonic(), selectors.DefaultSelector(), {}
    for k in range(count):
        one = socket.socket()
        one.setblocking(False)
        with contextlib.suppress(BlockingIOError):
            one.connect(("127.0.0.1", port))
        selector.register(one, selectors.EVENT_READ, k)
        told[k] = b""
    while selector.get_map() and time.monotonic() < began + TOLD_WITHIN_S:
        for key, _ in selector.select(1):
            try:
                more = key.fileobj.recv(4096)
            except OSError:
                more = b""
            told[key.data] += more
            if not more:
                selector.unregister(key.fileobj)
                key.fileobj.close()
    for key in list(selector.get_map().values()):
        key.fileobj.close()
    return list(told.values()), time.monotonic() - began


def polite(answer: bytes) -> bool:
    head, _, body = answer.partition(b"\r\n\r\n")
    return head.startswith(b"HTTP/1.1 503") and b"Retry-After" in head and bool(json.loads(body or b"{}").get("remedy"))


def measure_connections(context) -> Measured:
    soft, hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    resource.setrlimit(resource.RLIMIT_NOFILE, (min(hard, max(soft, 4 * CONNECTIONS)), hard))
    scenario = context.out / "gateway-scene/moving-things.x3d"
    scene_of_moving_things(scenario)
    with running(context, scenario, "connections") as gateway:
        held = [socket.create_connection(("127.0.0.1", gateway.port)) for _ in range(100)]  # as many as one address may have
        before, rounds = gateway.memory_mib(), []
        for _ in range(ROUNDS):
            answers, seconds = knock(gateway.port, CONNECTIONS)
            rounds.append((sum(map(polite, answers)), seconds, gateway.memory_mib()))
        for one in held:
            one.close()
    return Measured({"connections.refused_politely": float(min(count for count, _, _ in rounds)),
                     "connections.refused_s": median([seconds for _, seconds, _ in rounds]),
                     "connections.grown_mib": rounds[0][2] - before, "connections.grown_again_mib": rounds[-1][2] - rounds[0][2]})


def measured_parts(context, parts) -> tuple[Measured, list[str]]:
    """Everything that could be measured, and what could not."""
    result, missing = Measured(), []
    for name, part in parts:
        print(f"  {name} ...", flush=True)
        try:
            one = part(context)
        except Missing as reason:
            missing.append(f"{name}: {reason}")
            continue
        result.metrics |= one.metrics
        result.curves |= one.curves
        result.notes += one.notes
    return result, missing


def measure(context) -> tuple[Measured, list[str]]:
    return measured_parts(context, (("load", measure_load), ("stream", measure_stream), ("connections", measure_connections)))


def plot(result: Measured, out: Path, machine: str) -> list[Path]:
    made, numbers = [], result.metrics
    loads = [(name, numbers[f"first_load.{key}"]) for name, key in (("the shell", "shell_s"), ("the village, whole", "s"))
             if f"first_load.{key}" in numbers]
    if loads:
        made.append(out / "gateway-load.svg")
        bars(made[-1], "From a kiosk's address to the first picture", f"drawn by the processor, median of {LOADS} loads. {machine}",
             loads, "s")
    cpu = [[float(count), numbers[f"stream.cpu_pct.{count}"]] for count in CLIENTS if f"stream.cpu_pct.{count}" in numbers]
    if cpu:
        made.append(out / "gateway-stream.svg")
        lines(made[-1], f"{OBJECTS} moving things to browsers", f"the gateway's processor time. {machine}",
              {"gateway": cpu, "plain loop": [[float(CLIENTS[-1]), numbers["stream.cpu_pct.peer"]]]}, "clients", "% of a core",
              logarithmic=False, points=("plain loop",))
    series = {"gateway": "frame_age_ms", "plain loop": "frame_age_ms.peer"}
    gaps = {"all read": "steady.gap", "one of them does not": "stalled.gap"}
    for file, title, names in (("gateway-age.svg", f"How old a frame is at one of {CLIENTS[-1]} clients", series),
                               ("gateway-stalled.svg", f"Between two frames, at {MANY} clients", gaps)):
        found = {label: result.curves[name] for label, name in names.items() if name in result.curves}
        if found:
            made.append(out / file)
            tails(made[-1], title, machine, found)
    return made
