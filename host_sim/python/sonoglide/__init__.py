"""Sonoglide: scenes, their simulation, and the controller of friction that is shipped.

Numbers are in SI units, the unit in the name. Every function has its documentation:
help(sonoglide.run).
"""

from ._core import (
    ComputationError,
    Loop,
    Run,
    Scene,
    SceneError,
    Unit,
    friction_ratio,
    identify_friction,
    identify_impedance,
    limits,
    rollout,
    run,
    settlings,
    states,
    sweep,
)

__all__ = [
    "ComputationError",
    "Loop",
    "Run",
    "Scene",
    "SceneError",
    "Unit",
    "friction_ratio",
    "identify_friction",
    "identify_impedance",
    "limits",
    "rollout",
    "run",
    "settlings",
    "states",
    "sweep",
]
