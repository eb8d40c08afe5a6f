"""Simulated scenes."""

from __future__ import annotations

import json
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _core, _html
from ._scene import Scene

if TYPE_CHECKING:
    import matplotlib.figure
    import pandas

_words = {"state": _core.states, "limit": _core.limits, "settling": _core.settlings}


class Columns(dict[str, Any]):
    """{name: column}, a table in memory, the unit in the name."""

    def frame(self) -> pandas.DataFrame:
        """As a pandas.DataFrame. States, limits and settlings are in words, as in periods.csv."""
        try:
            import pandas
        except ImportError as error:
            raise ImportError("frame() needs pandas: apt install python3-pandas") from error

        def column(name: str, values: Any) -> Any:
            numbered = name in _words and isinstance(values, np.ndarray)
            return np.array(_words[name], dtype=object)[values] if numbered else values

        return pandas.DataFrame({name: column(name, values) for name, values in self.items()})


class Run:
    """What a simulated scene comes to.

    scene    the scene
    summary  the content of summary.json, as `sonoglide run` writes it: every figure, and the scene
             with its defaults. A figure that is not defined is None.
    periods  Columns, a value for each carrier period: those of periods.csv and more. Empty if
             run.record of the scene is absent. Read-only. state, limit and settling are places in
             states, limits and settlings; periods.frame() has the words.
    trace    Columns, the recorded channels at multiples of run.record_interval_s, as in trace.csv.
             Read-only.
    """

    def __init__(self, scene: Scene, summary: dict[str, Any], periods: Columns, trace: Columns) -> None:
        self.scene = scene
        self.summary = summary
        self.periods = periods
        self.trace = trace
        for column in (*periods.values(), *trace.values()):
            column.setflags(write=False)

    def __reduce__(self) -> tuple[Any, ...]:
        return Run, (self.scene, self.summary, self.periods, self.trace)

    @property
    def trace_hash(self) -> str | None:
        """Of every drive command, bit for bit: that of `sonoglide run`. None in open loop."""
        control = self.summary.get("control")
        return control["trace_hash"] if control else None

    def plot(self) -> matplotlib.figure.Figure:
        """Friction ratio or force, target and drive amplitude over time, by matplotlib."""
        try:
            from matplotlib import pyplot
        except ImportError as error:
            raise ImportError("plot() needs matplotlib: apt install python3-matplotlib") from error
        periods = self.periods
        if len(periods["time_s"]) == 0:
            raise ValueError(
                "nothing was recorded; required: run.record and run.record_interval_s of the scene, as in "
                'scene.replace({"run.record": ["displacement_m"], "run.record_interval_s": 1e-6})'
            )
        figure, (ratio, drive) = pyplot.subplots(2, sharex=True, height_ratios=(2, 1))
        time_ms = periods["time_s"] * 1e3
        of_force = "target_force_N" in periods
        held = "friction force [N]" if of_force else "friction ratio"
        ratio.plot(time_ms, periods["friction_force_N" if of_force else "friction_ratio"], label=held)
        if self.trace_hash is not None:
            ratio.plot(time_ms, periods["target_force_N" if of_force else "target"], "--", label="target")
        ratio.set_ylabel(held)
        ratio.legend()
        unit = "V" if "drive_amplitude_V" in periods else "N"
        amplitude = periods[f"drive_amplitude_{unit}"]
        if self.scene.values.get("drive", {}).get("interpolation") == "linear":
            ends_ms = np.append(time_ms, self.scene.values["run"]["duration_s"] * 1e3)
            drive.plot(ends_ms, np.append(0.0, amplitude))
        else:
            drive.step(time_ms, amplitude, where="post")
        drive.set_ylabel(f"drive amplitude [{unit}]")
        drive.set_xlabel("time [ms]")
        figure.suptitle(self.scene.name)
        return figure

    def __repr__(self) -> str:
        ratio = self.summary["friction_ratio"]["window"]
        text = f"<sonoglide.Run of {self.scene.name}: friction ratio {_html.shown(ratio)}"
        if self.trace_hash is None:
            return text + ">"
        control = self.summary["control"]
        if "texture_periods" in control:
            return f"{text}, {control['texture_periods']} periods of a texture, trace {self.trace_hash}>"
        steps = control["steps"]
        settled = sum(step["settling_time_s"] is not None for step in steps)
        return f"{text}, {settled} of {len(steps)} steps settled, trace {self.trace_hash}>"

    def _repr_html_(self) -> str:
        title = f"Run of {self.scene.name}"
        facts = _html.fields(
            title, {f"friction ratio, {name}": ratio for name, ratio in self.summary["friction_ratio"].items()}
        )
        if self.trace_hash is None:
            return facts
        control = self.summary["control"]
        faults = ", ".join(map(str, control["faults"])) or "none"
        if "texture" in control:
            names = tuple(control["texture"][-1]) if control["texture"] else ("harmonic",)
            harmonics = [[each.get(name) for name in names] for each in control["texture"]]
            return facts + _html.table(f"Texture; faults: {faults}", names, harmonics)
        held = ("target_force_N", "steady_error_N", "ripple_N")
        if not control["steps"] or held[0] not in control["steps"][0]:
            held = ("target", "steady_error", "ripple")
        names = ("time_s", held[0], "settling_time_s", held[1], held[2], "limit")
        steps = [[step.get(name) for name in names] for step in control["steps"]]
        return facts + _html.table(f"Steps; faults: {faults}", names, steps)


def run(scene: Scene) -> Run:
    """Simulates a scene, in closed loop if it has a controller. Other threads run meanwhile. Raises
    ComputationError where the solver fails."""
    summary, periods, trace = _core.run(scene)
    return Run(scene, json.loads(summary), Columns(periods), Columns(trace))


def rollout(
    scenes: Scene | Iterable[Scene],
    targets: ArrayLike | None = None,
    *,
    out: NDArray[np.float64] | None = None,
    threads: int = 0,
) -> NDArray[np.float64]:
    """Runs many scenes, or one scene with many courses of its target, on several threads, while other
    threads run. -> the friction ratio of each carrier period, a row for each rollout

    scenes   a Scene, or several that last equally many carrier periods. Closed loops that the scene's
             solver.tolerance of 1e-6 or more allows run in SIMD lanes.
    targets  a row for each rollout, a target friction ratio for each carrier period, 0 to 1; 0: as
             before, and until the first other one the steps of the scene. None: those. The controller
             is given it at the end of the carrier period: a step of the scene at the beginning of
             period k is in column k - 1
    out      float64 array that takes the ratios; None: a new one
    threads  0: one for each core

    A row does not depend on the number of threads, to the bit. Raises ComputationError where a solver
    fails; the content of out is then of no use.
    """
    if isinstance(scenes, _core.Scene):
        scenes = [scenes] * (len(targets) if np.ndim(targets) == 2 else 1)  # type: ignore[arg-type]
    return _core.rollout(tuple(scenes), targets, out, threads)


def friction_ratio(velocity_ratio: ArrayLike, dahl_number: ArrayLike) -> Any:
    """Friction ratio mean(F)/Fc of a contact under sinusoidal tangential vibration, in closed form;
    numbers or arrays, which are broadcast.

    velocity_ratio  sliding velocity over peak vibration velocity, Vt / v [-]
    dahl_number     Kt X / Fc [-], 1e-12 to 1e12; inf is a Coulomb contact, whose ratio is
                    (2/pi) asin r
    """
    np.broadcast(velocity_ratio, dahl_number)  # ValueError where the shapes do not fit
    return _core.friction_ratio(velocity_ratio, dahl_number)
