#!/usr/bin/env python3
"""Writes the seeds of archive_fuzz.cpp into corpus/archive. tests/unit/studio/archive_test.cpp says what each is refused for; those that
begin with 'good' are taken. What the fuzzer itself found is kept beside them under names that begin with 'found_'."""

import io
import pathlib
import stat
import zipfile

TEXT = b"<X3D version='4.0'><Scene/></X3D>"
PLY = b"ply\n"


def packed(entries, compression=zipfile.ZIP_STORED, mode=0o644):
    """A zip archive of (name, bytes); a name may come twice."""
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w", compression) as archive:
        for name, content in entries:
            info = zipfile.ZipInfo(name)
            info.create_system, info.compress_type = 3, compression
            info.external_attr = ((stat.S_IFDIR | 0o755) if name.endswith("/") else (stat.S_IFREG | mode)) << 16
            archive.writestr(info, content)
    return out.getvalue()


def with_file(name, content=PLY):
    return packed([("crane/crane.x3d", TEXT), (name, content)])


def patched(archive, at_local, at_central, value):
    """Other bytes in each local header and each entry of the list, at these offsets."""
    out = bytearray(archive)
    for signature, offset in ((b"PK\3\4", at_local), (b"PK\1\2", at_central)):
        at = out.find(signature)
        while offset is not None and at >= 0:
            out[at + offset:at + offset + len(value)] = value
            at = out.find(signature, at + 4)
    return bytes(out)


def link():
    out = io.BytesIO()
    with zipfile.ZipFile(out, "w") as archive:
        archive.writestr("crane/crane.x3d", TEXT)
        info = zipfile.ZipInfo("crane/files/a.ply")
        info.create_system, info.external_attr = 3, (stat.S_IFLNK | 0o777) << 16
        archive.writestr(info, "/etc/passwd")
    return out.getvalue()


def streamed():
    """As a program writes it that cannot go back: sizes stand behind each file."""
    class Pipe(io.RawIOBase):
        def __init__(self):
            self.bytes = b""

        def writable(self):
            return True

        def write(self, some):
            self.bytes += bytes(some)
            return len(some)

    pipe = Pipe()
    with zipfile.ZipFile(pipe, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in (("crane/", b""), ("crane/crane.x3d", TEXT), ("crane/files/a.ply", PLY)):
            info = zipfile.ZipInfo(name)
            info.compress_type = zipfile.ZIP_STORED if name.endswith("/") else zipfile.ZIP_DEFLATED
            archive.writestr(info, content)
    return pipe.bytes


GOOD = packed([("crane/crane.x3d", TEXT), ("crane/files/a.ply", PLY), ("crane/files/b.ogg", b"OggS")])
ONE = packed([("crane/crane.x3d", TEXT)], zipfile.ZIP_DEFLATED)
ZEROS = packed([("crane/crane.x3d", TEXT), ("crane/files/a.ply", bytes(100_000))], zipfile.ZIP_DEFLATED)
SEEDS = {
    "good": GOOD,
    "good_deflated": packed([("crane/", b""), ("crane/crane.x3d", TEXT), ("crane/files/", b""), ("crane/files/a.ply", PLY)],
                            zipfile.ZIP_DEFLATED),
    "good_streamed": streamed(),
    "good_empty_file": with_file("crane/files/a.ply", b""),
    "nothing": b"",
    "text": TEXT,
    "cut_list": GOOD[:-30],
    "cut_half": GOOD[:len(GOOD) // 2],
    "wrong_checksum": GOOD.replace(b"ply\n", b"plx\n"),
    "no_entries": packed([]),
    "no_x3d": packed([("crane/files/a.ply", PLY)]),
    "two_x3d": with_file("crane/other.x3d", TEXT),
    "x3d_of_another_name": packed([("crane/other.x3d", TEXT)]),
    "two_folders": with_file("odometer/odometer.x3d", TEXT),
    "doubled": packed([("crane/crane.x3d", TEXT), ("crane/files/a.ply", PLY), ("crane/files/a.ply", b"ply\n2")]),
    "doubled_x3d": with_file("crane/crane.x3d", TEXT),
    "up": with_file("crane/files/../../../a.ply"),
    "up_at_once": with_file("../a.ply"),
    "absolute": with_file("/etc/a.ply"),
    "backslash": with_file("crane\\files\\a.ply"),
    "nul": with_file("crane/files/a.plyXb.ply").replace(b"a.plyXb", b"a.ply\0b"),
    "not_utf8": with_file("crane/files/aXX.ply").replace(b"aXX.ply", b"a\xff\xfe.ply"),
    "control": with_file("crane/files/a\x1b[2J.ply"),
    "program": with_file("crane/files/a.exe"),
    "deeper": with_file("crane/files/more/a.ply"),
    "beside": with_file("crane/a.ply"),
    "at_top": with_file("a.ply"),
    "link": link(),
    "encrypted": patched(GOOD, 6, 8, b"\1\0"),
    "bzip2": packed([("crane/crane.x3d", TEXT)], zipfile.ZIP_BZIP2),
    "large_x3d_declared": patched(ONE, None, 24, (17 << 20).to_bytes(4, "little")),
    "large_declared": patched(ZEROS, None, 24, (0x7FFFFFFF).to_bytes(4, "little")),
    "more_than_declared": patched(ZEROS, 22, 24, (100).to_bytes(4, "little")),
    "less_than_declared": patched(ZEROS, 22, 24, (200_000).to_bytes(4, "little")),
    "many": packed([("crane/crane.x3d", TEXT)] + [(f"crane/files/{i}.ply", b"") for i in range(201)]),
    "many_folders": packed([("crane/crane.x3d", TEXT)] + [(f"crane/{i}/", b"") for i in range(500)]),
}

if __name__ == "__main__":
    folder = pathlib.Path(__file__).parent / "corpus" / "archive"
    folder.mkdir(parents=True, exist_ok=True)
    for name, content in SEEDS.items():
        (folder / f"{name}.zip").write_bytes(content)
    print(f"{len(SEEDS)} archives in {folder.name}")
