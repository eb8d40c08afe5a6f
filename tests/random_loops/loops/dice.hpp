/// Random numbers that are the same on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>

#include "firmware/numeric/float_elementary.hpp"

namespace sonoglide::random_loops {

/// A stream for each pair of a seed and a number. The generator is the standard's, the
/// distributions are not: those of a library are its own. The core's exponential has the same bits
/// everywhere.
class Dice {
 public:
  Dice(std::uint32_t seed, std::uint32_t number) {
    std::seed_seq words{seed, number};
    generator_.seed(words);
  }

  /// [0, 1), 53 bits.
  double uniform() { return static_cast<double>(generator_() >> 11U) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  /// Its logarithm uniform.
  double over_decades(double low, double decades) {
    constexpr double ln_10 = 2.302585092994045684018;
    return low * numeric::exp(ln_10 * decades * uniform());
  }
  bool chance(double probability) { return uniform() < probability; }
  double sign() { return chance(0.5) ? 1.0 : -1.0; }
  int whole(int low, int high) {
    return low + static_cast<int>(uniform() * static_cast<double>(high - low + 1));
  }
  /// The index of one of some parts, by their percentages.
  template <class Percentages>
  std::size_t part(const Percentages& percentages) {
    double left = 100.0 * uniform();
    std::size_t index = 0;
    while (index + 1 < percentages.size() && left >= percentages[index]) {
      left -= percentages[index++];
    }
    return index;
  }

 private:
  std::mt19937_64 generator_;
};

}  // namespace sonoglide::random_loops
