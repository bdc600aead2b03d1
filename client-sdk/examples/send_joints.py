#!/usr/bin/env python3
"""Sends a hand that opens and closes to the driver 'joints', as a tracking program does: a pattern for a bridge of your own.

    mechane devices --test joints &
    python3 send_joints.py

What a datagram has in it stands in client-sdk/drivers/joints/hand_datagram.hpp.
"""

import argparse
import json
import math
import socket
import time

# A right hand from its wrist, in metres: x towards the fingers, y out of its back, z away from the thumb.
PALM = (0.050, 0.0, 0.0)
KNUCKLES = ((0.098, 0.0, -0.031), (0.102, 0.0, -0.010), (0.099, 0.0, 0.011), (0.091, 0.0, 0.031))
BONES = ((0.045, 0.026, 0.020), (0.050, 0.030, 0.021), (0.046, 0.029, 0.021), (0.037, 0.021, 0.019))
THUMB, THUMB_BONES = (0.030, -0.006, -0.040), (0.046, 0.034, 0.028)
THUMB_ALONG, THUMB_PALMWARDS = (0.622, -0.301, -0.723), (0.285, -0.773, 0.567)  # unit vectors


def chain(start, along, palmwards, bones, bends):
    """A finger's joints from the palm to its tip: each bone is turned towards the palm, from the one before."""
    points, angle = [start], 0.0
    for bone, bend in zip(bones, bends):
        angle += bend
        points.append(tuple(p + bone * (math.cos(angle) * a + math.sin(angle) * d)
                            for p, a, d in zip(points[-1], along, palmwards)))
    return points


def hand(form, closed):
    """The joints in the order of `form`; `closed` is 0 to 1."""
    joints = {"openxr": [PALM, (0.0, 0.0, 0.0)], "webxr": [(0.0, 0.0, 0.0)], "mediapipe": [(0.0, 0.0, 0.0)]}[form]
    joints += chain(THUMB, THUMB_ALONG, THUMB_PALMWARDS, THUMB_BONES, (0.4 * closed, 0.7 * closed, 1.0 * closed))
    for knuckle, bones in zip(KNUCKLES, BONES):
        if form != "mediapipe":
            joints.append(tuple(0.2 * part for part in knuckle))  # the metacarpal begins near the wrist
        joints += chain(knuckle, (1, 0, 0), (0, -1, 0), bones, (1.5 * closed, 1.7 * closed, 1.3 * closed))
    return joints


def seen(joint, form, left, height):
    """In the tracker's frame. The hand lies palm down, and its fingers point away from the visitor."""
    right, up, backwards = joint[2] * (-1 if left else 1), joint[1] + height, -joint[0]
    return (right, -up, -backwards) if form == "mediapipe" else (right, up, backwards)


def main():
    parser = argparse.ArgumentParser(description="Sends a hand that opens and closes to the driver 'joints'.")
    parser.add_argument("--port", type=int, default=9680, help="UDP port on this computer (9680)")
    parser.add_argument("--socket", help="the driver's Unix socket, instead of a port")
    parser.add_argument("--format", choices=("openxr", "webxr", "mediapipe"), default="openxr")
    parser.add_argument("--hand", choices=("right", "left"), default="right")
    parser.add_argument("--rate", type=float, default=60, help="hands a second (60)")
    parser.add_argument("--seconds", type=float, default=math.inf, help="how long (until Ctrl-C)")
    options = parser.parse_args()
    family, address = (socket.AF_UNIX, options.socket) if options.socket else (socket.AF_INET, ("127.0.0.1", options.port))
    with socket.socket(family, socket.SOCK_DGRAM) as out:
        out.setblocking(False)  # a driver that hangs must not hold up the tracker
        for number in range(int(min(options.seconds, 1e9) * options.rate)):
            t = number / options.rate
            closed, height = 0.5 - 0.5 * math.cos(math.pi * t), 0.05 * math.sin(math.pi * t)  # in two seconds
            joints = [seen(joint, options.format, options.hand == "left", height) for joint in hand(options.format, closed)]
            datagram = {"format": options.format, "hand": options.hand, "seq": number, "joints": joints}
            try:
                out.sendto(json.dumps(datagram).encode(), address)
            except OSError:
                pass  # no driver listens just now; it may later
            time.sleep(1 / options.rate)  # sleeps: the pace of a tracker


if __name__ == "__main__":
    try:
        main()
    except KeyboardInterrupt:
        pass
