"""What every test of the Python module uses."""

import json
import os
import pathlib
import subprocess

import pytest

import sonoglide

SCENES = pathlib.Path(os.environ["SONOGLIDE_SCENES"])


@pytest.fixture
def scene():
    """Reads an example scene by its name."""

    def read(name, overrides={}):
        return sonoglide.Scene(SCENES / f"{name}.toml", overrides)

    return read


@pytest.fixture
def program():
    """What `sonoglide run --json` prints for an example scene."""

    def summary(name, *options):
        done = subprocess.run(
            [os.environ["SONOGLIDE_PROGRAM"], "run", SCENES / f"{name}.toml", "--json", "--quiet", *options],
            capture_output=True,
            check=True,
        )
        return json.loads(done.stdout)

    return summary
