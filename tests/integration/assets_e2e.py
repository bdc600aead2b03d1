"""A display whose assets lie on an HTTP server: the exhibit comes, stays without the server, and is never another's."""

import contextlib
import functools
import http.server
import json
import signal
import threading
import time
import unittest

from harness import ROOT, EndToEnd, marked, wait_until

MODEL = "/models/archimedes-screw.glb"


class AssetServer:
    """The scenarios' folder over HTTP, on a port of its own, with what a test does to the model."""

    def __init__(self, port=0):
        self.asked, self.instead, self.gate = [], None, None
        outer = self

        class Handler(http.server.SimpleHTTPRequestHandler):
            def do_GET(self):
                outer.asked.append(self.path)
                if outer.instead is not None:
                    self.path = outer.instead
                if outer.gate is not None:
                    whole = (ROOT / "scenarios" / self.path.lstrip("/")).read_bytes()
                    self.send_response(200)
                    self.send_header("Content-Length", str(len(whole)))
                    self.end_headers()
                    self.wfile.write(whole[: len(whole) // 2])
                    self.wfile.flush()
                    outer.gate.wait()
                    with contextlib.suppress(OSError):  # the display may be gone
                        self.wfile.write(whole[len(whole) // 2:])
                    return
                super().do_GET()

            def log_message(self, *_):
                pass

        handler = functools.partial(Handler, directory=str(ROOT / "scenarios"))
        self.server = http.server.ThreadingHTTPServer(("127.0.0.1", port), handler)
        self.server.daemon_threads = True
        self.port = self.server.server_port
        threading.Thread(target=self.server.serve_forever, daemon=True).start()

    def close(self):
        if self.gate is not None:
            self.gate.set()
        self.server.shutdown()
        self.server.server_close()


@marked("draws")
class Assets(EndToEnd):
    def setUp(self):
        super().setUp()
        self.environment["no_proxy"] = "127.0.0.1"
        self.assets = AssetServer()
        self.addCleanup(lambda: self.assets.close())
        self.server(records=False)

    def display(self, *more, prefix=(), path="/archimedes-screw"):
        return self.start("display", "display", "--offscreen", "--size", "320x180", "--out", self.folder / "out", "--asset-cache",
                          self.folder / "cache", "--assets", f"http://127.0.0.1:{self.assets.port}{path}", *more, prefix=prefix)

    def kept(self):
        return [file for file in (self.folder / "cache").rglob("*") if file.is_file()]

    def picture(self, display):
        """Of a pass that begins after this call: the first request may be met by the pass that is under way."""
        for _ in range(2):
            before = display.text().count("wrote ")
            display.process.send_signal(signal.SIGUSR1)
            wait_until(lambda: display.text().count("wrote ") > before, 60, "a picture is taken")

    def summary(self, display, come):
        """Once the log says that the model has come: a picture, and what the display says of itself at its end."""
        wait_until(lambda: come in display.text(), 60, f"the model {come}")
        self.picture(display)
        self.assertEqual(display.stop(60), 0, display.text())
        return json.loads([line for line in display.text().splitlines() if line.startswith("{")][-1])

    def test_the_exhibit_comes_over_http_and_the_next_time_from_the_disk(self):
        first = self.summary(self.display(), f"{MODEL}: is here")
        self.assertEqual((first["missing_assets"], first["differing_assets"]), ([], []))
        self.assertEqual(self.assets.asked, [MODEL])
        self.assertEqual(len(self.kept()), 1)
        self.assets.close()
        again = self.summary(self.display(), f"{MODEL}: is here")
        self.assertEqual(again["missing_assets"], [])

    def test_another_model_is_not_shown_and_the_right_one_is_when_it_comes(self):
        self.assets.instead = "/models/odometer.glb"
        display = self.display()
        wait_until(lambda: "it is not used" in display.text(), 60, "the wrong model is told")
        self.assertEqual(self.kept(), [])
        self.assets.instead = None
        self.assertEqual(self.summary(display, f"{MODEL}: is here now")["missing_assets"], [])
        self.assertEqual(display.text().count("it is not used"), 1)

    def test_without_a_server_of_assets_boxes_are_shown_until_it_is_up(self):
        port = self.assets.port
        self.assets.close()
        display = self.display()
        wait_until(lambda: "Failed to connect" in display.text(), 60, "the missing server is told")
        self.picture(display)
        self.assets = AssetServer(port)
        self.assertEqual(self.summary(display, f"{MODEL}: is here now")["missing_assets"], [])

    def test_the_root_of_a_web_server_will_do_and_a_steps_picture_waits_for_its_model(self):
        self.assets.gate = threading.Event()
        display = self.display("--every-step", path="/")
        wait_until(lambda: self.assets.asked, 60, "the model is on its way")
        time.sleep(1.5)  # sleeps: a picture would be taken half a second after the step began
        self.assertNotIn("wrote ", display.text())
        self.assets.gate.set()
        wait_until(lambda: "wrote " in display.text(), 60, "the picture is taken")
        self.assertIn(f"{MODEL}: is here", display.text().split("wrote ")[0])
        self.assertEqual(display.stop(60), 0, display.text())

    def test_a_display_killed_half_way_leaves_nothing_half(self):
        self.assets.gate = threading.Event()
        display = self.display()
        wait_until(lambda: self.assets.asked, 60, "the model is on its way")
        display.kill()
        self.assets.gate.set()
        self.assets.gate = None
        self.assertEqual(self.summary(self.display(), f"{MODEL}: is here")["missing_assets"], [])
        self.assertEqual([file.suffix for file in self.kept()], [".glb"])

    def test_a_full_disk_costs_the_cache_and_not_the_picture(self):
        prefix = self.full_disk(self.folder / "cache")
        if prefix[0] != "unshare":
            self.skipTest("no small disk can be made here")
        display = self.display(prefix=prefix)
        self.assertEqual(self.summary(display, f"{MODEL}: is here")["missing_assets"], [])
        self.assertIn("files are fetched again at each start", display.text())

    def test_what_is_no_address_is_told_at_once(self):
        result = self.run_command("display", "--offscreen", "--assets", "http://somebody:word@museum/screw")
        self.assertEqual(result.returncode, 1, result.stderr)
        self.assertIn("http://server:8000/archimedes-screw", result.stderr)


if __name__ == "__main__":
    unittest.main(verbosity=2)
