/// What the vibration shows of a natural mode beside the drive.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/control/vibration/frequency_estimate.hpp"
#include "firmware/control/vibration/mode_table.hpp"
#include "firmware/control/vibration/pair.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Observer of the natural mode, of a constant beside it and of the natural frequency, from the
/// vibration z demodulated over a carrier period, u the amplitude of the drive:
///   w' = A w + B (u' - u),   z = C w + H u + o,
/// w the mode at drive phase 0, in two coordinates that turn by θ = ωd T and decay by d = exp(−σT)
/// in a period, o what friction and a wrong model leave. What was not foreseen, e, corrects w and o
/// by the gains of a Kalman filter, and before that the frequency parameter p in the table of
/// natural frequencies: p + ψ·e/S, S the sum of ψ² with forgetting, ψ the slope of the forecast
/// over p (recursive least squares, Ljung 1999, ../README.md). ψ leaves out H u: a constant error is
/// o's.
///
/// z, o: base the sensor's range; w: base eight times the largest input gain; amplitudes: base the
/// largest; p: from -1 to 1. In fixed point what a gain lifts is limited to its base; a sum
/// overflows by policy, and only where a vibration or a mode leaves its base.
template <class Scalar>
class ModeObserver {
 public:
  struct Parameters {
    ModeTable<Scalar> table;
    std::uint8_t output_base;  ///< fixed point: exponents of what C, the gains, the feedback and
    std::uint8_t gain_base;    ///< H/|H|² are multiples of; 0 in floating point
    std::uint8_t feedback_base;
    std::uint8_t inverse_base;
    Scalar audible;  ///< least slope of a forecast that a sample shows
    Scalar quiet;    ///< mode and change of the amplitude up to which no slope is that large

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("table", self.table);
      visit("output_base", self.output_base);
      visit("gain_base", self.gain_base);
      visit("feedback_base", self.feedback_base);
      visit("inverse_base", self.inverse_base);
      visit("audible", self.audible);
      visit("quiet", self.quiet);
    }
  };

  /// @param parameters  of which the table stays where it is: it outlives this
  explicit ModeObserver(const Parameters& parameters)
      : table_(&parameters.table),
        output_base_(parameters.output_base),
        gain_base_(parameters.gain_base),
        feedback_base_(parameters.feedback_base),
        inverse_base_(parameters.inverse_base),
        audible_(parameters.audible),
        quiet_(parameters.quiet) {
    restart();
  }

  /// After a copy from elsewhere. @param parameters  equal ones, as in the constructor
  void settle_at(const Parameters& parameters) { table_ = &parameters.table; }

  /// At rest, and with its nominal frequency.
  void restart() {
    mode_ = {};
    offset_ = {};
    visible_ = {};
    frequency_parameter_.restart();
    row_.go(*table_, frequency_parameter_.frequency_parameter());
  }

  /// One call for each sample.
  /// @param sample  z
  /// @param before  amplitude in the period before the sampled one
  /// @param now     amplitude in the sampled period
  void observe(const Pair<Scalar>& sample, Scalar before, Scalar now) {
    const Scalar change = now - before;
    const Pair<Scalar> last = mode_;
    mode_ = next(mode_, change);
    visible_ = output(mode_, [this](std::size_t i) { return row_[i]; });
    Pair<Scalar> innovation = sample - value_of(mode::forced) * now - offset_ - visible_;
    if (!is_quiet(last, change)) {
      listen(last, change, innovation);
    }
    mode_ = mode_ + gained(mode::mode_gain, innovation);
    offset_ = offset_ + gained(mode::offset_gain, innovation);
  }

  const Pair<Scalar>& mode() const { return mode_; }  ///< w, in the sampled period

  /// w a period later, in which the amplitude is another by this.
  Pair<Scalar> next(const Pair<Scalar>& mode, Scalar change) const {
    return rotated(mode, value_of(mode::rotation)) + value_of(mode::input_gain) * change;
  }

  /// C w: what the mode was foreseen to add to the latest sample.
  const Pair<Scalar>& visible() const { return visible_; }

  /// o as an amplitude, a quarter of it: along H and across it.
  Pair<Scalar> quarter_offset() const {
    const Pair<Scalar> inverse = value_of(mode::inverse);
    const int base = inverse_base_ - 2;
    return {lowered(numeric::sum_of_products(inverse.first, offset_.first, inverse.second,
                                             offset_.second),
                    base),
            lowered(numeric::difference_of_products(inverse.first, offset_.second, inverse.second,
                                                    offset_.first),
                    base)};
  }

  /// v/|H|: the amplitude of a velocity without a mode and an offset, a quarter of it.
  Scalar quarter_amplitude(Scalar velocity) const {
    return lowered(row_[mode::per_velocity] * velocity, inverse_base_ - 2);
  }

  /// K (w, u - u*)
  Scalar feedback(const Pair<Scalar>& mode, Scalar error) const {
    const Scalar sum =
        product(mode::feedback, mode) + numeric::rough_product(row_[mode::feedback + 2], error);
    return numeric::lifted(sum, feedback_base_);
  }

 private:
  Pair<Scalar> value_of(std::size_t i) const { return {row_[i], row_[i + 1]}; }
  Pair<Scalar> slope_of(std::size_t i) const { return {row_.slope(i), row_.slope(i + 1)}; }
  Scalar product(std::size_t i, const Pair<Scalar>& pair) const {
    return numeric::sum_of_products(row_[i], pair.first, row_[i + 1], pair.second);
  }

  Pair<Scalar> gained(std::size_t i, const Pair<Scalar>& innovation) const {
    return {lifted_product(i, innovation, gain_base_),
            lifted_product(i + 2, innovation, gain_base_)};
  }
  Scalar lifted_product(std::size_t i, const Pair<Scalar>& pair, int base) const {
    return numeric::lifted_sum(row_[i], pair.first, row_[i + 1], pair.second, base);
  }

  /// As control::rotated(), in fewer instructions of fixed point.
  static Pair<Scalar> rotated(const Pair<Scalar>& mode, const Pair<Scalar>& rotation) {
    return {
        numeric::difference_of_products(rotation.first, mode.first, rotation.second, mode.second),
        numeric::sum_of_products(rotation.second, mode.first, rotation.first, mode.second)};
  }

  template <class Entry>
  Pair<Scalar> output(const Pair<Scalar>& mode, const Entry& entry) const {
    return {numeric::lifted_sum(entry(mode::output), mode.first, entry(mode::output + 1),
                                mode.second, output_base_),
            numeric::lifted_sum(entry(mode::output + 2), mode.first, entry(mode::output + 3),
                                mode.second, output_base_)};
  }

  bool is_quiet(const Pair<Scalar>& last, Scalar change) const {
    return numeric::abs(last.first) <= quiet_ && numeric::abs(last.second) <= quiet_ &&
           numeric::abs(change) <= quiet_;
  }

  /// Corrects the frequency parameter where the forecast depends on it.
  /// @param last    w in the period before
  /// @param change  of the amplitude from then on
  /// @param miss    of the forecast; becomes that of the corrected one
  void listen(const Pair<Scalar>& last, Scalar change, Pair<Scalar>& innovation) {
    const Pair<Scalar> slope =
        rotated(last, slope_of(mode::rotation)) + slope_of(mode::input_gain) * change;
    const Pair<Scalar> tilt = output(mode_, [this](std::size_t i) { return row_.slope(i); }) +
                              output(slope, [this](std::size_t i) { return row_[i]; }) +
                              slope_of(mode::forced) * change;
    if (audible_ < numeric::max(numeric::abs(tilt.first), numeric::abs(tilt.second))) {
      const Scalar moved = correct_frequency(tilt, innovation);
      mode_ = mode_ + slope * moved;
      innovation = innovation - tilt * moved;
    }
  }

  /// @return by how much the frequency parameter has moved
  Scalar correct_frequency(const Pair<Scalar>& tilt, const Pair<Scalar>& innovation) {
    const Scalar moved = frequency_parameter_.move(
        numeric::scale_by_power_of_two(tilt.first * tilt.first + tilt.second * tilt.second,
                                       -FrequencyEstimate<Scalar>::base),
        numeric::sum_of_products(tilt.first, innovation.first, tilt.second, innovation.second));
    row_.go(*table_, frequency_parameter_.frequency_parameter());
    return moved;
  }

  const ModeTable<Scalar>* table_;
  std::uint8_t output_base_;
  std::uint8_t gain_base_;
  std::uint8_t feedback_base_;
  std::uint8_t inverse_base_;
  Scalar audible_;
  Scalar quiet_;
  ModeInterpolation<Scalar> row_;
  Pair<Scalar> mode_;
  Pair<Scalar> offset_;
  Pair<Scalar> visible_;
  FrequencyEstimate<Scalar> frequency_parameter_;  ///< p
};

}  // namespace sonoglide::control
