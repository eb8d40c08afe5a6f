/// What the friction shows of a natural mode beside the drive.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/control/felt_table.hpp"
#include "firmware/control/mode_observer.hpp"
#include "firmware/control/place_estimate.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// The amplitudes of the sampled period and of the two before it.
template <class Scalar>
struct PastAmplitudes {
  Scalar now;
  Scalar before;
  Scalar earlier;
};

/// Observer of the natural mode, of a constant beside it and of the natural frequency, from one number
/// a period: the vibration velocity y that the measured friction ratio stands for (README.md):
///   w' = M w + b Δu,   y = |H| u + o + e·w + g Δu + h Δu₋₁,
/// Δu the last change of the amplitude u, Δu₋₁ the one before. M, b and H are those of ModeObserver.
/// e, g and h depend on the velocity ratio r = Vt/(|H| u + o). What was not foreseen corrects w and o
/// by the gains of a Kalman filter, and before that the place p in the table of natural frequencies
/// (PlaceEstimate), with the slope of the forecast carried along.
///
/// y, o, speeds: on the base of the sliding velocity; w: base eight times the largest kick; amplitudes:
/// base the largest. In fixed point what a gain lifts is limited to its base; a sum overflows by policy,
/// and only where a velocity or a mode leaves its base.
template <class Scalar>
class FeltObserver {
 public:
  struct Parameters {
    FeltTable<Scalar> table;
    std::uint8_t
        seen_base;  ///< fixed point: exponents of what e, g and h, the gains, the feedback and
    std::uint8_t gain_base;  ///< 1/|H| are multiples of; 0 in floating point
    std::uint8_t feedback_base;
    std::uint8_t inverse_base;
    numeric::Split<Scalar>
        linear;  ///< mode, per velocity |H| u + o, up to which readings are believed

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("table", self.table);
      visit("seen_base", self.seen_base);
      visit("gain_base", self.gain_base);
      visit("feedback_base", self.feedback_base);
      visit("inverse_base", self.inverse_base);
      visit("linear", self.linear);
    }
  };

  /// @param parameters  of which the table stays where it is: it outlives this
  explicit FeltObserver(const Parameters& parameters)
      : seen_base_(parameters.seen_base),
        gain_base_(parameters.gain_base),
        feedback_base_(parameters.feedback_base),
        inverse_base_(parameters.inverse_base),
        linear_(numeric::floating(parameters.linear)),
        row_(parameters.table) {
    restart();
  }

  /// After a copy from elsewhere. @param parameters  equal ones, as in the constructor
  void settle_at(const Parameters& parameters) { row_.settle_at(parameters.table); }

  /// At rest, and as it was believed at first.
  void restart() {
    mode_ = {};
    mode_slope_ = {};
    offset_ = {};
    offset_slope_ = {};
    place_.restart();
    row_.go(place_.place());
  }

  /// A period passes, in which the amplitude is another by this.
  void pass(Scalar change) {
    constexpr Scalar keep = numeric::from_real<Scalar>(0.9);  // an old slope is no longer linear
    const Pair<Scalar> slope = turned(mode_slope_, value_of(felt::turn)) * keep;
    mode_slope_ = slope + turned(mode_, slope_of(felt::turn)) + slope_of(felt::kick) * change;
    mode_ = next(mode_, change);
  }

  /// One call for each usable reading, after pass().
  /// @param velocity  y; `highest` where the reading is beyond all velocities
  /// @param speed     |Vt| > 0
  /// @param wanted    velocity that is asked for
  void observe(Scalar velocity, Scalar speed, const PastAmplitudes<Scalar>& u, Scalar wanted) {
    const Scalar driven = row_[felt::forced] * u.now + offset_;
    const Scalar before = row_[felt::forced] * numeric::min(u.before, u.earlier) + offset_;
    // At a velocity below that of the sliding nothing is felt.
    if (!(speed < driven && speed < before) || !believed(driven)) {
      return;
    }
    row_.look(ratio(speed, driven));
    const Scalar last = u.now - u.before;
    const Scalar before_last = u.before - u.earlier;
    const Scalar forecast = driven + seen(mode_, last, before_last);
    constexpr Scalar highest = numeric::from_code<Scalar>(INT32_MAX);
    if (!(velocity < highest) && !(forecast < highest)) {
      return;
    }
    const Scalar most = numeric::from_real<Scalar>(0.3) * speed;
    Scalar miss = numeric::clamp(velocity - forecast, -most, most);
    const Scalar tilt = slope_of_forecast(last, before_last);
    const Scalar noise = row_.of_node(felt::noise);
    if (numeric::twice(noise) + noise < numeric::abs(tilt)) {
      miss = miss - correct_place(tilt, miss, noise);
    }
    correct(miss, tilt, numeric::abs(miss) < numeric::twice(noise) + noise);
    offset_ = numeric::clamp(offset_, numeric::from_real<Scalar>(-0.5),
                             numeric::from_real<Scalar>(0.6) * wanted);
  }

  const Pair<Scalar>& mode() const { return mode_; }  ///< w, in the sampled period
  Scalar place() const { return place_.place(); }     ///< p

  /// w a period later, in which the amplitude is another by this.
  Pair<Scalar> next(const Pair<Scalar>& mode, Scalar change) const {
    return turned(mode, value_of(felt::turn)) + value_of(felt::kick) * change;
  }

  /// (v − o)/|H|: the amplitude that brings y to v without a mode, a quarter of it.
  Scalar quarter_amplitude(Scalar velocity) const {
    return lowered(row_[felt::per_velocity] * (velocity - offset_), inverse_base_ - 2);
  }

  /// |H| u: what the drive alone makes, of an amplitude.
  Scalar believed_velocity(Scalar amplitude) const { return row_[felt::forced] * amplitude; }

  /// K (w, u − u*)
  Scalar feedback(const Pair<Scalar>& mode, Scalar error) const {
    return numeric::lifted(row_[felt::feedback] * mode.first +
                               row_[felt::feedback + 1] * mode.second +
                               row_[felt::feedback + 2] * error,
                           feedback_base_);
  }

 private:
  Pair<Scalar> value_of(std::size_t i) const { return {row_[i], row_[i + 1]}; }
  Pair<Scalar> slope_of(std::size_t i) const { return {row_.slope(i), row_.slope(i + 1)}; }

  /// a/b, 0 < a < b
  static Scalar ratio(Scalar a, Scalar b) {
    const auto quotient = numeric::quotient(numeric::floating(a), numeric::floating(b));
    if constexpr (numeric::is_fixed_point_v<Scalar>) {
      return numeric::scale_by_power_of_two(quotient.mantissa, quotient.exponent);
    } else {
      return quotient;
    }
  }

  /// The friction of a contact follows a large mode no longer linearly.
  bool believed(Scalar driven) const {
    const Scalar size = numeric::max(numeric::abs(mode_.first), numeric::abs(mode_.second));
    return !(numeric::limited_product(driven, linear_) < size);
  }

  /// e·w + g Δu + h Δu₋₁
  Scalar seen(const Pair<Scalar>& mode, Scalar last, Scalar before) const {
    return numeric::lifted(
        row_.of_node(felt::seen) * mode.first + row_.of_node(felt::seen + 1) * mode.second +
            row_.of_node(felt::last_change) * last + row_.of_node(felt::change_before) * before,
        seen_base_);
  }

  Scalar slope_of_forecast(Scalar last, Scalar before) const {
    const Scalar of_table = numeric::lifted(row_.slope_of_node(felt::seen) * mode_.first +
                                                row_.slope_of_node(felt::seen + 1) * mode_.second +
                                                row_.slope_of_node(felt::last_change) * last +
                                                row_.slope_of_node(felt::change_before) * before,
                                            seen_base_);
    return of_table + seen(mode_slope_, Scalar{}, Scalar{}) + offset_slope_;
  }

  /// @return what the forecast rises by
  Scalar correct_place(Scalar tilt, Scalar miss, Scalar noise) {
    constexpr int base = PlaceEstimate<Scalar>::base;
    // As if the place were known to be 0 within a quarter or so.
    constexpr Scalar prior =
        numeric::from_real<Scalar>(20.0 / static_cast<double>(std::int32_t{1} << base));
    const Scalar most = numeric::scale_by_power_of_two(noise, 2);
    place_.weigh(prior * (noise * noise));
    const Scalar moved = place_.move(numeric::scale_by_power_of_two(tilt * tilt, -base),
                                     tilt * numeric::clamp(miss, -most, most));
    row_.go(place_.place());
    mode_ = mode_ + mode_slope_ * moved;
    offset_ = offset_ + offset_slope_ * moved;
    return tilt * moved;
  }

  /// @param quiet  no more than noise: a quarter of the gain
  void correct(Scalar miss, Scalar tilt, bool quiet) {
    const int less = quiet ? -2 : 0;
    const Scalar error = numeric::scale_by_power_of_two(miss, less);
    const Scalar slope = numeric::scale_by_power_of_two(tilt, less);
    mode_ =
        mode_ + Pair<Scalar>{gained(felt::mode_gain, error), gained(felt::mode_gain + 1, error)};
    mode_slope_ = mode_slope_ -
                  Pair<Scalar>{gained(felt::mode_gain, slope), gained(felt::mode_gain + 1, slope)};
    offset_ = offset_ + gained(felt::offset_gain, error);
    offset_slope_ = offset_slope_ - gained(felt::offset_gain, slope);
  }

  Scalar gained(std::size_t i, Scalar miss) const {
    return numeric::lifted(row_.of_node(i) * miss, gain_base_);
  }

  static Pair<Scalar> turned(const Pair<Scalar>& mode, const Pair<Scalar>& turn) {
    return {turn.first * mode.first - turn.second * mode.second,
            turn.second * mode.first + turn.first * mode.second};
  }

  std::uint8_t seen_base_;
  std::uint8_t gain_base_;
  std::uint8_t feedback_base_;
  std::uint8_t inverse_base_;
  numeric::Floating<Scalar> linear_;
  FeltPlace<Scalar> row_;
  Pair<Scalar> mode_;
  Pair<Scalar> mode_slope_;  ///< over p
  Scalar offset_{};
  Scalar offset_slope_{};  ///< over p
  PlaceEstimate<Scalar> place_;
};

}  // namespace sonoglide::control
