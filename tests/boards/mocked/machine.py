"""An image of a board in Unicorn, with mocks in the place of its peripherals.

It executes the instructions of the image and counts them. It knows neither time nor what a register means, but
for what a mock says of it.
"""
import struct

from unicorn import UC_ARCH_ARM, UC_HOOK_CODE, UC_MODE_MCLASS, UC_MODE_THUMB, Uc
from unicorn.arm_const import UC_ARM_REG_LR, UC_ARM_REG_PC, UC_ARM_REG_SP, UC_ARM_REG_XPSR

PAGE = 0x1000
SYSTEM = 0xE000E000
VECTOR_TABLE = 0xE000ED08
INTERRUPT_ENABLE = 0xE000E100
RETURN = 0x1FFF0000  # of an interrupt, in a page of its own
HARD_FAULT = 3
FIRST_INTERRUPT = 16
LOADED = 1


class Elf:
    def __init__(self, file):
        with open(file, "rb") as opened:
            self.content = opened.read()
        assert self.content[:4] == b"\x7fELF", f"{file} is no .elf file"

    def segments(self):
        """Address where it is kept, and content."""
        table, = struct.unpack_from("<I", self.content, 28)
        size, count = struct.unpack_from("<HH", self.content, 42)
        for i in range(count):
            kind, offset, _, address, length = struct.unpack_from("<5I", self.content, table + i * size)
            if kind == LOADED and length > 0:
                yield address, self.content[offset:offset + length]

    def symbols(self):
        table, = struct.unpack_from("<I", self.content, 32)
        size, count = struct.unpack_from("<HH", self.content, 46)
        sections = [struct.unpack_from("<10I", self.content, table + i * size) for i in range(count)]
        found = {}
        for section in sections:
            if section[1] == 2:  # a table of symbols
                names = sections[section[6]][4]
                for at in range(section[4], section[4] + section[5], 16):
                    name, value = struct.unpack_from("<II", self.content, at)
                    end = self.content.index(b"\0", names + name)
                    found[self.content[names + name:end].decode()] = value
        return found


class Machine:
    """memories: address and size of each; peripherals: likewise, answered by read() and write() of a board, which
    also has fast_memory: where the code of its interrupts is."""

    def __init__(self, file, model, memories, peripherals):
        self.elf = Elf(file)
        self.symbols = self.elf.symbols()
        self.uc = Uc(UC_ARCH_ARM, UC_MODE_THUMB | UC_MODE_MCLASS)
        self.uc.ctl_set_cpu_model(model)
        for address, size in [*memories, (RETURN, PAGE)]:
            self.uc.mem_map(address, size)
        for address, content in self.elf.segments():
            self.uc.mem_write(address, content)
        self.registers = {}
        self.accesses = None  # a list while they are recorded
        self.instructions = 0
        self.in_interrupt = False
        self.from_flash = set()  # of instructions that wait for a flash
        for address, size in [*peripherals, (SYSTEM, PAGE)]:
            self.uc.mmio_map(address, size, self._read, address, self._write, address)
        self.uc.hook_add(UC_HOOK_CODE, self._count)

    def _count(self, _, address, *__):
        self.instructions += 1
        if self.in_interrupt and address not in self.fast_memory:
            self.from_flash.add(address)

    def _read(self, _, offset, size, base):
        address = base + offset
        value = self.read(address & ~3) >> (8 * (address & 3)) & (1 << 8 * size) - 1
        if self.accesses is not None:
            self.accesses.append(("read", address, value))
        return value

    def _write(self, _, offset, size, value, base):
        address = base + offset
        assert size == 4, f"{size} bytes are written to {address:#x}"
        if self.accesses is not None:
            self.accesses.append(("write", address, value))
        self.write(address, value)

    # A register keeps what is written to it, unless a board says otherwise.
    def read(self, address):
        return self.registers.get(address, 0)

    def write(self, address, value):
        self.registers[address] = value

    def word(self, address):
        return struct.unpack("<I", self.uc.mem_read(address, 4))[0]

    def words(self, address, count):
        return struct.unpack(f"<{count}I", self.uc.mem_read(address, 4 * count))

    def reset(self, vectors):
        self.uc.reg_write(UC_ARM_REG_SP, self.word(vectors))
        self.uc.reg_write(UC_ARM_REG_PC, self.word(vectors + 4) | 1)

    def run(self, count):
        """So many instructions of main."""
        self.uc.emu_start(self.uc.reg_read(UC_ARM_REG_PC) | 1, RETURN, count=count)

    def run_until(self, finished, most=3_000_000, step=200):
        for _ in range(0, most, step):
            if finished():
                return
            self.run(step)
        raise AssertionError(f"it does not come to its end; at {self.uc.reg_read(UC_ARM_REG_PC):#x}")

    def handler(self, exception):
        return self.word(self.registers[VECTOR_TABLE] + 4 * exception)

    def enabled(self, interrupt):
        return self.registers.get(INTERRUPT_ENABLE + 4 * (interrupt // 32), 0) >> interrupt % 32 & 1

    def take(self, exception, most=20_000):
        """An exception or interrupt, and its return. The processor itself saves what the callee does not.
        Returns the number of instructions; None if it does not come back."""
        saved = self.uc.context_save()
        self.uc.reg_write(UC_ARM_REG_SP, (self.uc.reg_read(UC_ARM_REG_SP) - 0x68) & ~7)
        self.uc.reg_write(UC_ARM_REG_LR, RETURN | 1)
        # It may have come between an instruction and those that depend on its condition.
        self.uc.reg_write(UC_ARM_REG_XPSR, self.uc.reg_read(UC_ARM_REG_XPSR) & ~0x0600FC00)
        before = self.instructions
        self.uc.emu_start(self.handler(exception) | 1, RETURN, count=most)
        back = self.uc.reg_read(UC_ARM_REG_PC) & ~1 == RETURN
        if back:
            self.uc.context_restore(saved)
        return self.instructions - before if back else None

    def interrupt(self, number):
        assert self.enabled(number), f"interrupt {number} is not enabled"
        self.in_interrupt = True
        taken = self.take(FIRST_INTERRUPT + number)
        self.in_interrupt = False
        assert not self.from_flash, f"an interrupt runs from flash, at {min(self.from_flash):#x}"
        return taken
