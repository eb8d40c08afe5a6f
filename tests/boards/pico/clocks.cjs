// What a control takes on the emulated Pico, held to clocks.csv exactly: dearer and cheaper both fail.
const assert = require('node:assert');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');

const table = path.join(__dirname, 'clocks.csv');
const renew = 'If this is meant, cmake --build --preset release --target write_clocks and commit the change.';

// image: its file; median and worst: clocks from the carrier's interrupt to its end
exports.hold = (image, median, worst) => {
  const name = path.parse(image).name;
  const compiler = execFileSync('arm-none-eabi-g++', ['-dumpfullversion'], {encoding: 'utf8'}).trim();
  const row = [name, compiler, median, worst].join(',');
  const [head, ...rows] = fs.readFileSync(table, 'utf8').trimEnd().split('\n');
  const isOfImage = line => line.startsWith(`${name},`);
  if (process.env.SONOGLIDE_WRITE_CLOCKS) {
    const renewed = [...rows.filter(line => !isOfImage(line)), row].sort();
    fs.writeFileSync(table, [head, ...renewed, ''].join('\n'));
    return;
  }
  assert.strictEqual(row, rows.find(isOfImage), renew);
};
