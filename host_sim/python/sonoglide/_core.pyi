# Types of the compiled part; its documentation has the units. mypy's stubtest holds both together.
from collections.abc import Iterable, Mapping, Sequence
from os import PathLike
from typing import Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

class SceneError(ValueError):
    file: str
    line: int
    column: int
    key: str
    reason: str

class ComputationError(ArithmeticError): ...

class Scene:
    def __init__(self, path: str | PathLike[str], overrides: Mapping[str, Any] = {}) -> None: ...
    @staticmethod
    def from_text(text: str, overrides: Mapping[str, Any] = {}, name: str = "scene") -> Scene: ...
    def replace(self, overrides: Mapping[str, Any]) -> Scene: ...
    @property
    def name(self) -> str: ...
    @property
    def values(self) -> dict[str, dict[str, Any]]: ...
    @property
    def toml(self) -> str: ...
    def __copy__(self) -> Scene: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> Scene: ...

class Run:
    @property
    def summary(self) -> dict[str, Any]: ...
    @property
    def trace_hash(self) -> str | None: ...
    @property
    def periods(self) -> dict[str, NDArray[Any]]: ...
    @property
    def trace(self) -> dict[str, NDArray[np.float64]]: ...

def run(scene: Scene) -> Run: ...
def friction_ratio(velocity_ratio: ArrayLike, dahl_number: ArrayLike) -> Any: ...

states: tuple[str, ...]
limits: tuple[str, ...]
settlings: tuple[str, ...]

class Loop:
    observation_names: ClassVar[list[str]]
    def __init__(self, scene: Scene) -> None: ...
    def reset(
        self, seed: int | None = None, options: Any = None
    ) -> tuple[NDArray[np.float64], dict[str, Any]]: ...
    def step(
        self, target: float | None = None
    ) -> tuple[NDArray[np.float64], float, bool, bool, dict[str, Any]]: ...
    @property
    def trace_hash(self) -> str: ...
    def __copy__(self) -> Loop: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> Loop: ...

class Unit:
    def __init__(self, scene: Scene, arithmetic: str | None = None) -> None: ...
    def step(
        self,
        force_code: int,
        velocity_code: int,
        in_phase_code: int | None = None,
        quadrature_code: int | None = None,
        *,
        fresh: bool = True,
        force_at_rail: bool = False,
        velocity_at_rail: bool = False,
    ) -> int: ...
    def steps(
        self,
        force_codes: NDArray[np.int32],
        velocity_codes: NDArray[np.int32],
        in_phase_codes: NDArray[np.int32] | None = None,
        quadrature_codes: NDArray[np.int32] | None = None,
        *,
        out: NDArray[np.int32] | None = None,
    ) -> NDArray[np.int32]: ...
    @property
    def answer(self) -> dict[str, Any]: ...
    target: float
    @property
    def force_full_scale_N(self) -> float: ...
    @property
    def velocity_full_scale_m_per_s(self) -> float: ...
    @property
    def amplitude_full_scale_N(self) -> float: ...
    def __copy__(self) -> Unit: ...
    def __deepcopy__(self, memo: dict[int, Any]) -> Unit: ...

def rollout(
    scenes: Scene | Iterable[Scene],
    targets: ArrayLike | None = None,
    *,
    out: NDArray[np.float64] | None = None,
    threads: int = 0,
) -> NDArray[np.float64]: ...
def sweep(
    scene: Scene, vary: Mapping[str, Any], *, threads: int = 0
) -> dict[str, NDArray[np.float64] | list[str]]: ...
def identify_friction(
    path: str | PathLike[str], laws: Sequence[str] = []
) -> dict[str, Any]: ...
def identify_impedance(
    path: str | PathLike[str],
    mass_kg: float | None = None,
    force_factor_N_per_V: float | None = None,
) -> dict[str, Any]: ...
