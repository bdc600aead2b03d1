"""What `deploy/bench` makes of figures: numbers, verdicts and plots. What it measures is tested in tests/benchmark."""

import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from types import SimpleNamespace

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "deploy/bench_lib"))

import against  # noqa: E402
import aims  # noqa: E402
import bench  # noqa: E402
import gateway  # noqa: E402
import studio  # noqa: E402
import plots  # noqa: E402
import worlds  # noqa: E402
from peers import Measured  # noqa: E402

SVG = "{http://www.w3.org/2000/svg}"


class Numbers(unittest.TestCase):
    def test_three_digits_count_and_what_rounding_leaves_is_zero(self):
        shown = {0: "0", 8.05e-47: "0", -2.24e-15: "0", 1.234e-5: "0.0000123", 0.98765: "0.988", 41: "41.0", 119_712: "119,712"}
        for value, text in shown.items():
            self.assertEqual(plots.number(value), text)


class Aims(unittest.TestCase):
    LIMITS = {"ratio": (("at least", 0.9), ("at most", 1.1)), "cost_us.*": (("under", 20),)}

    def test_a_figure_on_its_limit_is_met_but_not_where_it_is_to_be_under_it(self):
        for ratio, met in ((0.89, False), (0.9, True), (1.1, True), (1.11, False)):
            self.assertEqual(aims.judge({"ratio": ratio}, self.LIMITS)["ratio"].met, met, ratio)
        judged = aims.judge({"cost_us.b": 20, "cost_us.a": 19.9, "cost": 99}, self.LIMITS)
        self.assertEqual([(name, one.met) for name, one in judged.items()], [("cost_us.a", True), ("cost_us.b", False)])

    def test_the_table_tells_aim_and_verdict(self):
        metrics = {"ratio": 1.0, "cost_us.a": 21.0}
        rows = aims.table(metrics, aims.judge(metrics, self.LIMITS)).splitlines()[2:]
        self.assertRegex(rows[0], r"ratio +1\.00 +at least 0\.9, at most 1\.1 +met$")
        self.assertRegex(rows[1], r"cost_us\.a +21\.0 +under 20 +MISSED$")
        self.assertEqual(aims.table({}, {}), "")

    def test_every_benchmark_has_aims_with_words_that_can_be_judged(self):
        for name, benchmark in bench.BENCHMARKS.items():
            self.assertTrue(benchmark.AIMS, name)
            figures = {pattern.replace("*", "x"): 1.0 for pattern in benchmark.AIMS}
            self.assertEqual(len(aims.judge(figures, benchmark.AIMS)), len(figures), name)


class Against(unittest.TestCase):
    """An earlier revision that slows down from turn to turn, as a machine does, and one that is always twice as slow."""

    def measured(self, **of_benchmark):
        turns = []

        def measure(context):
            turns.append(context.root.name)
            return Measured({"step_us.median": context.us * len(turns), "step_us.max": 9.0}), ["no peer"] if context.us == 1 else []

        now, before = SimpleNamespace(root=Path("/now"), us=1), SimpleNamespace(root=Path("/before"), us=2)
        result, missing = against.measure(SimpleNamespace(measure=measure, **of_benchmark), now, before)
        self.assertEqual(turns, ["before", "now", "now", "before"])
        self.assertEqual(missing, ["now: no peer"] * 2)
        return result.metrics

    def test_both_run_in_turn_and_the_ratio_is_the_mean_of_both_orders(self):
        metrics = self.measured()
        self.assertAlmostEqual(metrics["against.step_us.median"], (2 / (2 * 1) * 3 / (2 * 4)) ** 0.5)
        self.assertEqual(metrics["step_us.median"], 2, "of the first turn")
        self.assertNotIn("against.step_us.max", metrics)

    def test_a_benchmark_may_say_what_it_compares(self):
        self.assertEqual(self.measured(against=lambda now, before: {"against.sum": 4.0})["against.sum"], 4)

    def test_worlds_compare_each_exhibit_all_together_and_how_many_a_core_holds(self):
        now = {"tick_us.a.median": 9.0, "tick_us.a.mean": 10.0, "tick_us.b.median": 1.0, "tick_us.b.mean": 2.0, "tick_us.new.median": 1.0,
               "tick_us.new.mean": 1.0, "worlds_per_core": 30}
        before = {"tick_us.a.mean": 40.0, "tick_us.b.mean": 2.0, "worlds_per_core": 10}
        self.assertEqual(worlds.against(now, before), {"against.cpu_ratio.a": 0.25, "against.cpu_ratio.b": 1,
                                                       "against.cpu_ratio_sum": 12 / 42, "against.worlds_ratio": 3})
        self.assertEqual(worlds.against({}, {}), {})

    def test_a_revision_that_is_not_there_is_said(self):
        with self.assertRaisesRegex(against.NoRevision, "single revision|unknown revision"):
            against.checkout(bench.ROOT, "no-such-revision")


class Gateway(unittest.TestCase):
    def test_clients_count_each_frame_with_its_age_and_its_sender_s_time(self):
        with gateway.peer(7000, 50) as (pid, port):
            seen = gateway.clients(port, "/", pid, 3, 0.5)
        self.assertEqual(seen["bytes"], 7000 * seen["frames"])
        self.assertGreater(seen["frames"], 3)
        self.assertEqual(len(seen["ages_s"]), seen["frames"])
        self.assertGreaterEqual(min(seen["ages_s"]), 0)
        self.assertLess(min(seen["ages_s"]), 0.05)
        self.assertGreaterEqual(seen["cpu_pct"], 0)

    def test_only_a_refusal_with_a_remedy_is_polite(self):
        head = b"HTTP/1.1 503 Service Unavailable\r\nRetry-After: 60\r\n\r\n"
        self.assertTrue(gateway.polite(head + b'{"error": "full", "remedy": "try again"}'))
        for rude in (b"", head, head + b'{"error": "full"}', b"HTTP/1.1 503 No\r\n\r\n{}"):
            self.assertFalse(gateway.polite(rude), rude)


class Studio(unittest.TestCase):
    def test_a_draft_is_filled_until_it_has_so_many_nodes_without_its_metadata(self):
        class Fake:
            """Its boxes have three nodes."""
            boxes, revision = 0, 0

            def get(self, path):
                return b"<X3D><Scene><WorldInfo><MetadataSet/></WorldInfo>" + self.boxes * b"<Transform><Shape/><Box/></Transform>" + b"</Scene></X3D>"

            def post(self, path, body):
                assert body.get("revision", 0) == self.revision
                self.boxes += len(body.get("commands", []))
                self.revision += 1
                return {"revision": self.revision}

        draft, count = studio.begin(Fake(), "many", 500)
        self.assertEqual((draft["revision"], count), (3, 502))


class Lines(unittest.TestCase):
    def drawn(self, series, **style):
        with tempfile.TemporaryDirectory() as folder:
            plots.lines(Path(folder) / "plot.svg", "title", "subtitle", series, "x", "y", **style)
            return ElementTree.parse(Path(folder) / "plot.svg").getroot()

    def test_a_logarithmic_axis_begins_below_the_lowest_point(self):
        for lowest in (24.4, 20, 10, 0.09):
            svg = self.drawn({"a": [[0, 1000], [20, lowest]]})
            grid = max(float(line.get("y1")) for line in svg.iter(SVG + "line"))
            point = max(float(circle.get("cy")) for circle in svg.iter(SVG + "circle"))
            self.assertLess(point, grid - 5, lowest)

    def test_points_are_open_and_have_no_line_and_what_stands_beside_is_dashed(self):
        curve = [[0, 4], [1, 2]]
        svg = self.drawn({"theory": curve, "measured": curve}, points=("measured",), beside={"theory": 3}, limit=(5, "the most"))
        circles = [circle.get("fill") for circle in svg.iter(SVG + "circle")]
        self.assertEqual(circles.count("none"), 2)
        dashes = [line.get("stroke-dasharray") is not None for line in svg.iter(SVG + "polyline")]
        self.assertEqual(dashes, [False, True])
        self.assertIn("the most", [text.text for text in svg.iter(SVG + "text")])


class Haptics(unittest.TestCase):
    def test_each_plot_is_drawn_from_its_curves(self):
        curve = [[0.05, 0.5], [0.2, 0.75]]
        plays = ("stroke", "press", "slide", "crank")
        names = ["wall.theory", "wall.measured", *(f"deadband.{what}.{play}" for what in ("saved", "error") for play in plays)]
        result = Measured({"deadband0.local.crank.one_ms_error_n.p99": 2.6}, {name: curve for name in names})
        with tempfile.TemporaryDirectory() as folder:
            made = bench.haptics.plot(result, Path(folder), "a machine")
            self.assertEqual([file.stem for file in made], ["haptics-wall", "haptics-deadband-saved", "haptics-deadband-error"])
            self.assertIn("stroke-dasharray", made[2].read_text())


class Collision(unittest.TestCase):
    def test_a_wall_has_its_rows_and_the_cost_of_building_its_plot(self):
        metrics = {f"build_cpu_s.{kind}.{triangles}": triangles / 1e4 for kind in ("closed", "scan") for triangles in (100_000, 3000)}
        metrics.update({"warm_s.closed.3000": 0.125, "wall_step_us.ours.median": 584.0, "wall.hulls.overlap_mm.max": 2.144})
        rows = [line.split() for line in bench.collision.table("collision", metrics).splitlines()]
        self.assertIn(["Mechane", "584", *5 * "-"], rows)
        self.assertIn(["Bullet,", "convex", "hulls", *4 * "-", "2.14", "-"], rows)
        self.assertEqual([row[0] for row in rows if row and row[0].startswith("closed")], ["closed.3000", "closed.100000"])
        with tempfile.TemporaryDirectory() as folder:
            made = bench.collision.plot(Measured(metrics), Path(folder), "a machine")
            self.assertEqual([file.stem for file in made], ["collision-build"])
            ElementTree.parse(made[0])
        self.assertEqual([cost for _, cost in bench.collision._cost(metrics, "scan")], [0.3, 10])


if __name__ == "__main__":
    unittest.main()
