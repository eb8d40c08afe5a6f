"""tools/coverage on a toy room, whose test reaches all but what the tool has to show.

Usage: coverage_test.py SOURCES SCRATCH
"""

import pathlib
import subprocess
import sys
import unittest

import toy_room

SOURCES, SCRATCH = map(pathlib.Path, sys.argv[1:3])

PRESETS = """{"version": 6, "configurePresets": [{"name": "coverage", "generator": "Ninja",
  "binaryDir": "${sourceDir}/build/coverage", "cacheVariables": {"CMAKE_CXX_COMPILER": "clang++",
  "CMAKE_CXX_FLAGS": "-fprofile-instr-generate -fcoverage-mapping"}}]}
"""
HEADER = """#pragma once

template <class Number>
bool below(Number value) {
  if (value < 9) {
    return true;
  }
  return false;
}

template <int most>
int limited(int value) {
  if constexpr (most > 0 && most < 9) {
    return value > most ? most : value;
  }
  return value;
}

inline bool both(bool one, bool other) {
  return one && other;
}

inline int not_called() {
  return 1;
}

template <class Number>
Number not_made(Number value) {
  return value;
}

/// At compile time.
constexpr int square(int side) {
  return side * side;
}
inline constexpr int nine = square(3);

enum class Way { left, right };

inline int sign(Way way) {
  switch (way) {
    case Way::left:
      return -1;
    case Way::right:
      break;
  }
  return 1;
}
"""
TEST = """#include "firmware/link/toy.hpp"
int main() {
  return below(1) && !below(20.0) && limited<5>(7) + limited<5>(3) + limited<0>(1) == nine &&
      sign(Way::left) + sign(Way::right) == 0 && MORE ? 0 : 1;
}
"""
ALL = "both(true, true) && !both(true, false) && !both(false, true) && not_called() == not_made(1)"


def setUpModule():
    toy_room.make(SCRATCH, SOURCES / "tools/coverage",
                  {"CMakePresets.json": PRESETS, "firmware/link/toy.hpp": HEADER, "tests/toy_test.cpp": TEST})


class ToyRoom(unittest.TestCase):
    def covered(self, more, room="link"):
        (SCRATCH / "tests/toy_test.cpp").write_text(TEST.replace("MORE", more))
        return subprocess.run([sys.executable, SCRATCH / "tools/coverage", room], capture_output=True, text=True)

    def test_shows_what_no_instance_of_a_template_reaches(self):
        run = self.covered("both(true, true)")
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertEqual([line for line in run.stdout.splitlines() if line.startswith("firmware")],
                         ["firmware/link/toy.hpp:20:10: never false", "firmware/link/toy.hpp:20:17: never false",
                          "firmware/link/toy.hpp:23: not run", "firmware/link/toy.hpp:24: not run",
                          "firmware/link/toy.hpp:25: not run", "firmware/link/toy.hpp:29: not run"])
        self.assertIn("less than its least coverage", run.stderr)

    def test_is_content_with_a_room_whose_tests_reach_all(self):
        run = self.covered(ALL)
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertRegex(run.stdout, "link +100.0 +100.0")

    def test_refuses_tests_that_fail_and_other_rooms(self):
        self.assertIn("link_tests fails", self.covered("below(30)").stderr)
        self.assertIn("Usage:", self.covered(ALL, "plant").stderr)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
