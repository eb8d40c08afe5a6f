// A PWM slice that counts up and down, in place of that of rp2040js, whose period is two clocks short in this
// mode and which wraps at the top as well. Source: Raspberry Pi, RP2040 Datasheet, PWM.
const registers = {control: 0x00, divider: 0x04, counter: 0x08, compare: 0x0c, top: 0x10};
const upAndDown = 2;

class Slice {
  // wrapped: called where the counter is 0, with what is in force from then on.
  constructor(mcu, index, wrapped) {
    this.mcu = mcu;
    this.index = index;
    this.wrapped = wrapped;
    this.timer = {frequency: 0}; // rp2040js sets it with the clocks
    this.pinB1 = 2 * index + 1;
    this.pinB2 = this.pinB1 + 16;
    this.reset();
    this.alarm = mcu.clock.createAlarm(() => this.wrap());
  }

  reset() {
    this.values = new Map([[registers.divider, 16], [registers.top, 0xffff]]);
    this.latched = 0;
  }

  get en() { return this.get(registers.control) & 1; }
  set en(value) { this.writeRegister(registers.control, this.get(registers.control) & ~1 | (value ? 1 : 0)); }

  get(offset) { return this.values.get(offset) ?? 0; }
  readRegister(offset) { return this.get(offset); }
  gpioBChanged() {}

  get periodNanos() {
    return 2 * (this.get(registers.top) + 1) * 1e9 / this.mcu.clkSys;
  }

  writeRegister(offset, value) {
    const was = this.en;
    this.values.set(offset, value);
    if (offset === registers.control && this.en && !was) {
      if (!(value & upAndDown) || this.get(registers.divider) !== 16 || this.get(registers.counter) !== 0) {
        throw new Error('only a slice that counts every clock, up and down, from 0 is emulated');
      }
      this.begin = this.mcu.clock.nanos;
      this.periods = 0;
      this.latched = this.get(registers.compare);
      this.alarm.schedule(this.periodNanos);
    }
  }

  wrap() {
    this.latched = this.get(registers.compare);
    ++this.periods;
    // From the first period on, so that no rounding adds up.
    const next = this.begin + (this.periods + 1) * this.periodNanos;
    this.alarm.schedule(next - this.mcu.clock.nanos);
    this.mcu.pwm.channelInterrupt(this.index);
    this.wrapped(this.latched);
  }
}

module.exports = {Slice};
