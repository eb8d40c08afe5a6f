import numpy
import pytest
import scipy.optimize

import sonoglide


def run_ratios(read):
    return sonoglide.run(read).periods["friction_ratio"]


def test_scenes_are_run_as_one_by_one(scene):
    scenes = [scene("target_step", {"friction.coefficient": mu}) for mu in (0.08, 0.1, 0.13)]
    ratios = sonoglide.rollout(scenes)
    assert ratios.shape == (3, 360)
    for row, each in zip(ratios, scenes):
        assert numpy.array_equal(row, run_ratios(each))


def test_scenes_that_nobody_else_keeps_live_long_enough(scene):
    ratios = sonoglide.rollout(scene("target_step", {"friction.coefficient": mu}) for mu in (0.08, 0.13))
    assert numpy.array_equal(ratios[1], run_ratios(scene("target_step", {"friction.coefficient": 0.13})))


def test_what_is_no_scene_is_refused(scene):
    with pytest.raises(TypeError, match="allowed: a Scene"):
        sonoglide.rollout([scene("target_step"), "target_step"])
    with pytest.raises(TypeError):
        sonoglide.rollout(7)


def test_targets_of_0_leave_those_of_the_scene(scene):
    read = scene("target_step")
    ratios = sonoglide.rollout(read, numpy.zeros((1, 360)))
    assert numpy.array_equal(ratios[0], run_ratios(read))


def test_a_row_of_targets_is_what_a_loop_is_given(scene):
    read = scene("target_step_q31")
    targets = numpy.random.default_rng(3).uniform(0.3, 0.8, (2, 360))
    targets[:, 5:100] = 0.0
    ratios = sonoglide.rollout(read, targets)
    for row, course in zip(ratios, targets):
        loop = sonoglide.Loop(read)
        assert [loop.step(target or None)[0][0] for target in course] == row.tolist()


def test_rows_do_not_depend_on_the_number_of_threads(scene):
    scenes = [scene("target_step", {"solver.tolerance": 1e-6, "friction.coefficient": mu})
              for mu in numpy.linspace(0.08, 0.13, 40)]
    one = sonoglide.rollout(scenes, threads=1)
    assert numpy.array_equal(one, sonoglide.rollout(scenes, threads=3))
    # In lanes: near those of `run`.
    assert one[7] == pytest.approx(run_ratios(scenes[7]), abs=1e-5)


def test_the_given_array_is_filled(scene):
    read = scene("target_step")
    out = numpy.empty((1, 360))
    assert numpy.shares_memory(sonoglide.rollout(read, out=out), out)
    assert numpy.array_equal(out[0], run_ratios(read))


@pytest.mark.parametrize("out", [numpy.empty((1, 359)), numpy.empty((2, 360)), numpy.empty(360)])
def test_an_array_of_another_shape_is_refused(scene, out):
    with pytest.raises(ValueError, match="allowed: 1 rows"):
        sonoglide.rollout(scene("target_step"), out=out)


@pytest.mark.parametrize("out", [numpy.empty((1, 360), numpy.float32), numpy.empty((360, 1)).T[:, ::-1]])
def test_an_array_that_would_have_to_be_copied_is_refused(scene, out):
    with pytest.raises(TypeError):
        sonoglide.rollout(scene("target_step"), out=out)


def test_a_target_out_of_range_is_named(scene):
    targets = numpy.full((2, 360), 0.5)
    targets[1, 7] = 1.5
    with pytest.raises(ValueError, match="rollout 1 in carrier period 7 is 1.5; allowed: 0 to 1"):
        sonoglide.rollout(scene("target_step"), targets)


def test_scenes_of_other_lengths_are_refused(scene):
    scenes = [scene("target_step"), scene("target_step", {"run.duration_s": 5e-3})]
    with pytest.raises(ValueError, match="scene 1 has 300"):
        sonoglide.rollout(scenes)


def test_a_failed_rollout_is_named(scene):
    bad = {"solver.method": "rk4", "solver.step_s": 1.667e-6, "solver.tolerance": None}
    fine = scene("stiff_contact_open_loop")
    with pytest.raises(sonoglide.ComputationError, match="rollout 1: "):
        sonoglide.rollout([fine, scene("stiff_contact_open_loop", bad)])


def test_no_scenes_are_no_rows():
    assert sonoglide.rollout([]).shape == (0, 0)


def test_an_optimiser_finds_the_drive_of_a_friction_ratio(scene):
    # Case with a known answer: 526.3 N within 1 % for a ratio of 0.5.
    base = scene("steady_open_loop", {"solver.tolerance": 1e-8})

    def error(force_N):
        ratios = sonoglide.rollout([base.replace({"drive.force_amplitude_N": float(force_N)})])
        return ratios[0, -20:].mean() - 0.5

    force_N = scipy.optimize.brentq(error, 300.0, 900.0, xtol=0.1)
    assert force_N == pytest.approx(526.3, rel=0.01)


def test_a_global_optimiser_drives_whole_populations(scene):
    base = scene("target_step", {"solver.tolerance": 1e-6, "controller.target_friction_ratio": [[0.0, 0.4]],
                                 "model_error.stiffness": 1.04})

    def ripple(populations):
        # scipy hands over (parameters, candidates).
        scenes = [base.replace({"model_error.stiffness": k}) for k in populations[0]]
        return numpy.abs(sonoglide.rollout(scenes)[:, 60:] - 0.4).mean(axis=1)

    found = scipy.optimize.differential_evolution(ripple, [(0.9, 1.1)], vectorized=True, updating="deferred",
                                                  seed=1, popsize=8, maxiter=8, polish=False)
    # The controller does best with the spring that is there.
    assert found.x[0] == pytest.approx(1.0, abs=5e-3)
