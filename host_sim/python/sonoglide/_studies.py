"""The studies of the program, and what it makes of a scene. Options left out are the command's."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from os import PathLike, fspath
from pathlib import Path
from typing import TYPE_CHECKING, Any, Union

import numpy as np

from . import _core
from ._run import Columns
from ._scene import Scene, _key

if TYPE_CHECKING:
    import pandas

    # A file, or columns by their names.
    Measurements = Union[str, PathLike[str], Mapping[str, Any], pandas.DataFrame, np.ndarray[Any, Any]]


class Study(dict[str, Any]):
    """The content of the JSON file that the command writes.

    scene  the Scene that the command writes beside it; None where there is none
    """

    scene: Scene | None

    def __init__(self, found: str, scene: str = "", name: str = "scene") -> None:
        super().__init__(json.loads(found))
        self.scene = Scene.from_text(scene, name=name) if scene else None


def _given(**options: Any) -> dict[str, Any]:
    return {name: value for name, value in options.items() if value is not None}


def _listed(value: Any) -> str:
    text = str(value).lower() if isinstance(value, bool) else str(value)
    if not text or "," in text or ":" in text:
        raise ValueError(
            f'a value is "{text}"; allowed: numbers, words, truth values, or FROM:TO:COUNT in place of all'
        )
    return text


def _vary(key: Any, values: Any) -> str:
    if not isinstance(values, str):
        values = ",".join(map(_listed, values.tolist() if hasattr(values, "tolist") else values))
    return f"{_key(key)}={values}"


def sweep(scene: Scene, vary: Mapping[str, Any], *, threads: int = 0) -> Columns:
    """Runs a scene for every combination of the values of some keys, on several threads, while other
    threads run. -> Columns, those of sweep.csv, in its order

    vary     {"table.key": values}: numbers, words, or a text FROM:TO:COUNT or FROM:TO:COUNT:log;
             velocity_ratio is the sliding velocity over the peak vibration velocity. The first key
             changes slowest.
    threads  0: one for each core

    A point that cannot be computed has NaN, and why in the column status. Raises SceneError for a
    point that is no scene: nothing is computed then.
    """
    return Columns(_core.sweep(scene, [_vary(key, values) for key, values in vary.items()], threads))


def robust(
    scene: Scene,
    *,
    samples: int | None = None,
    search: int | None = None,
    seed: int | None = None,
    threads: int = 0,
) -> Study:
    """Runs a closed loop on many plants inside the scene's [tolerance], on several threads, and
    searches for the worst of them, as `sonoglide robust`. -> the content of robust.json; its scene is
    the worst plant

    samples  plants to draw; a power of two fills the tolerances best
    search   runs that the search for the worst plant may take; 0: no search
    seed     of the draw: the same seed, the same plants
    threads  0: one for each core
    """
    return Study(
        *_core.robust(scene, threads=threads, **_given(samples=samples, search=search, seed=seed)),
        name="worst",
    )


def design(
    scene: Scene, ratios: Sequence[float] = (), *, velocity_m_per_s: tuple[float, float] | None = None
) -> Study:
    """What force, vibration and power friction ratios take, as `sonoglide design`. -> the content of
    design.json

    ratios            friction ratios in place of the scene's targets
    velocity_m_per_s  slowest and fastest sliding velocity, in place of the scene's
    """
    return Study(_core.design(scene, list(ratios), velocity_m_per_s))


def _columns(measured: Any) -> dict[str, np.ndarray[Any, Any]]:
    names = measured.dtype.names if isinstance(measured, np.ndarray) else list(measured)
    if not names:
        raise TypeError("measurements without names; allowed: a file, or columns by their names")
    columns: dict[str, np.ndarray[Any, Any]] = {}
    for name in names:
        column = np.asarray(measured[name])
        if np.iscomplexobj(column):
            real, imaginary = (
                ("conductance_S", "susceptance_S")
                if _key(name).lower().startswith(("y", "admittance"))
                else ("resistance_ohm", "reactance_ohm")
            )
            columns |= {real: column.real, imaginary: column.imag}
        else:
            columns[_key(name)] = column
    return columns


def _measurements(measured: Measurements) -> _core.Measurements:
    if isinstance(measured, (str, PathLike)):
        with open(measured, "rb"):
            pass
        return _core.Measurements(Path(measured))
    columns = _columns(measured)
    sizes = {name: column.shape for name, column in columns.items()}
    if len(set(sizes.values())) != 1 or any(len(shape) != 1 for shape in sizes.values()):
        raise ValueError(f"columns of the shapes {sizes}; allowed: one dimension, and equally many readings")
    rows = zip(*(column.tolist() for column in columns.values()))
    lines = [",".join(columns), *(",".join(map(repr, row)) for row in rows)]
    return _core.Measurements("measurements", "\n".join(lines) + "\n")


def identify_friction(measured: Measurements, laws: Sequence[str] = ()) -> Study:
    """Fits friction laws to measured friction under vibration, as `sonoglide identify friction`.
    -> the content of identify.json; its scene is that of scene.toml

    measured  a file, or columns by their names: sliding_velocity_m_per_s, vibration_velocity_m_per_s
              or velocity_ratio, and friction_ratio or friction_force_N
    laws      words of scenes; none: all of them
    """
    return Study(*_core.identify_friction(_measurements(measured), list(laws)))


def identify_impedance(
    measured: Measurements, mass_kg: float | None = None, force_factor_N_per_V: float | None = None
) -> Study:
    """Fits the equivalent circuit of a transducer to a measured sweep of its impedance, as
    `sonoglide identify impedance`. -> the content of identify.json; its scene is that of scene.toml,
    where a mechanical fact is given

    measured              a file: a table with named columns, Touchstone .s1p, or the text of an
                          Agilent 4294A. Or columns by their names: frequency_Hz, and impedance_ohm or
                          admittance_S of complex numbers, or resistance_ohm and reactance_ohm, or
                          what else the heading of a file may name
    mass_kg               the moving mass, from which the force factor follows
    force_factor_N_per_V  the force factor, from which the moving mass follows
    """
    return Study(*_core.identify_impedance(_measurements(measured), mass_kg, force_factor_N_per_V))


def identify(kind: str, measured: Measurements, **options: Any) -> Study:
    """identify_impedance() or identify_friction(), by the word of the command.

    kind     'impedance' or 'friction'
    options  of that function
    """
    functions: dict[str, Callable[..., Study]] = {
        "impedance": identify_impedance,
        "friction": identify_friction,
    }
    if kind not in functions:
        raise ValueError(f"kind is {kind!r}; allowed: {', '.join(functions)}")
    return functions[kind](measured, **options)


def commission(device: str | PathLike[str], scene: Scene) -> Study:
    """Drives a running unit through some targets and fits the scene's plant to what it records, as
    `sonoglide commission`; friction falls meanwhile, and at the end the unit is stopped. -> the content
    of identify.json; its scene is that of commissioned.toml

    device  path of the unit's serial device; no Port may hold it meanwhile: close() it
    scene   the one that the unit's image was built from

    OSError: the device is absent or silent, the unit is that of another scene, refuses or finds a fault.
    ComputationError: its readings are those of no sliding contact. ValueError: a scene whose plant cannot
    be identified; the message has the key.
    """
    return Study(*_core.commission(fspath(device), scene), name="commissioned")


def configure(scene: Scene, plant: str | None = None) -> dict[str, str]:
    """The controller of a closed loop as a C++ header for its image, as `sonoglide configure`.
    -> {name of the header: text}

    plant  'float32' or 'q31': the plant as well, in this arithmetic, for an image that holds both
    """
    return _core.configure(scene, plant)


def fmu(scene: Scene, kind: str, path: str | PathLike[str], fmi: str | int | None = None) -> None:
    """Writes plant, controller or closed loop of a scene as an FMU for co-simulation, as
    `sonoglide fmu`.

    kind  'plant', 'controller' or 'loop'
    path  of the file, which ends in .fmu; a file there that no earlier call wrote is not replaced,
          a folder that is missing is made
    fmi   version of the interface: 3 or 2
    """
    if Path(path).suffix != ".fmu":
        raise ValueError(f"path is {str(path)!r}; allowed: a file that ends in .fmu")
    _core.fmu(scene, kind, None if fmi is None else str(fmi), Path(__file__).parent / "engine", Path(path))
