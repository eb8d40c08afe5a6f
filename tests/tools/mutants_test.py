"""tools/mutants on a toy room, whose test notices the changes of one line and none of another.

Usage: mutants_test.py SOURCES SCRATCH CMAKE COMPILER
"""

import pathlib
import runpy
import subprocess
import sys
import unittest

import toy_room

SOURCES, SCRATCH = map(pathlib.Path, sys.argv[1:3])
CMAKE, COMPILER = sys.argv[3:5]

HEADER = """#pragma once

inline bool above(int value) {
  return value > 2;
}

inline bool below(int value) {
  return value < 9;
}
"""
# At the edges of the one, far from those of the other.
TEST = """#include "firmware/link/toy.hpp"
int main() {
  return above(3) && !above(2) && below(0) && !below(20) ? 0 : 1;
}
"""
SURVIVORS = ("return value <= 9;", "return value < 10;", "return value < 8;")


def accepted(changed, why="Nobody asks near the edge."):
    return f"\n\nfirmware/link/toy.hpp\n- return value < 9;\n+ {changed}\n{why}"


LIST = SCRATCH / "tests/firmware/equivalent_changes.txt"


def setUpModule():
    toy_room.make(SCRATCH, SOURCES / "tools/mutants", {"firmware/link/toy.hpp": HEADER, "tests/toy_test.cpp": TEST})
    LIST.parent.mkdir(parents=True)
    subprocess.run([CMAKE, "-G", "Ninja", "-B", "build/release", f"-DCMAKE_CXX_COMPILER={COMPILER}",
                    "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON"], cwd=SCRATCH, check=True, stdout=subprocess.DEVNULL)


class ToyRoom(unittest.TestCase):
    def judged(self, equivalent):
        LIST.write_text("# Accepted." + equivalent + "\n")
        return subprocess.run([sys.executable, SCRATCH / "tools/mutants", "100", "1", "link"], capture_output=True,
                              text=True)

    def test_shows_the_changes_that_no_test_notices(self):
        run = self.judged("")
        self.assertEqual(run.returncode, 1, run.stderr)
        self.assertEqual(run.stdout.count("killed: firmware/link/toy.hpp:4"), 3)
        self.assertIn("killed 3, timed out 0, survived 3, changes nothing 0, does not compile 0", run.stdout)
        for change in SURVIVORS:
            self.assertIn(f"- return value < 9;\n+ {change}\n", run.stdout)

    def test_leaves_out_what_is_listed_with_a_reason(self):
        run = self.judged("".join(map(accepted, SURVIVORS)))
        self.assertEqual(run.returncode, 0, run.stderr)
        self.assertIn("killed 3, timed out 0, survived 0", run.stdout)

    def test_refuses_a_list_that_is_out_of_date_or_has_no_reason(self):
        for entry in (accepted("return value < 11;"), accepted(SURVIVORS[0], why="")):
            run = self.judged(entry)
            self.assertEqual(run.returncode, 1)
            self.assertIn(entry.strip(), run.stderr)
            self.assertEqual(run.stdout, "")

    def test_the_list_of_the_sources_is_up_to_date(self):
        for header, *_ in runpy.run_path(str(SOURCES / "tools/mutants"))["equivalent"]():
            self.assertTrue((SOURCES / header).is_file())


class Sample(unittest.TestCase):
    def test_an_edit_elsewhere_leaves_the_order_of_the_other_changes(self):
        tool = runpy.run_path(str(SCRATCH / "tools/mutants"))
        header = SCRATCH / "firmware/link/toy.hpp"

        def ordered():
            return sorted(tool["changes"]("firmware/link/toy.hpp"), key=lambda change: tool["order"](change, 1))

        before = ordered()
        header.write_text("// A line before.\n" + HEADER.replace("value > 2", "value > 4"))
        after = ordered()
        header.write_text(HEADER)
        self.assertEqual([change for change in before if "<" in change[1]],
                         [change for change in after if "<" in change[1]])
        self.assertEqual(len(after), 6)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
