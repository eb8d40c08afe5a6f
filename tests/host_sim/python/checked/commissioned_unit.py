"""A unit in a simulated plant is calibrated and commissioned. Usage: commissioned_unit.py STAND"""

import contextlib
import os
import pathlib
import subprocess
import sys

import sonoglide

SCENE = pathlib.Path(os.environ["SONOGLIDE_SCENES"]) / "target_step.toml"


@contextlib.contextmanager
def unit_in(*plant):
    """Of target_step, in a plant with these changes. -> its serial device"""
    with subprocess.Popen([sys.argv[1], *plant], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as stand:
        yield stand.stdout.readline().strip()
        stand.stdin.close()


def a_tare_saves_the_offset():
    lifted = ("true_values.friction.coefficient=1e-9", "sensor.adc_bits=12", "sensor.force_offset_N=0.001")
    for noise_N, equal in ((1e-5, False), (0.0, True)):
        with unit_in(*lifted, f"sensor.force_noise_N={noise_N}") as device:
            port = sonoglide.Port(device)
            told = port.tare()
            assert told["force_offset_before_N"] == 0.0, told
            # Of a converter of 12 bits; without noise, its step is an error that no mean takes away.
            assert abs(told["force_offset_N"] - 1e-3) < 0.03924 / 2**11, told
            assert (told["standard_error_N"] == 0.0) == equal == told["readings_equal"], told
            assert port.parameter("force_offset")["value"] == told["force_offset_N"]


def the_plant_is_found():
    with unit_in("sensor.adc_bits=12", "true_values.friction.coefficient=0.12") as device:
        study = sonoglide.commission(device, sonoglide.Scene(SCENE, {"sensor.adc_bits": 12}))
    assert abs(study["parameters"]["friction.coefficient"]["value"] - 0.12) < 0.12e-3, study
    assert study["warnings"] == [], study
    assert study.scene.name == "commissioned"


a_tare_saves_the_offset()
the_plant_is_found()
