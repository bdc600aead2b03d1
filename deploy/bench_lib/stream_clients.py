"""Lean WebSocket clients of a gateway's kiosk, all in one process: they read frames and note when each came. Run by gateway.py, as a
program of its own, so that nothing else holds them up; prints one JSON object. STREAM.md beside the gateway has the wire."""

import argparse
import base64
import json
import os
import selectors
import socket
import struct
import time

PROTOCOL = "mechane.1"
FRAME, TEXT, BINARY, PING, CLOSE = 1, 1, 2, 9, 8
WARM_S = 1.0  # after the last client has its first frame
READY_WITHIN_S = 60
TENTHS = 0x10000  # of a millisecond, after which the time of sending begins anew


class Ended(Exception):
    """The other side closed."""


class Client:
    """One WebSocket. `frames`: pairs of (when it came, how old it was then), in seconds, once `counts`."""

    def __init__(self, port: int, path: str, receive_buffer: int | None = None):
        self.socket = socket.socket()
        if receive_buffer:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        self.socket.settimeout(READY_WITHIN_S)
        self.socket.connect(("127.0.0.1", port))
        key = base64.b64encode(os.urandom(16)).decode()
        self.socket.sendall((f"GET {path} HTTP/1.1\r\nHost: 127.0.0.1:{port}\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                             f"Sec-WebSocket-Key: {key}\r\nSec-WebSocket-Version: 13\r\nSec-WebSocket-Protocol: {PROTOCOL}\r\n"
                             f"Origin: http://127.0.0.1:{port}\r\n\r\n").encode())
        self.held = bytearray()
        while b"\r\n\r\n" not in self.held:
            self._receive()
        head, _, self.held = self.held.partition(b"\r\n\r\n")
        if head.split()[1] != b"101":
            raise Ended(head.decode(errors="replace").splitlines()[0])
        self.socket.setblocking(False)
        self.counts, self.seen, self.frames, self.bytes = False, False, [], 0
        self.skipped = self.skipped_before = 0

    def _receive(self) -> None:
        more = self.socket.recv(1 << 18)
        if not more:
            raise Ended("closed")
        self.held += more

    def read(self) -> None:
        """Takes what has come."""
        self._receive()
        now = time.monotonic_ns()
        at, held = 0, self.held
        while len(held) - at >= 2:
            size, body = held[at + 1] & 0x7F, at + 2
            if size >= 126:
                body += 2 if size == 126 else 8
                if len(held) < body:
                    break
                size = int.from_bytes(held[at + 2:body], "big")
            if len(held) < body + size:
                break
            self._take(held[at] & 0x0F, body, size, now)
            at = body + size
        del held[:at]

    def _take(self, kind: int, at: int, size: int, now_ns: int) -> None:
        if kind == BINARY:
            what, sent, self.skipped, waited_s = struct.unpack_from("<BxHI16xd", self.held, at)
            if what != FRAME:
                return
            self.seen = True
            if self.counts:
                way = (now_ns // 100_000 - sent) % TENTHS / 10_000
                self.frames.append((now_ns / 1e9, waited_s + way))
                self.bytes += size
        elif kind == PING:  # the answer is masked with nothing
            self.socket.send(bytes([0x8A, 0x80 | size]) + bytes(4) + self.held[at:at + size])
        elif kind == CLOSE:
            raise Ended("closed by the other side")

    def begin(self) -> None:
        self.counts, self.skipped_before = True, self.skipped


def processor_s(pid: int) -> float:
    """Processor time of a process's threads so far, to the nanosecond: /proc counts whole ticks of the clock."""
    return time.clock_gettime((~pid << 3) | 2)  # as clock_getcpuclockid() has it on Linux


def read_for(selector: selectors.BaseSelector, until) -> None:
    """Reads until `until()` holds."""
    while not until():
        for key, _ in selector.select(0.05):
            key.data.read()


def measure(clients: list[Client], seconds: float, pid: int) -> dict:
    selector = selectors.DefaultSelector()
    for client in clients:
        selector.register(client.socket, selectors.EVENT_READ, client)
    end = time.monotonic() + READY_WITHIN_S
    read_for(selector, lambda: all(client.seen for client in clients) or time.monotonic() > end)
    if not all(client.seen for client in clients):
        raise Ended(f"no frame within {READY_WITHIN_S} s")
    warm = time.monotonic() + WARM_S
    read_for(selector, lambda: time.monotonic() > warm)
    for client in clients:
        client.begin()
    began, before = time.monotonic(), processor_s(pid)
    read_for(selector, lambda: time.monotonic() > began + seconds)
    lasted, used = time.monotonic() - began, processor_s(pid) - before
    ages = [age for client in clients for _, age in client.frames]
    gaps = [b - a for client in clients for (a, _), (b, _) in zip(client.frames, client.frames[1:])]
    return {"seconds": lasted, "cpu_pct": 100 * used / lasted, "frames": len(ages), "bytes": sum(client.bytes for client in clients),
            "skipped": sum(client.skipped - client.skipped_before for client in clients), "ages_s": ages, "gaps_s": gaps}


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--port", type=int, required=True)
    parser.add_argument("--path", required=True)
    parser.add_argument("--clients", type=int, required=True)
    parser.add_argument("--stalled", type=int, default=0, help="how many more read nothing")
    parser.add_argument("--seconds", type=float, required=True)
    parser.add_argument("--process", type=int, required=True, help="whose processor time is measured")
    options = parser.parse_args()
    stalled = [Client(options.port, options.path, 4096) for _ in range(options.stalled)]
    clients = [Client(options.port, options.path) for _ in range(options.clients)]
    print(json.dumps({**measure(clients, options.seconds, options.process), "stalled": len(stalled)}))


if __name__ == "__main__":
    main()
