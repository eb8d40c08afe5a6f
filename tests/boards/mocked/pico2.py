"""What an image finds on a Raspberry Pi Pico 2, as far as its mocks know it. Source: RP2350 Datasheet."""
import math
import struct

from unicorn.arm_const import UC_CPU_ARM_CORTEX_M33

from machine import Machine

CONVERSIONS = 4
PAIRS_OF_CLOCKS_HZ = 75e6
CARRIER_INTERRUPT = 8

FLASH = 0x10000000
HISTORY = 0x3FC000  # in the flash chip, and the parameters behind it
CLOCKS, RESETS, PINS, PADS = 0x40010000, 0x40020000, 0x40028000, 0x40038000
CRYSTAL, PLLS = 0x40048000, (0x40050000, 0x40058000)
UART, CONVERTER = 0x40070000, 0x400A0000
SLICE, SLICE_EVENTS = 0x400A8014, 0x400A80F4
CONTROL, COMPARE, TOP = 0x00, 0x0C, 0x10
LINK = 0x400D0000
WATCHDOG, WATCHDOG_TICKS = 0x400D8000, 0x40108030
TRANSFERS, TRANSFER_EVENTS = 0x50000000, 0x50000400
LEG_A, LEG_B = 2, 3
MODULATOR = 4


class FlashChip:
    """Answers byte by byte while it is selected; an instruction is carried out at its end."""

    def __init__(self):
        self.content = {HISTORY + i: 0xFF for i in range(0x4000)}
        self.bytes = []
        self.enabled = False

    def exchange(self, byte):
        self.bytes.append(byte)
        order, *rest = self.bytes
        if order == 0x03 and len(rest) > 3:
            return self.content[int.from_bytes(rest[:3], "big") + len(rest) - 4]
        return 0  # status: never busy

    def deselect(self):
        if not self.bytes:
            return
        order, *rest = self.bytes
        address = int.from_bytes(bytes(rest[:3]), "big")
        if order in (0x02, 0x20):
            assert self.enabled, "the flash is written without leave"
        if order == 0x20:
            self.content.update({address + i: 0xFF for i in range(0x1000)})
        if order == 0x02:
            for i, byte in enumerate(rest[3:]):
                self.content[address + i] &= byte
        self.enabled = order == 0x06
        self.bytes = []


class Board(Machine):
    peripheral_space = range(0x40000000, 0x60000000)
    streams = range(LINK, LINK + 0x10)
    memory_space = range(0x20040000, 0x20080000)
    fast_memory = range(0x20000000, 0x20080000)

    def __init__(self, file):
        super().__init__(file, UC_CPU_ARM_CORTEX_M33,
                         [(FLASH, 0x400000), (0x20000000, 0x80000)],
                         [(0x40000000, 0x200000), (0x50000000, 0x1000)])
        self.registers = {RESETS: 0x1FFFFFFF}
        self.chip = FlashChip()
        self.answers = []  # of the flash chip
        self.carrier_periods = 0
        self.fed = 0  # the period in which the watchdog was
        self.block = 1  # the first one passes before the carrier begins
        self.lose_conversions = False
        self.heard, self.sent = [], []
        definition = self.word(self.symbols["image_definition"])
        assert definition == 0xFFFFDED3, "the boot ROM finds no image"
        assert self.symbols["image_definition"] < FLASH + 0x1000, "the boot ROM looks at the first 4 KiB alone"
        self.reset(FLASH)

    def read(self, address):
        value = self.registers.get(address, 0)
        if address == RESETS + 8:
            return ~self.registers[RESETS] & 0x1FFFFFFF
        if address == CRYSTAL + 4:
            return 1 << 31
        if address in PLLS:
            return value | 1 << 31
        if address in (CLOCKS + 0x38, CLOCKS + 0x44):  # the source that is in force
            return 1 << (self.registers.get(address - 8, 0) & 3)
        if address == CONVERTER:
            return value | 1 << 8
        converting = self.registers.get(CONVERTER, 0) & 8
        if address == TRANSFER_EVENTS and converting and not self.enabled(CARRIER_INTERRUPT):
            return 3  # the image waits for the second block
        if address == LINK:
            return value | (0 if self.answers else 1 << 16)
        if address == LINK + 8:
            return self.answers.pop(0)
        if address == UART + 0x18:
            return 0 if self.heard else 1 << 4
        if address == UART:
            return self.heard.pop(0)
        return value

    def write(self, address, value):
        if address in (SLICE_EVENTS, TRANSFER_EVENTS):  # a set bit clears it
            self.registers[address] = self.registers.get(address, 0) & ~value
            return
        if address == UART:
            self.sent.append(value)
            return
        if address == LINK and not value & 1 << 2:
            self.chip.deselect()
        if address == LINK + 4:
            assert self.registers[LINK] & 1 and value & 1 << 19, "the flash does not hear it"
            self.answers.append(self.chip.exchange(value & 0xFF) if self.registers[LINK] & 4 else 0xFF)
            return
        if address == WATCHDOG + 4:
            self.fed = self.carrier_periods
        self.registers[address] = value

    def transfer(self, channel):
        """Where a transfer leads; 16 bits at a time."""
        at = TRANSFERS + 0x40 * channel
        peripheral, memory, count = (self.registers[at + 4 * i] for i in range(3))
        control = self.registers.get(at + 12, self.registers.get(at + 16))
        assert control & 0x3F == 1 | 1 << 2, "it reads another address, or another size"
        assert control >> 6 & 3 == 1 and control >> 8 & 0x1F == 4 | 1 << 4, "it fills no ring of 16 bytes"
        assert control >> 13 & 15 == 1 - channel and control >> 17 & 63 == 48
        assert peripheral == CONVERTER + 12 and count == 2 * CONVERSIONS
        return memory

    def convert(self, force, velocity):
        """The conversions of a period: codes of 12 bits, in turn."""
        if self.lose_conversions:
            return
        codes = [code for pair in zip(force, velocity) for code in pair]
        self.uc.mem_write(self.transfer(self.block), struct.pack(f"<{2 * CONVERSIONS}H", *codes))
        self.registers[TRANSFER_EVENTS] = self.registers.get(TRANSFER_EVENTS, 0) | 1 << self.block
        self.block ^= 1

    def period(self, *conversions):
        """One carrier period: its conversions, then its interrupt. Returns the instructions of that."""
        self.convert(*conversions)
        self.registers[SLICE_EVENTS] = self.registers.get(SLICE_EVENTS, 0) | 2
        self.carrier_periods += 1
        return self.interrupt(CARRIER_INTERRUPT)

    def start(self):
        self.block = 0
        self.run_until(lambda: self.enabled(CARRIER_INTERRUPT) and self.registers.get(SLICE_EVENTS + 4, 0) & 2)

    def half_period(self):
        return self.registers[SLICE + TOP] + 1

    def written_amplitude(self):
        """Of the fundamental that the registers will make from the next period on; of full scale."""
        a, b = (self.registers[SLICE + COMPARE] >> shift & 0xFFFF for shift in (0, 16))
        half = self.half_period()
        assert a == half - b, "the pulses of the legs are not alike"
        assert a <= half // 2, "the legs are high together"
        return math.sin(math.pi * a / half)

    def follows_carrier(self):
        """Whether the pins of the legs are the carrier's."""
        legs = [self.registers.get(PINS + 8 * leg + 4, 0x1F) for leg in (LEG_A, LEG_B)]
        return legs == [MODULATOR, MODULATOR]

    def driven(self):
        """Whether a leg is ever high."""
        return self.follows_carrier() and self.written_amplitude() != 0

    def hear(self, content):
        """Bytes on the serial line to the image."""
        self.heard.extend(content)

    def parameters(self):
        return dict(self.chip.content)

    def store(self, content):
        self.chip.content = dict(content)

    def reset_by_watchdog(self):
        assert self.registers[WATCHDOG] >> 30 & 1 and self.registers[WATCHDOG_TICKS + 4] == 12
        count = self.registers[WATCHDOG + 4]
        clocks = (self.carrier_periods - self.fed) * 2 * self.half_period()
        return clocks / 150 > count  # microseconds

    def tell_watchdog_reset(self):
        self.registers[WATCHDOG + 8] = 1
        self.registers[WATCHDOG + 12] = 0x536F6E6F  # the image's mark

    def check_other_exceptions(self):
        """There is none that may return."""


def conversions_of(code):
    """Four conversions of 12 bits whose sum is a code of 14 bits, full scale 2^31."""
    total = (code >> 18) + CONVERSIONS * 2048
    assert code & 0x3FFFF == 0, f"{code} has more than 14 bits"
    total = min(max(total, CONVERSIONS), CONVERSIONS * 4094)
    return [total // CONVERSIONS + (1 if i < total % CONVERSIONS else 0) for i in range(CONVERSIONS)]
