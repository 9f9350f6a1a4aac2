"""docs/which_light.py, by a quick run of its own: what it rewrites, what it leaves alone, and which claims it refuses.

    python3 tests/docs/which_light_test.py PROGRAM
"""

import contextlib
import io
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "docs"))
import which_light  # noqa: E402

PAGE = (ROOT / "docs" / "which-light.md").read_text()
PROGRAM = ROOT / "build/release/bin/mis"
SECTION = re.compile(r"(<!-- table: \w+ -->).*?(<!-- end -->)", re.S)


class WhichLight(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        cls.runs = which_light.runs_for(cls.folder, quick=True)
        with contextlib.redirect_stderr(io.StringIO()):
            which_light.measure(PROGRAM, cls.runs, cls.folder)
        lamps = which_light.lamps_for(quick=True)
        which_light.predict_lamps(PROGRAM, lamps, cls.folder)
        read = which_light.read(cls.runs, cls.folder), which_light.read_lamps(lamps, cls.folder)
        cls.found = which_light.Found(*read)

    def claims(self, *lines):
        return list(which_light.broken_claims("<!-- holds\n" + "\n".join(lines) + "\n-->", self.found))

    def test_rewrites_every_section_and_no_prose(self):
        stale = SECTION.sub(r"\1\nstale\n\2", PAGE)
        page = which_light.rewritten(stale, self.found)
        self.assertNotIn("stale", "".join(m[0] for m in SECTION.finditer(page)))
        self.assertEqual(SECTION.sub("", page), SECTION.sub("", PAGE))
        self.assertEqual(which_light.rewritten(page, self.found), page)

    def test_refuses_a_page_that_has_no_place_for_a_table_or_two(self):
        for page in (PAGE.replace("<!-- table: ways -->\n", ""), PAGE + "<!-- table: ways -->\n<!-- end -->"):
            with self.assertRaisesRegex(SystemExit, "table ways"):
                which_light.rewritten(page, self.found)

    def test_a_cell_is_the_ratio_of_what_the_reports_say(self):
        scene = self.found["lecture"]["strategies"]
        classic = [f"{choice}/{h}" for choice in which_light.CHOICES for h in which_light.HEURISTICS]
        known = {n: scene[n]["relative_variance"]["value"] for n in classic if scene[n]["status"] == "ranked"}
        uniform = min(x for name, x in known.items() if name.startswith("uniform/"))
        row = next(line for line in which_light.policies(self.found).splitlines() if line.startswith("| [lecture]"))
        cells = [cell.strip(" ~") for cell in row.split("|")]
        self.assertAlmostEqual(float(cells[4]) / (uniform / min(known.values())), 1, delta=0.01)

    def test_every_scene_and_strategy_has_its_place_in_the_complete_tables(self):
        for name in which_light.SAMPLES:
            text = which_light.complete(name, self.found[name])
            for strategy in self.found[name]["strategies"]:
                self.assertEqual(text.count(f"| `{strategy}` |"), 1, (name, strategy))

    def test_claims_are_held_against_the_figures(self):
        true = "single relative_variance uniform / product/light: 0.99 to 1.01"
        self.assertEqual(self.claims(true, "veach brdf: not_resolved", "single variance tree/light / tree/light: 1 to 1"), [])
        false = ["single relative_variance uniform / product/light: 2 to 3", "single uniform/light: not_resolved"]
        unknown = ["veach relative_variance brdf / brdf: 0 to inf"]  # of what is not resolved nothing holds
        self.assertEqual(self.claims(*false, *unknown), false + unknown)

    def test_what_the_page_claims_can_be_read(self):
        random = {f"random-{count}": self.found["random-1000"] for count in which_light.COUNTS}
        scenes = which_light.Found({**self.found, **random}, self.found.lamps)
        blocks = re.findall(r"<!-- holds\n(.*?)-->", PAGE, re.S)
        claimed = {line.split()[0] for block in blocks for line in block.splitlines()}
        self.assertLessEqual(claimed, {*scenes, "lamps"})
        list(which_light.broken_claims(PAGE, scenes))

    def test_lamps_are_known_without_a_sample(self):
        matt = self.found.lamps["32 lamps, matt"]
        self.assertAlmostEqual(matt["product/light"], matt["irradiance/light"], delta=1e-6)  # without a lobe they are one
        self.assertLess(matt["irradiance/light/projected"], matt["irradiance/light"])
        row = next(line for line in which_light.lamps(self.found).splitlines() if line.startswith("| 32 lamps, matt"))
        self.assertEqual(row.split("|")[2].strip(), which_light.number(matt["uniform/light"]))
        true = "lamps 32 lamps, matt: uniform/light / irradiance/light: 2 to 1e6"
        false = "lamps 32 lamps, matt: uniform/light / irradiance/light: 0 to 2"
        self.assertEqual(self.claims(true, false), [false])

    def test_pictures_are_small_and_whole(self):
        for name, picture in which_light.pictures(self.found).items():
            self.assertIn(f"images/{name}", PAGE)
            self.assertLess(len(picture.encode()), 30_000)
            xml.etree.ElementTree.fromstring(picture)

    def test_without_reports_nothing_is_written(self):
        into = self.folder / "into"
        script = [sys.executable, ROOT / "docs" / "which_light.py", "--from", self.folder / "empty", "--into", into]
        run = subprocess.run(script, capture_output=True, text=True)
        self.assertEqual(run.returncode, 1)
        self.assertIn("single.json", run.stderr)
        self.assertFalse(into.exists())

    def test_numbers_and_durations(self):
        numbers = {0: "0", 1: "1.00", 0.9996: "1.00", 12.34: "12.3", 1234: "1230", 2e6: "2.0e6", 3e-15: "3.0e-15"}
        self.assertEqual({x: which_light.number(x) for x in numbers}, numbers)
        durations = {0.0125: "12 ms", 1.25: "1.2 s", 90: "1.5 min", 7200: "2 h", 4e-5: "40 µs"}
        for seconds, text in durations.items():
            strategy = {"status": "ranked", "seconds_to_1_percent": seconds}
            self.assertEqual(which_light.duration(strategy), text)


if __name__ == "__main__":
    PROGRAM = pathlib.Path(sys.argv.pop(1)) if len(sys.argv) > 1 else PROGRAM
    unittest.main()
