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


def content(text):
    """What a JSON file of the program says, as if nobody had typed a command."""
    read = json.loads(text)
    read["program"]["command_line"] = None
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
        return content(done.stdout)

    return summary
