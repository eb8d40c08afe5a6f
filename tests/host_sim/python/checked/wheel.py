"""Builds a wheel of what is built already, installs it into an environment of its own, and uses it; and a
source archive. Nothing of it needs a network."""

import pathlib
import subprocess
import sys
import tarfile
import zipfile

SOURCE, BUILD, VERSION = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3]
FOLDER = pathlib.Path("wheel").resolve()

USE = """
import importlib.metadata, pathlib, sonoglide
assert sonoglide.__version__ == importlib.metadata.version("sonoglide") == VERSION
assert pathlib.Path(sonoglide.__file__).is_relative_to(pathlib.Path(FOLDER))
scene = sonoglide.Scene(sonoglide.scenes / "target_step.toml")
assert sonoglide.run(scene).summary["control"]["steps"][1]["target"] == 0.6
sonoglide.fmu(scene, "loop", pathlib.Path(FOLDER) / "loop.fmu")
assert len(list(sonoglide.notebooks.glob("*.ipynb"))) == 3
(entry,) = [each for each in importlib.metadata.entry_points(group="gymnasium.envs") if each.name == "sonoglide"]
assert entry.value == "sonoglide.gymnasium:register"
"""


def run(*words, **options):
    return subprocess.run(words, check=True, **options)


def listed(repository):
    return set(run("git", "ls-files", cwd=repository, capture_output=True, text=True).stdout.splitlines())


run("rm", "-rf", FOLDER)
run(sys.executable, "-m", "pip", "wheel", "--quiet", "--no-index", "--no-deps", "--no-build-isolation",
    "--wheel-dir", FOLDER, SOURCE, env={"SONOGLIDE_BUILD": BUILD, "PATH": "/usr/bin:/bin"})
(wheel,) = FOLDER.glob("sonoglide-*.whl")
names = set(zipfile.ZipFile(wheel).namelist())
python = {f"sonoglide/{path.name}" for path in (SOURCE / "host_sim/python/sonoglide").iterdir() if path.is_file()}
assert python <= names, python - names
assert "none-any" not in wheel.name

run(sys.executable, "-m", "venv", "--system-site-packages", FOLDER / "environment")
interpreter = FOLDER / "environment" / "bin" / "python"
run(interpreter, "-m", "pip", "install", "--quiet", "--no-index", wheel)
run(interpreter, "-c", USE.replace("VERSION", repr(VERSION)).replace("FOLDER", repr(str(FOLDER))), cwd=FOLDER,
    env={"PATH": "/usr/bin:/bin"})

run(sys.executable, "-c", f"from setuptools import build_meta; build_meta.build_sdist({str(FOLDER)!r})", cwd=SOURCE,
    stdout=subprocess.DEVNULL)
(archive,) = FOLDER.glob("sonoglide-*.tar.gz")
inside = {name.split("/", 1)[1] for name in tarfile.open(archive).getnames() if "/" in name}
missing = listed(SOURCE) - inside
assert not missing, f"{len(missing)} files are not in the archive: {sorted(missing)[:5]}"
