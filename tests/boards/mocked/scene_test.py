"""The image of a scene meets the samples of the workstation's run and answers with the same commands, bit for
bit; the bridge makes each amplitude.

Usage: scene_test.py BOARD IMAGE.elf TRACE MOST [encoder]   (MOST: instructions of a step, its interrupt included;
encoder: the trace begins with its count)
"""
import importlib
import math
import random
import re
import struct
import sys
from pathlib import Path


def read(file):
    with open(file, encoding="ascii") as lines:
        return [[int(word) for word in line.split()] for line in lines]


def check_frequencies(half_periods, configuration, pairs_Hz):
    """The time that has passed is that of the frequencies asked for, within one pair of clocks."""
    text = configuration.read_text(encoding="utf-8")
    step_Hz = re.search(r"frequency_step_Hz = ([^;]+);", text)
    if not step_Hz:
        return
    start_s = float.fromhex(re.search(r"carrier_period_s = ([^;]+);", text).group(1))
    step = float.fromhex(step_Hz.group(1)) * start_s
    passed = sum(half_period for half_period, _ in half_periods)
    relative = sum(1 / (1 + step * frequency) for _, frequency in half_periods)
    start = pairs_Hz * start_s
    assert abs(passed - start * relative) < 1.1, f"{passed} pairs of clocks in place of {start * relative}"


def main():
    name, image, trace, most, *encoder = sys.argv[1:]
    board_of = importlib.import_module(name)
    board = board_of.Board(image)
    board.start()
    dice = random.Random(1)
    counts = []
    half_periods = []
    farthest = 0.0
    for number, step in enumerate(read(trace)):
        if encoder:
            board.turn_encoder(step.pop(0))
        force, velocity, force_at_rail, fresh, velocity_at_rail, *rest = step
        assert fresh, "a period without a sample is tested in unit_test.py"
        conversions = [board_of.conversions_of(force), board_of.conversions_of(velocity)]
        for codes, at_rail in zip(conversions, (force_at_rail, velocity_at_rail)):
            if at_rail:
                codes[-1] = 4095 if sum(codes) > len(codes) * 2048 else 0
        expected = rest
        if len(rest) > 6:  # with a vibration sensor
            in_phase, quadrature, *expected = rest
            conversions.append(board_of.vibration_of(in_phase, quadrature, dice))
        counts.append(board.period(*conversions))
        assert counts[-1] is not None, "the interrupt does not return"
        layout = "<ii4Bi" if len(expected) > 6 else "<ii4B"
        answer = list(struct.unpack(layout, board.uc.mem_read(board.symbols["last_answer"], struct.calcsize(layout))))
        assert answer == expected, f"step {number}: {answer} in place of {expected}"
        farthest = max(farthest, abs(board.written_amplitude() - answer[0] / 2**31))
        largest = 1 / 2048 + math.pi / (2 * board.half_period()) + math.pi / 2**14  # hal/bridge.hpp
        assert farthest <= largest, f"an amplitude is off by {farthest}"
        half_periods.append((board.half_period(), answer[-1] if len(expected) > 6 else 0))
    check_frequencies(half_periods, Path(trace).with_name("controller_configuration.hpp"), board_of.PAIRS_OF_CLOCKS_HZ)
    counts.sort()
    median = counts[len(counts) // 2]
    print(f"{len(counts)} periods: every command is the workstation's; a step takes {counts[0]} instructions at "
          f"least, {median} in the median, {counts[-1]} at most; amplitudes within {farthest:.5f}")
    assert median <= int(most), f"a step takes {median} instructions"


if __name__ == "__main__":
    main()
