// A unit on the emulated Pico under random orders of a host, with a contact behind its converters and its
// bridge: no carrier period is late, the host is answered, a bad conversion and a byte that is lost do what
// they should, what is saved is there after a reset, and a service that hangs ends in a reset with the drive
// at zero.
//
// Usage: node unit_test.cjs IMAGE SECONDS SEED   (IMAGE: an .elf or a .uf2 file)
const assert = require('node:assert');
const {Pico} = require('../../../hal/pico/emulated/pico.cjs');
const {StandInContact} = require('../../../hal/pico/emulated/contact.cjs');
const {hold} = require('./clocks.cjs');
const {Link, kinds} = require('./link.cjs');

const longestControl = 1900; // clocks from the carrier's interrupt to its end, of 2,200
const driveLimit = 1; // numbers of parameters
const hostTimeout = 7;
const refusedWhileDriving = 6;
const states = {off: 0, fault: 4};
const faults = {missing: 17, saturated: 18, overrun: 32, watchdogReset: 33};

const [, , image, seconds, seed] = process.argv;
let state = Number(seed) >>> 0;
function random(below) { // xorshift32
  state ^= state << 13;
  state ^= state >>> 17;
  state ^= state << 5;
  return (state >>> 0) % below;
}

const pico = new Pico(image);

const contact = new StandInContact();
const noise = () => random(41) - 20;
let oneConversion = null; // in the place of the next one of the force
pico.input = (period, channel, turn) => {
  const code = contact.code(channel) + (channel === 0 ? noise() : 0);
  const shown = channel === 0 && turn === 2 && oneConversion !== null ? oneConversion : code;
  oneConversion = shown === code ? oneConversion : null;
  return shown;
};

let worst = 0;
let controls = 0;
const counts = new Map();
pico.onControl = clocks => {
  ++controls;
  worst = Math.max(worst, clocks);
  counts.set(clocks, (counts.get(clocks) ?? 0) + 1);
};
pico.onPeriod = (latched, late) => {
  assert.ok(!late, `the interrupt of period ${pico.periods} is late`);
  contact.live(latched);
};

let answer = null;
const link = new Link(pico, frame => { answer = frame; });
const tally = {asked: 0, refused: 0};

// The answer to a request; none within 50 ms is a failure.
function ask(kind, ...fields) {
  answer = null;
  const end = pico.seconds + 0.05 + (kind === kinds.writeParameter ? 0.2 : 0);
  link.request(kind, ...fields);
  pico.runWhile(() => answer === null && pico.seconds < end);
  assert.ok(answer !== null, `request ${kind} is not answered at ${pico.seconds} s`);
  assert.strictEqual(answer.kind, kind);
  assert.strictEqual(answer.sequence, link.sequence);
  ++tally.asked;
  tally.refused += answer.refused ? 1 : 0;
  return answer;
}

function telemetry() {
  const {payload} = ask(kinds.telemetry);
  const [period, force, velocity, driven, target] = [0, 4, 8, 12, 16].map(at => payload.readInt32LE(at));
  return {period, force, velocity, amplitude: driven, target, state: payload[20], fault: payload[22],
          parameters: payload[23], lost: payload.readUInt16LE(24)};
}

function pause(duration) {
  const end = pico.seconds + duration;
  pico.runWhile(() => pico.seconds < end);
}

function act() {
  const chance = random(16);
  if (chance < 4) {
    ask(kinds.restart);
  } else if (chance < 6) {
    ask(kinds.stop);
  } else if (chance < 10) {
    ask(kinds.target, [100000 + random(800000), 4]);
  } else if (chance < 11) {
    const {refused, payload} = ask(kinds.writeParameter, [driveLimit, 1], [300000 + random(700001), 4]);
    assert.ok(!refused || payload[1] === refusedWhileDriving);
  } else {
    assert.notStrictEqual(telemetry().fault, faults.overrun);
  }
  pause(random(1000) * 5e-6);
}

// A unit that was never used erases a page for its history first; then it is off, and its drive at zero.
pause(0.06);
const first = telemetry();
assert.deepStrictEqual([first.state, first.parameters, first.amplitude], [states.off, 1, 0]);

let driven = 0;
while (pico.seconds < Number(seconds)) {
  act();
  driven += contact.amplitude > 0.1 ? 1 : 0;
}
assert.ok(driven > 0, 'the unit never drives');
assert.strictEqual(telemetry().lost, 0);
assert.strictEqual(pico.resets, 0);

// One conversion of four that failed, or that is at the end of its range, ends the drive.
function drive() {
  ask(kinds.target, [400000, 4]);
  ask(kinds.restart);
  pause(0.02);
  telemetry();
  assert.ok(contact.amplitude > 0.1, 'the unit does not drive');
}
for (const [code, fault] of [[2048 | 0x8000, faults.missing], [4095, faults.saturated], [0, faults.saturated]]) {
  drive();
  oneConversion = code;
  pause(60e-6);
  assert.strictEqual(contact.amplitude, 0);
  assert.strictEqual(telemetry().fault, fault);
}

// A byte that is lost costs its frame alone.
answer = null;
link.request(kinds.telemetry);
pico.toSend.splice(5, 1);
pause(0.01);
assert.strictEqual(answer, null);
assert.strictEqual(telemetry().lost, 1);

// What is saved is there after a reset, and a service that hangs is one.
ask(kinds.stop);
assert.ok(!ask(kinds.writeParameter, [driveLimit, 1], [765432, 4]).refused);
drive();
pico.runWhile(() => pico.inInterrupt);
const loop = 0x20041000; // above the stack
pico.mcu.writeUint16(loop, 0xe7fe); // b .
pico.mcu.core.PC = loop;
const hung = pico.seconds;
pico.runWhile(() => contact.amplitude > 0 && pico.seconds < hung + 0.06);
assert.strictEqual(contact.amplitude, 0, 'a hung service goes unnoticed');
pico.runWhile(() => pico.resets === 0 && pico.mcu.clock.nanos < (hung + 0.2) * 1e9);
assert.strictEqual(pico.resets, 1, 'the watchdog does not reset a hung unit');
pause(0.02);
const last = telemetry();
assert.deepStrictEqual([last.state, last.fault, last.parameters, contact.amplitude],
                       [states.fault, faults.watchdogReset, 0, 0]);
assert.strictEqual(ask(kinds.readParameter, [driveLimit, 1]).payload.readUInt32LE(2), 765432);

const history = ask(kinds.history).payload;
const [boots, , byWatchdog] = [0, 4, 8].map(at => history.readUInt32LE(at));
assert.deepStrictEqual([boots, byWatchdog, ...history.subarray(20)], [2, 1, 2, 1, 0], 'the history is not kept');

let below = 0;
const [median] = [...counts].sort(([a], [b]) => a - b).find(([, times]) => (below += times) * 2 >= controls);
console.log(`${controls} carrier periods, none late; ${tally.asked} requests answered, ${tally.refused} of ` +
    `them refused; control takes ${median} clocks in the median, ${worst} at most, of 2200`);
assert.ok(worst <= longestControl, `control takes ${worst} clocks`);
hold(image, '-', worst); // off in most of its periods, so the median says little
