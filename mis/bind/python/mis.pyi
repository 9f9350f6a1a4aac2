"""Direct lighting from many spheres, and which light-choice strategy to use for it.

A strategy's name is ``policy/heuristic[/union|/projected][/one-sample][@l+b]``, as in ``solid-angle/power``, or one of
``brdf``, ``cosine``, ``hemisphere``. Lengths are in scene units, radiance in W/(sr m²), linear RGB; luminance is Rec. 709's.
All arrays stand over the memory of the run or of the scene that made them: nothing is copied. What takes time lets other
Python threads run. What is wrong with an argument is a ``ValueError`` with the message of the command line.
"""

import os
from typing import Any, Sequence, overload

import numpy as np
from numpy.typing import NDArray

__version__: str

class SceneError(ValueError):
    """A scene that cannot be used: where, what was found, what is allowed."""

class StrategyError(ValueError):
    """A strategy that has no meaning, or a name that is not known."""

class PredictError(ValueError):
    """A scene that quadrature cannot answer for: a mesh or quad could hide a light from a probe."""

class Scene:
    """A scene made ready to be lit; it never changes."""

    @overload
    def __init__(
        self,
        source: dict[str, Any],
        *,
        resolution: tuple[int, int] | None = None,
        folder: str | os.PathLike[str] = ".",
    ) -> None: ...
    @overload
    def __init__(
        self, source: str | os.PathLike[str], *, resolution: tuple[int, int] | None = None
    ) -> None: ...
    @property
    def name(self) -> str: ...
    @property
    def resolution(self) -> list[int] | None:
        """[width, height], pixels; None without a camera."""
    @property
    def probes(self) -> int:
        """How many it has."""
    @property
    def light_centers(self) -> NDArray[np.float64]:
        """(lights, 3), scene units; a read-only view."""
    @property
    def light_radii(self) -> NDArray[np.float64]:
        """(lights,), scene units; a read-only view."""
    @property
    def light_radiance(self) -> NDArray[np.float64]:
        """(lights, 3), RGB, W/(sr m²)."""

class Picture:
    """What render() gives: arrays over the run's own memory."""

    @property
    def radiance(self) -> NDArray[np.float32]:
        """(height, width, 3), linear RGB, W/(sr m²), from the top."""
    @property
    def variance(self) -> NDArray[np.float64]:
        """(height, width): of one sample's luminance; NaN where a pixel shows no surface, or for one sample per pixel."""
    @property
    def invalid(self) -> int:
        """Samples that were not finite; they count as 0."""

def render(
    scene: Scene,
    strategy: str,
    spp: int = 64,
    *,
    seed: int = 1,
    sampler: str = "independent",
    threads: int = 0,
) -> Picture:
    """The picture of a scene by one strategy, `spp` samples at every pixel. sampler: "independent" or "sobol"."""

def samples(
    scene: Scene,
    strategy: str,
    count: int,
    *,
    probe: int | None = None,
    pixel: tuple[int, int] | None = None,
    first: int = 0,
    seed: int = 1,
    sampler: str = "independent",
    threads: int = 0,
) -> NDArray[np.float64]:
    """Luminances (count,) of samples [first, first + count) at a probe (the first one), or at a pixel (column, row)."""

def compare(
    scene: Scene,
    strategies: Sequence[str],
    *,
    spp: int | None = None,
    seconds: float | None = None,
    error: float | None = None,
    at: float = 16.0,
    seed: int = 1,
    sampler: str = "independent",
    threads: int = 0,
) -> dict[str, Any]:
    """Ranks strategies: mis-report/1. Until it is decided which to use or 30 s, or as far as `spp`, `seconds` or `error` says. sampler: "sobol" measures
    variances over scramblings of `at` samples each."""

def predict(
    scene: Scene, strategies: Sequence[str], *, threads: int = 0
) -> dict[str, NDArray[np.float64]]:
    """Exact figures at the probes, (probes, strategies): "mean", "variance", "fourth" (central moments), and "…_error"."""

def policies() -> list[str]:
    """Names of all policies."""

def heuristics() -> list[str]:
    """Names of all heuristics."""

def techniques() -> list[str]:
    """Names of all techniques."""
