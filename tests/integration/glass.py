"""A touch screen without glass: an Xorg with the drivers `dummy` (its picture) and `inputtest` (its fingers, which come through a socket)."""

import os
import pathlib
import shutil
import socket
import struct
import subprocess

from harness import PATIENCE, wait_until

# xf86-input-inputtest-protocol.h, version 1.1
CLIENT_VERSION, WAIT_FOR_SYNC, TOUCH = 0, 1, 6
BEGIN, UPDATE, END = 18, 19, 20  # XI_Touch...
VALUATORS, MOST = 64, 0xFFFF

CONFIGURATION = """
Section "ServerFlags"
  Option "AutoAddDevices" "false"
  Option "DontVTSwitch" "true"
EndSection
Section "InputDevice"
  Identifier "glass"
  Driver "inputtest"
  Option "DeviceType" "Touch"
  Option "TouchCount" "10"
  Option "SocketPath" "{glass}"
EndSection
Section "InputDevice"
  Identifier "mouse"
  Driver "inputtest"
  Option "DeviceType" "Pointer"
  Option "SocketPath" "{mouse}"
EndSection
Section "InputDevice"
  Identifier "keys"
  Driver "inputtest"
  Option "DeviceType" "Keyboard"
  Option "SocketPath" "{keys}"
EndSection
Section "Device"
  Identifier "card"
  Driver "dummy"
EndSection
Section "Monitor"
  Identifier "monitor"
  HorizSync 5-1000
  VertRefresh 5-200
EndSection
Section "Screen"
  Identifier "screen"
  Monitor "monitor"
  Device "card"
  DefaultDepth 24
  SubSection "Display"
    Depth 24
    Modes "640x360"
    Virtual 640 360
  EndSubSection
EndSection
Section "ServerLayout"
  Identifier "layout"
  Screen "screen"
  InputDevice "mouse" "CorePointer"
  InputDevice "keys" "CoreKeyboard"
  InputDevice "glass" "SendCoreEvents"
EndSection
"""


class NoGlass(Exception):
    """Xorg cannot be started here; says why."""


class Glass:
    SIZE = (640, 360)

    def __init__(self, folder, environment):
        self.folder = pathlib.Path(folder)
        self.down = {}  # finger to its place
        if shutil.which("Xorg") is None:
            raise NoGlass("there is no Xorg: deploy/install-deps")
        sockets = {name: self.folder / name for name in ("glass", "mouse", "keys")}
        configuration = self.folder / "xorg.conf"
        configuration.write_text(CONFIGURATION.format(**sockets))
        self._log = self.folder / "xorg.log"
        read, write = os.pipe()
        self._xorg = subprocess.Popen(["Xorg", "-displayfd", str(write), "-config", str(configuration), "-logfile", str(self._log),
                                       "-noreset", "-nolisten", "tcp"], pass_fds=[write], stdin=subprocess.DEVNULL,
                                      stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(write)
        with os.fdopen(read) as said:
            number = said.readline().strip()
        if not number:
            self._xorg.wait()
            raise NoGlass(f"Xorg did not start: {self._reason()}")
        self.environment = {**environment, "DISPLAY": f":{number}"}
        try:
            wait_until(sockets["glass"].exists, 10, "the glass has its socket")
            self._fingers = socket.socket(socket.AF_UNIX, socket.SOCK_STREAM)
            self._fingers.settimeout(10 * PATIENCE)
            self._fingers.connect(str(sockets["glass"]))
            self._fingers.sendall(struct.pack("=IIHH", 12, CLIENT_VERSION, 1, 1))
            self._answer()
        except (AssertionError, OSError) as error:
            self.stop()
            raise NoGlass(f"Xorg takes no fingers: {error}") from error

    def _reason(self):
        lines = self._log.read_text(errors="replace").splitlines() if self._log.exists() else []
        return "; ".join(line.split("(EE)")[1].strip() for line in lines if line.startswith("[") and "(EE)" in line and line.split("(EE)")[1].strip()) or "it says nothing"

    def _answer(self):
        length, kind = struct.unpack("=II", self._fingers.recv(8, socket.MSG_WAITALL))
        self._fingers.recv(length - 8, socket.MSG_WAITALL)
        return kind

    def _touch(self, kind, finger, at):
        """Returns when Xorg has taken it."""
        where = [0.0] * VALUATORS
        where[0], where[1] = (MOST * share for share in (at[0] / self.SIZE[0], at[1] / self.SIZE[1]))
        body = struct.pack(f"=IIIII8s4x{VALUATORS}d{VALUATORS}d", 16 + 16 + 16 * VALUATORS, TOUCH, finger, kind, 0, bytes([3]),
                           *where, *([0.0] * VALUATORS))
        self._fingers.sendall(body + struct.pack("=II", 8, WAIT_FOR_SYNC))
        self._answer()

    def press(self, finger, at):
        self._touch(BEGIN, finger, at)
        self.down[finger] = at

    def move(self, finger, at):
        self._touch(UPDATE, finger, at)
        self.down[finger] = at

    def lift(self, finger):
        """Where it is; of a finger that is not down Xorg would never say that it was taken."""
        if finger in self.down:
            self._touch(END, finger, self.down.pop(finger))

    def stop(self):
        if hasattr(self, "_fingers"):
            self._fingers.close()
        self._xorg.kill()
        self._xorg.wait()
