"""The controller, alone and in its loop, one carrier period at a time."""

from __future__ import annotations

from typing import Any

from . import _core, _html
from ._scene import Scene


class Unit(_core.Unit):
    """The controller of a scene as it is shipped: the control loop of the firmware image, codes in,
    codes out. Codes are left-justified integers of 32 bits: 2**31 is full scale. Copies and pickles
    go on from where it is, bit for bit; a pickle serves the same build of the module. One thread at a
    time may use a unit.

    scene       in closed loop; its first target is set
    arithmetic  'float64', 'float32', 'q31' or 'q15'; None: the scene's
    """

    scene: Scene

    def __init__(self, scene: Scene, arithmetic: str | None = None) -> None:
        self.scene = scene.replace({"controller.arithmetic": arithmetic}) if arithmetic else scene
        super().__init__(self.scene)

    def __getstate__(self) -> tuple[Any, ...]:
        return self.scene, self.save()

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        scene, saved = state
        Unit.__init__(self, scene)
        self.restore(saved)

    def _facts(self) -> dict[str, Any]:
        scales = ("force_full_scale_N", "velocity_full_scale_m_per_s", "amplitude_full_scale_N")
        return {
            "arithmetic": self.scene.values["controller"]["arithmetic"],
            "target": self.target,
            **{name: getattr(self, name) for name in scales},
            **self.answer,
        }

    def __repr__(self) -> str:
        facts = self._facts()
        return f"<sonoglide.Unit of {self.scene.name} in {facts['arithmetic']}: {facts['state']}, target {self.target:g}>"

    def _repr_html_(self) -> str:
        return _html.fields(f"Unit of {self.scene.name}", self._facts())


class Loop(_core.Loop):
    """A closed loop stepped from outside, one carrier period at a time: plant, sensor, controller and
    actuator of a scene, joined as in run(). It has the shape of a task of Gymnasium, which it does not
    need; sonoglide.gymnasium.Loop is one. Copies and pickles go on from where it is, bit for bit; a
    pickle serves the same build of the module.
    """

    scene: Scene

    def __init__(self, scene: Scene) -> None:
        self.scene = scene
        super().__init__(scene)

    def __getstate__(self) -> tuple[Any, ...]:
        return self.scene, self.seed, self.save()

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        scene, seed, saved = state
        Loop.__init__(self, scene)
        self.reset(seed)
        self.restore(saved)

    def _facts(self) -> dict[str, Any]:
        observed = self.observe()
        return {**observed[1], **dict(zip(self.observation_names, observed[0].tolist()))}

    def __repr__(self) -> str:
        facts = self._facts()
        return (
            f"<sonoglide.Loop of {self.scene.name}: {facts['state']} at {facts['time_s']:g} s,"
            f" friction ratio {facts['friction_ratio']:.4g}>"
        )

    def _repr_html_(self) -> str:
        return _html.fields(f"Loop of {self.scene.name}", self._facts())
