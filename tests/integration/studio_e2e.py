"""Authors edit drafts through the gateway: nothing that was answered is lost, nobody overwrites another, and a draft becomes an exhibit."""

import io
import json
import os
import re
import shutil
import subprocess
import unittest
import zipfile

from browser import Page, WithGateway
from harness import PATIENCE, ROOT, marked

SCREW = "archimedes-screw"
DRAFT = f"/api/studio/drafts/{SCREW}"
# 0.1 m by 0.2 m by 0.3 m.
BLOCK = "o block\n" + "".join(f"v {x} {y} {z}\n" for x in (0, 0.1) for y in (0, 0.2) for z in (0, 0.3)) + """f 1 2 4 3
f 5 7 8 6
f 1 5 6 2
f 3 4 8 7
f 1 3 7 5
f 2 6 8 4
"""


def docs_in(schema):
    """All explanations of keys and types, at any depth."""
    inner = schema.values() if isinstance(schema, dict) else schema if isinstance(schema, list) else []
    own = {schema["doc"]} if isinstance(schema, dict) and schema.get("doc") else set()
    return own.union(*map(docs_in, inner))


def docs_with_greek():
    """Those that the studio's modules have in Greek; a long one stands there in pieces."""
    help_folder = ROOT / "client-sdk/web/src/studio/help"
    text = "".join((help_folder / name).read_text() for name in ("docs_greek.ts", "docs_greek_format.ts"))
    entries = re.findall(r"^  \[?'(.+?)'\]?:\s+'[^']", re.sub(r"' \+\n +'", "", text), re.MULTILINE)
    return {english.replace("\\'", "'") for english in entries}


class Studio(WithGateway):
    def setUp(self):
        super().setUp()
        self.scenarios = self.folder / "scenarios"
        shutil.copytree(ROOT / "scenarios" / SCREW, self.scenarios / SCREW)
        (self.scenarios / "models").symlink_to(ROOT / "scenarios/models")
        self.file = self.scenarios / SCREW / f"{SCREW}.x3d"
        self.before = self.file.read_text()

    def who_may(self, author, visitor):
        """And who may not; and names that lead elsewhere or are taken."""
        self.assertEqual(Page(self.port).get("/api/studio/exhibits")[0], 401)
        self.assertEqual(visitor.get("/api/studio/exhibits")[0], 403)
        self.posted(visitor, "/api/studio/drafts", {"name": SCREW, "from": f"exhibit:{SCREW}"}, 403)
        self.assertEqual(author.post("/api/studio/drafts", {}, **{"X-Mechane-CSRF": "no"})[0], 403)
        self.posted(author, "/api/studio/drafts", {"name": "../up", "from": "template:empty"}, 400)
        self.posted(author, "/api/studio/drafts", {"name": SCREW, "from": "template:empty"}, 409)

    def look_at_the_scene(self, author):
        """What a kiosk would show, and the meshes of it."""
        scene = self.got(author, f"{DRAFT}/scene")
        self.assertTrue(scene["presentation"]["views"])
        objects = {one["name"]: one for one in scene["scene"]["objects"]}
        self.assertEqual(objects["CRANK"]["pose"], [1, 1, 0, 0, 0, 0, 1])
        for name in ("INNER", "CRANK"):
            status, _, mesh = author.get(f"/content/{objects[name]['hash']}")
            self.assertEqual((status, mesh[:4]), (200, b"glTF"), name)
        size = int.from_bytes(mesh[12:16], "little")
        self.assertIn("CRANK", [node["name"] for node in json.loads(mesh[20:20 + size])["nodes"]])

    def bring(self, page, file, content, status=200, query=""):
        told = page.post(f"{DRAFT}/files/{file}{query}", content, **{"Content-Type": "application/octet-stream"})
        self.assertEqual(told[0], status, told)
        return json.loads(told[1])

    def test_a_mesh_is_brought_in_made_a_body_joined_and_published(self):
        process, operator = self.gateway("--scenarios", self.scenarios)
        self.posted(operator, "/api/accounts", {"user": "tablet", "role": "visitor", "password": "a-long-password"})
        view = self.posted(operator, "/api/studio/drafts", {"name": SCREW, "from": f"exhibit:{SCREW}"})
        for file in ("..%2farm.obj", "arm.exe", "files%2farm.obj", "%00.obj"):
            self.bring(operator, file, BLOCK, 400)
        self.bring(self.page("tablet", "a-long-password"), "arm.obj", BLOCK, 403)
        self.bring(operator, "arm.glb", BLOCK, 400)
        # More than other requests may have; too much is refused before it is read.
        padding = "#" + 200_000 * " " + "\n"
        listed = self.bring(operator, "arm.obj", padding + BLOCK)["files"]
        self.assertEqual([(one["name"], one["uses"]) for one in listed], [("arm.obj", [])])
        self.posted(operator, f"{DRAFT}/versions", {"title": padding}, 413)
        self.bring(operator, "arm.obj", BLOCK, 409)
        self.bring(operator, "arm.obj", BLOCK, query="?replace=1")
        nodes = {one["name"]: one["volume"] for one in self.got(operator, f"{DRAFT}/files/arm.obj")["nodes"]}
        self.assertAlmostEqual(nodes["block"], 0.006, places=6)

        body = {"op": "insert", "url": "files/arm.obj", "node": "block", "mass": 4.2, "name": "ARM", "position": [2, 1, 0]}
        hinge = {"op": "join", "kind": "hinge", "body1": "ARM", "anchor": [2, 1, 0], "axis": [0, 0, 1], "name": "PIVOT"}
        here = {"op": "view", "pose": [2, 1, 3, 0, 0, 0, 1], "fieldOfView": 0.7, "name": "ARM_VIEW"}
        view = self.posted(operator, f"{DRAFT}/commands", {"revision": view["revision"], "commands": [body, hinge, here]})
        self.assertEqual(view["added"], ["ARM", "PIVOT", "ARM_VIEW"])
        self.assertEqual([one for one in view["problems"] if one["severity"] == "error"], [])
        self.assertIn("ARM_VIEW", [one["name"] for one in self.got(operator, f"{DRAFT}/scene")["presentation"]["views"]])
        objects = {one["name"]: one for one in self.got(operator, f"{DRAFT}/scene")["scene"]["objects"]}
        self.assertEqual(operator.get(f"/content/{objects['ARM']['hash']}")[0], 200)
        self.posted(operator, f"{DRAFT}/publish", {"revision": view["revision"]})
        self.assertEqual((self.file.parent / "files/arm.obj").read_text(), BLOCK)
        self.assertTrue(self.got(operator, f"{DRAFT}/files")["files"][0]["published"])
        self.assertEqual(process.stop(), 0, process.text()[-2000:])

    def bring_in(self, page, name, archive, status=200):
        told = page.post(f"/api/studio/drafts/{name}/import", archive, **{"Content-Type": "application/octet-stream"})
        self.assertEqual(told[0], status, told)
        return json.loads(told[1])

    def test_a_draft_is_exported_imported_and_added_to_another(self):
        process, operator = self.gateway("--scenarios", self.scenarios)
        self.posted(operator, "/api/accounts", {"user": "tablet", "role": "visitor", "password": "a-long-password"})
        view = self.posted(operator, "/api/studio/drafts", {"name": SCREW, "from": f"exhibit:{SCREW}"})
        self.bring(operator, "arm.obj", BLOCK)
        body = {"op": "insert", "url": "files/arm.obj", "node": "block", "mass": 4.2, "name": "ARM", "position": [2, 1, 0]}
        view = self.posted(operator, f"{DRAFT}/commands", {"revision": view["revision"], "commands": [body]})
        told = self.posted(operator, f"{DRAFT}/files/arm.obj/delete", {}, 409)
        self.assertEqual(len(told["uses"]), 1, told)

        status, headers, archive = operator.get(f"{DRAFT}/export")
        self.assertEqual((status, headers["content-type"]), (200, "application/zip"))
        self.assertEqual(operator.get(f"{DRAFT}/export")[2], archive)
        names = zipfile.ZipFile(io.BytesIO(archive)).namelist()
        self.assertEqual(names, [f"{SCREW}/{SCREW}.x3d", f"{SCREW}/files/archimedes-screw.glb", f"{SCREW}/files/arm.obj"])

        self.bring_in(self.page("tablet", "a-long-password"), "second", archive[:1000], 403)
        self.bring_in(operator, SCREW, archive, 409)
        self.bring_in(operator, "second", archive[:-40], 400)
        self.assertEqual(operator.get("/api/studio/drafts/second")[0], 404)
        second = self.bring_in(operator, "second", archive)
        self.assertEqual([one for one in second["problems"] if one["severity"] == "error"], [])
        self.bring_in(operator, "second", archive, 409)

        both = self.posted(operator, f"{DRAFT}/merge", {"revision": view["revision"], "from": "draft:second"})
        self.assertEqual([one for one in both["problems"] if one["severity"] == "error"], [])
        self.assertIn({"what": "name", "theirs": "ARM", "here": "ARM_2", "renamed": True}, both["merged"])
        self.posted(operator, f"{DRAFT}/merge", {"revision": view["revision"], "from": "draft:second"}, 409)
        for place, status in (("draft:third", 404), (f"draft:{SCREW}", 400), ("second", 400)):
            self.posted(operator, f"{DRAFT}/merge", {"revision": both["revision"], "from": place}, status)
        self.posted(operator, f"{DRAFT}/undo", {"revision": both["revision"]})
        self.bring(operator, "old.obj", BLOCK)
        left = self.posted(operator, f"{DRAFT}/files/old.obj/delete", {})["files"]
        self.assertEqual([one["name"] for one in left if one["uses"]], ["arm.obj"])
        self.posted(operator, f"{DRAFT}/files/old.obj/delete", {}, 404)
        self.assertEqual(process.stop(), 0, process.text()[-2000:])

    @marked("address")
    def test_a_draft_is_begun_edited_by_two_killed_and_published(self):
        process, operator = self.gateway("--scenarios", self.scenarios)
        for user, role in (("eleni", "author"), ("nikos", "author"), ("tablet", "visitor")):
            self.posted(operator, "/api/accounts", {"user": user, "role": role, "password": "a-long-password"})
        eleni, nikos, tablet = (self.page(user, "a-long-password") for user in ("eleni", "nikos", "tablet"))

        self.who_may(eleni, tablet)
        library = self.got(eleni, "/api/studio/exhibits")
        self.assertEqual([one["name"] for one in library["exhibits"]], [SCREW])
        self.assertIn("lever-and-weight", [one["name"] for one in library["templates"]])
        schema = self.got(eleni, "/api/studio/schema")
        self.assertIn("geometry.rope", [agent["name"] for agent in schema["agents"]])
        self.assertEqual(docs_in(schema), docs_with_greek(), "explanations without Greek, or Greek ones that no explanation has")

        view = self.posted(eleni, "/api/studio/drafts", {"name": SCREW, "from": f"exhibit:{SCREW}"})
        self.assertEqual((view["revision"], view["canUndo"]), (0, False))
        title = [{"op": "set", "path": "text/title.en", "value": "Ἡ ἕλιξ of Eleni"}]
        view = self.posted(eleni, f"{DRAFT}/commands", {"revision": 0, "commands": title})
        self.assertEqual((view["revision"], view["by"]), (1, "eleni"))

        # The other author has an older page.
        late = {"revision": 0, "commands": [{"op": "set", "path": "effortScale", "value": 1}]}
        told = self.posted(nikos, f"{DRAFT}/commands", late, 409)
        self.assertEqual(told["revision"], 1)
        self.assertIn("eleni", told["error"])
        half_right = {"revision": 1, "commands": late["commands"] + [{"op": "delete", "node": "X"}]}
        refused = self.posted(nikos, f"{DRAFT}/commands", half_right, 422)
        self.assertEqual(refused["command"], 1)
        self.posted(nikos, f"{DRAFT}/commands", {"revision": 1, "commands": [{"op": "fly"}]}, 400)

        # What was answered outlives a kill.
        text = eleni.get(f"{DRAFT}/text")[2].decode()
        different = [(a, b) for a, b in zip(self.before.splitlines(), text.splitlines()) if a != b]
        self.assertEqual(len(different), 1, different)
        self.assertIn("Ἡ ἕλιξ of Eleni", different[0][1])
        process.kill()
        process, operator = self.gateway("--scenarios", self.scenarios)
        eleni = self.page("eleni", "a-long-password")
        self.assertEqual(self.got(eleni, DRAFT)["revision"], 1)
        self.assertEqual(eleni.get(f"{DRAFT}/text")[2].decode(), text)

        crank = [{"op": "insert", "part": "crank", "position": [1, 1, 0]}]
        view = self.posted(eleni, f"{DRAFT}/commands", {"revision": 1, "commands": crank})
        self.assertEqual(view["added"], ["CRANK"])
        self.look_at_the_scene(eleni)

        self.posted(eleni, f"{DRAFT}/versions", {"title": "With a crank"})
        self.posted(eleni, f"{DRAFT}/undo", {"revision": 2})
        self.posted(eleni, f"{DRAFT}/publish", {"revision": 2}, 409)
        self.assertEqual(self.posted(eleni, f"{DRAFT}/publish", {"revision": 3}), {"published": True})
        self.assertEqual(self.file.read_text(), text)
        versions = self.got(eleni, f"{DRAFT}/versions")["versions"]
        self.assertEqual([one["title"] for one in versions], ["before publishing", "With a crank"])
        self.posted(eleni, f"{DRAFT}/versions/2/restore", {"revision": 3})
        self.assertEqual(eleni.get(f"{DRAFT}/text")[2].decode(), self.before)
        self.posted(eleni, f"{DRAFT}/discard", {"revision": 4})
        self.assertEqual(eleni.get(DRAFT)[0], 404)
        actions = [entry["action"] for entry in self.got(operator, "/api/audit")["entries"]]
        self.assertIn(f"{DRAFT}/publish", actions)
        self.assertEqual(process.stop(), 0, process.text()[-2000:])

    @marked("draws")
    def test_what_is_saved_is_shown_by_another_x3d_browser(self):
        process, operator = self.gateway("--scenarios", self.scenarios)
        edits = {"rope": ("template:crank-and-rope", "LOAD"), SCREW: (f"exhibit:{SCREW}", "INNER")}
        for name, (origin, body) in edits.items():
            draft = f"/api/studio/drafts/{name}"
            view = self.posted(operator, "/api/studio/drafts", {"name": name, "from": origin})
            commands = [{"op": "field", "node": body, "field": "mass", "value": "41"},
                        {"op": "insert", "part": "box", "position": [0.5, 0.2, 1]},
                        {"op": "view", "pose": [0, 1.5, 4, 0, 0, 0, 1], "fieldOfView": 0.7}]
            view = self.posted(operator, f"{draft}/commands", {"revision": view["revision"], "commands": commands})
            self.posted(operator, f"{draft}/publish", {"revision": view["revision"]})
        script = ROOT / "client-sdk/web/tests/browser/x3d.mjs"
        shown = subprocess.run(["node", script, *(self.scenarios / f"{name}/{name}.x3d" for name in edits)], capture_output=True,
                               text=True, timeout=120 * PATIENCE)
        self.assertEqual(shown.returncode, 0, shown.stdout + shown.stderr)
        self.assertEqual(process.stop(), 0, process.text()[-2000:])

    @marked("draws")
    def test_the_catalogue_finds_what_another_exhibit_has_and_who_uses_it(self):
        process, operator = self.gateway("--scenarios", self.scenarios)
        self.posted(operator, "/api/accounts", {"user": "tablet", "role": "visitor", "password": "a-long-password"})
        tablet = self.page("tablet", "a-long-password")
        for page, status in ((Page(self.port), 401), (tablet, 403)):
            self.assertEqual(page.get("/api/studio/catalogue")[0], status)
        self.posted(tablet, "/api/studio/catalogue/about", {"path": "models/archimedes-screw.glb", "about": {}}, 403)
        for name in ("first", "second"):
            self.posted(operator, "/api/studio/drafts", {"name": name, "from": "template:empty"})
        body = {"op": "insert", "url": "../first/files/gear.obj", "node": "block", "mass": 4.2, "name": "GEAR", "position": [2, 1, 0]}
        self.posted(operator, "/api/studio/drafts/second/commands", {"revision": 0, "commands": [body]})
        mesh = self.folder / "gear.obj"
        mesh.write_text(BLOCK)
        script = ROOT / "client-sdk/web/tests/browser/catalogue.mjs"
        folder = os.environ.get("MECHANE_PICTURES", "")
        done = subprocess.run(["node", script, f"http://127.0.0.1:{self.port}", self.password, mesh, *([folder] if folder else [])],
                              capture_output=True, text=True, timeout=300 * PATIENCE)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertEqual((self.folder / "state/studio/second/files/gear.obj").read_text(), BLOCK)
        self.posted(operator, "/api/studio/drafts/first/files/gear.obj/delete", {}, 409)
        tagged = self.got(operator, "/api/studio/catalogue?kind=mesh&tag=%CE%9E%CE%A5%CE%9B%CE%9F&licence=CC-BY-4.0")["items"]
        self.assertEqual([one["path"] for one in tagged], ["first/files/gear.obj", "second/files/gear.obj"])
        self.assertEqual(operator.get("/api/studio/catalogue?kind=film")[0], 400)
        self.posted(operator, "/api/studio/drafts/second/take", {"path": "../state/accounts.json"}, 404)
        self.assertIn("<meta name='license' content='CC0-1.0'/>", operator.get("/api/studio/drafts/first/text")[2].decode())
        self.assertEqual(process.stop(), 0, process.text()[-2000:])

    @marked("draws")
    def test_a_crane_is_made_in_a_browser_from_an_empty_page_and_worked_by_a_visitor(self):
        process, _ = self.gateway("--scenarios", self.scenarios)
        script = ROOT / "client-sdk/web/tests/browser/crane.mjs"
        made = subprocess.run(["node", script, f"http://127.0.0.1:{self.port}", self.password, "my-crane"], capture_output=True, text=True,
                              timeout=600 * PATIENCE)
        self.assertEqual(made.returncode, 0, made.stdout + made.stderr)
        self.assertEqual(process.stop(), 0, process.text()[-2000:])
        crane = self.scenarios / "my-crane/my-crane.x3d"
        checked = self.run_command("check", crane)
        self.assertEqual(checked.returncode, 0, checked.stdout)
        # A reader of X3D that shares nothing with ours.
        read = subprocess.run(["tovrmlx3d", crane, "--encoding=xml"], capture_output=True, text=True)
        self.assertEqual((read.returncode, "error" in read.stderr.lower()), (0, False), read.stderr)
        self.server(scenario=crane, records=False)
        visit = self.run_command("visitor", "--kiosk", "kiosk-1", "--scenario", crane, "--visit", "trying", limit_s=120)
        self.assertEqual(visit.returncode, 0, visit.stdout + visit.stderr)


if __name__ == "__main__":
    unittest.main()
