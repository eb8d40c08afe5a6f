import copy
import pickle
import threading

import numpy
import pytest

import sonoglide


def code(value, full_scale):
    return int(numpy.floor(value / full_scale * 2.0**31 + 0.5))


def samples_of(read, count):
    """What the ideal sensors of a scene hand to its controller, and its answers."""
    loop = sonoglide.Loop(read)
    unit = sonoglide.Unit(read)
    samples, answers = [], []
    for _ in range(count):
        observation, _, _, _, info = loop.step()
        samples.append(
            (
                code(info["mean_friction_force_N"], unit.force_full_scale_N),
                code(observation[2], unit.velocity_full_scale_m_per_s),
            )
        )
        answers.append(info["amplitude_code"])
    return samples, answers


@pytest.mark.parametrize("arithmetic", ["float64", "float32", "q31", "q15"])
def test_a_unit_answers_as_it_does_in_the_loop(scene, arithmetic):
    read = scene("target_step", {"controller.arithmetic": arithmetic, "controller.target_friction_ratio": [[0.0, 0.4]]})
    samples, answers = samples_of(read, 300)
    unit = sonoglide.Unit(scene("target_step"), arithmetic)
    assert [unit.step(*sample) for sample in samples] == answers


def test_arrays_give_what_single_steps_give(scene):
    read = scene("target_step_q31")
    samples, _ = samples_of(read, 100)
    force, velocity = numpy.array(samples, numpy.int32).T
    one_by_one = sonoglide.Unit(read)
    expected = [one_by_one.step(*sample) for sample in samples]
    unit = sonoglide.Unit(read)
    out = numpy.zeros(100, numpy.int32)
    answers = unit.steps(force[:60], velocity[:60], out=out[:60])
    assert numpy.shares_memory(answers, out)
    unit.steps(force[60:], velocity[60:], out=out[60:])
    assert out.tolist() == expected
    assert unit.answer == one_by_one.answer


@pytest.mark.parametrize("made_again", [copy.copy, copy.deepcopy, lambda s: pickle.loads(pickle.dumps(s))])
@pytest.mark.parametrize("arithmetic", ["float32", "q31"])
def test_copies_and_pickles_go_on_bit_for_bit(scene, arithmetic, made_again):
    read = scene("target_step", {"controller.arithmetic": arithmetic})
    samples, _ = samples_of(read, 120)
    unit = sonoglide.Unit(read)
    unit.target = 0.45
    for sample in samples[:60]:
        unit.step(*sample)
    again = made_again(unit)
    assert again.target == 0.45
    assert [again.step(*sample) for sample in samples[60:]] == [unit.step(*sample) for sample in samples[60:]]


def test_a_new_target_changes_the_answer(scene):
    read = scene("target_step")
    samples, _ = samples_of(read, 50)
    unit = sonoglide.Unit(read)
    for sample in samples:
        unit.step(*sample)
    other = copy.copy(unit)
    other.target = 0.8
    assert other.step(*samples[-1]) != unit.step(*samples[-1])


def test_the_answer_tells_the_state_in_words(scene):
    unit = sonoglide.Unit(scene("target_step"))
    assert unit.answer["state"] == "off"
    unit.step(0, 2**29)
    for _ in range(100):
        unit.step(0, 2**29, fresh=False)
    assert unit.answer["state"] == "fault"
    assert unit.answer["fault"] == "measurement_missing"
    assert unit.answer["amplitude_code"] == 0


def test_a_unit_that_observes_the_vibration_wants_its_codes(scene):
    unit = sonoglide.Unit(scene("damped_step"))
    with pytest.raises(ValueError, match="in_phase_code"):
        unit.step(0, 0)
    unit.step(0, 0, 0, 0)
    with pytest.raises(ValueError, match="observes no vibration"):
        sonoglide.Unit(scene("target_step")).step(0, 0, 0, 0)


@pytest.mark.parametrize("force, velocity", [(2**31, 0), (0, -(2**31) - 1)])
def test_codes_out_of_range_are_refused(scene, force, velocity):
    with pytest.raises(ValueError, match="allowed: -2147483648 to 2147483647"):
        sonoglide.Unit(scene("target_step")).step(force, velocity)


def test_arrays_of_other_lengths_are_refused(scene):
    unit = sonoglide.Unit(scene("target_step"))
    force = numpy.zeros(4, numpy.int32)
    with pytest.raises(ValueError, match="velocity_codes"):
        unit.steps(force, force[:3])
    with pytest.raises(ValueError, match="out"):
        unit.steps(force, force, out=numpy.zeros(5, numpy.int32))
    with pytest.raises(TypeError):
        unit.steps(force, force, out=numpy.zeros(4, numpy.int64))


def test_two_units_step_at_the_same_time(scene):
    read = scene("target_step_q31")
    force = numpy.full(200000, 2**29, numpy.int32)
    answers = [None, None]

    def step(i):
        answers[i] = sonoglide.Unit(read).steps(force, force)

    threads = [threading.Thread(target=step, args=(i,)) for i in range(2)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert numpy.array_equal(answers[0], answers[1])


def test_a_unit_in_use_says_so(scene):
    unit = sonoglide.Unit(scene("target_step_q31"))
    force = numpy.full(4_000_000, 2**29, numpy.int32)
    thread = threading.Thread(target=unit.steps, args=(force, force))
    thread.start()
    refused = 0
    while thread.is_alive():
        try:
            unit.step(0, 0)
        except RuntimeError as error:
            assert str(error) == "in use by another thread"
            refused += 1
    thread.join()
    assert refused > 0


def test_a_word_that_names_no_arithmetic_is_refused(scene):
    with pytest.raises(sonoglide.SceneError, match="q32"):
        sonoglide.Unit(scene("target_step"), "q32")


def test_an_open_loop_has_no_unit(scene):
    with pytest.raises(ValueError, match="controller"):
        sonoglide.Unit(scene("table_1_open_loop"))


def test_a_unit_shows_itself(scene):
    unit = sonoglide.Unit(scene("target_step"), "q31")
    assert repr(unit) == "<sonoglide.Unit of target_step in q31: off, target 0.4>"
    assert "<td>fault</td><td>none</td>" in unit._repr_html_()
