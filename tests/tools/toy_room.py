"""A checkout with one room, link, for the tests of tools that judge tests."""

import shutil
import subprocess

CMAKE_LISTS = """cmake_minimum_required(VERSION 3.25)
project(toy CXX)
add_executable(link_tests tests/toy_test.cpp)
target_include_directories(link_tests PRIVATE .)
set_target_properties(link_tests PROPERTIES RUNTIME_OUTPUT_DIRECTORY bin)
"""


def make(folder, tool, files):
    """
    folder: made anew
    tool: path of the tool, which goes into tools/
    files: text of each by its name; of the test program tests/toy_test.cpp, of the room firmware/link/
    """
    shutil.rmtree(folder, ignore_errors=True)
    for name, text in {"CMakeLists.txt": CMAKE_LISTS, f"tools/{tool.name}": tool.read_text(), **files}.items():
        (folder / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / name).write_text(text)
    for command in (["git", "init", "-q"], ["git", "add", "."]):
        subprocess.run(command, cwd=folder, check=True)
