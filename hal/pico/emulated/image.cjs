// What is read of an image: its bytes in flash, and where its symbols are.
const fs = require('node:fs');

const elfMagic = 0x464c457f;
const loaded = 1; // kinds of segments and of sections
const symbolTable = 2;

function readElf(bytes) {
  const segments = [];
  const symbols = new Map();
  const table = bytes.readUInt32LE(28);
  for (let i = 0; i < bytes.readUInt16LE(44); ++i) {
    const [kind, offset, , address, size] = [0, 4, 8, 12, 16].map(
        field => bytes.readUInt32LE(table + i * bytes.readUInt16LE(42) + field));
    if (kind === loaded && size > 0) {
      segments.push({address, bytes: bytes.subarray(offset, offset + size)});
    }
  }
  const section = number => {
    const at = bytes.readUInt32LE(32) + number * bytes.readUInt16LE(46);
    return {kind: bytes.readUInt32LE(at + 4), offset: bytes.readUInt32LE(at + 16),
            size: bytes.readUInt32LE(at + 20), link: bytes.readUInt32LE(at + 24)};
  };
  for (let i = 0; i < bytes.readUInt16LE(48); ++i) {
    const {kind, offset, size, link} = section(i);
    for (let at = offset; kind === symbolTable && at < offset + size; at += 16) {
      const name = section(link).offset + bytes.readUInt32LE(at);
      symbols.set(bytes.toString('latin1', name, bytes.indexOf(0, name)), bytes.readUInt32LE(at + 4));
    }
  }
  return {segments, symbols};
}

// The blocks of a .uf2 file, each held to the format: https://github.com/microsoft/uf2
function readUf2(bytes) {
  const segments = [];
  for (let at = 0; at < bytes.length; at += 512) {
    const word = index => bytes.readUInt32LE(at + 4 * index);
    const right = word(0) === 0x0a324655 && word(1) === 0x9e5d5157 && word(127) === 0x0ab16f30 &&
        word(2) === 0x2000 && word(7) === 0xe48bff56 && word(4) === 256 && word(3) % 256 === 0 &&
        word(5) === at / 512 && word(6) === bytes.length / 512;
    if (!right) {
      throw new Error(`block ${at / 512} is none of a .uf2 for the RP2040`);
    }
    segments.push({address: word(3), bytes: bytes.subarray(at + 32, at + 32 + word(4))});
  }
  return {segments, symbols: new Map()};
}

// Of an .elf or a .uf2 file.
function readImage(file) {
  const bytes = fs.readFileSync(file);
  return bytes.readUInt32LE(0) === elfMagic ? readElf(bytes) : readUf2(bytes);
}

module.exports = {readImage};
