"""What an image reads and writes until its carrier interrupts, against a list that somebody has looked through
with the reference manual in hand.

Usage: start_test.py BOARD IMAGE.elf GOLDEN [--write | PART]   (PART: a file of what this image does besides, once)
"""
import importlib
import itertools
import sys


def names_of(board):
    """Of the peripherals in the board's linker script, by address."""
    return sorted((value, name) for name, value in board.symbols.items() if value in board.peripheral_space)


def shown(board, name, value):
    """An address of the image's memory by its name: it is no property of the board."""
    if name not in ("transfers", "processor") or value not in board.memory_space:
        return f"{value:#010x}"
    at, symbol = max((at, symbol) for symbol, at in board.symbols.items()
                     if at <= value and symbol and symbol[0] != "$")
    return symbol + (f"+{value - at:#x}" if value > at else "")


def listed(board):
    names = names_of(board)
    while board.accesses[-1][0] == "read":  # of what follows the start
        board.accesses.pop()
    streamed = set()
    for (kind, address, value), repeats in itertools.groupby(board.accesses):
        if address in board.streams:  # words of a store: each kind of them once
            if (kind, address, value) in streamed:
                continue
            streamed.add((kind, address, value))
        base, name = max((entry for entry in names if entry[0] <= address), default=(0, "processor"))
        if address - base >= 0x100:
            base, name = 0, "processor"
        again = len(list(repeats))
        yield f"{kind} {name}+{address - base:#x} {shown(board, name, value)}" + (f" times {again}" if again > 1 else "")


def with_part(lines, part, found):
    """The lines with a part where the first of them is not the one that was found."""
    at = next((i for i, (line, other) in enumerate(zip(lines, found)) if line != other), len(lines))
    return lines[:at] + part + lines[at:]


def main():
    name, image, golden, *option = sys.argv[1:]
    board = importlib.import_module(name).Board(image)
    board.accesses = []
    board.start()
    text = "\n".join(listed(board)) + "\n"
    if option == ["--write"]:
        with open(golden, "w", encoding="ascii") as file:
            file.write(text)
        return
    with open(golden, encoding="ascii") as file:
        expected = file.read().splitlines()
    for part in option:
        with open(part, encoding="ascii") as file:
            expected = with_part(expected, file.read().splitlines(), text.splitlines())
    for number, (line, other) in enumerate(itertools.zip_longest(expected, text.splitlines()), 1):
        assert line == other, f"{golden}:{number}: {line}; the image: {other}"


if __name__ == "__main__":
    main()
