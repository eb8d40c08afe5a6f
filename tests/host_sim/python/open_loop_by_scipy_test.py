"""The equations of the plant, integrated by scipy: m x'' + Ks x = A cos wt - F and Dahl's F."""

import numpy
import pytest
from scipy.integrate import solve_ivp

import sonoglide


def from_reversal_to_reversal(equations, sliding_velocity, end, state, times):
    """Integrates smooth pieces, which end where the contact reverses. -> states at the times, at the end"""

    def reverses(t, y, sign):
        return sliding_velocity + y[1]

    reverses.terminal = True
    begin, sign, seen = 0.0, 1.0, []
    while begin < end:
        reverses.direction = -sign
        piece = solve_ivp(equations, (begin, end), state, method="DOP853", rtol=1e-11,
                          atol=[1e-18, 1e-13, 1e-13, 1e-18], events=reverses, dense_output=True, args=(sign,))
        inside = times[(times >= begin) & ((times < piece.t[-1]) | (piece.t[-1] >= end))]
        seen.append(piece.sol(inside))
        begin, state, sign = piece.t[-1], piece.y[:, -1], -sign
    return numpy.hstack(seen), state


def test_table_1_from_rest(scene):
    read = scene("table_1_open_loop")
    run = sonoglide.run(read)
    plant, friction, drive = (read.values[table] for table in ("plant", "friction", "drive"))
    velocity = read.values["sliding"]["velocity_m_per_s"]
    omega = 2.0 * numpy.pi * drive["frequency_Hz"]
    limit_N = friction["coefficient"] * friction["normal_force_N"]

    def equations(t, y, sign):
        x, v, force, _ = y
        slip = velocity + v
        return [
            v,
            (drive["force_amplitude_N"] * numpy.cos(omega * t) - force - plant["stiffness_N_per_m"] * x) / plant["mass_kg"],
            friction["contact_stiffness_N_per_m"] * slip * (1.0 - sign * force / limit_N),
            force,
        ]

    end = read.values["run"]["duration_s"]
    states, last = from_reversal_to_reversal(equations, velocity, end, [0.0] * 4, run.trace["time_s"])
    for name, expected in zip(("displacement_m", "velocity_m_per_s", "friction_force_N"), states):
        largest = numpy.abs(expected).max()
        assert run.trace[name] == pytest.approx(expected, abs=1e-9 * largest)
    ratio = run.summary["friction_ratio"]["whole_run"]
    assert ratio == pytest.approx(last[3] / (limit_N * end), abs=1e-10)
