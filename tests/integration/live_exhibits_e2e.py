"""Exhibits are loaded, replaced and retired while the server runs; visits in progress finish on theirs."""

import json
import os
import re
import shutil
import subprocess
import unittest

from harness import PATIENCE, ROOT, EndToEnd, marked, wait_until

# Where pictures of the console are left to look at; in the suite: nowhere.
PICTURES = [os.environ["MECHANE_PICTURES"]] if "MECHANE_PICTURES" in os.environ else []


class LiveExhibits(EndToEnd):
    def setUp(self):
        super().setUp()
        self.exhibits_folder = self.folder / "exhibits"
        for name in ("archimedes-screw", "odometer"):
            shutil.copytree(ROOT / "scenarios" / name, self.exhibits_folder / name)
        (self.exhibits_folder / "models").symlink_to(ROOT / "scenarios/models")
        self.screw = self.exhibits_folder / "archimedes-screw/archimedes-screw.x3d"
        self.key = self.folder / "records/exhibits.key"

    def command(self, *words, status=0, key=None):
        result = self.run_command("exhibits", *words, "--key", key or self.key, limit_s=300)
        self.assertEqual(result.returncode, status, result.stdout + result.stderr)
        return result.stderr

    def listed(self):
        result = self.run_command("exhibits", "list", "--json")
        self.assertEqual(result.returncode, 0, result.stderr)
        told = json.loads(result.stdout)
        return {exhibit["id"]: exhibit for exhibit in told["exhibits"]}, told

    def screw_is(self):
        return self.listed()[0]["archimedes-screw"]

    def title_at(self, kiosk):
        """The title that a display of the kiosk hears now; empty before there is one."""
        told = self.run_command("echo", "WorldStatus", "--kiosk", kiosk, "--json", "--count", "1", "--seconds", "20").stdout
        lines = [json.loads(line) for line in told.splitlines() if line.startswith("{")]
        return json.dumps(lines[-1]["title"], ensure_ascii=False) if lines else ""

    def write_title(self, title, former="Archimedes’ screw"):
        text = self.screw.read_text()
        changed = text.replace(former, title)
        self.assertNotEqual(changed, text)
        self.screw.write_text(changed)

    def on_the_console_page(self):
        """An operator at a gateway's page replaces the screw, which then has the title "A screw once more", and ends the visit in progress
        on the former one; loads and retires the odometer."""
        gateway = self.start("gateway", "gateway", "--listen", "127.0.0.1:0", "--state", self.folder / "state", "--records",
                             self.folder / "records")
        wait_until(lambda: "\nready" in gateway.text() or not gateway.running(), 60, "the gateway is ready")
        self.assertTrue(gateway.running(), gateway.text())
        address, password = (re.search(pattern, gateway.text()).group(1) for pattern in (r"console: (\S+)/console", r"operator (\S+)\n"))
        script = ROOT / "client-sdk/web/tests/browser/exhibits.mjs"
        result = subprocess.run(["node", script, address, password, self.screw, *PICTURES], capture_output=True, text=True,
                                timeout=300 * PATIENCE)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        self.assertEqual(gateway.stop(), 0, gateway.text())

    def restart(self, server):
        """A restarted server has what was loaded, and says what it cannot have again."""
        self.command("load", "odometer")
        self.assertEqual(server.stop(), 0, server.text()[-2000:])
        server = self.server(scenario=self.screw)
        self.assertEqual(set(self.listed()[0]), {"archimedes-screw", "odometer"})
        self.assertEqual(server.stop(), 0, server.text()[-2000:])
        (self.exhibits_folder / "odometer/odometer.x3d").write_text("<X3D")
        server = self.server(scenario=self.screw)
        self.assertIn("exhibit odometer was in use before and cannot be loaded again: ", server.text())
        self.assertEqual(set(self.listed()[0]), {"archimedes-screw"})
        self.assertEqual(server.stop(), 0, server.text()[-2000:])

    @marked("draws")
    def test_a_visit_finishes_on_its_exhibit_and_the_next_one_gets_the_new(self):
        server = self.server("--worlds", "4", scenario=self.screw)
        self.assertEqual(os.stat(self.key).st_mode & 0o777, 0o600)
        before = self.screw_is()
        self.assertEqual(self.listed()[1]["loadable"], ["odometer"])

        visitor = self.visitor("kiosk-1", "--visit", "assembling")
        events = self.start("events", "echo", "Event", "--kiosk", "kiosk-1", "--json")
        wait_until(lambda: '"grasped"' in events.text(), 60, "the visit has begun")

        # A broken file is refused with its place, and the old exhibit stays.
        good = self.screw.read_text()
        self.screw.write_text(good.replace("bodies' value='\"INNER\"'", "bodies' value='\"INER\"'", 1))
        told = self.command("replace", "archimedes-screw", status=1)
        self.assertIn("archimedes-screw.x3d:", told)
        self.assertIn("INER", told)
        self.assertEqual(self.screw_is(), {**before, "worlds": 1})
        self.screw.write_text(good)

        # Nobody without the server's key.
        other = self.folder / "other.key"
        other.write_text("00" * 32 + "\n")
        other.chmod(0o600)
        self.assertIn("is not the key", self.command("replace", "archimedes-screw", status=2, key=other))
        self.assertIn("A-Z", self.command("load", "../odometer/odometer", status=2))
        self.assertIn("there is no exhibit", self.command("load", "nothing", status=1))

        self.write_title("A changed screw")
        self.command("replace", "archimedes-screw")
        changed = self.screw_is()
        self.assertNotEqual(changed["content_hash"], before["content_hash"])
        self.assertEqual((changed["worlds"], changed["former_worlds"]), (0, 1), "the visit in progress keeps the old")

        hand = self.start("hand", "haptic", "--device", "virtual:hand=off", "--kiosk", "kiosk-2")
        wait_until(lambda: self.screw_is()["worlds"] == 1, 60, "a new kiosk gets the new exhibit")
        self.assertIn("A changed screw", self.title_at("kiosk-2"))
        self.assertNotIn("A changed screw", self.title_at("kiosk-1"))

        self.assertEqual(visitor.wait(240), 0, visitor.text()[-2000:])
        self.assertTrue(self.report_of(visitor)["complete"], "the visit finished on the old exhibit")
        wait_until(lambda: self.screw_is()["former_worlds"] == 0, 60, "and then its world has gone")

        # In a hurry: who is there is told why, and gets the new one.
        slow = self.screw.with_name("slow.x3d")  # this visit is still in progress when the page replaces its exhibit
        slow.write_text(re.sub(r"(position' value='0 0.55 0'/>.*?seconds' value=')4'", r"\g<1>400'", good, count=1, flags=re.DOTALL))
        self.start("slow", "visitor", "--kiosk", "kiosk-3", "--scenario", slow, "--visit", "assembling")
        events = self.start("events", "echo", "Event", "--kiosk", "kiosk-3", "--json")
        wait_until(lambda: '"grasped"' in events.text(), 60, "another visit has begun")
        self.on_the_console_page()
        wait_until(lambda: "A screw once more" in self.title_at("kiosk-3"), 60, "kiosk-3 has gone on to the newest")
        self.assertIn("kiosk-3: this exhibit has just been changed", server.text())
        wait_until(lambda: "A screw once more" in self.title_at("kiosk-2"), 60, "kiosk-2 has gone on to the newest")
        self.assertTrue(hand.running(), hand.text())

        self.command("load", "odometer")
        self.assertEqual(set(self.listed()[0]), {"archimedes-screw", "odometer"})
        opened = self.run_command("open", "odometer", "--kiosk", "kiosk-2")
        self.assertEqual(opened.returncode, 0, opened.stderr)
        self.command("retire", "odometer")
        self.assertEqual(set(self.listed()[0]), {"archimedes-screw"})
        wait_until(lambda: "A screw once more" in self.title_at("kiosk-2"), 60, "nobody touched it: the kiosk went home at once")
        self.assertIn("home", self.command("retire", "archimedes-screw", status=1))
        self.restart(server)


if __name__ == "__main__":
    unittest.main()
