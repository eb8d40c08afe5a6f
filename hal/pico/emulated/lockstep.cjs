// The scene image of a Pico in lockstep with its host, which has the plant: the frames of hal/lockstep/frame.hpp
// over standard input and output.
//
// The plant does a carrier period once it has the answer that the image still computes while the converters
// take that period. So they show marks of their period, input and turn, and where the image is about to read
// them, the codes of the sample take the places of these in RAM.
//
// Usage: node lockstep.cjs IMAGE.elf
const fs = require('node:fs');
const {Pico} = require('./pico.cjs');
const {conversionsOf} = require('./conversions.cjs');

const sampleBytes = 16;
const driveBytes = 24;
const pairsInPeriod = 4;
const blocks = 2;

const pico = new Pico(process.argv[2]);
const mark = (period, channel, turn) => (period & 511) << 3 | channel << 2 | turn;
pico.input = mark;
let answered = false;
pico.onControl = clocks => { answered = clocks; };
pico.onPeriod = (latched, late) => {
  if (late) {
    throw new Error(`the interrupt of carrier period ${pico.periods} is late`);
  }
};

// The next sample frame; null where the host has ended.
function receive() {
  const frame = Buffer.alloc(sampleBytes);
  for (let at = 0; at < sampleBytes;) {
    const count = fs.readSync(0, frame, at, sampleBytes - at);
    if (count === 0) {
      return null;
    }
    at += count;
  }
  return frame;
}

// Into the block of the DMA that holds the marks of a period.
function show(period, codes) {
  const pair = turn => mark(period, 0, turn) | mark(period, 1, turn) << 16;
  for (let block = 0; block < blocks; ++block) {
    const first = block * pairsInPeriod;
    if (pico.word('conversions', first) === pair(0)) {
      for (let turn = 0; turn < pairsInPeriod; ++turn) {
        if (pico.word('conversions', first + turn) !== pair(turn)) {
          throw new Error(`the DMA mixes up the conversions of carrier period ${period}`);
        }
        pico.setWord('conversions', first + turn, codes[0][turn] | codes[1][turn] << 16);
      }
      return;
    }
  }
  throw new Error(`the DMA has not carried the conversions of carrier period ${period}`);
}

function drive(period, clocks) {
  const frame = Buffer.alloc(driveBytes);
  frame.writeUInt32LE(period, 0);
  [0, 1, 2].forEach(index => frame.writeUInt32LE(pico.word('last_answer', index), 4 + 4 * index));
  frame.writeUInt32LE(clocks, 16);
  frame.writeUInt32LE(clocks, 20);
  return frame;
}

for (let period = 0, frame = receive(); frame !== null; ++period, frame = receive()) {
  if (frame.readUInt32LE(0) !== period) {
    throw new Error(`a sample of carrier period ${frame.readUInt32LE(0)} came in ${period}`);
  }
  pico.runWhile(() => !pico.inInterrupt);
  show(period, conversionsOf({
    force: frame.readInt32LE(4), velocity: frame.readInt32LE(8), forceAtRail: frame[12] !== 0,
    fresh: frame[13] !== 0, velocityAtRail: frame[14] !== 0}));
  answered = false;
  pico.runWhile(() => answered === false);
  fs.writeSync(1, drive(period, answered));
}
