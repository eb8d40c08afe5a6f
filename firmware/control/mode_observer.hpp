/// What the vibration shows of a natural mode beside the drive.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/control/mode_table.hpp"
#include "firmware/control/pair.hpp"
#include "firmware/control/place_estimate.hpp"
#include "firmware/numeric/headroom.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::control {

/// Observer of the natural mode, of a constant beside it and of the natural frequency, from the
/// vibration z demodulated over a carrier period, u the amplitude of the drive:
///   w' = M w + b (u' - u),   z = H u + E w + o,
/// w the mode at drive phase 0, in two coordinates that turn by θ = ωd T and decay by d = exp(−σT)
/// in a period, o what friction and a wrong model leave. What was not foreseen, e, corrects w and o
/// by the gains of a Kalman filter, and before that the place p in the table of natural
/// frequencies: p + ψ·e/S, S the sum of ψ² with forgetting, ψ the slope of the forecast over p
/// (recursive least squares, Ljung 1999, README.md). ψ leaves out H u: a constant error is o's.
///
/// z, o: base the sensor's range; w: base eight times the largest kick; amplitudes: base the largest;
/// p: from -1 to 1. In fixed point what a gain lifts is limited to its base; a sum overflows by
/// policy, and only where a vibration or a mode leaves its base.
template <class Scalar>
class ModeObserver {
 public:
  struct Parameters {
    ModeTable<Scalar> table;
    std::uint8_t seen_base;  ///< fixed point: exponents of what E, the gains, the feedback and
    std::uint8_t gain_base;  ///< H/|H|² are multiples of; 0 in floating point
    std::uint8_t feedback_base;
    std::uint8_t inverse_base;
    Scalar audible;  ///< least slope of a forecast that a sample shows
    Scalar quiet;    ///< mode and change of the amplitude up to which no slope is that large

    template <class Self, class Visitor>
    static constexpr void fields(Self& self, Visitor&& visit) {
      visit("table", self.table);
      visit("seen_base", self.seen_base);
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
        seen_base_(parameters.seen_base),
        gain_base_(parameters.gain_base),
        feedback_base_(parameters.feedback_base),
        inverse_base_(parameters.inverse_base),
        audible_(parameters.audible),
        quiet_(parameters.quiet) {
    restart();
  }

  /// After a copy from elsewhere. @param parameters  equal ones, as in the constructor
  void settle_at(const Parameters& parameters) { table_ = &parameters.table; }

  /// At rest, and as it was believed at first.
  void restart() {
    mode_ = {};
    offset_ = {};
    visible_ = {};
    place_.restart();
    row_.go(*table_, place_.place());
  }

  /// One call for each sample.
  /// @param before, now  amplitudes in the period before the sampled one and in that one
  void observe(const Pair<Scalar>& sample, Scalar before, Scalar now) {
    const Scalar change = now - before;
    const Pair<Scalar> last = mode_;
    mode_ = next(mode_, change);
    visible_ = seen(mode_, [this](std::size_t i) { return row_[i]; });
    Pair<Scalar> miss = sample - value_of(mode::forced) * now - offset_ - visible_;
    if (!is_quiet(last, change)) {
      listen(last, change, miss);
    }
    mode_ = mode_ + gained(mode::mode_gain, miss);
    offset_ = offset_ + gained(mode::offset_gain, miss);
  }

  const Pair<Scalar>& mode() const { return mode_; }  ///< w, in the sampled period

  /// w a period later, in which the amplitude is another by this.
  Pair<Scalar> next(const Pair<Scalar>& mode, Scalar change) const {
    return turned(mode, value_of(mode::turn)) + value_of(mode::kick) * change;
  }

  /// E w: what the mode was foreseen to add to the latest sample.
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

  Pair<Scalar> gained(std::size_t i, const Pair<Scalar>& miss) const {
    return {lifted_product(i, miss, gain_base_), lifted_product(i + 2, miss, gain_base_)};
  }
  Scalar lifted_product(std::size_t i, const Pair<Scalar>& pair, int base) const {
    return numeric::lifted_sum(row_[i], pair.first, row_[i + 1], pair.second, base);
  }

  /// As control::turned(), in fewer instructions of fixed point.
  static Pair<Scalar> turned(const Pair<Scalar>& mode, const Pair<Scalar>& turn) {
    return {numeric::difference_of_products(turn.first, mode.first, turn.second, mode.second),
            numeric::sum_of_products(turn.second, mode.first, turn.first, mode.second)};
  }

  template <class Entry>
  Pair<Scalar> seen(const Pair<Scalar>& mode, const Entry& entry) const {
    return {numeric::lifted_sum(entry(mode::seen), mode.first, entry(mode::seen + 1), mode.second,
                                seen_base_),
            numeric::lifted_sum(entry(mode::seen + 2), mode.first, entry(mode::seen + 3),
                                mode.second, seen_base_)};
  }

  bool is_quiet(const Pair<Scalar>& last, Scalar change) const {
    return numeric::abs(last.first) <= quiet_ && numeric::abs(last.second) <= quiet_ &&
           numeric::abs(change) <= quiet_;
  }

  /// Corrects the place where the forecast depends on it.
  /// @param last    w in the period before
  /// @param change  of the amplitude from then on
  /// @param miss    of the forecast; becomes that of the corrected one
  void listen(const Pair<Scalar>& last, Scalar change, Pair<Scalar>& miss) {
    const Pair<Scalar> slope = turned(last, slope_of(mode::turn)) + slope_of(mode::kick) * change;
    const Pair<Scalar> tilt = seen(mode_, [this](std::size_t i) { return row_.slope(i); }) +
                              seen(slope, [this](std::size_t i) { return row_[i]; }) +
                              slope_of(mode::forced) * change;
    if (audible_ < numeric::max(numeric::abs(tilt.first), numeric::abs(tilt.second))) {
      const Scalar moved = correct_place(tilt, miss);
      mode_ = mode_ + slope * moved;
      miss = miss - tilt * moved;
    }
  }

  /// @return by how much the place has moved
  Scalar correct_place(const Pair<Scalar>& tilt, const Pair<Scalar>& miss) {
    const Scalar moved = place_.move(
        numeric::scale_by_power_of_two(tilt.first * tilt.first + tilt.second * tilt.second,
                                       -PlaceEstimate<Scalar>::base),
        numeric::sum_of_products(tilt.first, miss.first, tilt.second, miss.second));
    row_.go(*table_, place_.place());
    return moved;
  }

  const ModeTable<Scalar>* table_;
  std::uint8_t seen_base_;
  std::uint8_t gain_base_;
  std::uint8_t feedback_base_;
  std::uint8_t inverse_base_;
  Scalar audible_;
  Scalar quiet_;
  ModePlace<Scalar> row_;
  Pair<Scalar> mode_;
  Pair<Scalar> offset_;
  Pair<Scalar> visible_;
  PlaceEstimate<Scalar> place_;  ///< p
};

}  // namespace sonoglide::control
