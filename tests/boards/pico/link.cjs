// The host's end of the framed link (firmware/link/README.md).
const zlib = require('node:zlib');

const version = 2;
const kinds = {telemetry: 1, target: 2, readParameter: 3, writeParameter: 4, restart: 5, stop: 6,
               fault: 7, confirm: 8, history: 17};
const refused = 0xff;
const answerBit = 0x80;

function crc32(bytes) {
  // Node before 22 has none of its own; a gzip file ends with one.
  return zlib.gzipSync(bytes, {level: 0}).readUInt32LE(zlib.gzipSync(bytes, {level: 0}).length - 8);
}

function stuff(bytes) {
  const wire = [0];
  let block = [];
  for (const byte of bytes) {
    if (byte === 0) {
      wire.push(block.length + 1, ...block);
      block = [];
    } else {
      block.push(byte);
    }
  }
  return [...wire, block.length + 1, ...block, 0];
}

function unstuff(wire) {
  const bytes = [];
  for (let at = 0; at < wire.length;) {
    const next = at + wire[at];
    bytes.push(...wire.slice(at + 1, next));
    at = next;
    if (at < wire.length) {
      bytes.push(0);
    }
  }
  return Buffer.from(bytes);
}

// Numbers of the given sizes in bytes, lowest byte first.
function payload(...fields) {
  const bytes = [];
  for (const [value, size] of fields) {
    for (let i = 0; i < size; ++i) {
      bytes.push(Math.floor(value / 256 ** i) & 255);
    }
  }
  return bytes;
}

class Link {
  // pico: its UART is the line. answered: called with each whole frame.
  constructor(pico, answered) {
    this.pico = pico;
    this.sequence = 0;
    pico.onByte = () => {
      if (pico.sent[pico.sent.length - 1] === 0) {
        const wire = pico.sent.splice(0).slice(0, -1);
        if (wire.length > 0) {
          answered(this.decode(wire));
        }
      }
    };
  }

  decode(wire) {
    const bytes = unstuff(wire);
    const content = bytes.subarray(0, -4);
    if (bytes[0] !== version || bytes.readUInt32LE(content.length) !== crc32(content)) {
      throw new Error('a damaged frame came from the unit');
    }
    const kind = content[1];
    return {kind: kind === refused ? content[4] : kind - answerBit, refused: kind === refused,
            sequence: content.readUInt16LE(2), payload: content.subarray(4)};
  }

  request(kind, ...fields) {
    this.sequence = (this.sequence + 1) & 0xffff;
    const content = [version, kind, this.sequence & 255, this.sequence >> 8, ...payload(...fields)];
    this.pico.send(stuff([...content, ...payload([crc32(Buffer.from(content)), 4])]));
  }
}

module.exports = {Link, kinds};
