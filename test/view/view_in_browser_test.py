"""The page of `tera view` in Chromium: what is drawn is what the dataset holds.

A dataset is made by the program, a diagnosis and a long table by hand. Numbers are held against the files themselves, read here by NumPy and
OpenCV; places in the world against the poses that the simulation wrote of links and sensors (`record: {poses_hz: N}`).
"""

import json
import math
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

import browser

SCENARIO = """
name: looked_at
seed: 5
duration_s: 1.2
site: {lat_deg: 46.78, lon_deg: -71.27, height_m: 90}
terrain: {size_m: [14, 14], cell_m: 0.1, soil: dirt}
record: {poses_hz: 10}
machines:
  - name: digger
    machine: tera:config/machines/tb235.yaml
    start: {xy_m: [0.5, -0.3], yaw_deg: 30, joints_deg: {boom: 40, arm: -95, bucket: -20}}
    operator: {type: random_levers}
    rig: {sensors: [
      {name: imu_boom, preset: tera:config/sensors/xsens_mti_670.yaml, link: boom, xyz_m: [1, 0, 0.5], rpy_deg: [0, 10, 20]},
      {name: joints, preset: tera:config/sensors/encoder.yaml},
      {name: camera, preset: tera:config/sensors/realsense_d435i.yaml, link: upper, xyz_m: [0.8, 0, 2], rpy_deg: [0, 25, 5],
       width_px: 96, height_px: 72, rate_hz: 5},
      {name: lidar, preset: tera:config/sensors/vlp16.yaml, link: upper, xyz_m: [0, 0, 2], columns: 256}]}
obstacles:
  - {name: cone1, preset: tera:config/obstacles/cone.yaml, xy_m: [4, 2]}
  - {name: worker, preset: tera:config/obstacles/person.yaml, xy_m: [-3, 2]}
"""
FROM_S, TO_S, FOUND = 0.3, 0.6, "dead_band"
DIAGNOSIS = {"format": 2, "verdict": ["named"], "channels": [], "findings": [{
    "channel": "digger/joints/boom_radps", "intervals_s": [[FROM_S, TO_S]], "mechanism": FOUND, "slot": "lever_map", "target": "boom",
    "regime": {"variable": "lever/boom", "error": "value", "low": -0.1, "high": 0.1, "shape": "odd saturating", "p": 0.01,
               "curve": {"at": [-0.5, 0, 0.5], "mean": [-0.1, 0, 0.1], "low": [-0.12, -0.02, 0.08], "high": [-0.08, 0.02, 0.12]}},
    "parameters": {"width": {"value": 0.12, "sigma": 0.006, "unit": "1"}}, "class": [FOUND], "rejected": [], "confidence": 1,
    "evidence": {"p_chosen": 1e-9, "p_confirmed": 1e-4},
    "held_out": {"rmse_before": 0.04, "rmse_after": 0.01, "unit": "rad/s", "excess_variance_removed": 0.9}}]}
LONG_ROWS = 250_000
SETTLED = """(async () => {
  const busy = () => tera.view.update.is_busy || tera.plots.values.is_busy || tera.cameras.cards.some((c) => c.update.is_busy)
    || tera.plots.plots.some((p) => p.load.is_busy || p.is_refining);
  for (let quiet = 0; quiet < 3; quiet = busy() ? 0 : quiet + 1) await new Promise((r) => setTimeout(r, 20));
})()"""


def rows_of(file):
    """Header and rows of a CSV of numbers."""
    head, *lines = pathlib.Path(file).read_text(encoding="ascii").splitlines()
    return head.split(","), [[float(x) for x in line.split(",")] for line in lines]


def add_long_table(dataset):
    """A table of many megabytes, a spike in one of its rows."""
    with open(dataset / "digger" / "long.csv", "w", encoding="ascii") as out:
        out.write("t_ns,wave_m,count_m,a_m,b_m\n")
        for k in range(LONG_ROWS):
            wave = 7.5 if k == 177_777 else math.sin(1e-3 * k)
            out.write(f"{k * 4800},{wave!r},{k},{-k / 7!r},{k / 3!r}\n")
    text = (dataset / "dataset.yaml").read_text(encoding="utf-8")
    (dataset / "dataset.yaml").write_text(text.replace("channels:\n", 'channels:\n  - {path: "digger/long.csv", type: table}\n', 1), encoding="utf-8")


class ViewInBrowser(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if browser.found() is None:
            raise unittest.SkipTest("ViewInBrowser: chromium is not installed")
        if not os.path.exists(os.environ["TERA_PAGE"]):
            raise unittest.SkipTest("ViewInBrowser: the page was not built")
        cls.folder = pathlib.Path(tempfile.mkdtemp(prefix="tera_view_"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        (cls.folder / "looked_at.yaml").write_text(SCENARIO, encoding="utf-8")
        cls.a, cls.b, cls.why = cls.folder / "a", cls.folder / "b", cls.folder / "why"
        cls.tera("generate", "looked_at.yaml", "--out", "a")
        shutil.copytree(cls.a, cls.b)
        names, rows = rows_of(cls.b / "digger/joints/data.csv")
        cls.shifted = names[1]
        text = "\n".join([",".join(names), *(",".join([str(int(r[0])), repr(r[1] - 0.25), *map(repr, r[2:])]) for r in rows)]) + "\n"
        (cls.b / "digger/joints/data.csv").write_text(text, encoding="ascii")
        add_long_table(cls.a)
        cls.why.mkdir()
        (cls.why / "diagnosis.json").write_text(json.dumps(DIAGNOSIS), encoding="utf-8")
        cls.browser = browser.Browser(1400, 900)
        cls.addClassCleanup(cls.browser.__exit__)

    @classmethod
    def tera(cls, *arguments):
        done = subprocess.run([os.environ["TERA_PROGRAM"], *arguments], cwd=cls.folder, capture_output=True, text=True, check=False)
        assert done.returncode == 0, done.stderr
        return done.stdout

    def look(self, *paths):
        """Opens the page on these paths and waits until all is drawn."""
        server = subprocess.Popen([os.environ["TERA_PROGRAM"], "view", *map(str, paths), "--stop-with-stdin"], stdin=subprocess.PIPE,
                                  stdout=subprocess.PIPE, text=True)
        self.addCleanup(server.wait)
        self.addCleanup(server.stdout.close)
        self.addCleanup(server.stdin.close)
        self.show(re.search(r"http://\S+", server.stdout.readline())[0])

    def show(self, address):
        self.browser.events.clear()
        self.browser.resize(1400, 900)
        self.browser.open(address)
        self.browser.wait(f"location.href.startsWith({json.dumps(address[:20])}) && (window.tera?.is_ready || document.querySelector('.fatal'))", 120)
        self.browser.run(SETTLED)
        self.assertEqual(self.browser.faults(), [])

    def to(self, t_s):
        self.browser.run(f"tera.setTime({t_s})")
        self.browser.run(SETTLED)

    def values(self, path):
        """Values in the legend of a plot, by column."""
        return self.browser.run(f"""Object.fromEntries([...document.querySelectorAll('[data-path="{path}"] .entry')].map((e) =>
          [e.dataset.letter + e.dataset.column, Number(e.dataset.value)]))""")

    def test_shows_what_the_dataset_holds(self):
        self.look(self.a, self.why)
        self.check_values()
        self.check_links_stand_where_the_truth_has_them()
        self.check_points()
        self.check_pixels()
        self.check_pixel_and_point()
        self.check_finding()
        self.check_events()
        self.check_keys()
        self.check_long_table()
        self.check_phone()
        self.assertEqual(self.browser.faults(), [])

    def check_values(self):
        for t_s in (0.0, 0.7, 1.2):
            self.to(t_s)
            names, rows = rows_of(self.a / "digger/joints/data.csv")
            now = [row for row in rows if row[0] <= round(1e9 * t_s)] or rows[:1]
            for column, value in self.values("digger/joints").items():
                self.assertEqual(value, now[-1][names.index(column)], (t_s, column))

    def check_events(self):
        """The timeline has a row for each kind, with each event where its times are."""
        head, *rows = (self.a / "truth/events.csv").read_text(encoding="ascii").splitlines()
        first = dict(zip(head.split(","), rows[0].split(",")))
        self.assertEqual((first["kind"], first["other"]), ("person_near", "worker"))
        events = self.browser.run("tera.timeline.events.map((e) => [e.kind, e.from_s, e.to_s, e.text])")
        self.assertEqual(len(events), len(rows))
        kind, from_s, to_s, text = events[0]
        self.assertEqual(kind, "person_near")
        self.assertAlmostEqual(from_s, 1e-9 * int(first["t_ns"]))
        self.assertAlmostEqual(to_s, 1e-9 * int(first["end_ns"]))
        self.assertIn("digger – worker", text)
        under = self.browser.run("""(() => {
          const t = tera.timeline, width = t.canvas.getBoundingClientRect().width;
          return t.eventsAt(t.xOf(0.5, width), 4).map((e) => e.kind);
        })()""")
        self.assertEqual(under, ["person_near"])

    def check_links_stand_where_the_truth_has_them(self):
        links = self.browser.run("tera.state.datasets[0].stage.machines[0].links")
        for k, link in enumerate(links):
            _, rows = rows_of(self.a / f"truth/digger/links/{link}.csv")
            row = rows[7]
            X = self.browser.run(f"tera.state.datasets[0].stateAt({row[0]} * 1e-9).then((s) => s.digger.links[{k}].elements)")
            for i in range(3):
                self.assertAlmostEqual(X[12 + i], row[1 + i], 4, link)  # truth of the pose between steps is rounded to microseconds
            w, x, y, z = row[4:8]
            first_column = (1 - 2 * (y * y + z * z), 2 * (x * y + z * w), 2 * (x * z - y * w))
            for i in range(3):
                self.assertAlmostEqual(X[i], first_column[i], 4, link)

    def check_points(self):
        scans = sorted((self.a / "digger/lidar/scans").glob("*.pcd"), key=lambda file: int(file.stem))
        self.to(1e-9 * int(scans[3].stem))
        head = scans[3].read_bytes()[:600].decode("latin1")
        self.assertEqual(self.browser.run("tera.view.points"), int(re.search(r"POINTS (\d+)", head)[1]))

    def check_pixels(self):
        import cv2
        self.browser.run("tera.state.opacity = 1; tera.state.boxes = false; tera.state.overlay = 'semantic'; tera.cameras.cards.forEach((c) => c.update.ask())")
        self.to(0.4)
        label = cv2.imread(str(self.a / "digger/camera/semantic/400000000.png"), cv2.IMREAD_UNCHANGED)
        for u, v in ((5, 5), (50, 60), (90, 30), (48, 36)):
            drawn = self.browser.run(f"[...tera.cameras.cards[0].canvas.getContext('2d').getImageData({u}, {v}, 1, 1).data]")
            meant = self.browser.run(f"tera.state.datasets[0].index.classes[{label[v, u]}].rgb")
            for c in range(3):
                self.assertAlmostEqual(drawn[c], meant[c], delta=2)

    def check_pixel_and_point(self):
        """A pixel's place in the world, by its depth and the pose that the simulation wrote of the camera."""
        import cv2
        self.to(0.4)
        depth = cv2.imread(str(self.a / "digger/camera/depth/400000000.png"), cv2.IMREAD_UNCHANGED)
        v, u = 60, 50
        box = self.browser.run("(({left, top, width, height}) => [left, top, width, height])(tera.cameras.cards[0].canvas.getBoundingClientRect())")
        self.browser.move(box[0] + (u + 0.5) * box[2] / 96, box[1] + (v + 0.5) * box[3] / 72)
        self.browser.wait("tera.state.point !== null")
        self.assertEqual(self.browser.run("tera.state.point.pixel"), [u, v])
        p_W = self.browser.run("tera.state.point.p_W")
        _, poses = rows_of(self.a / "truth/digger/sensors/camera.csv")
        row = next(r for r in poses if r[0] == 400_000_000)
        lens = self.browser.run("tera.state.datasets[0].by_path.get('digger/camera').sheet.lens")
        z = depth[v, u] / 1000
        p_S = (z, -z * (u - lens["cx_px"]) / lens["fx_px"], -z * (v - lens["cy_px"]) / lens["fy_px"])
        w, x, y, q = row[4:8]
        R = ((1 - 2 * (y * y + q * q), 2 * (x * y - q * w), 2 * (x * q + y * w)), (2 * (x * y + q * w), 1 - 2 * (x * x + q * q), 2 * (y * q - x * w)),
             (2 * (x * q - y * w), 2 * (y * q + x * w), 1 - 2 * (x * x + y * y)))
        for i in range(3):
            self.assertAlmostEqual(p_W[i], row[1 + i] + sum(R[i][j] * p_S[j] for j in range(3)), delta=0.01)  # the lens of the preset bends by less

    def check_finding(self):
        """It lies on the timeline where its interval is, in its colour; a click on it shows its channel."""
        bar = self.browser.run("(({from, to, x, width}) => ({from, to, x, width}))(tera.timeline.bars[0])")
        self.assertEqual((bar["from"], bar["to"]), (FROM_S, TO_S))
        width = self.browser.run("tera.timeline.canvas.clientWidth")
        left, edge = self.browser.run("tera.timeline.left"), 10
        per_s = (width - left - edge) / self.browser.run("tera.state.to_s - tera.state.from_s")
        self.assertAlmostEqual(bar["x"], left + FROM_S * per_s, delta=0.5)
        self.assertAlmostEqual(bar["width"], (TO_S - FROM_S) * per_s, delta=0.5)
        pixel = ("(x) => [...tera.timeline.canvas.getContext('2d').getImageData(x, 11 * tera.timeline.event_rows.length + 4, 1, 1).data]"
                 ".slice(0, 3).join()")
        inside = self.browser.run(f"({pixel})({bar['x'] + bar['width'] / 2})")
        outside = self.browser.run(f"({pixel})({bar['x'] + bar['width'] + 9})")
        self.assertNotEqual(inside, outside)
        self.browser.run("document.querySelector('.finding').click()")
        self.browser.run(SETTLED)
        self.assertTrue(self.browser.run("tera.plots.plots.some((p) => p.path === 'digger/joints' && p.columns.includes('boom_radps'))"))
        self.assertTrue(self.browser.run("Boolean(document.querySelector('.finding .curve canvas'))"))

    def check_keys(self):
        self.to(0.0)
        self.browser.key(".")
        self.assertAlmostEqual(self.browser.run("tera.state.t_s"), 0.2, 9)  # the camera's next picture
        self.browser.key("End")
        self.assertAlmostEqual(self.browser.run("tera.state.t_s"), 1.2, 9)
        was = self.browser.run("document.documentElement.dataset.theme")
        self.browser.key("t")
        self.assertNotEqual(self.browser.run("document.documentElement.dataset.theme"), was)

    def check_long_table(self):
        """Its rows are those of the file, and its overview misses nothing once it is read through."""
        read = "tera.state.datasets[0].call"
        self.assertGreater((self.a / "digger/long.csv").stat().st_size, 8 << 20)
        for k in (0, 123_456, LONG_ROWS - 1):
            row = self.browser.run(f"{read}('rows', {{paths: ['digger/long.csv'], t_s: {k * 4800 + 1} * 1e-9}}).then((r) => r[0].now.values)")
            self.assertEqual(row, [7.5 if k == 177_777 else math.sin(1e-3 * k), k, -k / 7, k / 3])
        whole = f"{read}('series', {{path: 'digger/long.csv', columns: ['wave_m'], from_s: 0, to_s: 2, points: 300}})"
        self.browser.run(whole)
        highest = self.browser.run(f"(async () => {{ while ((await {read}('refine', {{path: 'digger/long.csv', blocks: 4}})).more); "
                                   f"const s = await {whole}; return [s.complete, Math.max(...s.values[0]), s.t_s.length]; }})()")
        self.assertEqual(highest[:2], [True, 7.5])
        self.assertLessEqual(highest[2], 2 * 300)

    def check_phone(self):
        self.browser.resize(390, 844, True)
        for tab in ("view3d", "cameras", "plots", "map", "side"):
            self.browser.run(f"document.querySelector('[data-tab={tab}]').click()")
            self.browser.run(SETTLED)
            self.assertLessEqual(self.browser.run("document.documentElement.scrollWidth"), 390, tab)
            shown = self.browser.run("[...document.querySelectorAll('.panel')].filter((p) => p.offsetWidth > 0).length")
            self.assertEqual(shown, 1, tab)

    def test_shows_the_difference_of_two_datasets(self):
        self.look(self.a, self.b)
        self.to(0.5)
        both = self.values("digger/joints")
        self.assertAlmostEqual(both["A" + self.shifted] - both["B" + self.shifted], 0.25, 12)
        self.browser.key("d")
        self.browser.run(SETTLED)
        rms = self.browser.run("tera.plots.plots.find((p) => p.path === 'digger/joints').rms")
        self.assertAlmostEqual(rms[0], 0.25, 9)
        self.assertAlmostEqual(rms[1], 0, 9)
        self.browser.run("tera.state.shown = 'difference'; tera.cameras.cards.forEach((c) => c.update.ask())")
        self.browser.run(SETTLED)
        brightest = self.browser.run("tera.cameras.cards[0].canvas.getContext('2d').getImageData(0, 0, 96, 72).data.reduce((m, v, k) => k % 4 === 3 ? m : Math.max(m, v), 0)")
        self.assertEqual(brightest, 0)  # the pictures are the same

    def test_keeps_the_datasets_of_one_file_apart(self):
        self.tera("view", "a", "b", "--export", "both.html", "--size", "10")
        self.show((self.folder / "both.html").as_uri())
        self.to(0.5)
        both = self.values("digger/joints")
        self.assertAlmostEqual(both["A" + self.shifted] - both["B" + self.shifted], 0.25, 12)

    def test_is_one_file_that_needs_no_server(self):
        said = self.tera("view", "b", "why", "--export", "page.html", "--size", "5")
        self.assertRegex(said, r"page\.html: [\d.]+ MB\. An excerpt: ")
        self.assertLess((self.folder / "page.html").stat().st_size, 5_000_000)
        self.show((self.folder / "page.html").as_uri())
        self.to(0.7)
        names, rows = rows_of(self.b / "digger/joints/data.csv")
        now = [row for row in rows if row[0] <= 700_000_000][-1]
        for column, value in self.values("digger/joints").items():
            self.assertEqual(value, now[names.index(column)])
        self.assertGreater(self.browser.run("tera.view.points"), 0)
        self.assertTrue(self.browser.run("tera.view.bodies.size === 1"))


if __name__ == "__main__":
    unittest.main()
