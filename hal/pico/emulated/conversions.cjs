// A sample of 32-bit codes as the converters of a Pico show it: four codes of 12 bits for either value.
const failed = 0x8000; // a conversion that failed
const top = 4095;

// Codes whose mean is this one, of 32 bits; with one at an end of the range where it says so.
function conversions(code, atRail) {
  const sum = (code + 2 ** 31) / 2 ** 18;
  if (!Number.isInteger(sum) || sum > 4 * top) {
    throw new Error(`no four conversions of 12 bits have the mean ${code}`);
  }
  const end = sum >= top ? top : 0;
  const [rest, count] = atRail ? [sum - end, 3] : [sum, 4];
  const part = Math.floor(rest / count);
  const codes = Array.from({length: count}, (_, i) => part + (i < rest % count ? 1 : 0));
  if (atRail) {
    codes.push(end);
  } else if (codes.some(one => one === 0 || one === top)) {
    throw new Error(`the mean ${code} has conversions at an end of the range`);
  }
  return codes;
}

// By channel, force and velocity, and by turn.
function conversionsOf({force, velocity, forceAtRail, velocityAtRail, fresh}) {
  const [forces, velocities] = [conversions(force, forceAtRail), conversions(velocity, velocityAtRail)];
  return [fresh ? forces : forces.map(code => code | failed), velocities];
}

module.exports = {conversionsOf};
