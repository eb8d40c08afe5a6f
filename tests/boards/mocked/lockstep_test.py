"""An image in lockstep over its serial line meets the samples of the workstation's run and answers with the same
commands, bit for bit.

Usage: lockstep_test.py BOARD IMAGE.elf TRACE
"""
import importlib
import struct
import sys

GREETING = 0xA5


def frame_of(period, step):
    """The sample's frame (hal/lockstep/frame.hpp), the layout of the answer, and the answer that is expected."""
    force, velocity, force_at_rail, fresh, velocity_at_rail, *rest = step
    frame = struct.pack("<Iii4B", period, force, velocity, force_at_rail, fresh, velocity_at_rail, 0)
    if len(rest) == 6:
        return frame, "<Iii4BII", rest
    in_phase, quadrature, *expected = rest
    return frame + struct.pack("<ii4B", in_phase, quadrature, 0, fresh, 0, 0), "<Iii4BIIi", expected


def main():
    name, image, trace = sys.argv[1:]
    board = importlib.import_module(name).Board(image)
    board.run_until(lambda: board.sent == [GREETING])
    with open(trace, encoding="ascii") as lines:
        steps = [[int(word) for word in line.split()] for line in lines]
    for period, step in enumerate(steps):
        frame, layout, expected = frame_of(period, step)
        board.sent.clear()
        board.hear(frame)
        board.run_until(lambda size=struct.calcsize(layout): len(board.sent) >= size)
        answered, *answer = struct.unpack(layout, bytes(board.sent))
        del answer[6:8]  # the cost; the mocks have no counter
        assert (answered, answer) == (period, expected), f"step {period}: {answer} in place of {expected}"
    assert not board.driven(), "the bridge is off in lockstep"
    print(f"{len(steps)} periods: every command is the workstation's")


if __name__ == "__main__":
    main()
