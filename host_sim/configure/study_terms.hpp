/// How a solver takes part in the studies of solvers.
#pragma once

namespace sonoglide::configure {

/// Settings of `sonoglide work-precision` for one order of a solver: tolerances from
/// 10^-first_decade down to 10^-last_decade, or 10^first_decade up to 10^last_decade steps for each
/// carrier period.
struct Sweep {
  int order;  ///< 0 where the solver has but one
  int first_decade;
  int last_decade;
};

/// Of a solver's curves there.
enum class Palette { blue, orange, green };

/// The orders that one row of `sonoglide stability` takes in each arithmetic.
struct TrialOrders {
  int float64;
  int float32;
};

/// A tolerance, or a number of steps for each carrier period, in each arithmetic.
struct TrialSettings {
  double float64;
  double float32;
};

}  // namespace sonoglide::configure
