"""The studio: how soon an author sees a draft, what an edit's check takes on 500 nodes, what a drag takes from the pointer's event to the
picture's submission, and what a thousand edits leave in the memory of page and gateway. An answer with a check is held against one without,
of the same draft in the same run."""

import contextlib
import http.client
import json
import re
import shutil
import subprocess
import time
from pathlib import Path

from gateway import measured_parts, quantile, start_gateway, tail
from peers import Measured, Missing
from plots import tails
from running import Programs, memory_mib

AIMS = {
    "bundle_kb.gzip": (("under", 1024),),
    "load_s": (("under", 2),),
    "check_ms.p99": (("under", 200),),
    "drag_ms.p95": (("under", 33),),
}
NODES = 500
EDITS = 1000
PAUSE_S = 0.1  # of one who edits fast; without it the gateway would soon say that there are too many requests
DRAFTS = "/api/studio/drafts"
TEMPLATE = "crank-and-rope"  # what a first draft begins from
BODY = "LOAD"


class Author:
    """Requests of a page that is signed in, over one connection."""

    def __init__(self, port: int, user: str, password: str):
        self._connection = http.client.HTTPConnection("127.0.0.1", port, timeout=60)
        self._headers = {"Origin": f"http://127.0.0.1:{port}", "Content-Type": "application/json"}
        answer, text = self._ask("POST", "/api/sign-in", {"user": user, "password": password})
        self._headers |= {"Cookie": answer.getheader("set-cookie").split(";")[0], "X-Mechane-CSRF": json.loads(text)["csrf"]}

    def _ask(self, method: str, path: str, body: dict | None = None) -> tuple[http.client.HTTPResponse, bytes]:
        self._connection.request(method, path, json.dumps(body) if body is not None else None, self._headers)
        answer = self._connection.getresponse()
        text = answer.read()
        if answer.status != 200:
            raise Missing(f"{method} {path}: {answer.status} {text[:300].decode(errors='replace')}")
        return answer, text

    def get(self, path: str) -> bytes:
        return self._ask("GET", path)[1]

    def post(self, path: str, body: dict) -> dict:
        return json.loads(self._ask("POST", path, body)[1])


class Running:
    def __init__(self, gateway: subprocess.Popen, told: str):
        self.pid = gateway.pid
        self.port = int(re.search(r"console: http://[^:]+:(\d+)/console", told).group(1))
        self.user, self.password = "operator", re.search(r"operator (\S+)", told).group(1)
        self.author = Author(self.port, self.user, self.password)

    def memory_mib(self) -> float:
        return memory_mib(self.pid)


@contextlib.contextmanager
def running(context):
    if not (context.bin / "mechane-gateway").exists():
        raise Missing(f"mechane-gateway missing in {context.bin}: it was not built")
    folder = context.out / "studio"
    shutil.rmtree(folder, ignore_errors=True)
    (folder / "scenarios").mkdir(parents=True)
    programs = Programs("bench", context.bin, folder)
    try:
        yield Running(*start_gateway(programs, "--scenarios", folder / "scenarios"))
    finally:
        programs.stop_all()
        shutil.rmtree(folder / "state", ignore_errors=True)


def nodes(author: Author, name: str) -> int:
    """Without those that hold metadata."""
    return len(re.findall(rb"<(?!Metadata|X3D\b|Scene\b)[A-Z]", author.get(f"{DRAFTS}/{name}/text")))


def begin(author: Author, name: str, wanted: int) -> tuple[dict, int]:
    """A draft with at least so many nodes, most of them of boxes; it, and how many."""
    draft = author.post(DRAFTS, {"name": name, "from": f"template:{TEMPLATE}"})
    count, boxes, each = nodes(author, name), 0, 1
    while count < wanted:
        more = -(-(wanted - count) // each)
        places = [[0.5 * (k % 12), 0.2, 1 + 0.5 * (k // 12)] for k in range(boxes, boxes + (more if boxes else 1))]
        commands = [{"op": "insert", "part": "box", "position": place} for place in places]
        draft = author.post(f"{DRAFTS}/{name}/commands", {"revision": draft["revision"], "commands": commands})
        boxes += len(places)
        before, count = count, nodes(author, name)
        each = (count - before) // len(places)
    return draft, count


def timed(call, *arguments):
    begun = time.monotonic()
    answer = call(*arguments)
    return time.monotonic() - begun, answer


def quantiles(name: str, values: list[float], high: str, share: float) -> dict[str, float]:
    return {f"{name}.median": quantile(values, 0.5), f"{name}.{high}": quantile(values, share), f"{name}.max": max(values)}


def measure_edits(context) -> Measured:
    """Each edit is checked whole, written to disk, and answered with the draft as it is then."""
    with running(context) as gateway:
        author, edits_s, views_s = gateway.author, [], []
        draft, count = begin(author, "many", NODES)
        before = gateway.memory_mib()
        for k in range(EDITS):
            edit = {"op": "field", "node": BODY, "field": "mass", "value": str(1 + k % 7)}
            seconds, draft = timed(author.post, f"{DRAFTS}/many/commands", {"revision": draft["revision"], "commands": [edit]})
            edits_s.append(seconds)
            views_s.append(timed(author.get, f"{DRAFTS}/many")[0])
            time.sleep(PAUSE_S)
        after = gateway.memory_mib()
    result = Measured({"check.nodes": float(count), "memory.gateway_mib": after, "memory.gateway_mib.grown": after - before})
    for name, values in (("check_ms", edits_s), ("view_ms", views_s)):
        result.metrics |= quantiles(name, [1000 * value for value in values], "p99", 0.99)
        result.curves[name] = tail(values)
    result.metrics["check_ratio.median"] = result.metrics["check_ms.median"] / result.metrics["view_ms.median"]
    return result


def measure_page(context) -> Measured:
    """By the studio's page in a new browser, at a draft from a template."""
    script = context.root / "client-sdk/web/tests/browser/studio_load.mjs"
    with running(context) as gateway:
        begin(gateway.author, "page", 0)
        try:
            done = subprocess.run(["node", str(script), f"http://127.0.0.1:{gateway.port}", gateway.user, gateway.password, "page", BODY,
                                   str(EDITS), str(context.out / "studio.png")], capture_output=True, text=True, timeout=900,
                                  stdin=subprocess.DEVNULL)
        except (FileNotFoundError, subprocess.TimeoutExpired) as reason:
            raise Missing(f"the page could not be measured: {reason}") from None
        if done.returncode:
            raise Missing(f"the page could not be measured: {done.stderr.strip()[-600:]}")
    seen = json.loads(done.stdout)
    result = Measured({"bundle_kb.gzip": seen["gzip_kb"], "bundle_kb": seen["app_kb"], "load_s": seen["load_s"],
                       "memory.page_mib": seen["after_mib"], "memory.page_mib.grown": seen["after_mib"] - seen["before_mib"]},
                      notes=["Chromium draws by the processor, 1280x720"])
    result.metrics |= quantiles("drag_ms", seen["drags_ms"], "p95", 0.95)
    result.metrics["drop_ms"] = seen["drop_ms"]
    result.curves["drag_ms"] = tail([value / 1000 for value in seen["drags_ms"]])
    return result


def measure(context) -> tuple[Measured, list[str]]:
    """Everything that could be measured, and what could not."""
    return measured_parts(context, (("page", measure_page), ("edits", measure_edits)))


def plot(result: Measured, out: Path, machine: str) -> list[Path]:
    series = {"an edit, checked": "check_ms", "the draft, without a check": "view_ms", "a drag": "drag_ms"}
    found = {label: result.curves[name] for label, name in series.items() if name in result.curves}
    if not found:
        return []
    tails(out / "studio.svg", "What an author waits for",
          f"{NODES} nodes and more; a drag in Chromium without a graphics card. {machine}", found)
    return [out / "studio.svg"]
