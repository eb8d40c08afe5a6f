/// What the friction shows of a natural mode beside the drive.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/control/vibration/mode_table.hpp"
#include "firmware/control/vibration/pair.hpp"
#include "firmware/control/vibration/sensorless_covariance.hpp"
#include "firmware/control/vibration/sensorless_table.hpp"
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

/// Observer of the natural mode, of a constant beside it and of the natural frequency, from one
/// number a period: the vibration velocity y that the measured friction ratio stands for
/// (../vibration.md):
///   w' = A w + B Δu,   y = |H| u + o + C w + g Δu + h Δu₋₁,
/// Δu the last change of the amplitude u, Δu₋₁ the one before. A, B and H are those of
/// ModeObserver, at the frequency parameter p in the table of natural frequencies. C, g and h
/// depend on the velocity ratio r = Vt/(|H| u + o). What was not foreseen corrects w, o and p as an
/// extended Kalman filter does (SensorlessCovariance).
///
/// y, o, speeds: on the base of the sliding velocity; w: base eight times the largest input gain;
/// amplitudes: base the largest. In fixed point what a correction lifts is limited to its base; a
/// sum overflows by policy, and only where a velocity or a mode leaves its base.
template <class Scalar>
class SensorlessObserver {
  using Index = SensorlessIndex;

 public:
  struct Parameters {
    SensorlessTable<Scalar> table;
    typename SensorlessCovariance<Scalar>::Parameters covariance;
    /// Fixed point: exponents of what C, g and h, the feedback and 1/|H| are multiples of. 0 in
    /// floating point, as the two exponents below.
    std::uint8_t output_base;
    std::uint8_t feedback_base;
    std::uint8_t inverse_base;
    std::uint8_t slower;   ///< SensorlessCovariance has velocities on a base smaller by 2^-this
    std::uint8_t quieter;  ///< likewise the mode; at most output_base + slower
    numeric::Split<Scalar>
        linear;  ///< mode, per velocity |H| u + o, up to which readings are believed

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("table", self.table);
      visit("covariance", self.covariance);
      visit("output_base", self.output_base);
      visit("feedback_base", self.feedback_base);
      visit("inverse_base", self.inverse_base);
      visit("slower", self.slower);
      visit("quieter", self.quieter);
      visit("linear", self.linear);
    }
  };

  /// @param parameters  of which the table stays where it is: it outlives this
  explicit SensorlessObserver(const Parameters& parameters)
      : covariance_(parameters.covariance),
        output_base_(parameters.output_base),
        feedback_base_(parameters.feedback_base),
        inverse_base_(parameters.inverse_base),
        slower_(parameters.slower),
        quieter_(parameters.quieter),
        jacobian_base_(static_cast<std::uint8_t>(parameters.output_base + parameters.slower -
                                                 parameters.quieter)),
        linear_(numeric::floating(parameters.linear)),
        row_(parameters.table) {
    restart();
  }

  /// After a copy from elsewhere. @param parameters  equal ones, as in the constructor
  void settle_at(const Parameters& parameters) { row_.settle_at(parameters.table); }

  /// At rest, and with its nominal frequency.
  void restart() {
    covariance_.restart();
    mode_ = {};
    offset_ = {};
    frequency_parameter_ = {};
    row_.go(frequency_parameter_);
  }

  /// A period passes, in which the amplitude is another by this.
  void predict(Scalar change) {
    const Pair<Scalar> mode = lifted(mode_, quieter_);
    const Pair<Scalar> input_gain = lifted(slope_of(Index::input_gain) * change, quieter_);
    covariance_.predict(value_of(Index::rotation),
                        rotated(mode, slope_of(Index::rotation)) + input_gain, mode);
    mode_ = next(mode_, change);
  }

  /// A force that is constant over the period changes at its begin, and with it the displacement
  /// at which the mode is at rest. @param change  of the second coordinate of w
  void displace(Scalar change) { mode_.second = mode_.second + change; }

  /// One call for each usable reading, after predict().
  /// @param velocity  y; `highest` where the reading is beyond all velocities
  /// @param speed     |Vt| > 0
  /// @param u         the last amplitudes
  /// @param wanted    velocity that is asked for
  void observe(Scalar velocity, Scalar speed, const PastAmplitudes<Scalar>& u, Scalar wanted) {
    const Scalar driven = row_[Index::forced] * u.now + offset_;
    const Scalar before = row_[Index::forced] * numeric::min(u.before, u.earlier) + offset_;
    // At a velocity below that of the sliding a reading shows nothing of the mode.
    if (!(speed < driven && speed < before)) {
      forget();
      return;
    }
    const Scalar size = relative_size(driven);
    constexpr Scalar highest = numeric::from_code<Scalar>(INT32_MAX);
    if (!(size < highest)) {
      return;
    }
    row_.look(ratio(speed, driven));
    const Scalar last = u.now - u.before;
    const Scalar before_last = u.before - u.earlier;
    const Scalar forecast = driven + numeric::lifted(output(last, before_last), output_base_);
    if (!(velocity < highest) && !(forecast < highest)) {
      return;
    }
    const Scalar most = numeric::from_real<Scalar>(0.3) * speed;
    const Scalar innovation = numeric::clamp_magnitude(velocity - forecast, most);
    correct(innovation, jacobian(u.now, last, before_last), variance(driven, size));
    offset_ = numeric::clamp(offset_, numeric::from_real<Scalar>(-0.5),
                             numeric::from_real<Scalar>(0.6) * wanted);
  }

  /// See SensorlessCovariance.
  void inflate_offset(Scalar part) { covariance_.inflate_offset(part); }

  const Pair<Scalar>& mode() const { return mode_; }                   ///< w, in the sampled period
  Scalar frequency_parameter() const { return frequency_parameter_; }  ///< p

  /// w a period later, in which the amplitude is another by this.
  Pair<Scalar> next(const Pair<Scalar>& mode, Scalar change) const {
    return rotated(mode, value_of(Index::rotation)) + value_of(Index::input_gain) * change;
  }

  /// (v − o)/|H|: the amplitude that brings y to v without a mode, a quarter of it.
  Scalar quarter_amplitude(Scalar velocity) const {
    return lowered(row_[Index::per_velocity] * (velocity - offset_), inverse_base_ - 2);
  }

  /// |H| u: what the drive alone makes, of an amplitude.
  Scalar nominal_velocity(Scalar amplitude) const { return row_[Index::forced] * amplitude; }

  /// K (w, u − u*)
  Scalar feedback(const Pair<Scalar>& mode, Scalar error) const {
    return numeric::lifted(row_[Index::feedback] * mode.first +
                               row_[Index::feedback + 1] * mode.second +
                               row_[Index::feedback + 2] * error,
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

  /// Of the mode, over that up to which readings are believed: the friction of a contact follows a
  /// large mode no longer linearly. At most 1.
  Scalar relative_size(Scalar driven) const {
    const Scalar size = numeric::max(numeric::abs(mode_.first), numeric::abs(mode_.second));
    const Scalar most = numeric::limited_product(driven, linear_);
    return size < most ? ratio(size, most) : numeric::from_code<Scalar>(INT32_MAX);
  }

  /// A mode that no reading shows is held for less and less, as its feedback may keep the drive
  /// from showing it.
  void forget() {
    constexpr int slowly = -5;
    mode_ = mode_ - Pair<Scalar>{numeric::scale_by_power_of_two(mode_.first, slowly),
                                 numeric::scale_by_power_of_two(mode_.second, slowly)};
  }

  /// C w + g Δu + h Δu₋₁, on the base of C
  Scalar output(Scalar last, Scalar before) const {
    return row_.of_node(Index::Node::output) * mode_.first +
           row_.of_node(Index::Node::output + 1) * mode_.second +
           row_.of_node(Index::Node::last_change) * last +
           row_.of_node(Index::Node::change_before) * before;
  }

  /// The slopes of the forecast over w, o and p, so far lowered that C is on its own base.
  typename SensorlessCovariance<Scalar>::State jacobian(Scalar amplitude, Scalar last,
                                                        Scalar before) const {
    const Scalar output_slope = row_.slope_of_node(Index::Node::output) * mode_.first +
                                row_.slope_of_node(Index::Node::output + 1) * mode_.second +
                                row_.slope_of_node(Index::Node::last_change) * last +
                                row_.slope_of_node(Index::Node::change_before) * before;
    const Scalar driven_slope = numeric::lifted(row_.slope(Index::forced) * amplitude, slower_);
    return {{row_.of_node(Index::Node::output), row_.of_node(Index::Node::output + 1)},
            on_jacobian_base(numeric::from_code<Scalar>(INT32_MAX)),
            numeric::lifted(output_slope, quieter_) + on_jacobian_base(driven_slope)};
  }

  /// Of a reading, on the base of jacobian(): of the velocity 1.5 % are the error of the map, and
  /// up to an eighth for what follows the square of the mode. @param size  see relative_size()
  Scalar variance(Scalar driven, Scalar size) const {
    const Scalar relative_error =
        numeric::from_real<Scalar>(0.015) + numeric::scale_by_power_of_two(size * size, -3);
    const Scalar wrong = on_jacobian_base(relative_error * numeric::lifted(driven, slower_));
    const Scalar noise =
        on_jacobian_base(numeric::lifted(row_.of_node(Index::Node::noise), slower_));
    return wrong * wrong + noise * noise;
  }

  /// A velocity of SensorlessCovariance where jacobian() has it.
  Scalar on_jacobian_base(Scalar x) const { return down(x, jacobian_base_); }

  /// x 2^-n; in floating point x, where n is 0.
  static Scalar down(Scalar x, int n) {
    if constexpr (numeric::is_fixed_point_v<Scalar>) {
      return numeric::scale_by_power_of_two(x, -n);
    } else {
      return x;
    }
  }

  void correct(Scalar innovation, const typename SensorlessCovariance<Scalar>::State& jacobian,
               Scalar variance) {
    const typename SensorlessCovariance<Scalar>::State moved = covariance_.update(
        jacobian, variance, on_jacobian_base(numeric::lifted(innovation, slower_)));
    mode_ =
        mode_ + Pair<Scalar>{down(moved.mode.first, quieter_), down(moved.mode.second, quieter_)};
    offset_ = offset_ + down(moved.offset, slower_);
    constexpr Scalar end = numeric::from_code<Scalar>(INT32_MAX - 1);
    const Scalar half =
        numeric::half(frequency_parameter_) + numeric::half(moved.frequency_parameter);
    frequency_parameter_ = numeric::twice(numeric::clamp_magnitude(half, numeric::half(end)));
    row_.go(frequency_parameter_);
  }

  static Pair<Scalar> lifted(const Pair<Scalar>& pair, int n) {
    return {numeric::lifted(pair.first, n), numeric::lifted(pair.second, n)};
  }

  SensorlessCovariance<Scalar> covariance_;
  std::uint8_t output_base_;
  std::uint8_t feedback_base_;
  std::uint8_t inverse_base_;
  std::uint8_t slower_;
  std::uint8_t quieter_;
  /// jacobian() has velocities on a base larger by 2^this than SensorlessCovariance.
  std::uint8_t jacobian_base_;
  numeric::Floating<Scalar> linear_;
  SensorlessInterpolation<Scalar> row_;
  Pair<Scalar> mode_;
  Scalar offset_{};
  Scalar frequency_parameter_{};
};

}  // namespace sonoglide::control
