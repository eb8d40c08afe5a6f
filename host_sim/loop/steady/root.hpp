/// Roots of functions of a positive number that have no value, NaN, at some places.
#pragma once

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace sonoglide::steady {

/// Of a root: a relative error of 1e-13.
inline constexpr int root_bits = 44;

/// Root by TOMS 748 where the function has one sign at `low` and the other at `high`.
///
/// @return NaN where the search comes by a place without a value
template <class Function>
double root_between(const Function& function, double low, double high) {
  bool missing = false;
  const auto or_end = [&](double place) {
    const double value = function(place);
    missing = missing || std::isnan(value);
    return missing ? 0.0 : value;  // which ends the search
  };
  const double at_low = or_end(low);
  const double at_high = missing ? 0.0 : or_end(high);
  std::uintmax_t evaluations = 100;
  const auto [below, above] = boost::math::tools::toms748_solve(
      or_end, low, high, at_low, at_high, boost::math::tools::eps_tolerance<double>(root_bits),
      evaluations);
  return missing ? std::numeric_limits<double>::quiet_NaN() : 0.5 * below + 0.5 * above;
}

/// Brackets the root of a function that falls, in steps that grow from a guess, and steps over
/// places without a value. Where the function rises again it looks for a root before its minimum.
template <class Function>
class FallingBracket {
 public:
  /// @param guess  > 0
  FallingBracket(const Function& function, double guess) : function_(function), low_(guess) {
    if (walk_down()) {
      walk_up(guess);
      found_ = std::isnan(missing_) ? !std::isnan(high_)
                                    : close_gap_from_below() || close_gap_from_above();
    }
  }

  explicit operator bool() const { return found_; }
  double low() const { return low_; }    ///< above 0 there
  double high() const { return high_; }  ///< at most 0 there

  /// Where the function is least, and above 0; NaN where it has a root or does not rise again.
  double minimum() const { return minimum_; }

 private:
  static constexpr double none = std::numeric_limits<double>::quiet_NaN();
  static constexpr int most_steps = 60;
  static constexpr int most_missing = 5;  ///< on each way; a search that fails takes long
  static constexpr int most_rises = 4;
  static constexpr int halvings = 10;

  /// Factors from one place to the next.
  struct Steps {
    double factor = 1.1;
    double next() { return std::exchange(factor, std::min(2.0, 1.1 * factor)); }
  };

  bool walk_down() {
    Steps steps;
    double value = function_(low_);
    for (int i = 0, missed = 0; !(value > 0.0); ++i) {
      missed += std::isnan(value) ? 1 : 0;
      if (i == most_steps || missed == most_missing) {
        return false;
      }
      (std::isnan(value) ? missing_ : high_) = low_;
      missing_ = std::isnan(value) ? missing_ : none;
      low_ /= steps.next();
      value = function_(low_);
    }
    low_value_ = value;
    return true;
  }

  void walk_up(double place) {
    Steps steps;
    double before = low_ / 2.0;
    int rises = 0;
    for (int i = 0, missed = 0; std::isnan(high_) && i < most_steps && missed < most_missing; ++i) {
      place *= steps.next();
      const double value = function_(place);
      if (std::isnan(value)) {
        missing_ = std::isnan(missing_) ? place : missing_;
        ++missed;
      } else if (value <= 0.0) {
        high_ = place;
      } else {
        rises = value > low_value_ ? rises + 1 : 0;
        if (rises == most_rises) {
          dip(before, place);
          return;
        }
        before = rises == 0 ? low_ : before;
        low_ = place;
        low_value_ = value;
        missing_ = none;
      }
    }
  }

  /// The minimum between two places.
  void dip(double from, double to) {
    constexpr int minimum_bits = 20;
    missing_ = none;
    if (!(function_(from) > 0.0)) {
      return;
    }
    const auto or_more = [&](double logarithm) {
      const double value = function_(std::exp(logarithm));
      return std::isnan(value) ? std::numeric_limits<double>::max() : value;
    };
    const auto [logarithm, least] =
        boost::math::tools::brent_find_minima(or_more, std::log(from), std::log(to), minimum_bits);
    low_ = from;
    (least > 0.0 ? minimum_ : high_) = std::exp(logarithm);
  }

  /// Whether the root is below what has no value.
  bool close_gap_from_below() {
    for (int i = 0, missed = 0; i < halvings && missed < most_missing; ++i) {
      const double place = std::sqrt(low_ * missing_);
      const double value = function_(place);
      missed += std::isnan(value) ? 1 : 0;
      if (value <= 0.0) {
        high_ = place;
        return true;
      }
      (value > 0.0 ? low_ : missing_) = place;
    }
    return false;
  }

  /// Whether it is above that.
  bool close_gap_from_above() {
    for (int i = 0, missed = 0; i < halvings && missed < most_missing && !std::isnan(high_); ++i) {
      const double place = std::sqrt(missing_ * high_);
      const double value = function_(place);
      missed += std::isnan(value) ? 1 : 0;
      if (value > 0.0) {
        low_ = place;
        return true;
      }
      (value <= 0.0 ? high_ : missing_) = place;
    }
    return false;
  }

  const Function& function_;
  double low_;
  double low_value_ = none;
  double high_ = none;     ///< the nearest place above low_ of those that are known
  double missing_ = none;  ///< likewise, without a value; below high_
  double minimum_ = none;
  bool found_ = false;
};

/// @return NaN where there is no bracket, or the search comes by a place without a value
template <class Function>
double root_in(const FallingBracket<Function>& bracket, const Function& function) {
  return bracket ? root_between(function, bracket.low(), bracket.high())
                 : std::numeric_limits<double>::quiet_NaN();
}

}  // namespace sonoglide::steady
