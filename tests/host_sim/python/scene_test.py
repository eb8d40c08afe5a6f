import copy
import math
import pathlib
import pickle

import numpy
import pytest

import sonoglide


def test_values_have_the_defaults_filled_in(scene):
    read = scene("table_1_open_loop")
    assert read.name == "table_1_open_loop"
    assert read.values["friction"]["normal_force_N"] == 0.02 * 9.81
    assert read.values["solver"] == {"method": "event_taylor", "tolerance": 1e-10}


def test_the_text_of_a_scene_is_the_same_scene(scene):
    read = scene("target_step")
    assert sonoglide.Scene.from_text(read.toml).values == read.values


@pytest.mark.parametrize(
    "value",
    [400, 400.5, numpy.float64(400.5), numpy.int32(400), numpy.float64(0.1) * 3],
)
def test_overrides_keep_every_bit_of_a_number(scene, value):
    read = scene("table_1_open_loop", {"drive.force_amplitude_N": value})
    assert read.values["drive"]["force_amplitude_N"] == value


def test_overrides_of_every_kind(scene):
    targets = numpy.array([[0.0, 0.4], [1e-3, 0.7]])
    read = scene(
        "target_step",
        {
            "controller.arithmetic": "q31",
            "controller.target_friction_ratio": targets,
            "run.record": None,
            "run.record_interval_s": None,
        },
    )
    assert read.values["controller"]["arithmetic"] == "q31"
    assert read.values["controller"]["target_friction_ratio"] == targets.tolist()
    assert "record" not in read.values["run"]


def test_a_replaced_value_wins_and_leaves_the_other_scene(scene):
    first = scene("table_1_open_loop", {"drive.force_amplitude_N": 100.0})
    second = first.replace({"drive.force_amplitude_N": 200.0})
    assert first.values["drive"]["force_amplitude_N"] == 100.0
    assert second.values["drive"]["force_amplitude_N"] == 200.0


def test_errors_carry_line_and_column(tmp_path):
    path = tmp_path / "typo.toml"
    path.write_text("[plant]\nmass_kg = 0.02\n  stifness_N_per_m = 1.0\n")
    with pytest.raises(sonoglide.SceneError) as caught:
        sonoglide.Scene(path)
    error = caught.value
    assert (error.file, error.line, error.column) == (str(path), 3, 3)
    assert error.key == "plant.stifness_N_per_m"
    assert "stiffness_N_per_m" in error.reason
    assert str(error) == f"{path}:3:3: {error.key}: {error.reason}"
    assert isinstance(error, ValueError)


@pytest.mark.parametrize("overrides", [{7: 1.0}, {"plant.mass_kg": object()}])
def test_overrides_of_other_types_are_refused(scene, overrides):
    with pytest.raises(TypeError):
        scene("target_step", overrides)


def test_errors_of_overrides_name_their_place(scene):
    with pytest.raises(sonoglide.SceneError) as caught:
        scene("target_step", {"plant.mass_kg": 0.02, "friction.coefficient": math.nan})
    assert (caught.value.file, caught.value.line) == ("--set", 2)
    assert caught.value.key == "friction.coefficient"


@pytest.mark.parametrize("name", [pathlib.Path("nowhere.toml"), "nowhere.toml"])
def test_a_missing_file_is_an_error_of_the_system(name):
    with pytest.raises(FileNotFoundError, match="nowhere.toml"):
        sonoglide.Scene(name)


def test_a_number_is_no_file(capfd):
    with pytest.raises(TypeError):
        sonoglide.Scene(True)
    print("still open", flush=True)
    assert capfd.readouterr().out == "still open\n"


def test_a_folder_is_no_scene(tmp_path):
    with pytest.raises(IsADirectoryError):
        sonoglide.Scene(tmp_path)


@pytest.mark.parametrize("name", [path.stem for path in sorted(sonoglide.scenes.glob("*.toml"))])
def test_every_example_is_the_same_scene_from_its_values(scene, name):
    read = scene(name)
    again = sonoglide.Scene.from_dict(read.values, name=name)
    assert again == read
    assert hash(again) == hash(read)
    assert again.toml == read.toml


def test_scenes_with_other_values_differ(scene):
    read = scene("target_step")
    assert read != read.replace({"friction.coefficient": 0.11})
    assert read == read.replace({"friction.coefficient": 0.1})
    assert read != "target_step"


def test_dictionaries_take_overrides_and_refuse_what_is_no_key(scene):
    values = scene("table_1_open_loop").values
    assert sonoglide.Scene.from_dict(values, {"drive.force_amplitude_N": 7}).values["drive"]["force_amplitude_N"] == 7
    with pytest.raises(sonoglide.SceneError, match="masse_kg"):
        sonoglide.Scene.from_dict({**values, "plant": {**values["plant"], "masse_kg": 1.0}})


def test_a_scene_shows_itself(scene):
    read = scene("target_step_q31", {"controller.shaping": "none"})
    assert repr(read) == "<sonoglide.Scene target_step_q31: dahl, closed loop in q31>"
    assert "<td>coefficient</td><td>0.1</td>" in read._repr_html_()
    assert repr(scene("table_1_open_loop")) == "<sonoglide.Scene table_1_open_loop: dahl, open loop>"


@pytest.mark.parametrize("made_again", [copy.copy, copy.deepcopy, lambda s: pickle.loads(pickle.dumps(s))])
def test_copies_and_pickles_are_the_same_scene(scene, made_again):
    read = scene("target_step", {"controller.arithmetic": "q15"})
    again = made_again(read)
    assert (again.name, again.values) == (read.name, read.values)
