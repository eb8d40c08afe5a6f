// What the carrier's interrupt of a unit takes on an emulated Pico, from a restart by its host on, with a contact
// behind its converters and its bridge. Prints clocks: the median, the most, and those of a carrier period.
//
// Usage: node unit_steps.cjs IMAGE.elf PERIODS RESTART   (RESTART: the frame that asks for it, in hexadecimal)
const {Pico} = require('./pico.cjs');
const {StandInContact} = require('./contact.cjs');

const [, , image, periods, restart] = process.argv;
const pico = new Pico(image);
const contact = new StandInContact();
let dice = 1;
pico.input = (period, channel) => {
  dice = (Math.imul(dice, 1103515245) + 12345) & 0x7fffffff;
  return contact.code(channel) + (dice >>> 16) % 41 - 20;
};
let latest = 0;
let clocksInPeriod = 0;
let late = false;
let driven = false;
pico.onPeriod = (latched, lateNow) => {
  clocksInPeriod = Math.round((pico.mcu.clock.nanos - latest) * pico.mcu.clkSys / 1e9);
  latest = pico.mcu.clock.nanos;
  late = late || lateNow;
  contact.live(latched);
  driven = driven || contact.amplitude > 0;
};
const clocks = [];
pico.onControl = count => clocks.push(count);
pico.send(Buffer.from(restart, 'hex'));
pico.runWhile(() => !driven && pico.seconds < 0.2);
if (!driven) {
  throw new Error('the unit does not drive');
}
const begin = clocks.length;
pico.runWhile(() => clocks.length < begin + Number(periods));
if (late) {
  throw new Error('an interrupt of the carrier is late');
}
const sorted = clocks.slice(begin - 4).sort((a, b) => a - b); // with the restart
console.log(sorted[sorted.length >> 1], sorted[sorted.length - 1], clocksInPeriod);
