/// How a run is cut into carrier periods, and when two times are one.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "firmware/numeric/turn.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

/// Carrier periods from the beginning of a run on; the last one may be cut short. Without a drive a
/// "period" is one thousandth of the run.
class CarrierGrid {
 public:
  /// Of a run at the carrier frequency that the scene names.
  explicit CarrierGrid(const scene::Scene& scene)
      : CarrierGrid(scene.drive ? 1.0 / scene.drive->frequency_Hz : scene.run.duration_s / 1000.0,
                    0.0, scene.run.duration_s) {}
  /// Of the rest of a run.
  CarrierGrid(double period_s, double origin_s, double end_s)
      : period_s_(period_s),
        origin_s_(origin_s),
        end_s_(end_s),
        count_(std::max<std::uint64_t>(1, at_or_after(end_s_))) {}

  double period_s() const { return period_s_; }
  std::uint64_t count() const { return count_; }

  double begin_s(std::uint64_t index) const {
    return origin_s_ + static_cast<double>(index) * period_s_;
  }
  double end_s(std::uint64_t index) const {
    return index + 1 < count_ ? begin_s(index + 1) : end_s_;
  }
  bool is_whole(std::uint64_t index) const {
    return index + 1 < count_ || end_s_ - begin_s(index) >= period_s_ - rounding_s(end_s_);
  }
  /// Of a whole period exactly one period: the difference of two late times would not be.
  double duration_s(std::uint64_t index) const {
    return is_whole(index) ? period_s_ : end_s_ - begin_s(index);
  }

  /// Periods that are over at a time.
  std::uint64_t over_at(double time_s) const {
    return static_cast<std::uint64_t>(
        std::floor((time_s - origin_s_ + rounding_s(time_s)) / period_s_));
  }
  /// Index of the first period that begins at a time or after it.
  std::uint64_t at_or_after(double time_s) const {
    return static_cast<std::uint64_t>(
        std::ceil(std::max(0.0, time_s - origin_s_ - rounding_s(time_s)) / period_s_));
  }

  /// The number of periods that a time is, where that is a whole one.
  std::optional<std::uint64_t> whole_periods(double time_s) const {
    const std::uint64_t over = over_at(time_s);
    return over == at_or_after(time_s) ? std::optional(over) : std::nullopt;
  }

  /// Times closer than this are one: a step that is meant to fall on a carrier period misses it by
  /// the rounding of its decimal figure, and by that of a late time.
  double rounding_s(double time_s) const {
    return 1e-9 * period_s_ + 4.0 * std::numeric_limits<double>::epsilon() * time_s;
  }

 private:
  double period_s_;
  double origin_s_;
  double end_s_;
  std::uint64_t count_;
};

/// The period that a run is in. Each may have a frequency of its own, from its phase 0 on. While the
/// frequency holds, periods begin at multiples of theirs, as on a CarrierGrid.
class CarrierClock {
 public:
  explicit CarrierClock(const scene::Scene& scene)
      : grid_(scene),
        end_s_(scene.run.duration_s),
        frequency_Hz_(scene.drive ? scene.drive->frequency_Hz : 0.0) {}

  /// The run has ended.
  bool over() const { return index_ >= grid_.count(); }
  void next() { ++index_; }

  /// Of this period and of those to come, until the next call.
  void set_frequency_Hz(double frequency_Hz) {
    if (frequency_Hz != frequency_Hz_) {
      grid_ = CarrierGrid(1.0 / frequency_Hz, begin_s(), end_s_);
      index_ = 0;
      frequency_Hz_ = frequency_Hz;
    }
  }

  double begin_s() const { return grid_.begin_s(index_); }
  double end_s() const { return grid_.end_s(index_); }
  double duration_s() const { return grid_.duration_s(index_); }
  /// Not cut short by the end of the run.
  bool is_whole() const { return grid_.is_whole(index_); }
  double period_s() const { return grid_.period_s(); }
  double rounding_s(double time_s) const { return grid_.rounding_s(time_s); }
  /// 0 without a drive.
  double frequency_Hz() const { return frequency_Hz_; }
  /// 2π f; 0 without a drive.
  double drive_rate_rad_per_s() const { return numeric::two_pi * frequency_Hz_; }

 private:
  CarrierGrid grid_;
  double end_s_;
  double frequency_Hz_;
  std::uint64_t index_ = 0;
};

}  // namespace sonoglide::loop
