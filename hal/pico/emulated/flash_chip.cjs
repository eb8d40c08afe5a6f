// A flash chip at the end of the RP2040's SSI, in place of that of rp2040js, which reads nothing back.
const {BasePeripheral} = require('rp2040js');

const flashBytes = 2 << 20;
const sectorBytes = 4096;
const pageBytes = 256;
const eraseNanos = 45e6;
const programNanos = 0.4e6;

// Bits can only be cleared by programming and set by erasing. Busy for the time of a W25Q16JV.
class FlashChip {
  constructor() {
    this.bytes = new Uint8Array(flashBytes).fill(0xff);
    this.busyUntil = 0;
    this.writable = false;
    this.received = [];
  }

  select() { this.received = []; }

  deselect(now) {
    const [instruction, ...operands] = this.received;
    const address = operands[0] << 16 | operands[1] << 8 | operands[2];
    if (instruction === 0x06) {
      this.writable = true;
    } else if (this.writable && instruction === 0x20 && operands.length === 3) {
      const begin = address - address % sectorBytes;
      this.bytes.fill(0xff, begin, begin + sectorBytes);
      this.work(now, eraseNanos);
    } else if (this.writable && instruction === 0x02 && operands.length > 3) {
      operands.slice(3).forEach((value, i) => {
        const page = address - address % pageBytes;
        this.bytes[page + (address + i) % pageBytes] &= value;
      });
      this.work(now, programNanos);
    }
  }

  work(now, nanos) {
    this.busyUntil = now + nanos;
    this.writable = false;
  }

  // The answer to a byte, which comes while the byte goes.
  exchange(byte, now) {
    const count = this.received.push(byte);
    const [instruction] = this.received;
    if (instruction === 0x05) {
      return (now < this.busyUntil ? 1 : 0) | (this.writable ? 2 : 0);
    }
    if (now < this.busyUntil) {
      throw new Error('the flash is spoken to while it is busy');
    }
    if (instruction === 0x03 && count > 4) {
      const [, high, middle, low] = this.received;
      return this.bytes[(high << 16 | middle << 8 | low) + count - 5];
    }
    return 0xff;
  }
}

// The SSI: readable in the address space while it is set so; else byte by byte.
class FlashLink extends BasePeripheral {
  constructor(mcu, chip) {
    super(mcu, 'SSI');
    this.chip = chip;
    this.registers = new Map();
    this.selected = false;
    this.answers = [];
  }

  get(offset) { return this.registers.get(offset) ?? 0; }

  get inAddressSpace() {
    return this.get(0x08) === 1 && this.get(0x00) === 0x001f0300 && this.get(0xf4) === 0x03000218 &&
        this.get(0x14) >= 2 && !this.selected;
  }

  readUint32(offset) {
    if (offset === 0x28) {
      return 2 | 4 | (this.answers.length > 0 ? 8 : 0);
    }
    return offset === 0x60 ? this.answers.shift() ?? 0 : this.get(offset);
  }

  writeUint32(offset, value) {
    if (offset === 0x60) {
      const bytes = this.get(0x08) === 1 && this.get(0x00) === 0x00070000 && this.get(0x10) === 1;
      if (!bytes || !this.selected) {
        throw new Error('a byte for the flash without a link to it');
      }
      this.answers.push(this.chip.exchange(value & 0xff, this.rp2040.clock.nanos));
      return;
    }
    if (offset !== 0x08 && offset !== 0x10 && this.get(0x08) === 1) {
      throw new Error(`SSI register 0x${offset.toString(16)} is written while the SSI is on`);
    }
    this.registers.set(offset, value);
    this.show();
  }

  // What is not in the address space is read as nothing that could be taken for it.
  show() {
    const bytes = this.inAddressSpace ? this.chip.bytes : new Uint8Array(flashBytes).fill(0xde);
    this.rp2040.flash.set(bytes);
  }

  // By the override of the select pin.
  select(control) {
    const was = this.selected;
    this.selected = (control >> 8 & 3) === 2;
    if (this.selected && !was) {
      this.chip.select();
    } else if (was && !this.selected) {
      this.chip.deselect(this.rp2040.clock.nanos);
    }
  }
}

class FlashPins extends BasePeripheral {
  constructor(mcu, link) {
    super(mcu, 'IO_QSPI');
    this.link = link;
  }
  readUint32() { return 0; }
  writeUint32(offset, value) {
    if (offset === 0x0c) {
      this.link.select(value);
    }
  }
}

module.exports = {FlashChip, FlashLink, FlashPins};
