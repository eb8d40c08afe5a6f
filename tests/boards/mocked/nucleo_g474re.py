"""What an image finds on a Nucleo-G474RE, as far as its mocks know it. Source: ST, RM0440."""
import math
import struct

from unicorn.arm_const import UC_CPU_ARM_CORTEX_M4

from machine import Machine

CONVERSIONS = 16
PAIRS_OF_CLOCKS_HZ = 84e6
CARRIER_INTERRUPT = 25
NON_MASKABLE = 2

FLASH = 0x08000000
HISTORY = 0x0807E000  # and the parameters behind it
WATCHDOG, WATCHDOG_WINDOW = 0x40002C00, 0x40002C04
USART = 0x40004400
POWER_BOOST = 0x40007080
CARRIER, SAMPLING = 0x40012C00, 0x40013400
ENCODER = 0x40000C00
CONTROL_1, SLAVE, STATUS, RELOAD, COMPARE, BREAK = 0x00, 0x08, 0x10, 0x2C, 0x34, 0x44
TRANSFER_EVENTS, TRANSFER_CLEAR, TRANSFERS, REQUESTS = 0x40020000, 0x40020004, 0x40020008, 0x40020800
RCC_CONTROL, RCC_CONFIGURATION, RCC_PLL = 0x40021000, 0x40021008, 0x4002100C
RCC_INTERRUPTS, RCC_CAUSES = 0x4002101C, 0x40021094
FLASH_KEY, FLASH_STATUS, FLASH_CONTROL, FLASH_ECC = 0x40022008, 0x40022010, 0x40022014, 0x40022018
PORT_A, PORT_B, PORT_C = 0x48000000, 0x48000400, 0x48000800
CONVERTERS = {"force": 0x50000000, "velocity": 0x50000100, "vibration": 0x50000400}
PAIR = 0x50000308
OUTPUTS_ON = 1 << 15
BROKEN_BY_LINE, BROKEN_BY_CHIP = 1 << 7, 1 << 13
HALF_AND_WHOLE = (2, 1)  # bits of a transfer's events, of its first and its second block


class Board(Machine):
    peripheral_space = range(0x40000000, 0x60000000)
    streams = ()
    memory_space = range(0x20000000, 0x20018000)
    fast_memory = range(0x10000000, 0x10008000)

    def __init__(self, file):
        super().__init__(file, UC_CPU_ARM_CORTEX_M4,
                         [(FLASH, 0x40000), (0x08040000, 0x40000), (0x10000000, 0x8000), (0x20000000, 0x18000)],
                         [(0x40000000, 0x30000), (0x48000000, 0x1000), (0x50000000, 0x1000)])
        self.uc.mem_write(0x08040000, b"\xff" * 0x40000)
        self.registers = {FLASH_CONTROL: 1 << 31, PORT_A: 0xABFFFFFF,
                          PORT_B: 0xFFFFFEBF, PORT_C: 0xFFFFFFFF, POWER_BOOST: 1 << 8,
                          SAMPLING + RELOAD: 0xFFFF}
        self.events = {CARRIER: 0, SAMPLING: 0}
        self.waits = 0
        self.carrier_periods = 0  # since the counter runs
        self.reloaded = 0  # the period in which the watchdog was
        self.block = 0
        self.breaks = 0  # what holds the legs low: the line at PA6, a fault of the chip
        self.lose_conversions = False
        self.encoder = 0  # its count
        self.in_force = None  # reload and compare values of the present period
        self.sent = []
        self.received = 0
        self.keys = []
        self.reset(FLASH)

    def mark(self, base, bits):
        self.registers[base] = self.registers.get(base, 0) | bits

    def read(self, address):
        value = self.registers.get(address, 0)
        if address == RCC_CONTROL:
            return value | (value & (1 << 16 | 1 << 24)) << 1  # ready where on
        if address == RCC_CONFIGURATION:
            return value | (value & 3) << 2
        if address == CARRIER + STATUS:
            # The image waits for the first update before anybody is there to begin a period.
            if not self.events[CARRIER] & 1 and self.running() and self.in_force is None:
                self.waits += 1
                if self.waits > 2:
                    self.update()
            return self.events[CARRIER]
        if address == CARRIER + BREAK and self.breaks:
            return value & ~OUTPUTS_ON
        if address == WATCHDOG:
            return value & ~0x7F | self.count()
        if address == USART + 0x1C:
            return 1 << 7
        return value

    def write(self, address, value):
        if address in (CARRIER + STATUS, SAMPLING + STATUS):
            self.events[address & ~0x3FF] &= value
            self.events[CARRIER] |= self.breaks
            return
        if address == TRANSFER_CLEAR:
            self.registers[TRANSFER_EVENTS] = self.registers.get(TRANSFER_EVENTS, 0) & ~value
            return
        for base in CONVERTERS.values():
            if address == base:  # a set bit of the status clears it
                self.registers[base] = self.registers.get(base, 0) & ~value
                return
            if address == base + 8:
                if value & 1:
                    self.mark(base, 1)
                value &= ~(1 << 31)  # the calibration takes no time
        if address == WATCHDOG:
            window = self.registers.get(WATCHDOG_WINDOW, 0x7F) & 0x7F
            assert self.reloaded == 0 or self.count() <= window, "the watchdog is reloaded too early: a reset"
            self.reloaded = max(self.carrier_periods, 1)
        if address == FLASH_KEY:
            self.keys = [*self.keys, value][-2:]
            if self.keys == [0x45670123, 0xCDEF89AB]:
                self.registers[FLASH_CONTROL] &= ~(1 << 31)
            return
        if address == FLASH_CONTROL:
            if self.registers[FLASH_CONTROL] >> 31:
                return
            if value & 1 << 16:
                assert value & 1 << 11 and value & 2, "a page of the bank that holds the image is erased"
                page = value >> 3 & 0x7F
                self.uc.mem_write(0x08040000 + 0x800 * page, b"\xff" * 0x800)
        if address == FLASH_ECC:
            value = self.registers.get(FLASH_ECC, 0) & ~value
        if address == FLASH_STATUS:
            value = 0
        if address == RCC_CAUSES and value & 1 << 23:
            value = 0
        if address == CARRIER + BREAK and self.breaks:
            value &= ~OUTPUTS_ON
        if address == USART + 0x28:
            self.sent.append(value)
        self.registers[address] = value

    def hold_fault(self, held):
        """The line at PA6 is low."""
        self.breaks = BROKEN_BY_LINE if held else 0
        self._break()

    def find_fault(self):
        """Of its own, as a parity error of its RAM: it lasts until a reset."""
        self.breaks = BROKEN_BY_CHIP
        self._break()

    def fail_crystal(self):
        """Returns what the RAM then holds over the reset."""
        self.find_fault()
        self.registers[RCC_INTERRUPTS] = 1 << 8
        assert self.take(NON_MASKABLE) is None, "the image goes on without its crystal"
        return self.memory()

    def memory(self):
        return bytes(self.uc.mem_read(self.memory_space.start, len(self.memory_space)))

    def keep_memory(self, content):
        self.uc.mem_write(self.memory_space.start, content)

    def _break(self):
        self.events[CARRIER] |= self.breaks
        if self.breaks:
            self.registers[CARRIER + BREAK] = self.registers.get(CARRIER + BREAK, 0) & ~OUTPUTS_ON

    def running(self):
        return self.registers.get(CARRIER + CONTROL_1, 0) & 1

    def count(self):
        """Of the watchdog: falls from 127 by one in 4096 clocks times its divider."""
        divider = 4096 << (self.registers.get(WATCHDOG_WINDOW, 0) >> 11 & 7)
        periods = max(self.carrier_periods - self.reloaded, 0)  # no time passes before the first
        clocks = periods * 2 * self.registers.get(CARRIER + RELOAD, 1400)
        return max(0x7F - clocks // divider, 0)

    def update(self):
        """The end of a carrier period: what was written takes effect."""
        self.in_force = [self.registers.get(CARRIER + RELOAD, 0xFFFF)] + [
            self.registers.get(CARRIER + COMPARE + 4 * i, 0) for i in range(4)]
        self.events[CARRIER] |= 1
        self.carrier_periods += 1
        if self.registers.get(ENCODER + CONTROL_1, 0) & 1:
            self.latch_encoder()

    def latch_encoder(self):
        """The update of the carrier is the trigger that captures the count."""
        slave, inputs, third, outputs, top = (
            self.registers.get(ENCODER + offset, 0) for offset in (SLAVE, 0x18, 0x1C, 0x20, RELOAD))
        assert (slave, inputs & 0x303, third, outputs, top) == (3, 0x101, 3, 1 << 8, 0xFFFFFFFF), "no encoder is read"
        assert self.registers[CARRIER + 4] >> 4 & 7 == 2, "the carrier triggers nothing at its update"
        for port, pin, function in ((PORT_B, 2, 2), (PORT_C, 12, 1)):
            assert self.registers[port] >> 2 * pin & 3 == 2, "a pin is not its timer's"
            assert self.registers[port + 0x20 + 4 * (pin // 8)] >> 4 * (pin % 8) & 15 == function
        self.registers[ENCODER + COMPARE + 8] = self.encoder

    def turn_encoder(self, count):
        assert self.registers.get(ENCODER + CONTROL_1, 0) & 1, "the encoder's timer stands"
        self.encoder = count & 0xFFFFFFFF

    def transfer(self, channel):
        """Where a transfer leads: peripheral, memory, count and bytes of an element."""
        at = TRANSFERS + 0x14 * channel
        control, count, peripheral, memory = (self.registers[at + 4 * i] for i in range(4))
        assert control & 1 << 5 and control & 1 << 7 and control & 1, "it fills no ring"
        return peripheral, memory, count, 1 << (control >> 10 & 3)

    def convert(self, force, velocity, vibration=(2048,) * CONVERSIONS):
        """The conversions of a period: codes of 12 bits."""
        for codes, converter in ((force, "force"), (velocity, "velocity"), (vibration, "vibration")):
            if min(codes) < 1 or max(codes) > 4094:
                self.mark(CONVERTERS[converter], 1 << 7)
        peripheral, memory, count, size = self.transfer(0)
        assert (peripheral, count, size) == (PAIR + 4, 2 * CONVERSIONS, 4)
        assert self.registers[REQUESTS] == 5
        self.uc.mem_write(memory + 4 * CONVERSIONS * self.block, struct.pack(
            f"<{CONVERSIONS}I", *(f | v << 16 for f, v in zip(force, velocity))))
        peripheral, memory, count, size = self.transfer(1)
        assert (peripheral, count, size) == (CONVERTERS["vibration"] + 0x40, 2 * CONVERSIONS, 2)
        assert self.registers[REQUESTS + 4] == 37
        self.uc.mem_write(memory + 2 * CONVERSIONS * self.block, struct.pack(f"<{CONVERSIONS}H", *vibration))
        if self.lose_conversions:
            return
        event = 1 << HALF_AND_WHOLE[self.block]
        self.mark(TRANSFER_EVENTS, event | event << 4)
        self.block ^= 1

    def period(self, *conversions):
        """One carrier period: its conversions, then its interrupt. Returns the instructions of that."""
        self.convert(*conversions)
        self.update()
        return self.interrupt(CARRIER_INTERRUPT)

    def start(self):
        self.run_until(lambda: self.enabled(CARRIER_INTERRUPT) and
                       self.registers.get(CARRIER + 0x0C, 0) & 1)

    def half_period(self):
        return self.registers.get(CARRIER + RELOAD, 0xFFFF)

    def written_amplitude(self):
        """Of the fundamental that the registers will make from the next period on; of full scale."""
        half = self.half_period()
        a, a_top, b, b_top = (self.registers.get(CARRIER + COMPARE + 4 * i, 0) for i in range(4))
        assert a == half - b_top and b == half - a_top and (a == 0 or b == 0), "the pulses of the legs are not alike"
        assert max(a, b) <= half // 2, "the legs are high together"
        return math.sin(math.pi * (a - b) / half)

    def follows_carrier(self):
        """Whether the pins of the legs are the carrier's, and it may drive them."""
        on = self.read(CARRIER + BREAK) & OUTPUTS_ON
        modes = self.registers[PORT_A]
        return bool(on and modes >> 16 & 3 == 2)

    def driven(self):
        """Whether a leg is ever high."""
        return self.follows_carrier() and self.written_amplitude() != 0

    def hear(self, content):
        """Bytes on the serial line to the image."""
        peripheral, memory, _, size = self.transfer(2)
        assert (peripheral, size, self.registers[REQUESTS + 8]) == (USART + 0x24, 1, 26)
        for byte in content:
            self.uc.mem_write(memory + self.received, bytes([byte]))
            self.received = (self.received + 1) % 256
            self.registers[TRANSFERS + 0x14 * 2 + 4] = 256 - self.received

    def parameters(self):
        return bytes(self.uc.mem_read(HISTORY, 0x2000))

    def store(self, content):
        self.uc.mem_write(HISTORY, content)

    def reset_by_watchdog(self):
        return self.count() <= 0x3F

    def tell_watchdog_reset(self):
        self.registers[RCC_CAUSES] = 1 << 30

    def check_other_exceptions(self):
        """A word of flash that cannot be corrected is none that ends the image."""
        self.registers[FLASH_ECC] = 1 << 31
        assert self.take(NON_MASKABLE) is not None, "a spoilt word of flash ends the image"
        assert self.registers[FLASH_ECC] == 0


def demodulated(codes):
    """The codes of 14 bits that the image makes of 16 conversions, as it says in demodulation.hpp."""
    cosines = (32138, 27246, 18205, 6393)
    odd = [codes[i] - codes[i + 8] for i in range(8)]
    x = sum(cosines[i] * (odd[i] - odd[7 - i]) for i in range(4))
    y = -sum(cosines[3 - i] * (odd[i] + odd[7 - i]) for i in range(4))
    return tuple(min(max((value + (1 << 15)) >> 16, -8191), 8191) for value in (x, y))


def conversions_of(code):
    """16 conversions of 12 bits whose sum is a code of 16 bits, full scale 2^31."""
    total = (code >> 16) + 32768
    assert code & 0xFFFF == 0, f"{code} has more than 16 bits"
    total = min(max(total, CONVERSIONS), CONVERSIONS * 4094)
    return [total // CONVERSIONS + (1 if i < total % CONVERSIONS else 0) for i in range(CONVERSIONS)]


def vibration_of(in_phase, quadrature, dice):
    """16 conversions that show a phasor, whose codes have 14 bits."""
    wanted = (in_phase >> 18, quadrature >> 18)
    angles = [2 * math.pi * (i + 0.5) / CONVERSIONS for i in range(CONVERSIONS)]
    exact = [2048 + 2048 * (in_phase * math.cos(t) - quadrature * math.sin(t)) / 2**31 for t in angles]
    codes = [min(max(round(value), 1), 4094) for value in exact]
    for _ in range(10_000):
        if demodulated(codes) == wanted:
            return codes
        codes = [min(max(math.floor(value + dice.random()), 1), 4094) for value in exact]
    raise AssertionError(f"no conversions show {in_phase}, {quadrature}")
