"""A closed loop as an environment of Gymnasium: gymnasium.make("sonoglide/Loop-v0").

Where the package was installed by pip, Gymnasium finds it; else `import sonoglide.gymnasium` first.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

try:
    import gymnasium
except ImportError as error:
    raise ImportError("sonoglide.gymnasium needs Gymnasium: pip install gymnasium") from error

from . import _control
from ._scene import Scene, scenes

ENVIRONMENT = "sonoglide/Loop-v0"


class Loop(gymnasium.Env[NDArray[np.float32], NDArray[np.float32]]):
    """A controller of friction whose target a policy sets, one carrier period a step.

    scene  in closed loop; None: the example target_step.toml. An episode is as long as the scene.

    action       the target that the controller is given, over the highest that it takes, in [0, 1]: that
                 is a friction ratio of 1, or the force that the sensor reads at most; what is below
                 least_target counts as that
    observation  observation_names, each over its full scale and kept inside its bounds
    reward       1 - |what is held - what is wanted|, the first two of the observation
    terminated   a fault has switched the drive off
    truncated    the scene is over
    info         as sonoglide.Loop.step() has it

    reset(seed=...) decides the sensor's noise of this episode and of those that follow.
    """

    metadata: dict[str, Any] = {"render_modes": []}
    least_target = 1e-3
    observation_names: tuple[str, ...] = (
        "friction_ratio",  # mean of the period; -2 to 2
        "wanted_ratio",  # that the scene wanted of it; 0 to 1
        "coming_ratio",  # that it wants of the next one; 0 to 1
        "drive_amplitude",  # over the actuator's limit; 0 to 1
        "sliding_velocity",  # over the controller's full scale, as those below; -1 to 1
        "displacement",
        "velocity",
        "friction_force",
    )

    def __init__(self, scene: Scene | None = None) -> None:
        self.scene = scene or Scene(scenes / "target_step.toml")
        self._loop = _control.Loop(self.scene)
        unit = _control.Unit(self.scene)
        velocity = unit.velocity_full_scale_m_per_s
        omega = 2.0 * np.pi * self.scene.values["drive"]["frequency_Hz"]
        if self._loop.holds_force:
            targets = "friction_force_along_sliding", "wanted_force", "coming_force"
            self.observation_names = (*targets, *self.observation_names[3:])
        # In the order of sonoglide.Loop.observation_names.
        self._full_scales = np.array(
            [1.0, unit.amplitude_full_scale_N, velocity, velocity / omega, velocity, unit.force_full_scale_N]
        )
        low = np.array([-2.0, 0.0, 0.0, 0.0, -1.0, -1.0, -1.0, -1.0], np.float32)
        high = np.array([2.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0], np.float32)
        self.observation_space = gymnasium.spaces.Box(low, high, dtype=np.float32)
        self.action_space = gymnasium.spaces.Box(0.0, 1.0, (1,), np.float32)

    def _observation(self, observed: NDArray[np.float64], info: dict[str, Any]) -> NDArray[np.float32]:
        scaled = observed / self._full_scales
        if self._loop.holds_force:
            names = "friction_force_along_sliding_N", "wanted_friction_force_N", "coming_friction_force_N"
            targets = [info[name] / self._loop.highest_target for name in names]
        else:
            targets = [scaled[0], info["wanted_friction_ratio"], info["coming_friction_ratio"]]
        values = np.concatenate([targets, scaled[1:]])
        box = self.observation_space
        clipped: NDArray[np.float32] = np.clip(values, box.low, box.high).astype(np.float32)
        return clipped

    def reset(
        self, *, seed: int | None = None, options: dict[str, Any] | None = None
    ) -> tuple[NDArray[np.float32], dict[str, Any]]:
        super().reset(seed=seed)
        observed, info = self._loop.reset(int(self.np_random.integers(2**32)))
        return self._observation(observed, info), info

    def step(
        self, action: NDArray[np.float32]
    ) -> tuple[NDArray[np.float32], float, bool, bool, dict[str, Any]]:
        target = max(float(np.reshape(action, ())), self.least_target)
        observed, _, terminated, truncated, info = self._loop.step(target * self._loop.highest_target)
        observation = self._observation(observed, info)
        reward = 1.0 - abs(float(observation[0]) - float(observation[1]))
        return observation, reward, terminated, truncated, info


def register() -> None:
    """Makes the environment known to gymnasium.make()."""
    if ENVIRONMENT not in gymnasium.registry:
        gymnasium.register(ENVIRONMENT, entry_point="sonoglide.gymnasium:Loop")


register()
