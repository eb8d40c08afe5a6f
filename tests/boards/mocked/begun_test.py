"""An image that defines begin_reset has it called before all else: no register is touched before, and the program is
not in RAM yet.

Usage: begun_test.py BOARD IMAGE.elf
"""
import importlib
import sys

from unicorn import UC_HOOK_CODE


def main():
    name, image = sys.argv[1:]
    board = importlib.import_module(name).Board(image)
    begin = board.symbols["begin_reset"] & ~1
    board.accesses = []
    begins = []

    def note(*_):
        begins.append((len(board.accesses), board.word(board.symbols["program_begin"])))

    board.uc.hook_add(UC_HOOK_CODE, note, begin=begin, end=begin)
    board.run_until(lambda: board.sent[-1:] == [ord("\n")])
    assert begins == [(0, 0)], f"register accesses and first word of the program before begin_reset: {begins}"
    line = bytes(board.sent).decode("ascii")
    assert line == "1 0 0 1001 0 0\n", f"resets, found and own values: {line}"


if __name__ == "__main__":
    main()
