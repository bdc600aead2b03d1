"""What the gateway's streaming is held against: a plain loop that sends the same bytes, at the same pace, to as many clients over the same
loopback; nothing is received, encoded or decided. Prints its port, and serves until it is told to end. Run by gateway.py."""

import argparse
import selectors
import socket
import struct
import time

from stream_clients import TENTHS

HELLO = b"HTTP/1.1 101 Switching Protocols\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n\r\n"


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--bytes", type=int, required=True, help="of a frame, with its header")
    parser.add_argument("--per-second", type=float, required=True)
    options = parser.parse_args()
    listener = socket.create_server(("127.0.0.1", 0))
    print(listener.getsockname()[1], flush=True)
    body = bytes(options.bytes - 32)
    prefix = b"\x82\x7e" + struct.pack(">H", options.bytes) if options.bytes < 65536 else b"\x82\x7f" + struct.pack(">Q", options.bytes)
    selector = selectors.DefaultSelector()
    selector.register(listener, selectors.EVENT_READ)
    clients: list[socket.socket] = []
    due, sequence = time.monotonic(), 0
    while True:
        for _ in selector.select(max(0.0, due - time.monotonic())):
            client, _ = listener.accept()
            client.settimeout(10)
            asked = b""
            while b"\r\n\r\n" not in asked:
                asked += client.recv(4096)
            client.sendall(HELLO)
            clients.append(client)
        if time.monotonic() < due:
            continue
        due, sequence = due + 1 / options.per_second, sequence + 1
        for client in list(clients):
            sent = time.monotonic_ns() // 100_000 % TENTHS
            try:
                client.sendmsg([prefix, struct.pack("<BBHIQQd", 1, 1, sent, 0, sequence, 0, 0.0), body])
            except OSError:
                clients.remove(client)


if __name__ == "__main__":
    main()
