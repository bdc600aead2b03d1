"""Clients of the soak's gateway: a few read all the time, others come and go, one reads slowly, one not at all. Run by soak.py as a program
of its own; ends with an error when the gateway closes one that reads. The clients are the benchmark's."""

import argparse
import contextlib
import random
import selectors
import sys
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "bench_lib"))
from stream_clients import Client, Ended  # noqa: E402

LASTING, GUESTS = 3, 4
STAYS_S = (2, 20)
SLOW_READS_EVERY_S = 0.5  # what a small buffer holds
SILENT_STAYS_S = 60  # the gateway closes who answers no ping for 30 s
SMALL_BUFFER = 4096


class Readers:
    def __init__(self, port: int, path: str):
        self.port, self.path, self.selector, self.draw = port, path, selectors.DefaultSelector(), random.Random(1)
        self.guests: dict[Client, float] = {}
        self.came = 0
        for _ in range(LASTING):
            self.add()
        self.slow, self.slow_at = Client(port, path, SMALL_BUFFER), time.monotonic()
        self.silent, self.silent_at = Client(port, path, SMALL_BUFFER), time.monotonic()

    def add(self) -> Client:
        client = Client(self.port, self.path)
        self.selector.register(client.socket, selectors.EVENT_READ, client)
        self.came += 1
        return client

    def pass_on(self) -> None:
        """Reads what there is; lets guests come, and leave without a word."""
        for key, _ in self.selector.select(0.05):
            key.data.read()
        now = time.monotonic()
        for guest in [guest for guest, until in self.guests.items() if now > until]:
            self.selector.unregister(guest.socket)
            guest.socket.close()
            del self.guests[guest]
        while len(self.guests) < GUESTS:
            self.guests[self.add()] = now + self.draw.uniform(*STAYS_S)
        if now > self.slow_at + SLOW_READS_EVERY_S:
            self.slow_at = now
            with contextlib.suppress(BlockingIOError):
                self.slow.read()
        if now > self.silent_at + SILENT_STAYS_S:
            self.silent.socket.close()
            self.silent, self.silent_at = Client(self.port, self.path, SMALL_BUFFER), now


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--port", type=int, required=True)
    parser.add_argument("--path", required=True)
    options = parser.parse_args()
    readers = Readers(options.port, options.path)
    told = 0.0
    while True:
        try:
            readers.pass_on()
        except (Ended, OSError) as reason:
            raise SystemExit(f"the gateway ended a reader: {reason}") from None
        if time.monotonic() > told + 60:
            told = time.monotonic()
            print(f"{readers.came} readers came", flush=True)


if __name__ == "__main__":
    main()
