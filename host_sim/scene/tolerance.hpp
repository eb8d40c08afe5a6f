/// How far the plant may be from what its scene says, and where it is known to be elsewhere.
#pragma once

#include <string>

namespace sonoglide::scene {

/// What a tolerance tells of the true value.
enum class Spread {
  half_width,  ///< anywhere within `amount` of the scene's value, relative to that
  normal,      ///< about the scene's value, with the standard deviation `amount`, relative to that
  range,       ///< anywhere from `lowest` to `highest`
};

/// The true value of one key of a scene.
struct Tolerance {
  std::string key;  ///< `table.key`
  Spread spread = Spread::range;
  double amount = 0.0;   ///< half width or standard deviation, relative; > 0
  double nominal = 0.0;  ///< the scene's value
  /// No true value is outside: the ends of the half width or the range; with `normal` those of the
  /// range that the key has.
  double lowest = 0.0;
  double highest = 0.0;
  bool whole = false;  ///< integers alone
};

/// The key has this value in truth; the controller takes it for the one that the scene gives.
struct TrueValue {
  std::string key;  ///< `table.key`
  double value = 0.0;
  bool whole = false;
};

}  // namespace sonoglide::scene
