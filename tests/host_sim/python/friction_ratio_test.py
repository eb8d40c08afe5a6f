import numpy
import pytest
from scipy.integrate import solve_ivp

import sonoglide


def test_coulomb_is_the_arc_sine():
    r = numpy.linspace(0.0, 1.0, 11)
    assert sonoglide.friction_ratio(r, numpy.inf) == pytest.approx(2.0 / numpy.pi * numpy.arcsin(r), abs=1e-15)


def test_dahl_meets_an_integration_of_its_equation():
    r, dahl_number = 0.5, 2.023

    def force(phase, state):
        v = r + numpy.cos(phase)
        return [dahl_number * v * (1.0 - numpy.sign(v) * state[0]), state[0]]

    state = [0.0, 0.0]
    for period in range(20):
        state = solve_ivp(force, (0.0, 2.0 * numpy.pi), [state[0], 0.0], rtol=1e-9, atol=1e-11,
                          max_step=0.02).y[:, -1]
    assert sonoglide.friction_ratio(r, dahl_number) == pytest.approx(state[1] / (2.0 * numpy.pi), abs=1e-6)


def test_numbers_and_arrays_are_broadcast():
    table = sonoglide.friction_ratio([[0.1], [0.5]], [1.0, 10.0, 100.0])
    assert table.shape == (2, 3)
    assert table[1, 2] == sonoglide.friction_ratio(0.5, 100.0)
    assert isinstance(sonoglide.friction_ratio(0.5, 1.0), float)


def test_shapes_that_do_not_fit_are_refused():
    with pytest.raises(ValueError, match="shape"):
        sonoglide.friction_ratio([0.1, 0.2, 0.3], [1.0, 2.0])


@pytest.mark.parametrize("ratio, number", [(numpy.nan, 1.0), (numpy.inf, 1.0), (0.5, 0.0), (0.5, -1.0), (0.5, 1e13)])
def test_numbers_out_of_range_are_refused(ratio, number):
    with pytest.raises(ValueError, match="allowed: "):
        sonoglide.friction_ratio(ratio, number)
