"""The Python module, as its users meet it. Seeds are fixed; statistical tests state their false-alarm rate."""

import ast
import inspect
import json
import math
import os
import pathlib
import signal
import sys
import tempfile
import threading
import time
import unittest

import numpy as np

import mis

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "docs"))
import lecture_figures  # noqa: E402

try:
    import matplotlib

    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
except ImportError:
    plt = None

LECTURE = ROOT / "scenes" / "lecture.json"
ECLIPSE = ROOT / "scenes" / "eclipse.json"
SINGLE = ROOT / "scenes" / "single.json"

ONE_LIGHT = {
    "format": "mis-scene/1",
    "name": "one light",
    "probes": [{"position": [0, 0, 0], "normal": [0, 1, 0], "outgoing": [0, 1, 0], "material": "grey"}],
    "materials": {"grey": {"type": "lambert", "albedo": 0.5}},
    "lights": [{"center": [0, 2, 0], "radius": 1, "radiance": [3, 3, 3]}],
}


def kept_by(array):
    """The name of the type that owns an array's memory."""
    assert not array.flags.owndata
    return type(array.base).__name__


class Scenes(unittest.TestCase):
    def test_a_file_and_its_dict_are_one_scene(self):
        strips = (line.split("//")[0] for line in ECLIPSE.read_text().splitlines())
        from_dict = mis.Scene(json.loads("\n".join(strips)))
        from_file = mis.Scene(ECLIPSE)
        self.assertEqual(from_dict.name, from_file.name)
        np.testing.assert_array_equal(from_dict.light_centers, from_file.light_centers)
        np.testing.assert_array_equal(
            mis.samples(from_dict, "power/balance", 100), mis.samples(from_file, "power/balance", 100)
        )

    def test_lights_are_views_of_the_scene(self):
        scene = mis.Scene(LECTURE)
        centers, radii = scene.light_centers, scene.light_radii
        self.assertEqual((centers.shape, radii.shape), ((4, 3), (4,)))
        np.testing.assert_array_equal(centers[1], [-0.5, 1, -1.2])
        np.testing.assert_array_equal(radii, [0.04, 0.12, 0.3, 0.6])
        power = scene.light_radiance * 4 * math.pi**2 * radii[:, None] ** 2
        np.testing.assert_allclose(power[2], [10, 25, 40], rtol=1e-6)
        again = scene.light_centers
        self.assertEqual(centers.ctypes.data, again.ctypes.data)
        self.assertIs(centers.base, scene)
        with self.assertRaises(ValueError):
            centers[0, 0] = 1
        expected = centers.copy()
        del scene, again
        np.testing.assert_array_equal(centers, expected)  # the view keeps the scene

    def test_resolution_takes_the_cameras_place(self):
        self.assertEqual(mis.Scene(LECTURE).resolution, [256, 171])
        self.assertEqual(mis.Scene(LECTURE, resolution=(8, 4)).resolution, [8, 4])
        self.assertIsNone(mis.Scene(ONE_LIGHT).resolution)


class Values(unittest.TestCase):
    def test_samples_have_the_mean_and_variance_that_is_predicted(self):
        strategies = ["uniform/light", "solid-angle/power", "brdf", "irradiance/balance@2+1"]
        scene = mis.Scene(LECTURE)
        predicted = mis.predict(scene, strategies)
        for key in ("mean", "variance", "fourth"):
            self.assertEqual(predicted[key].shape, (2, 4))
            self.assertEqual(predicted[key + "_error"].shape, (2, 4))
        count = 1 << 18
        bound = 5.5  # what the largest of 16 normal |z| exceeds with probability 1e-6
        for p in range(2):
            for s, strategy in enumerate(strategies):
                x = mis.samples(scene, strategy, count, probe=p)
                mean, variance, fourth = (predicted[key][p, s] for key in ("mean", "variance", "fourth"))
                d2 = (x - mean) ** 2
                z = (x.mean() - mean) / math.sqrt(variance / count)
                z2 = (d2.mean() - variance) / math.sqrt((fourth - variance**2) / count)
                self.assertLess(abs(z), bound, (strategy, p))
                self.assertLess(abs(z2), bound, (strategy, p))
        # The twin: a fiftieth off is seen.
        x = mis.samples(scene, "solid-angle/power", count, probe=1)
        off = (1.02 * x.mean() - predicted["mean"][1, 1]) / math.sqrt(predicted["variance"][1, 1] / count)
        self.assertGreater(off, bound)

    def test_one_light_overhead_is_known_in_closed_form(self):
        # E = π L sin²θ_max, so Lo = albedo/π · E.
        found = mis.predict(mis.Scene(ONE_LIGHT), ["power/light"])
        self.assertAlmostEqual(found["mean"][0, 0], 0.5 * 3 * 0.25, places=7)

    def test_a_sample_is_known_by_its_number(self):
        scene = mis.Scene(LECTURE, resolution=(32, 20))
        whole = mis.samples(scene, "power/balance", 40000, pixel=(16, 15), threads=2)
        part = mis.samples(scene, "power/balance", 100, pixel=(16, 15), first=30000, threads=1)
        np.testing.assert_array_equal(whole[30000:30100], part)
        other = mis.samples(scene, "power/balance", 100, pixel=(16, 15), first=30000, seed=2)
        self.assertFalse(np.array_equal(part, other))

    def test_a_picture_is_made_of_the_samples(self):
        scene = mis.Scene(LECTURE, resolution=(32, 20))
        picture = mis.render(scene, "power/balance", 40)
        self.assertEqual(picture.radiance.shape, (20, 32, 3))
        self.assertEqual(picture.radiance.dtype, np.float32)
        self.assertEqual(picture.variance.shape, (20, 32))
        self.assertEqual(picture.invalid, 0)
        x = mis.samples(scene, "power/balance", 40, pixel=(16, 15))
        luminance = picture.radiance[15, 16] @ [0.2126, 0.7152, 0.0722]
        self.assertAlmostEqual(luminance / x.mean(), 1, places=4)
        self.assertAlmostEqual(picture.variance[15, 16] / x.var(ddof=1), 1, places=6)
        empty = np.isnan(picture.variance)
        self.assertTrue(empty.any() and not empty.all())

    def test_threads_change_nothing(self):
        scene = mis.Scene(LECTURE, resolution=(40, 30))
        one, two = (mis.render(scene, "solid-angle/power", 4, threads=t).radiance for t in (1, 2))
        np.testing.assert_array_equal(one, two)
        sobol = mis.render(scene, "solid-angle/power", 4, sampler="sobol").radiance
        self.assertFalse(np.array_equal(one, sobol))

    def test_every_sampler_compares_and_samples(self):
        smooth = mis.Scene(SINGLE, resolution=(32, 20))
        variance = {}
        for sampler in ("independent", "sobol"):
            report = mis.compare(smooth, ["solid-angle/power"], spp=256, sampler=sampler)
            self.assertEqual(report["sampler"], sampler)
            variance[sampler] = report["scenes"][0]["strategies"][0]["variance"]["value"]
        self.assertLess(variance["sobol"], 0.2 * variance["independent"])
        scene = mis.Scene(LECTURE, resolution=(32, 20))
        picture = mis.render(scene, "solid-angle/power", 16, sampler="sobol")
        x = mis.samples(scene, "solid-angle/power", 16, pixel=(16, 15), sampler="sobol")
        luminance = picture.radiance[15, 16] @ [0.2126, 0.7152, 0.0722]
        self.assertAlmostEqual(luminance / x.mean(), 1, places=4)

    def test_compare_gives_the_report(self):
        scene = mis.Scene(LECTURE, resolution=(32, 20))
        report = mis.compare(scene, ["uniform/light", "radiant-solid-angle/light"], spp=256)
        self.assertEqual(report["format"], "mis-report/1")
        uniform, radiant = report["scenes"][0]["strategies"]
        self.assertEqual((radiant["name"], radiant["rank"]), ("radiant-solid-angle/light", 1))
        self.assertGreater(uniform["variance"]["low"], radiant["variance"]["high"])
        self.assertEqual(report["seed"], 1)


class Memory(unittest.TestCase):
    def test_arrays_stand_over_the_memory_of_the_run(self):
        scene = mis.Scene(LECTURE, resolution=(16, 10))
        picture = mis.render(scene, "power/balance", 2)
        arrays = [picture.radiance, picture.variance, mis.samples(scene, "power/balance", 10)]
        arrays += [scene.light_radiance, mis.predict(scene, ["power/light"])["mean"]]
        for array in arrays:
            self.assertEqual(kept_by(array), "PyCapsule")
        self.assertEqual(picture.radiance.ctypes.data, picture.radiance.ctypes.data)
        kept = [(array, array.copy()) for array in arrays]
        del scene, picture, arrays
        for array, copy in kept:
            np.testing.assert_array_equal(array, copy)

    def test_other_threads_run_meanwhile(self):
        scene = mis.Scene(LECTURE, resolution=(64, 48))
        works = {
            "render": lambda: mis.render(scene, "power/balance", 3000, threads=1),
            "samples": lambda: mis.samples(scene, "power/balance", 4_000_000, threads=1),
            "compare": lambda: mis.compare(scene, ["power/light", "brdf"], seconds=0.5, threads=1),
            "predict": lambda: mis.predict(mis.Scene(ECLIPSE), mis_strategies(), threads=1),
        }
        for name, work in works.items():
            done = threading.Event()

            def run():
                work()
                done.set()

            thread = threading.Thread(target=run)
            thread.start()
            steps = 0  # with the interpreter held, there is one at either end
            while not done.is_set():
                time.sleep(0.001)
                steps += 1
            thread.join()
            self.assertGreater(steps, 8, name)


    def test_ctrl_c_ends_a_run(self):
        scene = mis.Scene(LECTURE, resolution=(64, 48))
        many = [{"center": [0.01 * k, 2 + 0.02 * k, 0.1 * math.sin(k)], "radius": 1, "radiance": 1 + k} for k in range(60)]
        overlapping = mis.Scene({**ONE_LIGHT, "lights": many})
        lights = {"count": 10_000_000, "seed": 1, "box": [[0, 1, 0], [9, 9, 9]], "radius": [0.001, 0.01], "power": [1, 2]}
        ten_million = {**ONE_LIGHT, "lights": [{"type": "random", **lights}]}
        works = [
            lambda: mis.render(scene, "power/balance", 10_000_000),
            lambda: mis.samples(scene, "power/balance", 200_000_000),
            lambda: mis.compare(scene, ["power/light", "brdf"], seconds=1000),
            lambda: mis.predict(overlapping, mis_strategies()),
            lambda: mis.Scene(ten_million),
        ]
        for work in works:
            timer = threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT))
            timer.start()
            with self.assertRaises(KeyboardInterrupt):
                work()
            timer.join()


def mis_strategies():
    return [f"{p}/{h}" for p in mis.policies() for h in mis.heuristics() if h != "light"]


class Figures(unittest.TestCase):
    """docs/lecture_figures.py draws what it says it draws."""

    def test_only_the_mistake_is_far_from_pi(self):
        last = {name: x[-1] for name, x in lecture_figures.cosine_estimates(100_000).items()}
        self.assertAlmostEqual(last.pop("θ regular, taken for uniform"), 4, delta=0.05)
        self.assertEqual(len(last), 3)
        for name, estimate in last.items():
            self.assertAlmostEqual(estimate, math.pi, delta=0.05, msg=name)  # 8 standard errors

    def test_directions_have_their_mean_cosine(self):
        means = [w[:, 2].mean() for w in lecture_figures.directions(100_000).values()]
        for mean, expected in zip(means, [2 / math.pi, 1 / 2, 2 / 3]):
            self.assertAlmostEqual(mean, expected, delta=0.008)  # 8 standard errors

    def test_lights_are_drawn_by_power(self):
        luminance = np.array([40, 20, 0.2126 * 10 + 0.7152 * 25 + 0.0722 * 40, 0.2126 * 50 + 0.7152 * 40 + 0.0722 * 20])
        found = lecture_figures.light_powers(mis.Scene(LECTURE))
        np.testing.assert_allclose(found, luminance / luminance.sum(), rtol=1e-6)

    def test_errors_fall_by_the_root_of_n(self):
        n, errors = lecture_figures.convergence(mis.Scene(LECTURE), ["product/balance", "uniform/light"])
        for name, error in errors.items():
            slope = np.polyfit(np.log(n), np.log(error), 1)[0]
            self.assertAlmostEqual(slope, -0.5, delta=0.03, msg=name)

    @unittest.skipIf(plt is None, "matplotlib is not there")
    def test_every_figure_is_drawn(self):
        with tempfile.TemporaryDirectory() as folder:
            names = lecture_figures.draw_all(plt, pathlib.Path(folder), LECTURE, width=24, spp=2)
            written = sorted(path.name for path in pathlib.Path(folder).iterdir())
        self.assertEqual(written, sorted(f"{name}.png" for name in names))
        self.assertEqual(len(names), 7)


class BadInput(unittest.TestCase):
    def assert_says(self, words, call, kind=ValueError):
        with self.assertRaises(kind) as caught:
            call()
        for word in words:
            self.assertIn(word, str(caught.exception))

    def test_of_scenes(self):
        bad = json.loads(json.dumps(ONE_LIGHT))
        bad["lights"][0]["radius"] = -1
        self.assert_says(["/lights/0/radius", "-1"], lambda: mis.Scene(bad), mis.SceneError)
        self.assert_says(["nowhere.json"], lambda: mis.Scene("nowhere.json"), mis.SceneError)
        self.assert_says(["resolution", "0"], lambda: mis.Scene(LECTURE, resolution=(0, 4)))
        self.assert_says(["resolution", "no camera"], lambda: mis.Scene(ONE_LIGHT, resolution=(4, 4)))
        self.assertRaises(TypeError, lambda: mis.Scene(3))
        self.assertTrue(issubclass(mis.SceneError, ValueError))

    def test_of_strategies(self):
        scene = mis.Scene(ONE_LIGHT)
        self.assert_says(["pwoer", "power"], lambda: mis.samples(scene, "pwoer/light", 1), mis.StrategyError)
        self.assert_says(["brdf"], lambda: mis.predict(scene, ["uniform/brdf"]), mis.StrategyError)
        self.assert_says(["strategies", "none"], lambda: mis.compare(scene, []))
        self.assert_says(["strategies", "none"], lambda: mis.predict(scene, []))

    def test_of_numbers(self):
        scene = mis.Scene(LECTURE, resolution=(8, 5))
        one = mis.Scene(ONE_LIGHT)
        says = self.assert_says
        says(["spp", "found 0"], lambda: mis.render(scene, "brdf", 0))
        says(["threads", "-1"], lambda: mis.render(scene, "brdf", threads=-1))
        says(["sampler", "halton"], lambda: mis.render(scene, "brdf", sampler="halton"))
        says(["no camera"], lambda: mis.render(one, "brdf"))
        says(["count", "-1"], lambda: mis.samples(scene, "brdf", -1))
        says(["probe", "found 2"], lambda: mis.samples(scene, "brdf", 1, probe=2))
        says(["column", "found 8"], lambda: mis.samples(scene, "brdf", 1, pixel=(8, 0)))
        says(["no surface"], lambda: mis.samples(scene, "brdf", 1, pixel=(0, 0)))
        says(["no camera"], lambda: mis.samples(one, "brdf", 1, pixel=(0, 0)))
        says(["both"], lambda: mis.samples(scene, "brdf", 1, pixel=(0, 0), probe=0))
        says(["more than one"], lambda: mis.compare(scene, ["brdf"], spp=8, seconds=1))
        says(["seconds", "0"], lambda: mis.compare(scene, ["brdf"], seconds=0))
        says(["error", "nan"], lambda: mis.compare(scene, ["brdf"], error=math.nan))
        says(["sampler", "halton"], lambda: mis.compare(scene, ["brdf"], sampler="halton"))
        says(["sampler", "halton"], lambda: mis.samples(scene, "brdf", 1, sampler="halton"))
        says(["at", "2.5", "scrambling"], lambda: mis.compare(scene, ["brdf"], at=2.5, sampler="sobol"))
        says(["spp", "24", "multiple"], lambda: mis.compare(scene, ["brdf"], spp=24, sampler="sobol"))
        says(["at", "-2"], lambda: mis.compare(scene, ["brdf"], at=-2))
        self.assertRaises(TypeError, lambda: mis.render(scene, 3))

    def test_of_quadrature(self):
        hidden = json.loads(json.dumps(ONE_LIGHT))
        hidden["surfaces"] = [
            {"type": "quad", "corner": [-1, 0.5, -1], "edges": [[2, 0, 0], [0, 0, 2]], "material": "grey"}
        ]
        scene = mis.Scene(hidden)
        self.assertRaises(mis.PredictError, lambda: mis.predict(scene, ["brdf"]))
        no_probes = mis.Scene(ROOT / "scenes" / "veach.json")
        self.assert_says(["no probes"], lambda: mis.predict(no_probes, ["brdf"]))


class Document(unittest.TestCase):
    def test_the_program_of_the_page_runs(self):
        page = (ROOT / "docs" / "python.md").read_text()
        program = page.split("```python\n")[1].split("```")[0].replace('"scenes/', f'"{ROOT}/scenes/')
        names = {"print": lambda *values: None}
        exec(program.replace("seconds=2", "spp=16"), names)
        self.assertEqual(names["picture"].radiance.shape, (85, 128, 3))
        self.assertEqual(len(names["report"]["scenes"][0]["strategies"]), 3)


class Stub(unittest.TestCase):
    """mis.pyi says what the module has."""

    def setUp(self):
        stub = pathlib.Path(mis.__file__).with_name("mis.pyi")
        self.tree = ast.parse(stub.read_text())

    def test_it_names_what_there_is(self):
        names = set()
        for node in self.tree.body:
            if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
                names.add(node.name)
            elif isinstance(node, ast.AnnAssign):
                names.add(node.target.id)
        there = {name for name in dir(mis) if not name.startswith("__")} | {"__version__"}
        self.assertEqual(names, there)
        for node in self.tree.body:
            if isinstance(node, ast.ClassDef) and not node.name.endswith("Error"):
                members = {n.name for n in node.body if isinstance(n, ast.FunctionDef)}
                real = {n for n in vars(getattr(mis, node.name)) if not n.startswith("_")}
                self.assertEqual({n for n in members if not n.startswith("_")}, real, node.name)

    def test_arguments_have_the_names_that_help_shows(self):
        for node in self.tree.body:
            if not isinstance(node, ast.FunctionDef):
                continue
            shown = getattr(mis, node.name).__doc__.splitlines()[0]
            for argument in node.args.args + node.args.kwonlyargs:
                self.assertIn(f"{argument.arg}:", shown, node.name)
            self.assertEqual("*" in shown, bool(node.args.kwonlyargs), node.name)

    def test_all_that_is_public_has_a_docstring(self):
        for name in dir(mis):
            if not name.startswith("__"):
                self.assertGreater(len(inspect.getdoc(getattr(mis, name)) or ""), 20, name)


if __name__ == "__main__":
    unittest.main()
