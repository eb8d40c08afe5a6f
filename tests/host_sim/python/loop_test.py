import copy
import pickle

import numpy
import pytest

import sonoglide


def to_the_end(loop):
    steps = []
    while True:
        steps.append(loop.step())
        if steps[-1][2] or steps[-1][3]:
            return steps


@pytest.mark.parametrize(
    "name, changes",
    [
        ("target_step", {}),
        ("target_step_q31", {}),
        ("noisy_sensor", {}),
        ("damped_step", {}),
        ("target_step", {"drive.interpolation": "linear"}),
        ("target_step", {"drive.interpolation": "linear", "drive.codes_per_period": 2}),
    ],
)
def test_a_loop_left_to_its_scene_gives_the_commands_of_run(scene, name, changes):
    read = scene(name, changes)
    loop = sonoglide.Loop(read)
    loop.reset()
    to_the_end(loop)
    assert loop.trace_hash == sonoglide.run(read).trace_hash


def test_a_step_has_the_shape_of_gymnasium(scene):
    loop = sonoglide.Loop(scene("target_step"))
    observation, info = loop.reset(seed=7)
    assert observation.shape == (len(sonoglide.Loop.observation_names),)
    assert info["time_s"] == 0.0
    observation, reward, terminated, truncated, info = loop.step(0.5)
    named = dict(zip(sonoglide.Loop.observation_names, observation))
    assert reward == -abs(named["friction_ratio"] - 0.4)
    assert (terminated, truncated) == (False, False)
    assert info["time_s"] == pytest.approx(1.0 / 60e3)
    assert info["state"] == "running"


def test_an_episode_is_truncated_where_the_scene_ends(scene):
    loop = sonoglide.Loop(scene("target_step"))
    steps = to_the_end(loop)
    assert len(steps) == 360
    assert [step[3] for step in steps] == [False] * 359 + [True]


def test_an_episode_terminates_with_a_fault(scene):
    loop = sonoglide.Loop(scene("target_step", {"sensor.force_gain": -1.0}))
    observation, reward, terminated, truncated, info = to_the_end(loop)[-1]
    assert terminated and not truncated
    assert info["fault"] == "measurement_implausible"


def test_the_loop_follows_the_given_target(scene):
    loop = sonoglide.Loop(scene("target_step"))
    for _ in range(100):
        observation = loop.step(0.7)[0]
    assert observation[0] == pytest.approx(0.7, abs=1e-3)


def test_the_seed_decides_the_noise(scene):
    loop = sonoglide.Loop(scene("noisy_sensor"))
    hashes = []
    for seed in (1, 2, 1, None):
        loop.reset(seed)
        for _ in range(200):
            loop.step(0.5)
        hashes.append(loop.trace_hash)
    assert hashes[0] == hashes[2] == hashes[3] != hashes[1]


@pytest.mark.parametrize("made_again", [copy.copy, copy.deepcopy, lambda s: pickle.loads(pickle.dumps(s))])
@pytest.mark.parametrize("name", ["noisy_sensor", "damped_step", "target_step_q15"])
def test_copies_and_pickles_go_on_bit_for_bit(scene, name, made_again):
    loop = sonoglide.Loop(scene(name))
    loop.reset(seed=5)
    for _ in range(70):
        loop.step()
    again = made_again(loop)
    for _ in range(70):
        first, second = loop.step(), again.step()
        assert numpy.array_equal(first[0], second[0])
        assert first[1:] == second[1:]
    assert loop.trace_hash == again.trace_hash


def test_a_copy_leaves_the_loop_where_it_is(scene):
    loop = sonoglide.Loop(scene("target_step"))
    loop.step()
    copy.copy(loop).step(0.9)
    other = sonoglide.Loop(scene("target_step"))
    other.step()
    assert loop.step()[1] == other.step()[1]


def test_a_damaged_pickle_is_refused(scene):
    loop = sonoglide.Loop(scene("target_step"))
    scene_, seed, state = loop.__getstate__()
    spoilt = bytes([state[0] ^ 1]) + state[1:]
    with pytest.raises(ValueError, match="damaged"):
        sonoglide.Loop.__new__(sonoglide.Loop).__setstate__((scene_, seed, spoilt))


@pytest.mark.parametrize("target", [0.0, -0.1, 1.1, float("nan")])
def test_targets_out_of_range_are_refused(scene, target):
    loop = sonoglide.Loop(scene("target_step"))
    with pytest.raises(ValueError, match="allowed: "):
        loop.step(target)


@pytest.mark.parametrize("name", ["table_1_open_loop", "langevin"])
def test_scenes_that_cannot_be_stepped_are_refused(scene, name):
    with pytest.raises(ValueError, match="controller"):
        sonoglide.Loop(scene(name))


def test_a_loop_shows_itself(scene):
    loop = sonoglide.Loop(scene("target_step"))
    loop.step()
    assert repr(loop).startswith("<sonoglide.Loop of target_step: running at 1.66667e-05 s, friction ratio ")
    assert "<td>wanted_friction_ratio</td><td>0.4</td>" in loop._repr_html_()
