"""Whether the cursor of an X screen is seen: asked of XFixes, for no picture of a window has it."""

import ctypes
import unittest


class Image(ctypes.Structure):
    """XFixesCursorImage, Xfixes.h; of 32 bits a pixel, opacity the uppermost eight, each in a long."""
    _fields_ = [("x", ctypes.c_short), ("y", ctypes.c_short), ("width", ctypes.c_ushort), ("height", ctypes.c_ushort),
                ("xhot", ctypes.c_ushort), ("yhot", ctypes.c_ushort), ("serial", ctypes.c_ulong),
                ("pixels", ctypes.POINTER(ctypes.c_ulong)), ("atom", ctypes.c_ulong), ("name", ctypes.c_char_p)]


class Cursor:
    def __init__(self, environment):
        try:
            self._x11, self._fixes = ctypes.CDLL("libX11.so.6"), ctypes.CDLL("libXfixes.so.3")
        except OSError as error:
            raise unittest.SkipTest(f"nothing tells of the cursor: {error}") from error
        self._x11.XOpenDisplay.restype = ctypes.c_void_p
        self._fixes.XFixesGetCursorImage.restype = ctypes.POINTER(Image)
        self._screen = ctypes.c_void_p(self._x11.XOpenDisplay(environment["DISPLAY"].encode()))
        version = ctypes.c_int(4), ctypes.c_int(0)
        if not self._screen or not self._fixes.XFixesQueryVersion(self._screen, *map(ctypes.byref, version)):
            raise unittest.SkipTest("this screen tells nothing of its cursor")

    def seen(self):
        image = self._fixes.XFixesGetCursorImage(self._screen)
        pixels = image.contents.pixels[:image.contents.width * image.contents.height]
        self._x11.XFree(image)
        return any(pixel >> 24 & 0xFF for pixel in pixels)

    def close(self):
        self._x11.XCloseDisplay(self._screen)
