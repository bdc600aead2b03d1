"""The browser display at a real gateway: Chromium, a finger on its glass, the built app."""

import json
import re
import subprocess
import unittest

from harness import PATIENCE, ROOT, EndToEnd, marked, wait_until

CRANE = ROOT / "scenarios/pulley-crane/pulley-crane.x3d"


@marked("draws")
class Web(EndToEnd):
    def address(self):
        """Of a kiosk's page, at a gateway of its own."""
        gateway = self.start("gateway", "gateway", "--listen", "127.0.0.1:0", "--kiosk", "kiosk-1", "--state", self.folder / "state")
        wait_until(lambda: "\nready" in gateway.text() or not gateway.running(), 60, "the gateway is ready")
        self.assertTrue(gateway.running(), gateway.text())
        return re.search(r"kiosk kiosk-1: (\S+)", gateway.text()).group(1)

    def in_browser(self, script, *arguments):
        result = subprocess.run(["node", ROOT / f"client-sdk/web/tests/browser/{script}.mjs", *arguments], capture_output=True, text=True,
                                timeout=300 * PATIENCE)
        self.assertEqual(result.returncode, 0, result.stdout + result.stderr)
        return result.stdout

    def test_a_crank_is_taken_again_after_a_reload_and_turned_by_touch(self):
        server = self.server(scenario=CRANE, records=False)
        told = json.loads(self.in_browser("turn", self.address()))
        self.assertEqual((told["first"], told["step"]), ("grasp", "lift"))
        self.assertIn("kiosk-1", server.text())


if __name__ == "__main__":
    unittest.main()
