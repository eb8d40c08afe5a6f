// The image of a scene, on the emulated Pico, against the commands of the workstation.
//
// Usage: node scene_test.cjs IMAGE.elf TRACE
const assert = require('node:assert');
const {Pico} = require('../../../hal/pico/emulated/pico.cjs');
const {hold} = require('./clocks.cjs');
const {readTrace} = require('./trace.cjs');

const longestControl = 1900; // clocks from the carrier's interrupt to its end, of 2,200

const [, , image, file] = process.argv;
const trace = readTrace(file);
const pico = new Pico(image);
pico.input = (period, channel, turn) => trace[period]?.codes[channel][turn] ?? 2048;

// As the chip's memory shows the last answer: amplitude, ratio, then a byte each.
function answer() {
  const codes = pico.word('last_answer', 2);
  return [pico.word('last_answer') | 0, pico.word('last_answer', 1) | 0,
          codes & 255, codes >> 8 & 255, codes >> 16 & 255, codes >>> 24];
}

// The amplitude of the fundamental that the bridge makes.
function amplitude(compare) {
  const width = compare & 0xffff;
  assert.strictEqual(compare >>> 16, 1100 - width, 'the pulses of the two legs are not alike');
  return Math.sin(Math.PI * width / 1100);
}

const clocks = [];
pico.onControl = count => {
  assert.deepStrictEqual(answer(), trace[clocks.length].answer, `carrier period ${clocks.length}`);
  clocks.push(count);
};
let farthest = 0;
pico.onPeriod = (latched, late) => {
  assert.ok(!late, `the interrupt of period ${pico.periods} is late`);
  const answered = pico.periods - 2; // in force in the second period after that of its sample
  const wanted = answered < 0 ? 0 : trace[answered].answer[0] / 2 ** 31;
  farthest = Math.max(farthest, Math.abs(amplitude(latched) - wanted));
};
pico.runWhile(() => clocks.length < trace.length);

assert.strictEqual(pico.mcu.clkSys, 132e6);
assert.ok(farthest <= 1 / 2048 + Math.PI / 2200, `an amplitude is off by ${farthest}`);
const sorted = [...clocks].sort((a, b) => a - b);
const median = sorted[sorted.length >> 1];
const worst = sorted[sorted.length - 1];
console.log(`${trace.length} periods: every command is the workstation's; control takes ${
    median} clocks in the median, ${worst} at most, of 2200; ` +
    `the bridge makes each amplitude within ${farthest.toFixed(5)}`);
assert.ok(worst <= longestControl, `control takes ${worst} clocks`);
hold(image, median, worst);
