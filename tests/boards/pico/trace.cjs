// What pico_trace wrote, as the converters of a Pico show it.
const fs = require('node:fs');
const {conversionsOf} = require('../../../hal/pico/emulated/conversions.cjs');

function readTrace(file) {
  return fs.readFileSync(file, 'latin1').trimEnd().split('\n').map(line => {
    const [force, velocity, forceAtRail, fresh, velocityAtRail, ...answer] = line.split(' ').map(Number);
    return {codes: conversionsOf({force, velocity, forceAtRail: forceAtRail === 1, fresh: fresh === 1,
                                  velocityAtRail: velocityAtRail === 1}), answer};
  });
}

module.exports = {readTrace};
