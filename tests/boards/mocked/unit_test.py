"""A unit on a mocked board: under orders of its host it drives, and whatever goes wrong, its legs are low.

Usage: unit_test.py BOARD IMAGE.elf
"""
import importlib
import random
import struct
import sys

from link import READ_HISTORY, READ_PARAMETER, RESTART, STOP, TARGET, WRITE_PARAMETER, Link
from machine import HARD_FAULT

DRIVE_LIMIT = 1
STATE_OFF, STATE_FAULT = 0, 4
MISSING, SATURATED, STALLED, WATCHDOG_RESET, IMAGE_DAMAGED = 17, 18, 34, 33, 38
BY_LINE, BY_CHIP = 65, 66  # external_1, external_2
TRIPPED = 13  # reason of a refusal
POWER_ON, BY_WATCHDOG, BY_CRYSTAL = 0, 2, 4
IN_MAIN = 400  # instructions between two steps

board_of = importlib.import_module(sys.argv[1])


class Unit:
    """With a contact whose friction falls as the drive rises, as timed::StandInContact."""

    def __init__(self, prepare=lambda board: None):
        self.board = board_of.Board(sys.argv[2])
        prepare(self.board)
        self.board.start()
        self.link = Link(self.board, self.period)
        self.friction = 0.5
        self.dice = 1
        self.counts = []

    def codes(self):
        amplitude = abs(self.board.written_amplitude()) if self.board.driven() else 0
        self.friction += ((0.05 / amplitude if amplitude > 0.1 else 0.5) - self.friction) / 2
        self.dice = self.dice * 1103515245 + 12345 & 0x7FFFFFFF
        force = min(round(2048 + 2048 * self.friction) + (self.dice >> 16) % 41 - 20, 4000)
        return [force] * board_of.CONVERSIONS, [2048 + 205] * board_of.CONVERSIONS

    def period(self, in_main=IN_MAIN, change=lambda force, velocity: None):
        force, velocity = self.codes()
        change(force, velocity)
        self.counts.append(self.board.period(force, velocity))
        assert self.counts[-1] is not None, "the interrupt does not return"
        if in_main:
            self.board.run(in_main)

    def periods(self, count, **options):
        for _ in range(count):
            self.period(**options)

    def drive(self):
        assert not self.link.ask(TARGET, struct.pack("<I", 400_000))[0]
        assert not self.link.ask(RESTART)[0]
        self.periods(200)
        assert self.board.driven(), f"the unit does not drive: {self.link.telemetry()}"

    def fails(self, fault):
        assert not self.board.driven(), "a leg is driven"
        self.periods(20)
        shown = self.link.telemetry()
        assert (shown["state"], shown["fault"]) == (STATE_FAULT, fault), shown
        assert not self.board.driven()


def orders():
    unit = Unit()
    shown = unit.link.telemetry()
    assert (shown["state"], shown["parameters"], shown["amplitude"]) == (STATE_OFF, 1, 0), shown
    assert not unit.board.driven()
    unit.drive()
    driven = sorted(unit.counts[-100:])
    assert not unit.link.ask(STOP)[0]
    unit.periods(2)
    assert not unit.board.driven()
    print(f"a step of the unit while it drives: {driven[0]} instructions at least, {driven[50]} in the median, "
          f"{driven[-1]} at most; under orders {max(unit.counts)} at most")
    return unit


def external_fault(unit):
    if not hasattr(unit.board, "hold_fault"):  # the bridge has to see to it
        return
    unit.drive()
    unit.board.hold_fault(True)
    assert not unit.board.driven(), "the timer does not hold the legs low"
    unit.period()
    unit.fails(BY_LINE)
    refused, payload = unit.link.ask(RESTART)
    assert refused and payload[1] == TRIPPED, payload
    unit.periods(50)
    assert not unit.board.driven(), "a restart overcomes the fault's line"
    unit.board.hold_fault(False)
    unit.periods(50)
    assert not unit.board.driven(), "it drives again by itself"
    unit.drive()
    unit.board.hold_fault(True)
    unit.board.hold_fault(False)  # within a carrier period
    unit.period()
    unit.fails(BY_LINE)
    unit.drive()

    open_line = Unit(lambda board: board.hold_fault(True))
    open_line.periods(2)
    open_line.fails(BY_LINE)
    open_line.board.hold_fault(False)
    open_line.drive()
    open_line.board.find_fault()
    open_line.period()
    open_line.fails(BY_CHIP)
    open_line.link.ask(RESTART)
    open_line.fails(BY_CHIP)


def bad_conversions(unit):
    def one(code):
        def change(force, _):
            force[2] = code
        return change

    for code in (0, 4095):
        unit.drive()
        unit.period(change=one(code))
        unit.fails(SATURATED)
    unit.drive()
    unit.board.lose_conversions = True
    unit.period()
    unit.board.lose_conversions = False
    unit.fails(MISSING)


def history(unit):
    """Boots, watchdog resets, cause of the last one, and whether it is written down."""
    boots, _, by_watchdog, _, _, cause, saved, anew = struct.unpack("<5I3B", unit.link.ask(READ_HISTORY)[1])
    assert not anew, "the history began anew"
    return boots, by_watchdog, cause, saved


def parameters(unit):
    unit.link.ask(STOP)
    unit.periods(20)
    assert history(unit) == (1, 0, POWER_ON, 1), history(unit)
    assert not unit.link.ask(WRITE_PARAMETER, struct.pack("<BI", DRIVE_LIMIT, 765_432))[0]
    stored = unit.board.parameters()

    def same(board):
        board.store(stored)  # RAM is another

    again = Unit(same)
    payload = again.link.ask(READ_PARAMETER, struct.pack("<B", DRIVE_LIMIT))[1]
    assert struct.unpack_from("<I", payload, 2) == (765_432,), payload
    assert again.link.telemetry()["parameters"] == 0
    for boots in range(2, 50):  # through both pages, and again
        assert history(again) == (boots, boots // 3, BY_WATCHDOG if boots % 3 == 0 else POWER_ON, 1), history(again)
        stored = again.board.parameters()
        again = Unit(lambda board: (same(board), boots % 3 == 2 and board.tell_watchdog_reset()))
    assert struct.unpack_from("<I", again.link.ask(READ_PARAMETER, struct.pack("<B", DRIVE_LIMIT))[1], 2) == (765_432,)


def any_damaged_bit(count):
    """Of the flash: the unit says so, or hangs where what it runs until then is damaged, and no leg is driven."""
    dice = random.Random(1)
    told = 0
    for _ in range(count):
        boards, driven = [], False

        def flip(board):
            boards.append(board)
            segments = list(board.elf.segments())
            address, content = dice.choices(segments, [len(each) for _, each in segments])[0]
            at = dice.randrange(len(content))
            while 0 <= address + at - board.symbols["image_checksum"] < 4:  # its name, which nothing reads
                at = dice.randrange(len(content))
            board.uc.mem_write(address + at, bytes([content[at] ^ 1 << dice.randrange(8)]))

        try:
            unit = Unit(flip)
            unit.link.ask(RESTART)
            for _ in range(30):
                unit.period()
                driven = driven or boards[0].driven()
            told += unit.link.telemetry()["fault"] == IMAGE_DAMAGED
        except Exception:  # it hangs, answers anything, or asks its board for what is not there
            pass
        assert not driven and not boards[0].driven(), "a damaged image drives"
    print(f"of {count} flipped bits the unit tells {told}; none of the others drives")
    assert told > count // 2


def damaged_image():
    """A bit that has flipped in flash, where nothing runs before the test: in the checksum, in front of it, and in a
    vector that nothing takes."""
    for symbol, offset in (("image_checksum", 4), ("image_checksum", -1), ("program_image", 28)):
        def flip(board):
            address = board.symbols[symbol] + offset
            board.uc.mem_write(address, bytes([board.uc.mem_read(address, 1)[0] ^ 1]))
        unit = Unit(flip)
        unit.fails(IMAGE_DAMAGED)
        assert unit.link.ask(RESTART)[0], "a damaged image starts"
        assert not unit.link.ask(STOP)[0]
        assert unit.link.ask(RESTART)[0], "a damaged image starts after a stop"
        unit.periods(50)
        assert not unit.board.follows_carrier(), "damaged code could drive by the carrier alone"


def hung_service(unit):
    unit.drive()
    while unit.board.driven():
        unit.period(in_main=0)
        assert unit.board.carrier_periods < 1_000_000
    started = unit.board.carrier_periods
    while not unit.board.reset_by_watchdog():
        unit.period(in_main=0)
        assert unit.board.carrier_periods < started + 8_000, "the watchdog does not reset"
        assert not unit.board.driven()

    again = Unit(lambda board: board.tell_watchdog_reset())
    shown = again.link.telemetry()
    assert (shown["state"], shown["fault"]) == (STATE_FAULT, WATCHDOG_RESET), shown
    assert not again.board.driven()


def failed_crystal(unit):
    if not hasattr(unit.board, "fail_crystal"):  # it is not watched
        return
    unit.drive()
    memory = unit.board.fail_crystal()
    assert not unit.board.driven(), "a leg is driven without the crystal"
    for cause in (BY_CRYSTAL, BY_WATCHDOG):  # it is told once
        again = Unit(lambda board: (board.keep_memory(memory), board.tell_watchdog_reset()))
        assert history(again)[2] == cause, history(again)
        assert again.link.telemetry()["fault"] == WATCHDOG_RESET
        memory = again.board.memory()


def exceptions(unit):
    unit.drive()
    unit.board.check_other_exceptions()
    assert unit.board.driven()
    assert unit.board.take(HARD_FAULT) is None, "a hard fault returns"
    assert not unit.board.driven(), "a leg is driven after a hard fault"


if __name__ == "__main__":
    served = orders()
    external_fault(served)
    bad_conversions(served)
    parameters(served)
    hung_service(served)
    damaged_image()
    any_damaged_bit(20)
    fresh = Unit()
    exceptions(fresh)
    failed_crystal(Unit())
