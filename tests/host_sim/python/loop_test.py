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


HELD_FORCE = {"controller.target_friction_ratio": None,
              "controller.target_friction_force_N": [[0.0, 0.01], [2e-3, 0.012]]}
LOAD = {"sliding.velocity_m_per_s": None, "load.mass_kg": 0.05, "load.initial_velocity_m_per_s": 0.02672}


@pytest.mark.parametrize("changes", [HELD_FORCE, LOAD, {**HELD_FORCE, **LOAD}])
def test_force_targets_and_loads_give_the_commands_of_run(scene, changes):
    read = scene("target_step", changes)
    loop = sonoglide.Loop(read)
    to_the_end(loop)
    assert loop.trace_hash == sonoglide.run(read).trace_hash


def test_a_target_force_is_held_and_rewarded_in_newtons(scene):
    loop = sonoglide.Loop(scene("target_step", HELD_FORCE))
    for _ in range(150):
        observation, reward, terminated, truncated, info = loop.step(0.008)
    assert info["mean_friction_force_N"] == pytest.approx(0.008, rel=1e-3)
    # 2.5 ms: the scene wants the second of its forces.
    assert info["wanted_friction_force_N"] == 0.012
    assert reward == pytest.approx(-0.004, rel=1e-3)
    assert "wanted_friction_ratio" not in info


def test_a_force_is_along_the_sliding_whichever_way_it_goes(scene):
    loop = sonoglide.Loop(scene("target_step", {**HELD_FORCE, "sliding.velocity_m_per_s": -0.02672}))
    for _ in range(100):
        observation, reward, terminated, truncated, info = loop.step()
    assert info["mean_friction_force_N"] == pytest.approx(-0.01, rel=1e-3)
    assert reward == pytest.approx(0.0, abs=1e-5)


@pytest.mark.parametrize("target", [0.0, -0.1, 0.05, float("nan"), float("inf")])
def test_target_forces_out_of_range_are_refused(scene, target):
    loop = sonoglide.Loop(scene("target_step", HELD_FORCE))
    with pytest.raises(ValueError, match="allowed: a friction force above 0, at most 0.0.* N"):
        loop.step(target)


def test_a_force_on_the_load_is_that_of_a_profile(scene):
    loop = sonoglide.Loop(scene("target_step", LOAD))
    pushed = scene("target_step", {**LOAD, "load.force_profile_N": [[0.0, 0.01]]})
    for _ in range(2):
        loop.reset()
        assert loop.load_force_N == 0.0
        loop.load_force_N = 0.01
        steps = to_the_end(loop)
        final = sonoglide.run(pushed).summary["load"]
        assert steps[-1][0][2] == pytest.approx(final["final_velocity_m_per_s"], rel=1e-9)
        assert steps[-1][4]["load_displacement_m"] == pytest.approx(final["final_displacement_m"], rel=1e-9)


def test_a_force_on_the_load_may_change_between_steps(scene):
    # M dv = F dt: the friction of 0.02 N is little beside 5 N.
    loop = sonoglide.Loop(scene("target_step", {**LOAD, "controller.target_friction_ratio": [[0.0, 1.0]]}))
    velocities = []
    for force in (0.0, 5.0, -5.0):
        loop.load_force_N = force
        for _ in range(30):
            velocities.append(loop.step()[0][2])
    gained = 30 / 60e3 * 5.0 / 0.05
    assert velocities[59] - velocities[29] == pytest.approx(gained, rel=0.01)
    assert velocities[89] - velocities[59] == pytest.approx(-gained, rel=0.01)


def test_a_copy_keeps_the_force_on_the_load(scene):
    loop = sonoglide.Loop(scene("target_step", LOAD))
    loop.load_force_N = 0.5
    loop.step()
    again = pickle.loads(pickle.dumps(loop))
    assert again.load_force_N == 0.5
    assert numpy.array_equal(loop.step()[0], again.step()[0])


@pytest.mark.parametrize("changes, force, why", [({}, 1.0, "no load"), (LOAD, float("nan"), "finite"),
                                                 (LOAD, float("inf"), "finite")])
def test_a_force_that_no_load_can_have_is_refused(scene, changes, force, why):
    loop = sonoglide.Loop(scene("target_step", changes))
    with pytest.raises(ValueError, match=why):
        loop.load_force_N = force
    assert loop.load_force_N == 0.0


TEXTURE = {"controller.target_friction_ratio": None,
           "controller.target_texture": {"period_m": 53.44e-6, "ratio": [0.4, 0.5, 0.7, 0.5]}}
FORCE_TEXTURE = {"controller.target_friction_ratio": None,
                 "controller.target_texture": {"period_m": 53.44e-6, "force_N": [0.008, 0.012]}}


@pytest.mark.parametrize("changes", [TEXTURE, FORCE_TEXTURE, {**TEXTURE, **LOAD}])
def test_a_texture_gives_the_commands_of_run(scene, changes):
    read = scene("target_step", changes)
    loop = sonoglide.Loop(read)
    to_the_end(loop)
    assert loop.trace_hash == sonoglide.run(read).trace_hash


def test_a_texture_is_wanted_where_the_sliding_is(scene):
    # 0.02672 m/s and 2 ms of a period: in the steps of 1/60 ms the place is known without the loop.
    loop = sonoglide.Loop(scene("target_step", TEXTURE))
    loop.reset()
    places = numpy.array([0.0, 0.25, 0.5, 0.75, 1.0])
    values = numpy.array([0.4, 0.5, 0.7, 0.5, 0.4])
    wanted, coming = [], [loop.observe()[1]["coming_friction_ratio"]]
    for _ in range(300):
        info = loop.step()[4]
        wanted.append(info["wanted_friction_ratio"])
        coming.append(info["coming_friction_ratio"])
    middles = (numpy.arange(301) + 0.5) / 60e3 * 0.02672 / 53.44e-6
    assert wanted == pytest.approx(numpy.interp(middles[:300] % 1.0, places, values), abs=1e-9)
    assert coming == pytest.approx(numpy.interp(middles % 1.0, places, values), abs=1e-9)


def test_a_target_of_ones_own_ends_the_texture_and_not_what_is_wanted(scene):
    loop = sonoglide.Loop(scene("target_step", TEXTURE))
    loop.reset()
    for _ in range(240):
        observation, reward, _, _, info = loop.step(0.5)
    assert observation[0] == pytest.approx(0.5, abs=0.01)
    assert info["wanted_friction_ratio"] < 0.45
    assert reward == -abs(observation[0] - info["wanted_friction_ratio"])


def test_a_copy_goes_on_with_its_texture(scene):
    loop = sonoglide.Loop(scene("target_step", TEXTURE))
    for _ in range(130):
        loop.step()
    again = pickle.loads(pickle.dumps(loop))
    for _ in range(130):
        assert loop.step()[4] == again.step()[4]


@pytest.mark.parametrize("name", ["table_1_open_loop", "langevin"])
def test_scenes_that_cannot_be_stepped_are_refused(scene, name):
    with pytest.raises(ValueError, match="controller"):
        sonoglide.Loop(scene(name))


def test_a_loop_shows_itself(scene):
    loop = sonoglide.Loop(scene("target_step"))
    loop.step()
    assert repr(loop).startswith("<sonoglide.Loop of target_step: running at 1.66667e-05 s, friction ratio ")
    assert "<td>wanted_friction_ratio</td><td>0.4</td>" in loop._repr_html_()
