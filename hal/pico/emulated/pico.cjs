// A Raspberry Pi Pico that runs an image: rp2040js, with what it lacks or does otherwise than the chip.
//
// - No boot ROM: boot() does here what the ROM does with the second stage.
// - No flash behind the SSI (flash_chip.cjs), no PWM that counts up and down (slice.cjs).
// - The converter stays at its first input where it should take the inputs in turn, and an input is read at
//   the end of its conversion: it is read at its beginning here.
// - An interrupt takes no time: entry and exit take 15 clocks each here, those of a Cortex-M0+ without waits.
// - The UART takes bytes to be sent without limit: here they go at its baud rate, through 32 places.
// - The watchdog triggers for ever at one instant: it triggers once.
// - The instructions in flash wait for nothing. The program is in RAM, where the chip does not wait either,
//   unless the DMA wants the same bank at that clock.
// - No second core: the image does not start it.
const {RP2040} = require('rp2040js');
const {readImage} = require('./image.cjs');
const {FlashChip, FlashLink, FlashPins} = require('./flash_chip.cjs');
const {Slice} = require('./slice.cjs');

const carrierSlice = 1;
const exceptionClocks = 15;
const queueLength = 32;
const conversionsInPeriod = 8;
const flashBegin = 0x10000000;
const secondStage = {bytes: 256, address: 0x20041f00};

// As the boot ROM computes it: polynomial 0x04c11db7, high bit first, begun with ones, not inverted.
function checksum(bytes) {
  let result = 0xffffffff;
  for (const byte of bytes) {
    result ^= byte << 24;
    for (let bit = 0; bit < 8; ++bit) {
      result = result << 1 ^ (result < 0 ? 0x04c11db7 : 0);
    }
  }
  return result >>> 0;
}

class Pico {
  // image: an .elf or .uf2 file.
  constructor(image) {
    this.image = readImage(image);
    this.chip = new FlashChip();
    for (const {address, bytes} of this.image.segments) {
      this.chip.bytes.set(bytes, address - flashBegin);
    }
    this.input = () => 2048; // (period since the carrier began, 0: force or 1: velocity, 0 … 3) to a code
    this.onPeriod = () => {}; // (compare values in force), where a carrier period begins
    this.onControl = () => {}; // (clocks from there to the end of the interrupt)
    this.sent = [];
    this.toSend = [];
    this.resets = 0;
    this.start(0, []);
  }

  // What a power-on or the watchdog does.
  start(resetReason, scratch) {
    const mcu = new RP2040();
    this.chip.busyUntil -= this.mcu?.clock.nanos ?? 0;
    this.mcu = mcu;
    mcu.logger = {debug() {}, info() {}, ...Object.fromEntries(['warn', 'error'].map(
        level => [level, (name, text) => { throw new Error(`${name}: ${text}`); }]))};
    this.link = new FlashLink(mcu, this.chip);
    mcu.peripherals[0x18000] = this.link;
    mcu.peripherals[0x40018] = new FlashPins(mcu, this.link);
    mcu.pwm.channels[carrierSlice] = new Slice(mcu, carrierSlice, latched => this.beginPeriod(latched));
    this.connectConverter();
    this.connectUart();
    const watchdog = mcu.peripherals[0x40058];
    watchdog.reason = resetReason;
    scratch.forEach((word, i) => { watchdog.scratchData[i] = word; });
    watchdog.onWatchdogTrigger = () => {
      watchdog.alarm.enable = false;
      this.resetDue = true;
    };
    this.resetDue = false;
    this.inInterrupt = false;
    this.periods = 0;
    this.latest = 0;
    this.boot();
  }

  boot() {
    const stage = this.chip.bytes.subarray(0, secondStage.bytes);
    const stored = new DataView(stage.buffer, stage.byteOffset).getUint32(secondStage.bytes - 4, true);
    if (checksum(stage.subarray(0, -4)) !== stored) {
      throw new Error('the boot ROM refuses the second stage: its checksum is wrong');
    }
    this.mcu.sram.set(stage, secondStage.address - 0x20000000);
    this.mcu.core.SP = 0x20041800;
    this.mcu.core.PC = secondStage.address;
  }

  connectConverter() {
    const {adc} = this.mcu;
    let started = 0;
    let latched = 0;
    Object.defineProperty(adc, 'activeChannel', {
      get() { return this.cs >> 12 & 7; },
      set(channel) { this.cs = this.cs & ~(7 << 12) | channel << 12; },
    });
    const done = this.mcu.clock.createAlarm(() => adc.completeADCRead(latched & 0xfff, (latched & 0x8000) !== 0));
    adc.onADCRead = channel => {
      // The carrier begins after two blocks.
      const period = Math.floor(started / conversionsInPeriod) - 2;
      const turn = started++ % conversionsInPeriod;
      if (channel !== turn % 2) {
        throw new Error('the converter does not take force and velocity in turn');
      }
      latched = this.input(period, channel, turn >> 1);
      done.schedule(adc.sampleTime * 1000);
    };
  }

  connectUart() {
    const {clock, uart: [uart]} = this.mcu;
    this.uart = uart;
    const byteNanos = () => 10 * 1e9 / uart.baudRate;
    const outgoing = [];
    const send = clock.createAlarm(() => {
      this.sent.push(outgoing.shift());
      this.onByte?.();
      if (outgoing.length > 0) {
        send.schedule(byteNanos());
      }
    });
    uart.onByte = byte => {
      if (outgoing.push(byte) === 1) {
        send.schedule(byteNanos());
      }
    };
    Object.defineProperty(uart, 'flags', {get() {
      return (this.rxFIFO.full ? 1 << 6 : 0) | (this.rxFIFO.empty ? 1 << 4 : 0) |
          (outgoing.length >= queueLength ? 1 << 5 : 0) | (outgoing.length === 0 ? 1 << 7 : 0);
    }});
    this.receive = clock.createAlarm(() => {
      uart.feedByte(this.toSend.shift());
      if (this.toSend.length > 0) {
        this.receive.schedule(byteNanos());
      }
    });
    this.receiveNanos = byteNanos;
  }

  // To the unit, at its baud rate.
  send(bytes) {
    const idle = this.toSend.length === 0;
    this.toSend.push(...bytes);
    if (idle && bytes.length > 0) {
      this.receive.schedule(this.receiveNanos());
    }
  }

  beginPeriod(latched) {
    this.latest = this.mcu.clock.nanos;
    this.lateNow = this.inInterrupt;
    ++this.periods;
    this.onPeriod(latched, this.inInterrupt);
  }

  get seconds() { return this.mcu.clock.nanos / 1e9; }

  step() {
    const {core, clock} = this.mcu;
    let clocks = core.executeInstruction();
    if ((core.IPSR !== 0) !== this.inInterrupt) {
      clocks += exceptionClocks;
      this.inInterrupt = !this.inInterrupt;
      if (!this.inInterrupt) {
        clock.tick(clocks * 1e9 / this.mcu.clkSys);
        this.onControl(Math.round((clock.nanos - this.latest) * this.mcu.clkSys / 1e9));
        return;
      }
    }
    clock.tick(clocks * 1e9 / this.mcu.clkSys);
    if (this.resetDue) {
      ++this.resets;
      this.start(1, [...this.mcu.peripherals[0x40058].scratchData]);
    }
  }

  // While condition() holds, asked after each instruction.
  runWhile(condition) {
    while (condition()) {
      this.step();
    }
  }

  word(symbol, index = 0) { return this.mcu.readUint32(this.address(symbol, index)); }

  setWord(symbol, index, value) { this.mcu.writeUint32(this.address(symbol, index), value >>> 0); }

  address(symbol, index) { return this.image.symbols.get(symbol) + 4 * index; }
}

module.exports = {Pico, checksum};
