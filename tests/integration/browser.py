"""A browser's side of the gateway's wire, by the standard library: HTTP, and a small WebSocket client."""

import base64
import http.client
import json
import os
import re
import socket
import ssl
import struct
import threading

from harness import PATIENCE, EndToEnd, wait_until


class Page:
    """HTTP requests as a page of the gateway sends them, with its cookie."""

    def __init__(self, port, host="127.0.0.1", tls=False):
        self.host, self.port, self.tls = host, port, tls
        self.cookie, self.csrf = "", ""
        self.origin = f"{'https' if tls else 'http'}://{host}:{port}"

    def ask(self, method, path, body=None, headers=None):
        """The status, the headers by small names, and the body's bytes."""
        connection = self.connection()
        sent = {"Cookie": self.cookie} if self.cookie else {}
        if method == "POST":
            sent |= {"Origin": self.origin, "Content-Type": "application/json", "X-Mechane-CSRF": self.csrf}
        data = json.dumps(body) if isinstance(body, (dict, list)) else body
        connection.request(method, path, data, {**sent, **(headers or {})})
        answer = connection.getresponse()
        try:
            return answer.status, {name.lower(): value for name, value in answer.getheaders()}, answer.read()
        finally:
            connection.close()

    def connection(self):
        if not self.tls:
            return http.client.HTTPConnection(self.host, self.port, timeout=30 * PATIENCE)
        trusting = ssl.create_default_context()
        trusting.check_hostname, trusting.verify_mode = False, ssl.CERT_NONE
        return http.client.HTTPSConnection(self.host, self.port, timeout=30 * PATIENCE, context=trusting)

    def get(self, path, **headers):
        return self.ask("GET", path, headers=headers)

    def post(self, path, body, **headers):
        status, _, text = self.ask("POST", path, body, headers)
        return status, text

    def sign_in(self, user, password):
        status, headers, text = self.ask("POST", "/api/sign-in", {"user": user, "password": password})
        if status == 200:
            self.cookie = headers["set-cookie"].split(";")[0]
            self.csrf = json.loads(text)["csrf"]
        return status, headers, text


class Refused(Exception):
    def __init__(self, status, body):
        super().__init__(f"{status} {body}")
        self.status, self.body = status, body


class Frame:
    """As STREAM.md has it."""

    def __init__(self, data):
        self.skipped, self.sequence, self.tick, self.age_s, n, m, h, r = struct.unpack_from("<4xIQQdIIII", data)
        at = 48
        self.bodies = {}
        for _ in range(n):
            index, visible, *pose = struct.unpack_from("<II7f", data, at)
            self.bodies[index] = (visible, pose)
            at += 36
        self.quantities = struct.unpack_from(f"<{m}f", data, at)
        at += 4 * m
        self.hands = []
        for _ in range(h):
            user, kind, stale, holding, *force, segments = struct.unpack_from("<BBBB3fI", data, at)
            at += 20
            poses = [struct.unpack_from("<7f", data, at + 28 * k) for k in range(segments)]
            at += 28 * segments
            self.hands.append({"user": user, "kind": kind, "stale": stale, "holding": holding, "force": force, "poses": poses})
        self.ropes = []
        for _ in range(r):
            diameter, points = struct.unpack_from("<fI", data, at)
            self.ropes.append((diameter, [struct.unpack_from("<3f", data, at + 8 + 12 * k) for k in range(points)]))
            at += 8 + 12 * points
        if at != len(data):
            raise AssertionError(f"a frame of {len(data)} bytes, of which {at} are known")


class Browser:
    """A WebSocket at a kiosk. A thread reads what comes, unless `reads` is false; state() has the newest text of each type."""

    def __init__(self, page, path, reads=True, origin=None, protocol="mechane.1", receive_buffer=None):
        self.socket = socket.socket()
        if receive_buffer:
            self.socket.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receive_buffer)
        self.socket.settimeout(60 * PATIENCE)
        self.socket.connect((page.host, page.port))
        lines = [f"GET {path} HTTP/1.1", f"Host: {page.host}:{page.port}", "Upgrade: websocket", "Connection: Upgrade",
                 f"Sec-WebSocket-Key: {base64.b64encode(os.urandom(16)).decode()}", "Sec-WebSocket-Version: 13",
                 f"Origin: {page.origin if origin is None else origin}"]
        lines += [f"Sec-WebSocket-Protocol: {protocol}"] if protocol else []
        lines += [f"Cookie: {page.cookie}"] if page.cookie else []
        self.socket.sendall(("\r\n".join(lines) + "\r\n\r\n").encode())
        self._bytes = b""
        while b"\r\n\r\n" not in self._bytes:
            more = self.socket.recv(4096)
            if not more:
                raise Refused(0, "closed")
            self._bytes += more
        head, self._bytes = self._bytes.split(b"\r\n\r\n", 1)
        status = int(head.split()[1])
        if status != 101:
            raise Refused(status, (self._bytes + self._rest()).decode(errors="replace"))
        self.texts, self.frame, self.frames, self.events, self.open = {}, None, 0, [], True
        self.thread = threading.Thread(target=self._read, daemon=True)
        if reads:
            self.thread.start()

    def read(self):
        """Begins to read."""
        self.thread.start()

    def _rest(self):
        rest = b""
        while more := self.socket.recv(4096):
            rest += more
        return rest

    def _take(self, count):
        while len(self._bytes) < count:
            more = self.socket.recv(65536)
            if not more:
                raise ConnectionError
            self._bytes += more
        taken, self._bytes = self._bytes[:count], self._bytes[count:]
        return taken

    def _read(self):
        try:
            while True:
                first, second = self._take(2)
                size = second & 0x7F
                if size == 126:
                    (size,) = struct.unpack(">H", self._take(2))
                elif size == 127:
                    (size,) = struct.unpack(">Q", self._take(8))
                data = self._take(size)
                if first & 0x0F == 1:
                    text = json.loads(data)
                    self.texts[text["type"]] = text
                    if text["type"] == "event":
                        self.events.append(text)
                elif first & 0x0F == 2:
                    self.frame = Frame(data)
                    self.frames += 1
                elif first & 0x0F == 9:
                    self._send(10, data)
                elif first & 0x0F == 8:
                    break
        except OSError:
            pass
        self.open = False

    def _send(self, kind, data):
        mask = os.urandom(4)
        head = bytes([0x80 | kind])
        head += bytes([0x80 | len(data)]) if len(data) < 126 else bytes([0x80 | 126]) + struct.pack(">H", len(data)) \
            if len(data) < 65536 else bytes([0x80 | 127]) + struct.pack(">Q", len(data))
        self.socket.sendall(head + mask + bytes(b ^ mask[i % 4] for i, b in enumerate(data)))

    def say(self, **message):
        self._send(1, json.dumps(message).encode())

    def say_bytes(self, data, kind=2):
        self._send(kind, data)

    def wait(self, kind, condition=lambda text: True, limit_s=30):
        return wait_until(lambda: kind in self.texts and condition(self.texts[kind]) and self.texts[kind], limit_s,
                          f"the gateway tells of '{kind}'")

    def close(self):
        """As a page that is left without a word."""
        self.socket.close()


class WithGateway(EndToEnd):
    """Tests at a gateway of their own. A second one has the first one's state, so that its operator has the same password."""

    def gateway(self, *arguments):
        """It, and a page on which its operator has signed in."""
        process = self.start("gateway", "gateway", "--listen", "127.0.0.1:0", "--state", self.folder / "state", *arguments)
        wait_until(lambda: "\nready" in process.text() or not process.running(), 60, "the gateway is ready")
        self.assertTrue(process.running(), process.text())
        self.port = int(re.search(r"console: http://[^:]+:(\d+)/console", process.text()).group(1))
        if found := re.search(r"operator (\S+)", process.text()):
            self.password = found.group(1)
        return process, self.page("operator", self.password)

    def page(self, user, password):
        page = Page(self.port)
        self.assertEqual(page.sign_in(user, password)[0], 200)
        return page

    def got(self, page, path):
        status, _, body = page.get(path)
        self.assertEqual(status, 200, body)
        return json.loads(body)

    def posted(self, page, path, body, status=200):
        got, answer = page.post(path, body)
        self.assertEqual(got, status, answer)
        return json.loads(answer)
