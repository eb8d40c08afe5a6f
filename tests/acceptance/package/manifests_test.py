"""What other build systems read of the sources: PlatformIO's library.json, Arduino's library.properties
and the Zephyr module. A sketch is compiled for a Cortex-M4F against exactly the files that each gives.

Usage: manifests_test.py SOURCES STRANGER SCRATCH VERSION COMPILER CMAKE TOOLCHAIN
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

import kconfiglib
import yaml

SOURCES, STRANGER, SCRATCH = map(pathlib.Path, sys.argv[1:4])
VERSION, COMPILER, CMAKE, TOOLCHAIN = sys.argv[4:8]
SKETCH = pathlib.Path(__file__).parent / "sketch"
SCRATCH.mkdir(parents=True, exist_ok=True)


def fresh(name):
    folder = SCRATCH / name
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    return folder


def run(*command, cwd=None):
    ended = subprocess.run(command, cwd=cwd, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    assert ended.returncode == 0, f"{command}\n{ended.stdout}"
    return ended.stdout


def translation_unit(folder):
    """The IDE puts Arduino.h before a sketch and compiles it as C++."""
    unit = folder / "sketch.cpp"
    unit.write_text('#include "Arduino.h"\n' + (SKETCH / "sketch.ino").read_text())
    return unit


def compile_sketch(*folders):
    run(COMPILER, "-mcpu=cortex-m4", "-mthumb", "-mfloat-abi=hard", "-mfpu=fpv4-sp-d16", "-Os",
        "-std=gnu++17", "-fno-exceptions", "-fno-rtti", "-ffp-contract=off", f"-I{SKETCH}",
        f"-I{STRANGER / 'controller'}", *(f"-I{folder}" for folder in folders), "-c", str(translation_unit(SCRATCH)),
        "-o", str(SCRATCH / "sketch.o"))


def missing_includes(folder):
    """What headers include that is not there: a sketch may include any of them."""
    return {f"{header.relative_to(folder)}: {name}" for header in folder.rglob("*.hpp")
            for name in re.findall(r'^#include "(.*)"$', header.read_text(), re.MULTILINE)
            if not (folder / name).is_file()}


class PlatformIO(unittest.TestCase):
    manifest = json.loads((SOURCES / "library.json").read_text())

    def test_has_the_fields_that_a_package_needs(self):
        self.assertEqual(self.manifest["version"], VERSION)
        for field in ("name", "description", "license", "authors", "frameworks", "platforms"):
            self.assertTrue(self.manifest[field], field)
        self.assertLessEqual(len(self.manifest["description"]), 255)

    def test_serves_a_sketch_with_what_it_exports(self):
        package = fresh("platformio")
        chosen = self.manifest["export"]
        left_out = [SOURCES / name for name in chosen["exclude"]]
        for name in chosen["include"]:
            source = SOURCES / name
            files = [source] if source.is_file() else [f for f in source.rglob("*") if f.is_file()]
            self.assertTrue(files, name)
            for file in files:
                if not any(each in file.parents for each in left_out):
                    target = package / file.relative_to(SOURCES)
                    target.parent.mkdir(parents=True, exist_ok=True)
                    shutil.copy(file, target)
        # srcFilter compiles nothing; there must be nothing to compile.
        self.assertEqual(self.manifest["build"]["srcFilter"], ["-<*>"])
        self.assertEqual(list(package.rglob("*.cpp")), [])
        build = self.manifest["build"]
        # A flag is relative to the package.
        folders = [package / build["includeDir"], *(package / flag.removeprefix("-I ") for flag in build["flags"])]
        self.assertTrue(any((folder / self.manifest["headers"]).is_file() for folder in folders))
        compile_sketch(*folders)
        self.assertEqual(missing_includes(package), set())


class Arduino(unittest.TestCase):
    manifest = dict(line.split("=", 1) for line in
                    (SOURCES / "tools/arduino/library.properties").read_text().splitlines())

    def test_has_the_fields_of_the_library_specification(self):
        self.assertEqual(self.manifest["version"], VERSION)
        for field in ("name", "author", "maintainer", "sentence", "paragraph", "url"):
            self.assertTrue(self.manifest[field], field)
        self.assertTrue(re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9 _.-]{0,62}", self.manifest["name"]))
        self.assertEqual(self.manifest["architectures"], "*")
        self.assertIn(self.manifest["category"], {
            "Display", "Communication", "Signal Input/Output", "Sensors", "Device Control", "Timing",
            "Data Storage", "Data Processing", "Other"})

    def test_is_a_library_that_compiles_nothing(self):
        library = fresh("arduino") / "Sonoglide"
        run(SOURCES / "tools/arduino/make_library", library)
        # The IDE looks for the library by a header at the top of src, and compiles what is below.
        self.assertEqual([f.name for f in (library / "src").glob("*.h*")], [self.manifest["includes"]])
        self.assertEqual({f.suffix for f in (library / "src").rglob("*.*")}, {".h", ".hpp"})
        self.assertTrue((library / "library.properties").is_file())
        compile_sketch(library / "src")
        self.assertEqual(missing_includes(library / "src"), set())

    def test_a_folder_that_is_there_stays(self):
        folder = fresh("arduino_there")
        ended = subprocess.run([SOURCES / "tools/arduino/make_library", folder], text=True, capture_output=True)
        self.assertEqual(ended.returncode, 2)
        self.assertIn("allowed: a new folder", ended.stderr)
        self.assertEqual(list(folder.iterdir()), [])


class Zephyr(unittest.TestCase):
    module = yaml.safe_load((SOURCES / "zephyr/module.yml").read_text())

    def test_names_files_that_are_there(self):
        self.assertEqual(self.module["name"], "sonoglide")
        self.assertTrue((SOURCES / self.module["build"]["cmake"] / "CMakeLists.txt").is_file())
        self.assertTrue((SOURCES / self.module["build"]["kconfig"]).is_file())

    def test_can_be_chosen_where_the_language_is_known(self):
        menu = SCRATCH / "Kconfig"
        for standard, allowed in (("STD_CPP17", 2), ("STD_CPP11", 0)):
            menu.write_text("".join(f'config {name}\n\tbool\n\tdefault y\n' for name in ("CPP", standard))
                            + "config REQUIRES_FULL_LIBCPP\n\tbool\n"
                            + f'source "{SOURCES / self.module["build"]["kconfig"]}"\n')
            configuration = kconfiglib.Kconfig(str(menu), warn_to_stderr=False)
            option = configuration.syms["SONOGLIDE"]
            option.set_value(2)
            self.assertEqual(option.tri_value, allowed, standard)
            self.assertEqual(configuration.syms["REQUIRES_FULL_LIBCPP"].tri_value, allowed)

    def test_serves_an_application(self):
        build = fresh("zephyr")
        configured = run(
            CMAKE, "-G", "Ninja", "-S", str(pathlib.Path(__file__).parent / "module"), "-B", str(build),
            f"-DCMAKE_TOOLCHAIN_FILE={TOOLCHAIN}", f"-DMODULE={SOURCES}",
            f"-DMODULE_CMAKE={self.module['build']['cmake']}", f"-DSTRANGER={STRANGER}",
            "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON")
        self.assertNotIn("Warning", configured)
        run(CMAKE, "--build", str(build))
        commands = json.loads((build / "compile_commands.json").read_text())
        self.assertEqual(len(commands), 1)
        self.assertIn("-ffp-contract=off", commands[0]["command"])
        self.assertNotIn("-Werror", commands[0]["command"])


class Citation(unittest.TestCase):
    def test_has_the_version(self):
        citation = yaml.safe_load((SOURCES / "CITATION.cff").read_text())
        self.assertEqual(citation["version"], VERSION)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
