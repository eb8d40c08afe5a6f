import _thread
import multiprocessing
import os
import pickle
import subprocess
import sys
import threading

import numpy
import pytest

import sonoglide


@pytest.mark.parametrize("name", ["target_step", "target_step_q31", "target_step_q15", "target_step_float64"])
def test_commands_are_those_of_the_program_bit_for_bit(scene, program, name):
    assert sonoglide.run(scene(name)).trace_hash == program(name)["control"]["trace_hash"]


def test_the_summary_is_that_of_the_program(scene, program):
    mine = sonoglide.run(scene("target_step")).summary
    theirs = program("target_step")
    for summary in (mine, theirs):
        del summary["run"]["wall_s"], summary["run"]["real_time_factor"]
    assert mine == theirs


def test_a_texture_is_that_of_the_program(scene, program):
    texture = {"period_m": 53.44e-6, "ratio": [0.4, 0.6]}
    mine = sonoglide.run(scene("target_step", {"controller.target_friction_ratio": None,
                                               "controller.target_texture": texture}))
    theirs = program("target_step", "--set", "controller.target_friction_ratio=", "--set",
                     "controller.target_texture={ period_m = 53.44e-6, ratio = [0.4, 0.6] }")
    assert mine.trace_hash == theirs["control"]["trace_hash"]
    assert mine.summary["control"]["texture"] == theirs["control"]["texture"]
    assert mine.scene.values["controller"]["target_texture"] == texture
    assert ", 1 periods of a texture, trace " in repr(mine)
    assert "<th>target_phase_deg</th>" in mine._repr_html_()
    ratio = mine.periods["friction_ratio"][60:]
    assert ratio.min() < 0.45 and ratio.max() > 0.55


def test_open_loop_meets_the_reference(scene):
    # Twenty digits of another method: tests/firmware/plant/data/reference_open_loop.csv.
    run = sonoglide.run(scene("table_1_open_loop"))
    assert run.trace_hash is None
    assert run.summary["friction_ratio"]["whole_run"] == pytest.approx(0.656900288709659, abs=1e-9)
    assert run.summary["final"]["displacement_m"] == pytest.approx(-2.363445520920056e-7, rel=1e-7)


def test_columns_are_read_only_views(scene):
    run = sonoglide.run(scene("target_step"))
    columns = {**run.trace, **run.periods}
    assert set(run.trace) == {"time_s", "displacement_m", "friction_force_N", "drive_force_N"}
    for column in columns.values():
        assert not column.flags.owndata
        assert not column.flags.writeable
        with pytest.raises(ValueError):
            column.setflags(write=True)
    again = run.trace["displacement_m"]
    assert numpy.shares_memory(again, columns["displacement_m"])


def test_columns_outlive_the_run(scene):
    run = sonoglide.run(scene("target_step"))
    ratio = run.periods["friction_ratio"]
    before = ratio.copy()
    del run
    assert numpy.array_equal(ratio, before)


def test_columns_have_what_the_scene_tells(scene):
    run = sonoglide.run(scene("target_step"))
    assert len(run.periods["time_s"]) == 360
    assert run.trace["time_s"][-1] == pytest.approx(6e-3)
    late = run.periods["friction_ratio"][-30:]
    assert late == pytest.approx(0.5, abs=1e-3)
    assert sonoglide.states[run.periods["state"][-1]] == "running"
    assert sonoglide.limits[run.periods["limit"][-1]] == "none"
    assert sonoglide.settlings[run.periods["settling"][-1]] == "settled"


def test_a_scene_that_records_nothing_has_empty_columns(scene):
    run = sonoglide.run(scene("target_step", {"run.record": None, "run.record_interval_s": None}))
    assert list(run.trace) == ["time_s"]
    assert all(len(column) == 0 for column in run.periods.values())


# Of the tutorial: too slow to be damped by the drive alone.
slow_mode = {"plant.stiffness_N_per_m": 2.558e6, "friction.normal_force_N": 40.0, "drive.bias_limit_N": 12.0,
             "friction.contact_stiffness_N_per_m": 11.4e6, "drive.max_force_amplitude_N": 2200.0}


@pytest.mark.parametrize("name, changes, column", [
    ("target_step", {}, "drive_amplitude_N"),
    ("langevin", {}, "drive_amplitude_V"),
    ("damped_step", slow_mode, "bias_N"),
])
def test_periods_have_the_columns_of_the_table(scene, tmp_path, name, changes, column):
    pandas = pytest.importorskip("pandas")
    overrides = {"run.record": ["velocity_m_per_s"], "run.record_interval_s": 1e-4, "run.duration_s": 5e-3}
    read = scene(name, {**overrides, **changes, "controller.target_friction_ratio": [[0.0, 0.5]]})
    (tmp_path / "scene.toml").write_text(read.toml)
    subprocess.run([os.environ["SONOGLIDE_PROGRAM"], "run", "scene.toml", "--quiet", "--out", "out"],
                   cwd=tmp_path, check=True)
    run = sonoglide.run(read)
    for columns, table in ((run.periods, "periods.csv"), (run.trace, "trace.csv")):
        theirs = pandas.read_csv(tmp_path / "out" / table)
        mine = columns.frame()[list(theirs.columns)]
        pandas.testing.assert_frame_equal(mine, theirs, check_dtype=False, rtol=0, atol=1e-11)
    assert numpy.ptp(run.periods[column]) > 0.0


@pytest.mark.parametrize("name", ["target_step", "table_1_open_loop"])
def test_a_run_can_be_pickled(scene, name):
    run = sonoglide.run(scene(name))
    again = pickle.loads(pickle.dumps(run))
    assert (again.scene, again.summary, again.trace_hash) == (run.scene, run.summary, run.trace_hash)
    for mine, theirs in ((again.periods, run.periods), (again.trace, run.trace)):
        assert isinstance(mine, sonoglide.Columns)
        assert list(mine) == list(theirs)
        for column, other in zip(mine.values(), theirs.values()):
            assert numpy.array_equal(column, other, equal_nan=True)
            assert not column.flags.writeable


@pytest.mark.parametrize("method", ["fork", "spawn"])
def test_a_pool_of_processes_runs_scenes(scene, method):
    scenes = [scene("target_step", {"friction.coefficient": mu}) for mu in (0.09, 0.11)]
    with multiprocessing.get_context(method).Pool(2) as pool:
        hashes = [run.trace_hash for run in pool.map(sonoglide.run, scenes)]
        ratios = pool.map(sonoglide.rollout, scenes)
        sweeps = pool.starmap(sonoglide.sweep, [(each, {"plant.mass_kg": [0.02]}) for each in scenes])
    assert hashes == [sonoglide.run(each).trace_hash for each in scenes]
    assert numpy.array_equal(ratios[1], sonoglide.rollout(scenes[1]))
    assert sweeps[0]["status"] == ["ok"]


def test_a_run_draws_itself(scene):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    run = sonoglide.run(scene("target_step"))
    ratio, drive = run.plot().axes
    assert numpy.array_equal(ratio.lines[0].get_ydata(), run.periods["friction_ratio"])
    assert drive.get_ylabel() == "drive amplitude [N]"
    with pytest.raises(ValueError, match="run.record"):
        sonoglide.run(scene("target_step", {"run.record": None, "run.record_interval_s": None})).plot()


@pytest.mark.parametrize("library, call", [("matplotlib", "plot"), ("pandas", "frame")])
def test_what_is_not_installed_is_named(scene, monkeypatch, library, call):
    run = sonoglide.run(scene("target_step"))
    monkeypatch.setitem(sys.modules, library, None)
    with pytest.raises(ImportError, match=f"python3-{library}"):
        getattr(run if call == "plot" else run.periods, call)()


def test_a_run_shows_itself(scene):
    closed, opened = sonoglide.run(scene("target_step")), sonoglide.run(scene("table_1_open_loop"))
    assert repr(closed).endswith(f"3 of 3 steps settled, trace {closed.trace_hash}>")
    assert repr(opened) == "<sonoglide.Run of table_1_open_loop: friction ratio 0.659907>"
    assert "<th>settling_time_s</th>" in closed._repr_html_()
    assert "faults" not in opened._repr_html_()


def test_runs_in_threads_are_those_of_one(scene):
    read = scene("target_step_q31")
    hashes = []
    threads = [threading.Thread(target=lambda: hashes.append(sonoglide.run(read).trace_hash)) for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert hashes == [sonoglide.run(read).trace_hash] * 4


def test_an_interrupt_from_the_keyboard_ends_a_run(scene):
    long = scene("target_step", {"run.record": None, "run.record_interval_s": None, "run.duration_s": 60.0})
    timer = threading.Timer(0.2, _thread.interrupt_main)
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        sonoglide.run(long)
    timer.join()


def test_a_failed_computation_says_where(scene):
    too_hard = scene("stiff_contact_open_loop", {"solver.method": "rk4", "solver.step_s": 1.667e-6,
                                                 "solver.tolerance": None})
    with pytest.raises(sonoglide.ComputationError, match="the step is too long"):
        sonoglide.run(too_hard)
