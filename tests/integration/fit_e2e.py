"""`mechane fit`: a mesh into a .part file and a page of pictures; bad meshes, full disks, Ctrl-C."""

import json
import math
import os
import pty
import re
import signal
import struct
import subprocess
import unittest

import fault_e2e
from harness import BIN, EndToEnd, marked, wait_until

QUADS = ((3, 2, 1, 0), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))


def obj_of_boxes(boxes):
    """Boxes as OBJ text: (name, centre, half sizes) each; every box is a node of the file."""
    vertices, faces = [], []
    for name, centre, half in boxes:
        first = len(vertices) + 1
        for z in (-1, 1):
            for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                vertices.append([c + s * h for c, s, h in zip(centre, (x, y, z), half)])
        faces.append(f"o {name}")
        for a, b, c, d in QUADS:
            faces += [f"f {first + a} {first + b} {first + c}", f"f {first + a} {first + c} {first + d}"]
    return "\n".join(["v {} {} {}".format(*v) for v in vertices] + faces) + "\n"


CRANK = obj_of_boxes([("part_shaft", (0, 0, 0), (0.02, 0.02, 0.1)), ("part_arm", (0.11, 0, 0.1), (0.13, 0.015, 0.012)),
                      ("part_grip", (0.21, 0, 0.16), (0.017, 0.017, 0.06))])
# Many parts: long enough to be interrupted, and too much for a small disk.
FENCE = obj_of_boxes([(f"part_{i}", (0.3 * i, 0, 0), (0.1, 0.12, 0.14)) for i in range(60)])


BOX = obj_of_boxes([("part_box", (0, 0, 0), (0.02, 0.03, 0.04))])


def fine_ball(triangles):
    """A ball of 0.2 m as a binary STL."""
    down = round(math.sqrt(triangles / 4))
    ring = [[struct.pack("<3f", 0.1 * math.sin(math.pi * j / down) * math.cos(math.pi * i / down),
                         0.1 * math.sin(math.pi * j / down) * math.sin(math.pi * i / down),
                         0.1 * math.cos(math.pi * j / down)) for i in range(2 * down)] for j in range(down + 1)]
    for j in (0, down):
        ring[j] = [struct.pack("<3f", 0, 0, 0.1 if j == 0 else -0.1)] * (2 * down)
    faces = []
    for j in range(down):
        for i in range(2 * down):
            a, b = ring[j][i], ring[j][(i + 1) % (2 * down)]
            c, d = ring[j + 1][i], ring[j + 1][(i + 1) % (2 * down)]
            faces += ([a + c + d] if j < down - 1 else []) + ([a + d + b] if j > 0 else [])
    return bytes(80) + struct.pack("<I", len(faces)) + b"".join(bytes(12) + face + bytes(2) for face in faces)


class Fit(EndToEnd):
    def mesh(self, name, text):
        path = self.folder / name
        path.parent.mkdir(exist_ok=True)
        path.write_bytes(text) if isinstance(text, bytes) else path.write_text(text)
        return path

    def files(self):
        return sorted(p.name for p in self.folder.iterdir())

    def test_a_mesh_becomes_an_object_and_a_page(self):
        mesh = self.mesh("crank.obj", CRANK)
        result = self.run_command("fit", mesh, limit_s=120)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertEqual(self.files(), ["crank.html", "crank.obj", "crank.part"])
        self.assertIn(str(self.folder / "crank.part"), result.stdout.splitlines())
        for part in ("part_shaft", "part_arm", "part_grip"):
            self.assertIn(part, result.stdout)
        self.assertEqual([line for line in result.stdout.splitlines() if " " in line and len(line) > 100], [])
        page = (self.folder / "crank.html").read_text()
        self.assertEqual(page.count("<img"), 9 + 3)
        self.assertNotRegex(page, r"https?:|<script|<link")
        again = self.run_command("fit", mesh, "-o", self.folder / "new/folder", "--report", "none", limit_s=120)
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertEqual([p.name for p in (self.folder / "new/folder").iterdir()], ["crank.part"])
        self.assertEqual((self.folder / "new/folder/crank.part").read_bytes(), (self.folder / "crank.part").read_bytes())
        other = self.run_command("fit", mesh, "-o", self.folder / "new", "--report", "none", "--resolution", "64", limit_s=120)
        self.assertEqual(other.returncode, 0, other.stderr)
        self.assertGreater((self.folder / "new/crank.part").stat().st_size, (self.folder / "crank.part").stat().st_size)

    def test_figures_for_programs_and_units_of_the_file(self):
        box = obj_of_boxes([("part_block", (0, 0, 0), (50, 40, 30))])  # millimetres, as many programs export
        mesh = self.mesh("block.obj", box)
        result = self.run_command("fit", mesh, "--scale", "0.001", "--json", "--report", "none", "--strict", limit_s=120)
        self.assertEqual(result.returncode, 0, result.stderr)
        figures = json.loads((self.folder / "block.json").read_text())
        self.assertAlmostEqual(figures["diagonal_mm"], 2 * math.hypot(50, 40, 30), places=3)
        self.assertTrue(figures["met"])
        self.assertEqual([part["name"] for part in figures["parts"]], ["part_block"])
        # Nothing can be so exact; what there is, is written, and said to be less than asked for.
        result = self.run_command("fit", mesh, "--scale", "0.001", "--json", "--report", "none", "--strict", "--error", "1e-6", limit_s=120)
        self.assertEqual(result.returncode, 3, result.stderr + result.stdout)
        self.assertFalse(json.loads((self.folder / "block.json").read_text())["met"])
        self.assertIn("exceed the allowed error", result.stdout)

    @marked("address")
    def test_a_bad_mesh_is_told_and_does_not_stop_the_others(self):
        bad = {
            "empty.obj": "",
            "lines.obj": "v 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2\nl 2 3\n",
            "cut.glb": b"glTF" + struct.pack("<II", 2, 4000),
            "vast.obj": obj_of_boxes([("box", (0, 0, 0), (4e4, 4e4, 4e4))]),
            "not.txt": "hello",
        }
        paths = [self.mesh(name, text) for name, text in bad.items()] + [self.folder / "nowhere.stl"]
        good = self.mesh("good.obj", obj_of_boxes([("part_block", (0, 0, 0), (0.05, 0.04, 0.03))]))
        result = self.run_command("fit", *paths, good, "--report", "none", limit_s=120)
        self.assertEqual(result.returncode, 1, result.stderr)
        told = [line for line in result.stderr.splitlines() if line.startswith("mechane fit: ")]
        self.assertEqual(len(told), len(paths), result.stderr)
        for path, line in zip(paths, told):
            self.assertIn(path.name, line)
            self.assertIn("; ", line, "what to do stands behind what is wrong")
        self.assertEqual([p.name for p in self.folder.glob("*.part")], ["good.part"])

    def fit_alone(self, name, content, limit_s=120):
        return self.run_command("fit", self.mesh(name, content), "--report", "none", limit_s=limit_s)

    @marked("address")
    def test_an_open_mesh_is_built_with_a_word_about_it(self):
        text = "\n".join(CRANK.splitlines()[:-1]) + "\n"  # the last triangle is gone
        fin = BOX + "v 0.02 0.02 0.3\nf 1 2 9\n"  # three triangles share an edge
        for name, content, says in (("open.obj", text, r"part 'part_grip': open, with 3 edges without a\s+neighbour"),
                                    ("fin.obj", fin, r"part 'part_box': 69 cm² of it [\s\w,]+\s+are\s+left\s+out")):
            result = self.fit_alone(name, content)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertRegex(result.stdout, says)

    @marked("address")
    def test_a_value_that_is_not_a_number_is_reported(self):
        for name, content in (("nan.obj", CRANK.replace("v 0.02 ", "v nan ", 1)), ("inf.obj", BOX.replace("v -0.02 ", "v inf ", 1))):
            result = self.fit_alone(name, content)
            self.assertEqual(result.returncode, 1, result.stdout)
            self.assertRegex(result.stderr, rf"{name}, mesh part_\w+: corner \d+ .* not a finite number; .*export it again")
        self.assertEqual([name for name in self.files() if name.endswith(".part")], [])

    def test_faults_that_can_be_mended_are(self):
        turned = re.sub(r"f (\d+) (\d+) (\d+)", r"f \1 \3 \2", BOX)
        faces = [line for line in BOX.splitlines() if line.startswith("f ")]
        second = obj_of_boxes([("same", (0.02, 0.01, 0.03), (0.015, 0.06, 0.02))]).splitlines()
        second = [re.sub(r"\d+", lambda index: str(int(index[0]) + 8), line) if line.startswith("f ") else line for line in second]
        crossed = BOX + "\n".join(line for line in second if not line.startswith("o ")) + "\n"
        for name, content, says in (("plain.obj", BOX, "12 triangles"),
                                    ("turned.obj", turned, r"part 'part_box': inside out in the\s+model"),
                                    ("duplicate.obj", BOX + "\n".join(faces) + "\n", "12 triangles"),
                                    ("degenerate.obj", BOX + "f 1 1 2\nf 3 3 3\n", "12 triangles"),
                                    ("crossed.obj", crossed, "24 triangles")):
            result = self.fit_alone(name, content)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertRegex(result.stdout, says)
            self.assertNotIn("edges without", result.stdout)
            felt = re.search(r"([\d.]+) mm at p99; ([\d.]+) % of it is not felt", result.stdout)
            # Where two bodies cross, the edges of the crossing are rounded, and the summary says so.
            self.assertLess(float(felt[1]), 5 if name == "crossed.obj" else 1, result.stdout)
            self.assertLess(float(felt[2]), 0.5, result.stdout)

    @marked("address")
    def test_a_sheet_is_made_thick_or_refused_where_it_must_be_closed(self):
        sheet = "v 0 0 0\nv 0.1 0 0\nv 0.1 0.1 0\nv 0 0.1 0\n"
        for name, faces in (("two.obj", "f 1 2 3\nf 1 3 4\n"), ("folded.obj", "f 1 2 3\nf 1 3 2\n")):
            result = self.fit_alone(name, sheet + faces)
            self.assertEqual(result.returncode, 0, result.stderr)
            self.assertRegex(result.stdout, r"a sheet of\s+1\.0\s+mm")
            result = self.run_command("fit", self.folder / name, "--report", "none", "--solid", "closed", limit_s=120)
            self.assertEqual(result.returncode, 1, result.stdout)
            self.assertRegex(result.stderr, rf"mechane fit: .*{name}.*: .*; .+")

    def test_a_fine_mesh_is_done_in_a_while(self):
        result = self.fit_alone("fine.stl", fine_ball(50_000), limit_s=240)
        self.assertEqual(result.returncode, 0, result.stderr)
        self.assertRegex(result.stdout, r"1 part, [45]\d{4} triangles")

    def test_two_meshes_of_one_name_do_not_overwrite_each_other(self):
        first = self.mesh("a/crank.obj", CRANK)
        second = self.mesh("b/crank.obj", CRANK)
        result = self.run_command("fit", first, second, "-o", self.folder / "out", "--report", "none", limit_s=120)
        self.assertEqual(result.returncode, 1)
        self.assertIn(f"{second}: its results would overwrite those of {first}", result.stderr)
        self.assertTrue((self.folder / "out/crank.part").exists())

    def test_a_folder_that_is_a_file_is_told_before_the_work(self):
        mesh = self.mesh("fence.obj", FENCE)
        result = self.run_command("fit", mesh, "-o", mesh)
        self.assertEqual(result.returncode, 1)
        self.assertRegex(result.stderr, r"fence\.obj.*; name ")
        self.assertNotIn("parts built", result.stderr)

    def test_a_full_disk_is_told_and_leaves_nothing(self):
        mesh = self.mesh("fence.obj", FENCE)
        out = self.folder / "small"
        # A second command looks into the disk, which is gone with its namespace.
        command = [*fault_e2e.Faults.full_disk(out), "sh", "-c", '"$0" fit "$1" -o "$2" --report none; echo "status $?"; ls -A "$2"',
                   str(BIN / "mechane"), str(mesh), str(out)]
        result = subprocess.run(command, capture_output=True, text=True, timeout=300, env=self.environment)
        self.assertRegex(result.stderr, r"fence\.part: cannot be written: .*; make room on the disk")
        self.assertEqual(result.stdout.split("status ")[1].split(), ["1"], "no file is left")

    def test_it_runs_on_idle_time_without_rights(self):
        mesh = self.mesh("fence.obj", FENCE)
        # In a namespace of its own even root may not raise a priority.
        idle = ["chrt", "--idle", "0"]
        if subprocess.run(["unshare", "--map-root-user", "true"], capture_output=True).returncode == 0:
            idle += ["unshare", "--map-root-user"]
        result = subprocess.run([*idle, str(BIN / "mechane"), "fit", str(mesh), "-o", str(self.folder), "--report", "none"],
                                capture_output=True, text=True, timeout=300, env=self.environment)
        self.assertEqual(result.returncode, 0, result.stderr)

    @marked("address")
    def test_ctrl_c_ends_it_at_once_and_leaves_nothing(self):
        mesh = self.mesh("fence.obj", FENCE)
        (self.folder / "fence.part").write_text("the old one")
        # An error that no map meets: every one is tried, which takes long enough to be told.
        fit = self.start("fit", "fit", mesh, "--error", "0.000001", "--spacing", "0.0004", "--max-samples", "1000000")
        wait_until(lambda: "parts built" in fit.text(), 60, "parts are being built")
        fit.process.send_signal(signal.SIGINT)
        self.assertEqual(fit.wait(5), 130, fit.text())
        self.assertEqual((self.folder / "fence.part").read_text(), "the old one")
        self.assertEqual([name for name in self.files() if not name.endswith(".log")], ["fence.obj", "fence.part"])

    def test_a_terminal_gets_a_bar(self):
        mesh = self.mesh("crank.obj", CRANK)
        ours, theirs = pty.openpty()
        process = subprocess.Popen([str(BIN / "mechane"), "fit", str(mesh), "--report", "none"], stdin=subprocess.DEVNULL,
                                   stdout=subprocess.DEVNULL, stderr=theirs, env=self.environment)
        os.close(theirs)
        seen = b""
        try:
            while piece := os.read(ours, 4096):
                seen += piece
        except OSError:  # the other end is closed
            pass
        os.close(ours)
        self.assertEqual(process.wait(60), 0)
        text = seen.decode(errors="replace")
        self.assertRegex(text, r"crank\.obj +[█░]+ \d/3 parts built, \d+ s")
        self.assertTrue(text.endswith("\r\x1b[K"), "the line is free again")


if __name__ == "__main__":
    unittest.main(verbosity=2)
