"""Sonoglide: scenes, their simulation, and the controller of friction that is shipped.

Numbers are in SI units, the unit in the name. Every function has its documentation:
help(sonoglide.run).
"""

from ._control import Loop, Unit
from ._core import ComputationError, SceneError, limits, settlings, states
from ._core import version as __version__
from ._port import Port
from ._run import Columns, Run, friction_ratio, rollout, run
from ._scene import Scene, notebooks, scenes
from ._studies import (
    Study,
    commission,
    configure,
    design,
    fmu,
    identify,
    identify_friction,
    identify_impedance,
    robust,
    sweep,
)

__all__ = [
    "Columns",
    "ComputationError",
    "Loop",
    "Port",
    "Run",
    "Scene",
    "SceneError",
    "Study",
    "Unit",
    "__version__",
    "commission",
    "configure",
    "design",
    "fmu",
    "friction_ratio",
    "identify",
    "identify_friction",
    "identify_impedance",
    "limits",
    "notebooks",
    "robust",
    "rollout",
    "run",
    "scenes",
    "settlings",
    "states",
    "sweep",
]
