#!/usr/bin/python3
"""The figures of the lecture that asked mis's question (J.C. Iehl, "Intégration numérique et Monte Carlo", 2012).

    PYTHONPATH=build/release/python python3 docs/lecture_figures.py [FOLDER] [--scene FILE]

Reads like a notebook: a question of the lecture, what mis says to it, a picture. The pictures go to FOLDER (.). Needs
NumPy and, to draw, matplotlib (./do setup python).
"""

import argparse
import os
import pathlib
import sys

import numpy as np

import mis

SCENE = pathlib.Path(__file__).resolve().parents[1] / "scenes" / "lecture.json"


# 1. ∫ cosθ dω = π, by directions uniform on the hemisphere, and by directions ∝ cosθ.


def cosine_estimates(count, seed=1):
    """Running estimates of the integral after 1 … count draws, by name of the density."""
    u = np.random.default_rng(seed).random(count)
    n = np.arange(1, count + 1)
    uniform = 2 * np.pi * u  # cosθ = u; value over density 1/2π
    cosine = np.full(count, np.pi)  # cosθ over cosθ/π: every draw says π
    theta = np.pi / 2 * u  # regular in θ: density 1/(π² sinθ)
    return {
        "pdf = 1/2π": np.cumsum(uniform) / n,
        "pdf = cosθ/π": np.cumsum(cosine) / n,
        "θ regular, taken for uniform": np.cumsum(2 * np.pi * np.cos(theta)) / n,
        "θ regular, with its density": np.cumsum(np.cos(theta) * np.pi**2 * np.sin(theta)) / n,
    }


def draw_cosine(plt):
    figure, axes = plt.subplots(figsize=(7, 4.2))
    for name, estimate in cosine_estimates(10_000).items():
        axes.semilogx(np.arange(1, len(estimate) + 1), estimate, label=name)
    axes.axhline(np.pi, color="black", linewidth=0.8, linestyle=":")
    axes.set(xlabel="N directions", ylabel="estimate", ylim=(2, 5), title="∫ cosθ dω = π")
    axes.legend()
    return figure


# 2. Which directions are uniform? Regular in (θ, φ) they crowd around the normal.


def directions(count, seed=1):
    """Unit vectors (count, 3), z the normal, by name of how they are drawn."""
    u = np.random.default_rng(seed).random((count, 2))
    phi = 2 * np.pi * u[:, 1]

    def at(cos_theta):
        sin_theta = np.sqrt(1 - cos_theta**2)
        return np.stack([sin_theta * np.cos(phi), sin_theta * np.sin(phi), cos_theta], axis=1)

    return {
        "regular in θ and φ": at(np.cos(np.pi / 2 * u[:, 0])),
        "uniform: cosθ = u": at(u[:, 0]),
        "∝ cosθ: cosθ = √u": at(np.sqrt(u[:, 0])),
    }


def draw_directions(plt):
    figure, axes = plt.subplots(1, 3, figsize=(10, 3.7))
    for place, (name, w) in zip(axes, directions(1500).items()):
        # Equal areas of this picture are equal solid angles: r² = 1 − cosθ.
        r = np.sqrt(1 / (1 + w[:, 2]))
        place.scatter(w[:, 0] * r, w[:, 1] * r, s=2)
        place.add_patch(plt.Circle((0, 0), 1, fill=False, linewidth=0.8))
        place.set(aspect="equal", title=name, xlim=(-1.05, 1.05), ylim=(-1.05, 1.05))
        place.axis("off")
    figure.tight_layout(rect=(0, 0, 1, 0.95))
    figure.suptitle("the hemisphere from above, in equal areas")
    return figure


# 3. How is one of several values drawn? By inverting the distribution function: here of the lights, by power.


def light_powers(scene):
    """Φ ∝ luminance of 4π² r² L, as probabilities (lights,)."""
    power = (scene.light_radiance @ [0.2126, 0.7152, 0.0722]) * scene.light_radii**2
    return power / power.sum()


def draw_inversion(plt, scene):
    p = light_powers(scene)
    c = np.concatenate([[0], np.cumsum(p)])
    figure, axes = plt.subplots(1, 2, figsize=(8, 3.6))
    names = [f"light {j}" for j in range(len(p))]
    axes[0].bar(names, p)
    axes[0].set(title="pdf", ylabel="P(j)")
    axes[1].step(range(len(c)), c, where="post")
    u = 0.55
    j = int(np.searchsorted(c, u, side="right")) - 1
    axes[1].annotate("", (j + 0.5, 0), (j + 0.5, u), arrowprops={"arrowstyle": "->"})
    axes[1].plot([0, j + 0.5], [u, u], linestyle="--", color="black", linewidth=0.8)
    axes[1].set(title=f"u = {u} draws light {j}", xlabel="j", ylabel="C(j), distribution function", ylim=(0, 1.02))
    figure.tight_layout()
    return figure


# 4. How fast does it converge? In O(1/√N), whatever is drawn; the strategy sets the factor.


def convergence(scene, strategies, samples=1 << 18, largest=1024):
    """N (k,), and by strategy the relative error at the last probe of the mean of N samples (k,): root of a mean square
    over samples/N runs."""
    probe = scene.probes - 1
    exact = mis.predict(scene, strategies)["mean"][probe]
    n = 2 ** np.arange(int(np.log2(largest)) + 1)
    errors = {}
    for strategy, mean in zip(strategies, exact):
        x = mis.samples(scene, strategy, samples, probe=probe)
        errors[strategy] = np.array([np.sqrt(np.mean((x.reshape(-1, k).mean(axis=1) / mean - 1) ** 2)) for k in n])
    return n, errors


def draw_convergence(plt, scene):
    figure, axes = plt.subplots(figsize=(7, 4.6))
    strategies = ["hemisphere", "cosine", "brdf", "uniform/light", "solid-angle/power", "product/balance"]
    n, errors = convergence(scene, strategies)
    for strategy, error in errors.items():
        axes.loglog(n, error, marker=".", label=strategy)
    axes.loglog(n, 4 / np.sqrt(n), color="black", linestyle=":", label="slope −½")
    axes.set(xlabel="N samples", ylabel="relative error", title="error of the estimate at one point")
    axes.legend(fontsize=8)
    return figure


# 5. On which set of directions does one work: Ω⁺, or Ω_S? And 6., with M sources: which one should be chosen?


def pictures(scene, strategies, spp):
    """By strategy: the picture, and the mean over its pixels of one sample's variance."""
    rendered = {strategy: mis.render(scene, strategy, spp) for strategy in strategies}
    return {name: (p.radiance, np.nanmean(p.variance)) for name, p in rendered.items()}


def draw_pictures(plt, scene, strategies, spp, title):
    rows = (len(strategies) + 2) // 3
    figure, axes = plt.subplots(rows, 3, figsize=(10, 2.6 * rows + 0.4), squeeze=False)
    made = pictures(scene, strategies, spp)
    white = np.percentile(next(reversed(made.values()))[0], 98)
    for place in axes.flat:
        place.axis("off")
    for place, (name, (radiance, variance)) in zip(axes.flat, made.items()):
        place.imshow(np.clip(radiance / white, 0, 1) ** (1 / 2.2))
        place.set_title(f"{name}, variance {variance:.3g}", fontsize=9)
    figure.suptitle(f"{title} ({spp} samples per pixel)")
    figure.tight_layout()
    return figure


def draw_choices(plt, scene):
    """Exact variances of one sample at the probes, relative to the mean's square."""
    policies = mis.policies()
    heuristics = ["light", "balance", "power"]
    strategies = [f"{policy}/{heuristic}" for policy in policies for heuristic in heuristics]
    found = mis.predict(scene, strategies)
    relative = (found["variance"] / found["mean"] ** 2).reshape(-1, len(policies), len(heuristics))
    figure, axes = plt.subplots(1, len(relative), figsize=(10, 4), squeeze=False)
    for p, place in enumerate(axes.flat):
        for h, heuristic in enumerate(heuristics):
            place.barh(np.arange(len(policies)) + 0.27 * (h - 1), relative[p, :, h], height=0.25, label=heuristic)
        place.set_yticks(range(len(policies)), policies)
        place.invert_yaxis()
        place.set(xscale="log", title=f"probe {p}", xlabel="variance of one sample / mean²")
    axes.flat[0].legend(title="heuristic", fontsize=8)
    figure.tight_layout()
    return figure


def draw_all(plt, folder, file, width=256, spp=4):
    """Writes every figure; returns the names."""
    scene = mis.Scene(file, resolution=(width, width * 2 // 3))
    whole = ["hemisphere", "cosine", "brdf", "uniform/light", "uniform/power", "product/balance"]
    policies = [f"{policy}/power" for policy in mis.policies()]
    figures = {
        "1-cosine": draw_cosine(plt),
        "2-directions": draw_directions(plt),
        "3-inversion": draw_inversion(plt, scene),
        "4-convergence": draw_convergence(plt, scene),
        "5-sets": draw_pictures(plt, scene, whole, spp, "Ω⁺, cosθ, the BSDF, Ω_S, and both"),
        "6-which-light": draw_pictures(plt, scene, policies, spp, "M sources: which one?"),
        "7-variance": draw_choices(plt, scene),
    }
    for name, figure in figures.items():
        unfinished = folder / f".{name}.part.png"
        figure.savefig(unfinished, dpi=110)
        os.replace(unfinished, folder / f"{name}.png")
        plt.close(figure)
    return list(figures)


def main():
    parser = argparse.ArgumentParser(description="The figures of the lecture, by mis.")
    parser.add_argument("folder", nargs="?", default=".", type=pathlib.Path, help="where the pictures go (.)")
    parser.add_argument("--scene", default=SCENE, help="a scene with a camera and probes")
    options = parser.parse_args()
    try:
        import matplotlib
    except ImportError:
        sys.exit("lecture_figures.py: found no matplotlib, which draws\n    ./do setup python installs it.")
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    if not options.folder.is_dir():
        parser.error(f"there is no folder {options.folder}")
    try:
        names = draw_all(plt, options.folder, options.scene)
    except ValueError as error:
        parser.error(str(error))
    for name in names:
        print(options.folder / f"{name}.png")


if __name__ == "__main__":
    main()
