/// The carrier periods of a run, one after the other.
#pragma once

#include <cstdint>

#include "firmware/numeric/turn.hpp"
#include "host_sim/loop/carrier_grid.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

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
