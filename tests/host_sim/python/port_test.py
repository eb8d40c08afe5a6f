import contextlib
import os
import re
import subprocess

import pytest

import sonoglide

BOARD = "mps2-an386"
FORCE_FULL_SCALE_N = pytest.approx(0.03924, rel=1e-12)


def image_of_scene(folder, *settings):
    file = folder / "unit.elf"
    scene = os.path.join(os.environ["SONOGLIDE_SCENES"], "target_step.toml")
    command = [os.environ["SONOGLIDE_PROGRAM"], "image", scene, "--board", BOARD, "--out", file, "--quiet"]
    subprocess.run(command + [f"--set={setting}" for setting in settings], check=True)
    return file


@pytest.fixture(scope="module")
def image(tmp_path_factory):
    return image_of_scene(tmp_path_factory.mktemp("unit"))


@contextlib.contextmanager
def running(image):
    """An emulated board whose serial line is a device."""
    command = ["qemu-system-arm", "-machine", BOARD, "-nic", "user,restrict=on", "-nodefaults", "-display", "none"]
    command += ["-icount", "shift=5", "-serial", "pty", "-kernel", image]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True) as emulator:
        try:
            device = re.search(r"/dev/pts/\d+", emulator.stdout.readline()).group()
            yield sonoglide.Port(device, patience_s=20.0)
        finally:
            emulator.kill()


@pytest.fixture
def unit(image):
    with running(image) as port:
        yield port


def test_a_unit_is_started_set_and_stopped(unit):
    assert unit.identity()["board"] == BOARD
    assert unit.identity()["version"] == sonoglide.__version__
    assert unit.status()["state"] == "off"
    assert not unit.holds_force
    scales = unit.identity()["full_scales"]
    assert scales.pop("sliding_velocity_m_per_s") > 0.0
    assert scales.pop("step_s") == 1.0 / 60e3
    assert scales == {"friction_force_N": FORCE_FULL_SCALE_N, "drive_amplitude_N": 1920.0, "target": 1.0}
    unit.restart()
    assert unit.status()["state"] != "off"
    unit.set_target(0.5)
    status = unit.status()
    assert status["target"] == 0.5
    assert status["fault"] == "none"
    assert unit.status()["period"] > status["period"]
    unit.stop()
    assert unit.status()["state"] == "off"
    assert unit.status()["drive_amplitude_N"] == 0.0
    assert 0.0 < unit.status()["friction_force_N"] < 0.03924
    assert unit.parameter("friction_force")["highest"] == 0.03924
    assert unit.faults() == []


def test_a_step_is_measured(unit):
    with pytest.raises(RuntimeError, match="the drive is off: restart it first"):
        unit.step(0.4, 0.7)
    unit.restart()
    with pytest.raises(ValueError, match="target: allowed is .* to 1"):
        unit.step(0.4, 1.5)
    with pytest.raises(ValueError, match="both targets are the same"):
        unit.step(0.4, 0.4)
    step = unit.step(0.4, 0.7)
    assert step["friction_force_before_N"] < step["friction_force_after_N"]
    assert 0.0 < step["rise_s"] < step["settling_s"]
    assert (step["limit"], step["settling"]) == ("none", "settled")
    trace = step["trace"]
    assert len(trace["time_s"]) == len(trace["friction_force_N"]) == 1024
    assert [target for time, target in zip(trace["time_s"], trace["target"]) if time >= 0.0][0] == 0.7
    assert unit.status()["target"] == 0.7


# The contact of an emulated board is always loaded: it reads half of full scale.
def test_a_tare_under_load_is_refused(unit):
    with pytest.raises(RuntimeError, match="the contact slides at .* under a friction of 19.62 mN: lift it, or let it stand still"):
        unit.tare()
    assert unit.parameter("force_offset")["value"] == 0.0
    assert unit.parameter("force_offset")["lowest"] == -0.00981
    unit.restart()
    with pytest.raises(RuntimeError, match="stop the drive first"):
        unit.tare()


def test_what_is_no_count_of_a_parameter_is_refused(unit):
    for name, value, why in (("start_on_power", 0.5, "no whole number"), ("host_timeout", 4e-4, "less than"),
                             ("stuck_periods", 12.5, "no whole number"), ("force_offset", 1e-12, "less than")):
        with pytest.raises(ValueError, match=f"{name}: {value:g} is {why}"):
            unit.set_parameter(name, value)
    with pytest.raises(ValueError, match="target: -1e-07 is less than"):
        unit.set_target(-1e-7)
    unit.set_parameter("force_gain", 1.0 / 1.1)
    assert unit.parameter("force_gain")["value"] == 0.909091


def test_a_board_without_pages_for_it_keeps_no_history(unit):
    assert unit.history() is None
    assert unit.exception() is None


def test_a_force_is_ordered_in_newtons(tmp_path):
    of_force = ("controller.target_friction_ratio=", "controller.target_friction_force_N=[[0.0, 0.01]]")
    with running(image_of_scene(tmp_path, *of_force)) as unit:
        assert unit.holds_force
        assert unit.identity()["full_scales"]["target_force_N"] == FORCE_FULL_SCALE_N
        assert unit.status()["target_force_N"] == 0.01
        unit.set_target(0.012)
        assert unit.status()["target_force_N"] == 0.012
        with pytest.raises(ValueError, match="target: allowed is 0 to 0.03924 N"):
            unit.set_target(0.05)
        assert unit.parameter("target")["highest"] == 0.03924


def test_a_refusal_has_its_reason(unit):
    with pytest.raises(ValueError, match="target: allowed is .* to 1"):
        unit.set_target(1.5)
    with pytest.raises(ValueError, match="target: allowed is"):
        unit.set_target(float("nan"))
    with pytest.raises(ValueError, match="unknown parameter; there are: target, drive_limit"):
        unit.parameter("gain")
    parameters = unit.parameters()
    assert parameters["drive_limit"]["lowest"] <= parameters["drive_limit"]["value"] <= 1.0
    unit.restart()
    with pytest.raises(RuntimeError, match="stop the drive first"):
        unit.set_parameter("drive_limit", 0.8)


@pytest.mark.parametrize("device", ["/dev/null", "no_such_device"])
def test_what_is_no_unit_is_named(device):
    with pytest.raises(OSError, match=device):
        sonoglide.Port(device)


def test_a_name_does_not_end_at_a_byte_0():
    with pytest.raises(OSError, match="No such file"):
        sonoglide.Port("/dev/null\0")


def test_what_cannot_be_commissioned_is_named(scene):
    with pytest.raises(OSError, match="no_such_device"):
        sonoglide.commission("no_such_device", scene("target_step"))
    with pytest.raises(ValueError, match=r"sensor\.force: .*; required: true"):
        sonoglide.commission("no_such_device", scene("wire_bonder"))


def test_a_unit_of_another_scene_is_not_commissioned(image, scene):
    with running(image) as port:
        device = port.device
        with port as same, pytest.raises(OSError, match=f"{device}: is used by another program"):
            assert same is port
            sonoglide.Port(device)
        port.close()
        with pytest.raises(OSError, match=f"{device}: this port is closed"):
            port.status()
        with pytest.raises(OSError, match=f"{device}: the unit has another design than the scene"):
            sonoglide.commission(device, scene("target_step", {"plant.stiffness_N_per_m": 120e6}))


def test_patience_has_a_range():
    with pytest.raises(ValueError, match="patience_s is 0; allowed: above 0"):
        sonoglide.Port("/dev/null", 0.0)
