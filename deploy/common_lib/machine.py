"""What a result must say of the machine that it comes from."""

import os
import re
import subprocess
from pathlib import Path


def commit(root: Path) -> str:
    """Short hash of the checkout, with '+' where files differ from it; 'none' outside a checkout."""
    try:
        short = subprocess.run(["git", "-C", str(root), "rev-parse", "--short", "HEAD"], check=True, capture_output=True, text=True)
        changed = subprocess.run(["git", "-C", str(root), "status", "--porcelain"], check=True, capture_output=True, text=True)
    except (OSError, subprocess.CalledProcessError):
        return "none"
    return short.stdout.strip() + ("+" if changed.stdout.strip() else "")


def cpu() -> str:
    found = re.search(r"^model name\s*:\s*(.+)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    return found.group(1) if found else "unknown"


def simd() -> str:
    """The widest instructions that the kernels may use here, as server/collision/kernels.cpp judges. A server's report says which it did use."""
    found = re.search(r"^flags\s*:\s*(.+)$", Path("/proc/cpuinfo").read_text(), re.MULTILINE)
    flags = set(found.group(1).split()) if found else set()
    if {"avx512f", "avx512dq"} <= flags:
        return "avx512"
    return "avx2" if "avx2" in flags else "scalar"


def cores() -> int:
    return len(os.sched_getaffinity(0))
