"""A routed link that delays and loses: two networks, a router between them, and on one side of it a wire that this program is.

    unshare --map-root-user --net python3 impaired_link.py

prints one line of JSON: the process ids whose network namespaces are the two ends (nsenter --user --net --preserve-credentials
--target PID). Then it obeys lines on its input: `delay 40` (milliseconds each way), `loss 0.01`, `jitter 5` (milliseconds more for some,
which puts packets out of order); at the end of its input everything is gone. Root is needed of the own user namespace alone.
"""

import ctypes
import heapq
import json
import os
import random
import select
import signal
import socket
import subprocess
import sys
import time

CLONE_NEWNET = 0x40000000
PR_SET_PDEATHSIG = 1
PACKET_OUTGOING = 4
UDP = 17
LIBC = ctypes.CDLL(None, use_errno=True)
SERVER_ADDRESS, CLIENT_ADDRESS = "10.77.1.2", "10.77.2.2"


def die_with_parent():
    LIBC.prctl(PR_SET_PDEATHSIG, signal.SIGKILL)


def in_new_network(work):
    """A child process in a network namespace of its own that does `work`; returns its id once the namespace is there."""
    read, write = os.pipe()
    child = os.fork()
    if child == 0:
        die_with_parent()
        os.close(read)
        if LIBC.unshare(CLONE_NEWNET) != 0:
            os._exit(1)
        os.write(write, b"x")
        os.close(write)
        work()
        os._exit(0)
    os.close(write)
    if os.read(read, 1) != b"x":
        sys.exit("no network namespace can be made here")
    os.close(read)
    return child


def ip(words, inside=None):
    prefix = ["nsenter", "--net", "--target", str(inside)] if inside else []
    subprocess.run([*prefix, "ip", *words.split()], check=True, stdout=subprocess.DEVNULL)


def connect(near, near_in, far, far_in):
    ip(f"link add {near} type veth peer name {far}")
    for name, inside in ((near, near_in), (far, far_in)):
        if inside:
            ip(f"link set {name} netns {inside}")
        ip(f"link set {name} up", inside)


def without_checksum(frame):
    """The kernel leaves a datagram's checksum to a card that is not there; none at all is allowed."""
    is_ip = frame[12:14] == b"\x08\x00" and len(frame) >= 34
    if not is_ip or frame[23] != UDP or (frame[20] & 0x1F) or frame[21]:
        return frame
    at = 14 + 4 * (frame[14] & 0x0F) + 6
    return frame[:at] + b"\0\0" + frame[at + 2:]


class Wire:
    """Carries frames between two interfaces."""

    def __init__(self, names, orders):
        self.sockets = []
        for name in names:
            wire = socket.socket(socket.AF_PACKET, socket.SOCK_RAW, socket.htons(0x0003))
            wire.bind((name, 0))
            wire.setblocking(False)
            self.sockets.append(wire)
        self.orders, self.under_way, self.count = orders, [], 0
        self.settings = {"delay": 0.0, "loss": 0.0, "jitter": 0.0}
        self.random = random.Random(1)

    def take(self, wire, now):
        try:
            frame, (_, _, kind, *_) = wire.recvfrom(65536)
        except BlockingIOError:
            return
        if kind == PACKET_OUTGOING or self.random.random() < self.settings["loss"]:
            return
        late_ms = self.settings["delay"] + self.random.random() * self.settings["jitter"]
        self.count += 1
        other = self.sockets[1 - self.sockets.index(wire)]
        heapq.heappush(self.under_way, (now + late_ms / 1000, self.count, other, without_checksum(frame)))

    def obey(self):
        line = os.read(self.orders, 4096)
        if not line:
            return False
        for order in line.decode().splitlines():
            name, value = order.split()
            self.settings[name] = float(value)
        return True

    def run(self):
        while True:
            wait = max(0.0, self.under_way[0][0] - time.monotonic()) if self.under_way else None
            ready, _, _ = select.select([self.orders, *self.sockets], [], [], wait)
            if self.orders in ready and not self.obey():
                return
            now = time.monotonic()
            for wire in self.sockets:
                if wire in ready:
                    self.take(wire, now)
            while self.under_way and self.under_way[0][0] <= now:
                _, _, wire, frame = heapq.heappop(self.under_way)
                try:
                    wire.send(frame)
                except OSError:
                    pass  # the end has gone; so has the frame


def carry(begin, orders):
    os.read(begin, 1)
    Wire(("wire-1", "wire-2"), orders).run()


def main():
    begin_read, begin = os.pipe()
    order_read, orders = os.pipe()
    server, client = in_new_network(signal.pause), in_new_network(signal.pause)
    wire = in_new_network(lambda: (os.close(orders), carry(begin_read, order_read)))
    connect("router-1", None, "end-1", server)
    connect("router-2", None, "wire-1", wire)
    connect("wire-2", wire, "end-2", client)
    for network, end, inside, address in ((1, "end-1", server, SERVER_ADDRESS), (2, "end-2", client, CLIENT_ADDRESS)):
        gateway = f"10.77.{network}.1"
        ip(f"address add {gateway}/24 dev router-{network}")
        ip(f"address add {address}/24 dev {end}", inside)
        ip("link set lo up", inside)
        ip(f"route add default via {gateway}", inside)
    with open("/proc/sys/net/ipv4/ip_forward", "w") as forward:
        forward.write("1")
    os.write(begin, b"x")
    print(json.dumps({"server": server, "client": client}), flush=True)
    while line := sys.stdin.buffer.readline():
        os.write(orders, line)
    for child in (server, client, wire):
        os.kill(child, signal.SIGKILL)


if __name__ == "__main__":
    main()
