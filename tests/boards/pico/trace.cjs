// What pico_trace wrote, as the converters of a Pico show it.
const fs = require('node:fs');

// Four codes of 12 bits whose mean is a code of 32 bits.
function conversions(code, atRail) {
  const sum = (code + 2 ** 31) / 2 ** 18;
  if (!Number.isInteger(sum) || sum > 4 * 4095) {
    throw new Error(`no four conversions of 12 bits have the mean ${code}`);
  }
  const quarter = Math.floor(sum / 4);
  const codes = [0, 1, 2, 3].map(i => quarter + (i < sum % 4 ? 1 : 0));
  if (atRail !== codes.some(one => one === 0 || one === 4095)) {
    throw new Error(`the mean ${code} is ${atRail ? 'not' : ''} at a rail`);
  }
  return codes;
}

function readTrace(file) {
  return fs.readFileSync(file, 'latin1').trimEnd().split('\n').map(line => {
    const [force, velocity, forceAtRail, fresh, velocityAtRail, ...answer] = line.split(' ').map(Number);
    const codes = [conversions(force, forceAtRail === 1), conversions(velocity, velocityAtRail === 1)];
    if (fresh === 0) {
      codes[0] = codes[0].map(code => code | 0x8000); // a conversion that failed
    }
    return {codes, answer};
  });
}

module.exports = {readTrace};
