import csv
import os
import pathlib
import pickle
import subprocess

import numpy
import pytest

import sonoglide
from conftest import content

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
    theirs = content((tmp_path / "identify.json").read_text())
    assert sonoglide.identify_friction(path, ["normal_coulomb"]) == theirs


def test_impedance_is_identified_as_by_the_program(tmp_path):
    path = IDENTIFY / "impedance" / "examples" / "piece_112_kHz.csv"
    program("identify", "impedance", path, "--mass-kg", "0.01", "--out", tmp_path)
    assert sonoglide.identify_impedance(path, mass_kg=0.01) == content((tmp_path / "identify.json").read_text())


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


PIECE = IDENTIFY / "impedance" / "examples" / "piece_112_kHz.csv"
PIN = IDENTIFY / "friction" / "examples" / "dong_dapino_2015.csv"


def columns_of(path):
    """What a file says, as numpy has it."""
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    return {name: numpy.array(column, float) for name, *column in zip(*(line.split(",") for line in lines))}


def same_but_for_places(mine, theirs):
    """Warnings name lines of the file, which has comments above them."""
    return {**mine, "warnings": []} == {**theirs, "warnings": []}


def test_columns_are_identified_as_their_file():
    assert same_but_for_places(sonoglide.identify_friction(columns_of(PIN), ["coulomb"]),
                               sonoglide.identify_friction(PIN, ["coulomb"]))
    piece = columns_of(PIECE)
    found = sonoglide.identify("impedance", piece, mass_kg=0.01)
    assert same_but_for_places(found, sonoglide.identify("impedance", PIECE, mass_kg=0.01))
    assert found.scene.values["plant"]["mass_kg"] == 0.01


def test_complex_numbers_are_an_impedance_or_an_admittance():
    piece = columns_of(PIECE)
    f = piece["frequency_Hz"]
    z = piece["impedance_magnitude_ohm"] * numpy.exp(1j * numpy.deg2rad(piece["impedance_phase_deg"]))
    values = [
        sonoglide.identify_impedance(measured)["parameters"]["resonance_frequency_Hz"]["value"]
        for measured in (
            {"frequency_Hz": f, "impedance_ohm": z},
            {"frequency_Hz": f, "admittance_S": 1 / z},
            numpy.rec.fromarrays([f, z.real, z.imag], names=["frequency_Hz", "resistance_ohm", "reactance_ohm"]),
        )
    ]
    assert values == pytest.approx([112720.17] * 3, rel=1e-6)


def test_a_table_of_pandas_is_identified():
    pandas = pytest.importorskip("pandas")
    table = pandas.read_csv(PIN, comment="#")
    assert same_but_for_places(sonoglide.identify_friction(table, ["dahl"]), sonoglide.identify_friction(PIN, ["dahl"]))


@pytest.mark.parametrize("measured, error, words", [
    (numpy.zeros((3, 2)), TypeError, "without names"),
    ({"velocity_ratio": [0.1], "friction_ratio": [0.1, 0.2]}, ValueError, "equally many"),
    ({"sliding_velocity_m_per_s": [0.1, 0.2], "velocity_ratio": [0.1, float("nan")], "friction_ratio": [0.1, 0.2]}, sonoglide.SceneError, "measurements:3"),
    ({"velocity": [0.1, 0.3], "friction_ratio": [0.1, 0.2]}, sonoglide.SceneError, "velocity"),
    ("nowhere.csv", FileNotFoundError, "nowhere.csv"),
])
def test_what_are_no_measurements_is_refused(measured, error, words):
    with pytest.raises(error, match=words):
        sonoglide.identify_friction(measured)


def test_an_unknown_law_is_refused():
    with pytest.raises(ValueError, match="allowed: "):
        sonoglide.identify_friction(PIN, ["dahll"])


def test_an_unknown_kind_is_refused():
    with pytest.raises(ValueError, match="allowed: impedance, friction"):
        sonoglide.identify("temperature", PIN)


def test_mechanical_facts_out_of_range_are_refused():
    with pytest.raises(ValueError, match="one of them"):
        sonoglide.identify_impedance(PIECE, 0.01, 2.0)
    with pytest.raises(ValueError, match="mass_kg is -1; allowed: 1e-12 to 1e"):
        sonoglide.identify_impedance(PIECE, -1.0)


def test_robustness_is_that_of_the_program(scene, tmp_path):
    read = scene("robust_step", {"solver.tolerance": 1e-6})
    (tmp_path / "loop.toml").write_text(read.toml)
    program("robust", tmp_path / "loop.toml", "--samples", "16", "--search", "8", "--seed", "3", "--out", tmp_path / "out")
    mine = sonoglide.robust(read, samples=16, search=8, seed=3)
    assert mine == content((tmp_path / "out" / "robust.json").read_text())
    assert mine.scene == sonoglide.Scene(tmp_path / "out" / "worst.toml")


@pytest.mark.parametrize("options", [{"samples": 0}, {"samples": 10**7}, {"search": 10**7}])
def test_counts_out_of_range_are_refused(scene, options):
    with pytest.raises(ValueError, match="allowed: "):
        sonoglide.robust(scene("robust_step"), **options)


def test_robustness_wants_tolerances(scene):
    with pytest.raises(sonoglide.SceneError, match="tolerance"):
        sonoglide.robust(scene("target_step"))


def test_a_design_is_that_of_the_program(tmp_path):
    path = pathlib.Path(os.environ["SONOGLIDE_SCENES"]) / "target_step.toml"
    program("design", path, "--ratio", "0.5", "--velocity", "0.02:0.03", "--out", tmp_path)
    mine = sonoglide.design(sonoglide.Scene(path), [0.5], velocity_m_per_s=(0.02, 0.03))
    assert mine == content((tmp_path / "design.json").read_text())


@pytest.mark.parametrize("options", [{"ratios": [1.0]}, {"velocity_m_per_s": (0.03, 0.02)}])
def test_designs_out_of_range_are_refused(scene, options):
    with pytest.raises(ValueError, match="allowed: "):
        sonoglide.design(scene("target_step"), **options)


def test_the_header_is_that_of_the_program(scene, tmp_path):
    path = pathlib.Path(os.environ["SONOGLIDE_SCENES"]) / "target_step.toml"
    program("configure", path, "--plant", "q31", "--out", tmp_path)
    headers = sonoglide.configure(scene("target_step"), plant="q31")
    assert len(headers) == 2
    for name, text in headers.items():
        assert text == (tmp_path / name).read_text()
    with pytest.raises(ValueError, match='allowed: "float32", "q31"'):
        sonoglide.configure(scene("target_step"), plant="float64")


@pytest.mark.parametrize("options", [[], ["--fmi", "2"]])
def test_the_fmu_is_that_of_the_program(scene, tmp_path, options):
    path = pathlib.Path(os.environ["SONOGLIDE_SCENES"]) / "target_step.toml"
    program("fmu", path, "--kind", "loop", "--out", tmp_path / "theirs.fmu", *options)
    sonoglide.fmu(scene("target_step"), "loop", tmp_path / "mine.fmu", *map(int, options[1:]))
    assert (tmp_path / "mine.fmu").read_bytes() == (tmp_path / "theirs.fmu").read_bytes()


def test_an_fmu_of_another_kind_is_refused(scene, tmp_path):
    with pytest.raises(ValueError, match='allowed: "plant", "controller", "loop"'):
        sonoglide.fmu(scene("target_step"), "sensor", tmp_path / "a.fmu")
    with pytest.raises(ValueError, match="ends in .fmu"):
        sonoglide.fmu(scene("target_step"), "loop", tmp_path / "a.zip")


def test_an_fmu_replaces_its_own_alone(scene, tmp_path):
    path = tmp_path / "new" / "a.fmu"
    for _ in range(2):
        sonoglide.fmu(scene("target_step"), "plant", path)
    path.write_text("mine")
    with pytest.raises(OSError, match="was not written by an earlier run"):
        sonoglide.fmu(scene("target_step"), "plant", path)
    assert path.read_text() == "mine"


@pytest.mark.parametrize(
    "argument, given, allowed",
    [
        ("samples", -1, "1 to 1000000"),
        ("search", -1, "0 to 1000000"),
        ("seed", 2**63, "0 to 9223372036854775807"),
        ("seed", -1, "0 to 9223372036854775807"),
        ("threads", 1025, "0 to 1024"),
    ],
)
def test_an_integer_out_of_range_is_refused(scene, argument, given, allowed):
    read = scene("robust_step")
    with pytest.raises(ValueError, match=f"{argument} is {given}; allowed: {allowed}"):
        sonoglide.robust(read, **{argument: given})
    if argument == "threads":
        for study in (lambda: sonoglide.rollout(read, threads=given), lambda: sonoglide.sweep(read, {}, threads=given)):
            with pytest.raises(ValueError, match=f"threads is {given}; allowed: {allowed}"):
                study()
    if argument == "seed":
        with pytest.raises(ValueError, match=f"seed is {given}; allowed: {allowed}"):
            sonoglide.Loop(scene("target_step")).reset(seed=given)


def test_what_a_study_comes_to_can_be_pickled():
    found = sonoglide.identify_friction(PIN, ["coulomb"])
    again = pickle.loads(pickle.dumps(found))
    assert (again, again.scene) == (found, found.scene)
