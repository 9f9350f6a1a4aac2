#!/usr/bin/python3
"""The tables and pictures of docs/which-light.md: a point is lit by M spheres; which one, and how?

    ./do which-light [--quick] [--from FOLDER] [--into FOLDER]

Runs `mis compare` on every scene that comes along and on up to a million random lights. Of the page it rewrites what
stands between `<!-- table: NAME -->` and `<!-- end -->`, and draws the pictures. Of random lamps over a plain it asks `mis predict`. Prose is left alone; what it claims in
comments `<!-- holds … -->` is checked against the figures. Needs nothing but Python 3 and mis.
"""

import argparse
import datetime
import json
import math
import os
import pathlib
import random
import re
import subprocess
import sys
import typing

ROOT = pathlib.Path(__file__).resolve().parents[1]
CHOICES = ["uniform", "power", "solid-angle", "radiant-solid-angle", "irradiance", "product", "tree"]
HEURISTICS = ["light", "balance", "power"]
SAMPLES = {  # per point
    "single": 256, "veach": 1024, "veach-blinn": 1024, "lecture": 1024, "hundred": 512, "overlap": 1024,
    "eclipse": 1024, "horizon": 1024, "sun-and-lamp": 1024, "street": 512,
}  # fmt: skip
TOO_MANY = {"hundred", "street"}  # lights, to draw towards each
COUNTS = [10**3, 10**4, 10**5, 10**6]  # of random lights
DRAWS = [16, 64, 256]  # at a point, that are spread together
TOGETHER = ["product/balance", "product/light/projected", *(f"strata@{n}" for n in DRAWS)]
SURFACES = {  # under random lamps that nothing shades but they themselves
    "matt": {"type": "lambert", "albedo": 0.5},
    **{f"`blinn`, m = {m}": {"type": "blinn", "diffuse": 0.1, "specular": 0.9, "exponent": m} for m in (20, 200, 2000)},
}  # fmt: skip


# What is measured.


class Run(typing.NamedTuple):
    """One `mis compare`. As samples are given and not seconds, its variances come out the same again, to the bit."""

    name: str
    scene: pathlib.Path
    resolution: str
    samples: int
    strategies: list


def runs_for(folder, quick):
    """All that the page is made of. Pictures have half a scene's width and height: fewer points, more samples of each."""
    runs, part = [], 8 if quick else 2
    for name, samples in SAMPLES.items():
        file = pathlib.Path("scenes", f"{name}.json")
        width, height = re.search(r'"resolution": *\[(\d+), *(\d+)\]', (ROOT / file).read_text()).groups()
        size = f"{int(width) // part}x{int(height) // part}"
        runs.append(Run(name, file, size, 64 if quick else samples, strategies_for(name)))
        small = f"{int(width) // (2 * part)}x{int(height) // (2 * part)}"
        runs.append(Run(f"{name}-together", file, small, 1024 if quick else 32768, TOGETHER))
    for count in COUNTS[:2] if quick else COUNTS:
        file, samples = folder / f"random-{count}.scene.json", 64 if quick else 8192
        strategies = [f"{policy}/power" for policy in ("uniform", "power", "product", "tree")]
        runs.append(Run(f"random-{count}", file, "20x15", samples, strategies))
    return runs


def strategies_for(scene):
    """Every choice by the classic heuristics; of the best choice, also the other ways to draw and to weigh."""
    choices = CHOICES + ([] if scene in TOO_MANY else ["all"])
    ways = [f"product/{h}/{t}" for t in ("projected", "union") for h in HEURISTICS]
    return [f"{c}/{h}" for c in choices for h in HEURISTICS] + ["product/cutoff", "product/maximum", *ways, "brdf"]


def random_scene(count):
    """Lamps above a square with a dozen towers. Whatever their number, they fill the same part of the sky."""
    quads = [([-20, 0, -20], [[0, 0, 40], [40, 0, 0]])]
    for x, z in [(-12 + 8 * (i % 4), -9 + 8 * (i // 4)) for i in range(12)]:
        walls = [(x, z, 0.8, 0), (x, z, 0, 0.8), (x + 0.8, z, 0, 0.8), (x, z + 0.8, 0.8, 0)]
        quads += [([a, 0, b], [[along_x, 0, along_z], [0, 3, 0]]) for a, b, along_x, along_z in walls]
    radius = 0.02 * math.sqrt(1000 / count)
    lamps = {"box": [[-18, 4, -18], [18, 4.05, 18]], "radius": [radius, 10 * radius], "power": [1, 100]}
    return {
        "format": "mis-scene/1",
        "camera": {"position": [0, 8, 22], "target": [0, 1, 0]},
        "materials": {"ground": {"type": "blinn", "diffuse": 0.4, "specular": 0.2, "exponent": 200}},
        "surfaces": [{"type": "quad", "corner": c, "edges": e, "material": "ground"} for c, e in quads],
        "lights": [{"type": "random", "count": count, "seed": 1, **lamps}],
    }


class Lamps(typing.NamedTuple):
    """Random lamps over a plain, at some points of which `mis predict` knows the variances without a sample."""

    what: str
    surface: str
    count: int
    half_width: float  # of the plain; metres
    scenes: int
    strategies: list

    def file(self, scene):
        surface = re.sub("[^a-z0-9]+", "-", self.surface)
        return f"lamps-{self.count}-{surface.strip('-')}-{scene}"


def lamps_for(quick):
    ways = [f"{c}/light" for c in CHOICES] + ["irradiance/light/projected", "irradiance/balance", "product/balance"]
    few = [Lamps(f"32 lamps, {s}", s, 32, 5, 1 if quick else 6, ways) for s in SURFACES]
    many = ways[:7]  # by 1000 lamps, the union of the others takes too long
    return few + [Lamps(f"1000 lamps, {s}", s, 1000, 50, 1, many) for s in list(SURFACES)[::2]]


def lamp_scene(lamps, seed):
    """Radii and radiances over decades; eight points, each seen from somewhere above."""
    draw = random.Random(1000 * lamps.count + seed)

    def power_law(low, high):
        return math.exp(draw.uniform(math.log(low), math.log(high)))

    def over_plain(low, high, share=1):
        across = share * lamps.half_width
        return [draw.uniform(-across, across), draw.uniform(low, high), draw.uniform(-across, across)]

    probes, lights = [], []
    for _ in range(8):
        theta, phi = draw.uniform(0.2, 1.3), draw.uniform(0, 2 * math.pi)
        view = [math.sin(theta) * math.cos(phi), math.cos(theta), math.sin(theta) * math.sin(phi)]
        probes.append({"position": over_plain(0, 0, 0.8), "normal": [0, 1, 0], "outgoing": view, "material": "m"})
    for _ in range(lamps.count):
        radius, radiance = power_law(0.02, 0.3), power_law(1, 100)
        lights.append({"center": over_plain(0.7, 4), "radius": radius, "radiance": [radiance] * 3})
    return {"format": "mis-scene/1", "materials": {"m": SURFACES[lamps.surface]}, "probes": probes, "lights": lights}


def predict_lamps(mis, all_lamps, folder):
    """Leaves the exact figures of each of their scenes in the folder."""
    for lamps in all_lamps:
        for k in range(lamps.scenes):
            scene, out = folder / f"{lamps.file(k)}.scene.json", folder / f"{lamps.file(k)}.json"
            write(scene, json.dumps(lamp_scene(lamps, k)))
            command = [mis, "predict", scene, "--strategy", ",".join(lamps.strategies), "--quiet", "--json", out]
            subprocess.run(command, cwd=ROOT, stdout=subprocess.DEVNULL, check=True)


def read_lamps(all_lamps, folder):
    """What → strategy → relative variance of a sample, the mean over points and scenes."""
    found = {}
    for lamps in all_lamps:
        sums = found.setdefault(lamps.what, dict.fromkeys(lamps.strategies, 0.0))
        for k in range(lamps.scenes):
            report = json.loads((folder / f"{lamps.file(k)}.json").read_text())["scenes"][0]
            for s in report["strategies"]:
                squares = [p["variance"]["value"] / p["mean"]["value"] ** 2 for p in s["probes"]]
                sums[s["name"]] += sum(squares) / len(squares) / lamps.scenes
    return found


class Found(dict):
    """By name, the scene of each report; and what is known of lamps."""

    def __init__(self, scenes, lamps):
        super().__init__(scenes)
        self.lamps = lamps


def measure(mis, runs, folder):
    """Leaves a report NAME.json of every run in the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    for count in COUNTS:
        write(folder / f"random-{count}.scene.json", json.dumps(random_scene(count)))
    for i, run in enumerate(runs):
        print(f"which_light.py: {run.name}, {i + 1} of {len(runs)}", file=sys.stderr, flush=True)
        command = [mis, "compare", run.scene, "--own-samples", "--resolution", run.resolution, "--spp", str(run.samples)]
        command += ["--strategy", ",".join(run.strategies), "--quiet", "--json", folder / f"{run.name}.json"]
        subprocess.run(command, cwd=ROOT, stdout=subprocess.DEVNULL, check=True)


def read(runs, folder):
    """By name, the scene of each report, with its strategies by their names, and what the report says of the run."""
    found = {}
    for run in runs:
        file = folder / f"{run.name}.json"
        report = json.loads(file.read_text())
        scene = {**report, **report["scenes"][0], "date": datetime.date.fromtimestamp(file.stat().st_mtime)}
        found[run.name] = {**scene, "samples": run.samples, "strategies": {s["name"]: s for s in scene["strategies"]}}
    return found


# What is said of a figure.


def is_ranked(strategy):
    return bool(strategy) and strategy["status"] == "ranked"


def value(strategy, key):
    figure = strategy[key]
    return figure["value"] if isinstance(figure, dict) else figure


def best(scene, policy, key):
    """The ranked strategy of a policy that has the least of a figure, over the classic heuristics. Where none is ranked: one
    that is not; None where none was measured."""
    names = [policy, *(f"{policy}/{h}" for h in HEURISTICS)]
    known = [scene["strategies"][name] for name in names if name in scene["strategies"]]
    return min(filter(is_ranked, known), key=lambda s: value(s, key), default=known[0] if known else None)


def least(strategies, key):
    return min((value(s, key) for s in strategies if is_ranked(s)), default=1)


def number(x):
    """Three digits; an exponent only where there would be four zeros."""
    if not 1e-3 <= x < 1e6:
        return re.sub(r"e\+?(-?)0*", r"e\1", f"{x:.1e}") if x else "0"
    digits = 2 - int(f"{x:.2e}".split("e")[1])
    return f"{round(x, digits):.{max(0, digits)}f}"


def error_of(interval):
    """How far the 95 % interval reaches, as a share of the figure; 0 where that is not known."""
    x, low, high = interval["value"], interval["low"], interval["high"]
    return max(high / x - 1, 1 - low / x) if x and low and high else 0


def with_error(interval, scale=1):
    """'0.527 ±17 %', or both ends where they are far apart."""
    error = error_of(interval)
    if error > 0.5:
        return f"{number(scale * interval['low'])} to {number(scale * interval['high'])}"
    return number(scale * interval["value"]) + (f" ±{math.ceil(100 * error)} %" if error else "")


def times(strategy, unit):
    """How many times `unit` its relative variance is: ~ if that is known to worse than 20 %, ? if it is not resolved."""
    if not is_ranked(strategy):
        return "?" if strategy else "–"
    figure = strategy["relative_variance"]
    return ("~" if error_of(figure) > 0.2 else "") + number(figure["value"] / unit)


def times_or_doubt(strategy, unit):
    """The same, with the figure even where it is not resolved: of many draws together there are few observations."""
    if is_ranked(strategy) or strategy["status"] != "not_resolved":
        return times(strategy, unit)
    return number(strategy["relative_variance"]["value"] / unit) + "?"


def duration(strategy):
    """Time to 1 % error."""
    if not is_ranked(strategy):
        return "?" if strategy else "–"
    x, units = strategy["seconds_to_1_percent"], [(3600, "h"), (60, "min"), (1, "s"), (1e-3, "ms"), (1e-6, "µs")]
    unit, name = next((unit, name) for unit, name in units if x >= unit)
    return f"{float(f'{x / unit:.2g}'):g} {name}"


# The tables, as Markdown.


def table(head, rows):
    """The first column to the left, all others to the right."""
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, ["---"] + ["---:"] * (len(head) - 1), *rows])


def by_scene(found, head, cells):
    """A row for each scene that comes along, with a link to its complete table."""
    return table(["scene", *head], [[f"[{n}](which-light-tables.md#{n})", *cells(found[n])] for n in SAMPLES])


def policies(found):
    """The relative variance of each policy over the least of all choices of one light."""
    columns = [*CHOICES, "all", "brdf"]

    def cells(scene):
        strategies = [best(scene, policy, "relative_variance") for policy in columns]
        unit = least(strategies[: len(CHOICES)], "relative_variance")
        return [str(scene["lights"]), number(unit), *(times(s, unit) for s in strategies)]

    return by_scene(found, ["lights", "1 is", *columns], cells)


def ways(found):
    """The relative variance of `product` by the ways to draw and to weigh, over that of `product/power`."""
    columns = ["light", "balance", "cutoff", "maximum", "light/projected", "power/projected", "light/union", "power/union"]

    def cells(scene):
        unit = value(scene["strategies"]["product/power"], "relative_variance")
        return [number(unit), *(times(scene["strategies"][f"product/{way}"], unit) for way in columns)]

    return by_scene(found, ["1 is", *columns], cells)


def together(found):
    """The relative variance per draw of so many draws together, over that of `product/balance`."""

    def cells(name):
        strategies = found[f"{name}-together"]["strategies"]
        unit = value(strategies[TOGETHER[0]], "relative_variance")
        return [number(unit), *(times_or_doubt(strategies[s], unit) for s in TOGETHER[1:])]

    rows = [[f"[{n}](which-light-tables.md#{n})", str(found[n]["lights"]), *cells(n)] for n in SAMPLES]
    return table(["scene", "lights", "1 is", *TOGETHER[1:]], rows)


def seconds(found):
    """Time to 1 % error by the soonest strategy of each policy, and of all that draw one light."""
    key, columns = "seconds_to_1_percent", [*CHOICES, "all"]

    def cells(scene):
        one = [s for s in scene["strategies"].values() if is_ranked(s) and s["policy"] in CHOICES]
        soonest = [f"`{s['name']}`, {duration(s)}" for s in sorted(one, key=lambda s: s[key])]
        return [*(duration(best(scene, policy, key)) for policy in columns), *(soonest[:1] or "?")]

    return by_scene(found, [*columns, "the soonest by one light"], cells)


FIGURES = ["relative variance", "µs per point", "ns per sample", "rays per sample", "to 1 %"]


def figures_of(s):
    """What every complete table says of a strategy."""
    variance = with_error(s["relative_variance"]) if is_ranked(s) else s["status"].replace("_", " ")
    costs = with_error(s["seconds_per_point"], 1e6), with_error(s["seconds_per_sample"], 1e9)
    return [variance, *costs, number(s["rays_per_sample"]), duration(s)]


def scaling(found):
    """The figures of random lights, and the efficiency at 16 samples per point over that of the first strategy."""
    rows = []
    for scene in (found[name] for name in found if name.startswith("random-")):
        first, *_ = strategies = list(scene["strategies"].values())
        for s in strategies:
            gain = number(value(s, "efficiency") / value(first, "efficiency")) if is_ranked(s) else "?"
            rows.append([str(scene["lights"]), f"`{s['name']}`", *figures_of(s), gain])
    return table(["lights", "strategy", *FIGURES, "efficiency, times"], rows)


def origin(found):
    """Where and when it was measured, and the command of one scene."""
    scene, minutes = found["lecture"], sum(scene["seconds"] for scene in found.values()) / 60
    where = f"{scene['machine']}, {scene['threads']} threads, {scene['instruction_set']}; mis {scene['version']}"
    command = re.sub(" --quiet --json .*", "", scene["command"])
    return f"{where}; {scene['date']}, in {minutes:.1f} minutes; seed {scene['seed']}.\n\n```sh\n{command}\n```"


def lamps(found):
    """Relative variances that are known without a sample."""
    columns = list(next(iter(found.lamps.values())))

    def cells(figures):
        return [number(figures[name]) if name in figures else "–" for name in columns]

    return table(["scene", *columns], [[what, *cells(figures)] for what, figures in found.lamps.items()])


TABLES = [policies, ways, together, seconds, scaling, lamps, origin]
COMPLETE = """# Which light: the complete tables

By `./do which-light`; [which-light.md](which-light.md) says what they show and how they were made,
[report-format.md](report-format.md) what each figure is. Strategies stand in the order of their rank by variance; what is not
resolved has no rank. Variances are of one sample, the efficiency is at 16 samples per point, ± is a 95 % interval."""


def complete(name, scene):
    """All strategies of a scene by their ranks, and what mis says of them."""
    rows = []
    for s in sorted(scene["strategies"].values(), key=lambda s: s["rank"] or math.inf):
        place = ["–", "–", "–"]
        if is_ranked(s):
            ranks = sorted({s["rank_low"], s["rank_high"]})
            efficiency = "infinite" if s["exact"] else number(value(s, "efficiency"))
            place = ["–".join(map(str, ranks)), with_error(s["variance"]), efficiency]
        rows.append([f"`{s['name']}`", *place, *figures_of(s)])
    ranking = table(["strategy", "rank", "variance", "efficiency", *FIGURES], rows)
    pixels = "{} × {} pixels".format(*scene["resolution"])
    size = f"{pixels}, {scene['shading_points']} points, {scene['samples']} samples of each; lights: {scene['lights']}"
    return "\n\n".join([f"## {name}", size, ranking, *scene["sentences"][:3]])


# The pictures, as SVG.

STYLE = (
    "text{font:11px sans-serif;fill:#7d8590}.t{font-weight:bold}.l{text-anchor:end}.a{text-anchor:middle}"
    "rect{fill:#4a90d9}path{stroke:#c77d2e;stroke-width:2}.g{stroke:#7d8590;stroke-width:.4}"
)


def bars(panels, key):
    """Panels of bars from 1, the least of each, on one logarithmic axis, with a line for the 95 % interval.
    panels: title → label → strategy; one that is not ranked gets a question mark."""
    units = [least(rows.values(), key) for rows in panels.values()]
    most = max(value(s, key) / u for u, rows in zip(units, panels.values()) for s in rows.values() if is_ranked(s))
    decades, height = max(1, math.ceil(math.log10(1.2 * most))), 15 * max(map(len, panels.values())) + 48

    def x_at(ratio):
        return round(118 + 220 * math.log10(max(ratio, 1)) / decades, 1)

    parts = []
    for i, ((title, rows), unit) in enumerate(zip(panels.items(), units)):
        parts.append(f'<g transform="translate({i % 2 * 400} {i // 2 * height})">')
        parts.append(f'<text class="t" x="118" y="14">{title}</text>')
        for x, label in [(x_at(10**d), ["1", "10", "100", "1000", "10⁴", "10⁵", "10⁶"][d]) for d in range(decades + 1)]:
            parts.append(f'<path class="g" d="M{x} 20v{height - 46}"/>')
            parts.append(f'<text class="a" x="{x}" y="{height - 14}">{label}</text>')
        for y, (label, s) in zip(range(22, height, 15), rows.items()):
            parts.append(f'<text class="l" x="112" y="{y + 9}">{label}</text>' + bar(s, key, unit, x_at, y))
        parts.append("</g>")
    box = f"0 0 800 {height * ((len(panels) + 1) // 2)}"
    head = f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}"><style>{STYLE}</style>'
    return "\n".join([head, *parts, "</svg>"]) + "\n"


def bar(strategy, key, unit, x_at, y):
    if not is_ranked(strategy):
        return f'<text x="122" y="{y + 9}">?</text>'
    figure = strategy.get(f"{key}_interval", strategy[key])
    x, low, high = (x_at((figure[end] or figure["value"]) / unit) for end in ("value", "low", "high"))
    drawn = f'<rect x="117" y="{y}" width="{x - 116:.1f}" height="10"/><path d="M{low} {y + 5}H{high}"/>'
    return drawn + f'<text x="{high + 5:.1f}" y="{y + 9}">{number(figure["value"] / unit)}</text>'


def pictures(found):
    """File name → SVG."""
    variance, time = "relative_variance", "seconds_to_1_percent"
    choices = {name: {choice: best(found[name], choice, variance) for choice in CHOICES} for name in SAMPLES}
    lamps = {f"{scene['lights']} lamps": scene["strategies"] for name, scene in found.items() if name.startswith("random-")}
    return {"which-light-samples.svg": bars(choices, variance), "which-light-lamps.svg": bars(lamps, time)}


# The page.


def broken_claims(page, found):
    """What the page claims in `<!-- holds … -->` and the figures do not bear out. Lines of such a comment are like

        veach product/light: not_resolved
        street relative_variance irradiance / product: 5 to 8

    A policy's name stands for the best of its classic strategies, a number for itself."""
    for block in re.findall(r"<!-- holds\n(.*?)-->", page, re.S):
        for claim in block.splitlines():
            (scene, *words), expected = claim.split(": ")[0].split(), claim.split(": ")[1]
            if scene == "lamps":
                if not is_lamps(found.lamps, claim):
                    yield claim
            elif scene in found and not (is_status if len(words) == 1 else is_ratio)(found[scene], words, expected):
                yield claim


def is_status(scene, words, expected):
    return scene["strategies"][words[0]]["status"] == expected


def is_ratio(scene, words, expected):
    """Is `KEY A / B` in `LOW to HIGH`?"""
    key, *names = words[0], words[1], words[3]
    strategies = [scene["strategies"].get(name) or best(scene, name, key) for name in names]
    above, below = [float(n) if n[0].isdigit() else is_ranked(s) and value(s, key) for n, s in zip(names, strategies)]
    low, high = map(float, expected.split(" to "))
    return above and below and low <= above / below <= high


def is_lamps(known, claim):
    """Like `lamps WHAT: A / B: LOW to HIGH`; a number stands for itself."""
    what, ratio, expected = claim.removeprefix("lamps ").split(": ")
    above, below = [float(n) if n[0].isdigit() else known[what][n] for n in ratio.split(" / ")]
    low, high = map(float, expected.split(" to "))
    return low <= above / below <= high


def write(file, text):
    """Whole or not at all."""
    unfinished = file.with_name(f".{file.name}.part")
    unfinished.write_text(text)
    os.replace(unfinished, file)


def rewritten(page, found):
    """The page, its marked sections made anew."""
    for make in TABLES:
        mark = rf"(<!-- table: {make.__name__} -->\n).*?(<!-- end -->)"
        page, count = re.subn(mark, lambda m: f"{m[1]}\n{make(found)}\n\n{m[2]}", page, flags=re.S)
        if count != 1:
            sys.exit(f"which_light.py: found {count} places for the table {make.__name__}; the page has one of each")
    return page


def publish(found, into):
    """Writes pages and pictures; returns the page."""
    page = rewritten((ROOT / "docs" / "which-light.md").read_text(), found)
    (into / "images").mkdir(parents=True, exist_ok=True)
    for name, picture in pictures(found).items():
        write(into / "images" / name, picture)
    write(into / "which-light-tables.md", "\n\n".join([COMPLETE, *(complete(n, found[n]) for n in SAMPLES)]) + "\n")
    write(into / "which-light.md", page)
    return page


def main():
    parser = argparse.ArgumentParser(description="The tables and pictures of docs/which-light.md, in some fifteen minutes.")
    parser.add_argument("--quick", action="store_true", help="rough figures, soon; the page goes to build/which-light-quick")
    parser.add_argument("--from", dest="reports", type=pathlib.Path, metavar="FOLDER", help="measure nothing, read reports")
    parser.add_argument("--into", type=pathlib.Path, metavar="FOLDER", help="where the pages go (docs)")
    parser.add_argument("--mis", default=ROOT / "build/release/bin/mis", help="the program (build/release/bin/mis)")
    options = parser.parse_args()
    work = ROOT / "build" / ("which-light-quick" if options.quick else "which-light")
    folder = (options.reports or work).resolve()
    runs = runs_for(folder, options.quick)
    try:
        if not options.reports:
            measure(options.mis, runs, folder)
            predict_lamps(options.mis, lamps_for(options.quick), folder)
        found = Found(read(runs, folder), read_lamps(lamps_for(options.quick), folder))
    except (OSError, subprocess.CalledProcessError) as error:
        sys.exit(f"which_light.py: {error}")
    page = publish(found, options.into or (work if options.quick else ROOT / "docs"))
    broken = [] if options.quick else list(broken_claims(page, found))
    for claim in broken:
        print(f"which_light.py: the page says what the figures do not: {claim}", file=sys.stderr)
    sys.exit(bool(broken))


if __name__ == "__main__":
    main()
