"""The environment: by Gymnasium's own checker where it is installed, and rule by rule without it.

The rules are those that the checker of Gymnasium 1.x names, read there and told here in our own words.
"""

import copy
import importlib
import importlib.util
import inspect
import itertools
import sys
import types

import numpy
import pytest

import sonoglide

INSTALLED = importlib.util.find_spec("gymnasium") is not None


def stand_in():
    """What the environment takes of Gymnasium."""

    class Box:
        def __init__(self, low, high, shape=None, dtype=numpy.float32):
            shape = numpy.shape(low) if shape is None else shape
            self.low, self.high = (numpy.broadcast_to(numpy.asarray(end, dtype), shape) for end in (low, high))
            self.shape, self.dtype = shape, dtype

        def seed(self, seed):
            self.generator = numpy.random.default_rng(seed)

        def sample(self):
            return self.generator.uniform(self.low, self.high).astype(self.dtype)

        def __contains__(self, value):
            return value.shape == self.shape and value.dtype == self.dtype and bool(
                numpy.all((value >= self.low) & (value <= self.high)))

    class Env:
        metadata, render_mode, spec, np_random = {}, None, None, None

        def __class_getitem__(cls, _):
            return cls

        def reset(self, *, seed=None, options=None):
            if seed is not None or self.np_random is None:
                self.np_random = numpy.random.default_rng(seed)

        def close(self):
            pass

    module = types.ModuleType("gymnasium")
    module.Env, module.spaces, module.registry = Env, types.SimpleNamespace(Box=Box), {}
    module.register = lambda name, entry_point: module.registry.update({name: entry_point})
    return module


@pytest.fixture
def environment(monkeypatch):
    """sonoglide.gymnasium"""
    if not INSTALLED:
        monkeypatch.setitem(sys.modules, "gymnasium", stand_in())
    monkeypatch.delitem(sys.modules, "sonoglide.gymnasium", raising=False)
    return importlib.import_module("sonoglide.gymnasium")


def test_gymnasium_is_content_with_the_environment(environment, scene):
    if not INSTALLED:
        pytest.skip("Gymnasium is not installed: its own checker does not look at the environment")
    gymnasium = importlib.import_module("gymnasium")
    checker = importlib.import_module("gymnasium.utils.env_checker")
    for name in ("target_step", "noisy_sensor"):
        checker.check_env(gymnasium.make(environment.ENVIRONMENT, scene=scene(name)).unwrapped)


RULED = pytest.mark.parametrize("name", ["target_step", "target_step_q15", "noisy_sensor", "damped_step"])


def is_observation(value, env):
    return isinstance(value, numpy.ndarray) and value.dtype == numpy.float32 and value in env.observation_space


@RULED
def test_spaces_are_bounded_boxes_and_the_action_is_normalised(environment, scene, name):
    env = environment.Loop(scene(name))
    for space in env.action_space, env.observation_space:
        assert space.low.shape == space.high.shape == space.shape
        assert numpy.all(numpy.isfinite(space.low) & numpy.isfinite(space.high) & (space.low < space.high))
    assert env.action_space.low == 0.0 and env.action_space.high == 1.0


def test_seed_and_options_have_defaults_and_nothing_outdated_is_left(environment):
    reset = inspect.signature(environment.Loop.reset).parameters
    assert reset["seed"].default is None and reset["options"].default is None
    assert not hasattr(environment.Loop, "seed")


@RULED
def test_reset_gives_an_observation_and_a_dictionary(environment, scene, name):
    env = environment.Loop(scene(name))
    for arguments in {}, {"seed": 123}, {}, {"options": {}}, {"seed": 0, "options": {"any": 1}}:
        result = env.reset(**arguments)
        assert isinstance(result, tuple) and len(result) == 2
        assert is_observation(result[0], env) and isinstance(result[1], dict)


@RULED
def test_the_seed_decides_the_generator_and_the_observations(environment, scene, name):
    def resets(seed):
        env = environment.Loop(scene(name))
        first = env.reset(seed=seed)[0]
        state = copy.deepcopy(env.np_random.bit_generator.state)
        return first.tolist(), env.reset()[0].tolist(), state

    assert resets(123) == resets(123)
    assert resets(123)[2] != resets(456)[2]


@RULED
def test_a_step_is_the_same_again_after_the_same_seed(environment, scene, name):
    env = environment.Loop(scene(name))
    env.action_space.seed(123)
    action = env.action_space.sample()

    def step():
        env.reset(seed=123)
        generator = env.np_random
        result = env.step(action)
        assert env.np_random is generator
        return result

    (observation, *first), (again, *second) = step(), step()
    assert observation.tolist() == again.tolist()
    assert first == second
    assert first[2] is False


@RULED
def test_a_step_gives_five_things_of_their_types(environment, scene, name):
    env = environment.Loop(scene(name))
    env.reset(seed=1)
    result = env.step(numpy.array([0.5], numpy.float32))
    assert isinstance(result, tuple) and len(result) == 5
    observation, reward, terminated, truncated, info = result
    assert is_observation(observation, env)
    assert type(reward) is float and numpy.isfinite(reward)
    assert type(terminated) is bool and type(truncated) is bool
    assert isinstance(info, dict)


@RULED
def test_what_was_returned_stays_as_it_was(environment, scene, name):
    env = environment.Loop(scene(name))
    action = numpy.array([0.5], numpy.float32)
    returned = [env.reset(seed=1), *(env.step(action) for _ in range(3)), env.reset()]
    observations, infos = [result[0] for result in returned], [result[-1] for result in returned]
    assert not any(numpy.shares_memory(a, b) for a, b in itertools.combinations(observations, 2))
    assert len({id(info) for info in infos}) == len(infos)
    assert not any(isinstance(value, (dict, list, numpy.ndarray)) for info in infos for value in info.values())
    assert action == 0.5


def test_no_render_mode_is_declared_and_a_closed_environment_can_be_closed(environment, scene):
    env = environment.Loop(scene("target_step"))
    assert env.metadata["render_modes"] == [] and env.render_mode is None
    env.close()
    env.close()


def test_the_environment_is_registered(environment):
    spec = sys.modules["gymnasium"].registry[environment.ENVIRONMENT]
    assert getattr(spec, "entry_point", spec) == "sonoglide.gymnasium:Loop"
    environment.register()


def test_signatures_are_those_of_gymnasium(environment):
    reset = inspect.signature(environment.Loop.reset).parameters
    assert list(reset) == ["self", "seed", "options"]
    assert reset["seed"].kind is reset["seed"].KEYWORD_ONLY
    assert list(inspect.signature(environment.Loop.step).parameters) == ["self", "action"]


@pytest.mark.parametrize("name", ["target_step", "target_step_q15", "noisy_sensor", "damped_step", "speed_reversal"])
def test_every_observation_is_inside_its_space_and_tells_the_reward(environment, scene, name):
    env = environment.Loop(scene(name))
    actions = numpy.random.default_rng(2)
    observation, info = env.reset(seed=1)
    assert observation in env.observation_space
    names = env.observation_names
    coming = observation[names.index("coming_ratio")]
    while True:
        action = actions.uniform(0.0, 1.0, 1).astype(numpy.float32)
        observation, reward, terminated, truncated, info = env.step(action)
        assert observation in env.observation_space
        seen = dict(zip(names, observation.tolist()))
        assert reward == 1.0 - abs(seen["friction_ratio"] - seen["wanted_ratio"])
        assert seen["wanted_ratio"] == pytest.approx(info["wanted_friction_ratio"])
        assert seen["wanted_ratio"] == coming
        coming = observation[names.index("coming_ratio")]
        if terminated or truncated:
            break
    assert truncated


def test_observations_are_scaled(environment, scene):
    env, loop = environment.Loop(scene("target_step")), sonoglide.Loop(scene("target_step"))
    env.reset(seed=1)
    for _ in range(300):
        observation = env.step(numpy.array([0.6], numpy.float32))[0]
        plain = loop.step(float(numpy.float32(0.6)))[0]
    assert observation[0] == pytest.approx(plain[0])
    assert observation[3] == pytest.approx(plain[1] / 1920.0, rel=1e-6)
    assert 0.05 < abs(observation[3:]).max() <= 1.0


HELD_FORCE = {"controller.target_friction_ratio": None,
              "controller.target_friction_force_N": [[0.0, 0.01], [2e-3, 0.012]]}
FORCE_TEXTURE = {"controller.target_friction_ratio": None,
                 "controller.target_texture": {"period_m": 53.44e-6, "force_N": [0.008, 0.012]}}


@pytest.mark.parametrize("changes", [HELD_FORCE, FORCE_TEXTURE])
def test_target_forces_are_parts_of_what_the_sensor_reads(environment, scene, changes):
    read = scene("target_step", changes)
    full_N = read.values["sensor"]["force_full_scale_N"]
    env, loop = environment.Loop(read), sonoglide.Loop(read)
    names = env.observation_names
    assert names[:3] == ("friction_force_along_sliding", "wanted_force", "coming_force")
    first, _ = env.reset(seed=1)
    loop.reset()
    assert first in env.observation_space
    action = numpy.array([0.01 / full_N], numpy.float32)
    for _ in range(150):
        first, reward, terminated, truncated, info = env.step(action)
        plain = loop.step(float(action[0]) * full_N)
        assert first in env.observation_space
        assert info == plain[4]
        assert first[1] == pytest.approx(plain[4]["wanted_friction_force_N"] / full_N, rel=1e-6)
        assert reward == 1.0 - abs(float(first[0]) - float(first[1]))
    # 0.01 N is held whatever the scene wants; Newtons are found by the simulation's own mean force.
    assert first[0] * full_N == pytest.approx(0.01, rel=2e-3)
    assert first[0] * full_N == pytest.approx(abs(info["mean_friction_force_N"]), rel=1e-6)


def test_the_force_of_the_sensor_is_the_highest_action(environment, scene):
    env = environment.Loop(scene("target_step", HELD_FORCE))
    env.reset(seed=1)
    for action in 0.0, 1.0:
        observation, reward, terminated, truncated, info = env.step(numpy.array([action], numpy.float32))
        assert observation in env.observation_space and not terminated


@pytest.mark.parametrize("arithmetic", ["float32", "q31", "q15"])
def test_the_action_0_is_the_least_target(environment, scene, arithmetic):
    env = environment.Loop(scene("target_step", {"controller.arithmetic": arithmetic}))
    env.reset(seed=1)
    for _ in range(100):
        observation, reward, terminated, truncated, info = env.step(numpy.zeros(1, numpy.float32))
    assert not terminated
    assert observation[0] < 0.2
    env.step(numpy.ones(1, numpy.float32))


def test_the_seed_decides_the_episodes(environment, scene):
    def episodes(seed):
        env = environment.Loop(scene("noisy_sensor"))
        env.reset(seed=seed)
        rows = []
        for _ in range(2):
            rows.append([env.step(numpy.array([0.5], numpy.float32))[0].tolist() for _ in range(100)])
            env.reset()
        return rows

    first, again, other = episodes(1), episodes(1), episodes(2)
    assert first == again
    assert first[0] != other[0]
    assert first[0] != first[1]


def test_a_copy_goes_on_from_where_it_is(environment, scene):
    env = environment.Loop(scene("noisy_sensor"))
    env.reset(seed=3)
    action = numpy.array([0.5], numpy.float32)
    env.step(action)
    again = copy.deepcopy(env)
    assert env.step(action)[0].tolist() == again.step(action)[0].tolist()


def test_without_gymnasium_it_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "gymnasium", None)
    monkeypatch.delitem(sys.modules, "sonoglide.gymnasium", raising=False)
    with pytest.raises(ImportError, match="pip install gymnasium"):
        importlib.import_module("sonoglide.gymnasium")
