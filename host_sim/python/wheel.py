"""The Python package, built by CMake: what it holds are CMake's install rules. pyproject.toml names the
classes below as the commands of setuptools.

SONOGLIDE_BUILD names a folder that is built already, as build/release; else one is made.
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

import setuptools
import setuptools.command.build_ext
import setuptools.command.egg_info
import setuptools.command.sdist

try:
    from setuptools.command.bdist_wheel import bdist_wheel  # setuptools 70.1 and newer
except ImportError:
    from wheel.bdist_wheel import bdist_wheel

SOURCE = pathlib.Path(__file__).resolve().parents[2]
VERSION = re.search(r"project\(sonoglide VERSION ([\d.]+)", (SOURCE / "CMakeLists.txt").read_text())[1]


def run(*words):
    subprocess.run(words, cwd=SOURCE, check=True)


class Build(setuptools.command.build_ext.build_ext):
    """Compiles the module and the engine of FMUs, and takes what CMake installs."""

    def run(self):
        folder = SOURCE / os.environ.get("SONOGLIDE_BUILD", self.build_temp)
        if not (folder / "CMakeCache.txt").exists():
            run("cmake", "-S", SOURCE, "-B", folder, "-DCMAKE_BUILD_TYPE=Release",
                "-DSONOGLIDE_PYTHON=ON", "-DSONOGLIDE_TESTS=OFF", "-DSONOGLIDE_WERROR=OFF",
                f"-DPython_EXECUTABLE={sys.executable}",
                *(["-G", "Ninja"] if shutil.which("ninja") else []))
        run("cmake", "--build", folder, "--target", "sonoglide_python_module",
            "--parallel", os.environ.get("CMAKE_BUILD_PARALLEL_LEVEL", str(os.cpu_count())))
        with tempfile.TemporaryDirectory() as prefix:
            run("cmake", "--install", folder, "--component", "python", "--prefix", prefix)
            package = next(pathlib.Path(prefix).rglob("sonoglide/__init__.py")).parent
            shutil.copytree(package, pathlib.Path(self.build_lib) / "sonoglide", dirs_exist_ok=True)


class SourceArchive(setuptools.command.sdist.sdist):
    """Holds the files that git knows."""

    def make_distribution(self):
        listed = subprocess.run(["git", "ls-files", "-z"], cwd=SOURCE, check=True,
                                capture_output=True, text=True)
        self.filelist.extend(name for name in listed.stdout.split("\0") if name)
        self.filelist.sort()
        self.filelist.remove_duplicates()
        super().make_distribution()


class Metadata(setuptools.command.egg_info.egg_info):
    """Is written below build/, which git ignores."""

    def initialize_options(self):
        super().initialize_options()
        self.egg_base = str(SOURCE / "build")
        pathlib.Path(self.egg_base).mkdir(exist_ok=True)


class Wheel(bdist_wheel):
    """Is one of a machine and an interpreter: CMake compiles the extension and knows its sources."""

    def finalize_options(self):
        self.distribution.ext_modules = [setuptools.Extension("sonoglide._core", [])]
        super().finalize_options()
