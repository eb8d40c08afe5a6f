/// Random numbers for tests, the same on every machine.
#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace sonoglide::tests {

class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}

  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_() >> 11U) * 0x1p-53;
  }
  double decades(double low, double high) { return low * std::pow(high / low, between(0.0, 1.0)); }
  bool chance(double probability) { return between(0.0, 1.0) < probability; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace sonoglide::tests
