/// A board that runs on a timer of its own, with a contact, a watchdog and a byte link; and the
/// controller of the tests.
#pragma once

#include <cmath>
#include <cstdint>
#include <deque>
#include <vector>

#include "firmware/app/field_parameters.hpp"
#include "firmware/app/identity.hpp"
#include "firmware/app/unit.hpp"
#include "firmware/control/controller.hpp"
#include "firmware/control/feedback/integral_regulator.hpp"
#include "firmware/control/friction/coulomb_feedforward.hpp"
#include "firmware/control/friction/learnt_friction.hpp"
#include "firmware/control/limits/notch_shaper.hpp"
#include "firmware/control/limits/slew_limit.hpp"
#include "firmware/numeric/scalar.hpp"
#include "hal/board.hpp"
#include "hal/kept_exception.hpp"
#include "tests/firmware/app/flash/simulated_flash.hpp"

namespace sonoglide::app {

using Scalar = float;
using Parts = control::Parts<Scalar, control::TrustedFriction<Scalar>,
                             control::CoulombFeedforward<Scalar>, control::NoSlewLimit<Scalar>,
                             control::NoShaping<Scalar>, control::IntegralRegulator<Scalar, 1>>;
using TestedUnit = Unit<Parts, SimulatedFlash>;

struct TestedProduct : Unnamed {
  static constexpr const char* board = "test-stand";
  static std::uint32_t serial_number() { return 4711; }
  static inline const hal::KeptException* exception = nullptr;
};

inline constexpr control::Controller<Parts>::Parameters designed = [] {
  control::Controller<Parts>::Parameters parameters{};
  parameters.friction_force = 0.5F;
  parameters.smallest_friction = 1.0F / 1024.0F;
  parameters.speed_floor = 0.01F;
  parameters.regulator = {0.1F, 0.0F, 3, 12, 1};
  parameters.standstill = {1000, 0.0078125F};
  parameters.stuck = {10};
  parameters.plausibility = {20};
  parameters.watch = {0.01F, 50, 0.8F};
  return parameters;
}();
inline constexpr double carrier_period_s = 1.0 / 60e3;
inline constexpr link::FullScales full_scales{{{link::ScaleUnit::newton, 0.04},
                                               {link::ScaleUnit::metre_per_second, 5.0},
                                               {link::ScaleUnit::newton, 1920.0},
                                               {link::ScaleUnit::ratio, 1.0},
                                               {link::ScaleUnit::none, 0.0},
                                               {link::ScaleUnit::second, carrier_period_s}}};
inline constexpr FieldDesign<Parts> field_design(designed, 0.2F, 1, full_scales, carrier_period_s,
                                                 default_timeout_ms);

/// A Coulomb contact under a board whose drive comes into force with each carrier period.
class TimedBoard {
 public:
  /// Full drive takes the friction down to about 0.064; a ratio of 0.4 needs 0.17 of it.
  static constexpr double speed = 0.1;
  static constexpr double friction = 0.5;

  /// @param period  its counter, which wraps.
  explicit TimedBoard(std::uint32_t period = 0) : period_(period), sampled_(period) {}

  bool sample(hal::Sample& sample) {
    if (sampled_ == period_) {
      begin_period();
    }
    sampled_ = period_;
    sample = {code(friction * ratio_), code(speed), false, fresh};
    return period_ != last_period;
  }
  void drive(const hal::Drive& drive) {
    pass(step_takes);
    step_takes = 0;
    drive_ = drive;
  }
  std::uint32_t period() const { return period_; }

  /// Carrier periods that begin meanwhile.
  void pass(int periods) {
    for (; periods > 0; --periods) {
      begin_period();
    }
  }

  int step_takes = 0;             ///< carrier periods that begin before the next command arrives
  bool fresh = true;              ///< the sensor answers
  std::int64_t last_period = -1;  ///< at which the board shuts down; -1: none
  std::vector<std::int32_t> in_force;  ///< amplitude in each period

  const hal::Drive& latest_drive() const { return drive_; }
  /// Friction ratio of the last period.
  double ratio() const { return ratio_; }

 private:
  static std::int32_t code(double value) { return static_cast<std::int32_t>(value * 0x1p31); }

  void begin_period() {
    const double amplitude = numeric::from_code<double>(drive_.amplitude);
    ratio_ = amplitude > speed ? std::asin(speed / amplitude) / std::asin(1.0) : 1.0;
    in_force.push_back(drive_.amplitude);
    ++period_;
  }

  hal::Drive drive_{};
  double ratio_ = 1.0;
  std::uint32_t period_;
  std::uint32_t sampled_;
};

/// A flash of four pages, of which the last two alone are there.
class HistoryPages {
 public:
  static constexpr std::size_t page_words = SimulatedFlash::page_words;
  static constexpr std::size_t pages = 4;

  explicit HistoryPages(SimulatedFlash& flash) : flash_(flash) {}
  std::uint32_t read(std::size_t page, std::size_t word) const {
    return flash_.read(page - 2, word);
  }
  void erase(std::size_t page) { flash_.erase(page - 2); }
  void program(std::size_t page, std::size_t word, std::uint32_t value) {
    flash_.program(page - 2, word, value);
  }
  bool busy() const { return flash_.busy(); }

 private:
  SimulatedFlash& flash_;
};

class CountingWatchdog {
 public:
  void feed() { ++feeds; }
  bool caused_reset() const { return reset; }

  int feeds = 0;
  bool reset = false;
};

/// Both ends of a wire; the unit's output fills up like a register that is emptied now and then.
class Wire {
 public:
  bool receive(std::uint8_t& byte) {
    if (to_unit.empty()) {
      return false;
    }
    byte = to_unit.front();
    to_unit.pop_front();
    return true;
  }
  bool send(std::uint8_t byte) {
    full_ = blocked || !full_;
    if (!full_) {
      from_unit.push_back(byte);
    }
    return !full_;
  }

  std::deque<std::uint8_t> to_unit;
  std::vector<std::uint8_t> from_unit;
  bool blocked = false;  ///< nobody empties the register

 private:
  bool full_ = false;
};

}  // namespace sonoglide::app
