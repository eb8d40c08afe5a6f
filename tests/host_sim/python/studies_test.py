import csv
import json
import os
import pathlib
import subprocess

import numpy
import pytest

import sonoglide

IDENTIFY = pathlib.Path(os.environ["SONOGLIDE_SCENES"]).parent / "studies" / "identify"


def program(*arguments):
    subprocess.run([os.environ["SONOGLIDE_PROGRAM"], *arguments, "--quiet"], check=True)


def test_a_sweep_has_the_rows_of_the_program(scene, tmp_path):
    path = pathlib.Path(os.environ["SONOGLIDE_SCENES"]) / "table_1_open_loop.toml"
    program("sweep", path, "--vary", "friction.law=dahl,coulomb", "--vary", "velocity_ratio=0.2,0.6,1",
            "--set", "solver.tolerance=1e-8", "--out", tmp_path)
    with open(tmp_path / "sweep.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    columns = sonoglide.sweep(scene("table_1_open_loop", {"solver.tolerance": 1e-8}),
                              {"friction.law": ["dahl", "coulomb"], "velocity_ratio": numpy.array([0.2, 0.6, 1.0])})
    assert list(columns) == list(rows[0])
    for name, column in columns.items():
        theirs = [row[name] for row in rows]
        assert list(column) == (theirs if isinstance(column, list) else [float(each) for each in theirs])


def test_a_closed_loop_is_swept_in_its_figures(scene):
    read = scene("target_step", {"solver.tolerance": 1e-8})
    columns = sonoglide.sweep(read, {"controller.arithmetic": ["float32", "q31"]}, threads=1)
    for i, arithmetic in enumerate(columns["controller.arithmetic"]):
        step = sonoglide.run(read.replace({"controller.arithmetic": arithmetic})).summary["control"]["steps"][-1]
        assert columns["steady_error"][i] == step["steady_error"]
        assert columns["limit"][i] == step["limit"]


def test_a_point_that_cannot_be_computed_says_why(scene):
    read = scene("stiff_contact_open_loop", {"solver.method": "rk4", "solver.step_s": 1.667e-6, "solver.tolerance": None})
    columns = sonoglide.sweep(read, {"friction.coefficient": [0.1]})
    assert numpy.isnan(columns["friction_ratio_window"][0])
    assert "the step is too long" in columns["status"][0]


def test_a_range_of_the_program_is_understood(scene):
    columns = sonoglide.sweep(scene("table_1_open_loop"), {"friction.contact_stiffness_N_per_m": "1e4:1e6:3:log"})
    assert columns["friction.contact_stiffness_N_per_m"] == pytest.approx([1e4, 1e5, 1e6])


@pytest.mark.parametrize("vary", [{"plant.massa": [1.0]}, {"plant.mass_kg": [-1.0]}, {}])
def test_what_is_no_scene_is_refused(scene, vary):
    with pytest.raises(sonoglide.SceneError):
        sonoglide.sweep(scene("table_1_open_loop"), vary)


def test_a_value_that_would_be_two_is_refused(scene):
    with pytest.raises(ValueError, match="allowed"):
        sonoglide.sweep(scene("table_1_open_loop"), {"friction.law": ["dahl,coulomb"]})


def test_friction_is_identified_as_by_the_program(tmp_path):
    path = IDENTIFY / "friction" / "examples" / "dong_dapino_2015.csv"
    program("identify", "friction", path, "--law", "normal_coulomb", "--out", tmp_path)
    theirs = json.loads((tmp_path / "identify.json").read_text())
    assert sonoglide.identify_friction(path, ["normal_coulomb"]) == theirs


def test_impedance_is_identified_as_by_the_program(tmp_path):
    path = IDENTIFY / "impedance" / "examples" / "piece_112_kHz.csv"
    program("identify", "impedance", path, "--mass-kg", "0.01", "--out", tmp_path)
    assert sonoglide.identify_impedance(path, mass_kg=0.01) == json.loads((tmp_path / "identify.json").read_text())


def test_a_computed_circuit_is_found_again(tmp_path):
    # Butterworth and Van Dyke: C0 beside a series resonator, as numpy has it.
    c0, r1, l1, c1 = 2e-9, 30.0, 50e-3, 0.14e-9
    f = numpy.linspace(58e3, 62.5e3, 800)
    w = 2.0 * numpy.pi * f
    impedance = 1.0 / (1j * w * c0 + 1.0 / (r1 + 1j * w * l1 + 1.0 / (1j * w * c1)))
    path = tmp_path / "sweep.csv"
    rows = numpy.column_stack([f, impedance.real, impedance.imag])
    numpy.savetxt(path, rows, delimiter=",", header="frequency_Hz,resistance_ohm,reactance_ohm", comments="")
    found = sonoglide.identify_impedance(path)["parameters"]
    assert found["motional_resistance_ohm"]["value"] == pytest.approx(r1, rel=1e-6)
    assert found["motional_inductance_H"]["value"] == pytest.approx(l1, rel=1e-6)
    assert found["clamped_capacitance_F"]["value"] == pytest.approx(c0, rel=1e-6)


def test_an_unknown_law_is_refused():
    with pytest.raises(ValueError, match="allowed: "):
        sonoglide.identify_friction("nowhere.csv", ["dahll"])


def test_one_mechanical_fact_is_enough():
    with pytest.raises(ValueError, match="one of them"):
        sonoglide.identify_impedance("nowhere.csv", 0.01, 2.0)
