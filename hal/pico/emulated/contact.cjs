// A contact behind the converters and the bridge of the emulated Pico: its friction moves half of the way to its
// value in each carrier period, as that of timed::StandInContact.
class StandInContact {
  constructor() {
    this.amplitude = 0; // of full scale
    this.friction = 0.5;
  }

  // A carrier period with these compare values in force.
  live(latched) {
    this.amplitude = Math.sin(Math.PI * (latched & 0xffff) / 1100);
    this.friction += ((this.amplitude > 0.1 ? 0.05 / this.amplitude : 0.5) - this.friction) / 2;
  }

  // What a conversion of the force (0) or of the sliding velocity (1) shows, without its noise.
  code(channel) { return channel === 1 ? 2048 + 205 : Math.round(2048 + 2048 * this.friction); }
}

module.exports = {StandInContact};
