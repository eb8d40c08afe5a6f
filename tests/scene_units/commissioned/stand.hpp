/// A unit of target_step in a plant of its own, at the other end of a serial device.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

#include "firmware/app/link_service.hpp"
#include "firmware/app/timed_loop.hpp"
#include "firmware/app/unit.hpp"
#include "hal/timed/volatile_pages.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/run.hpp"
#include "tests/host_sim/boards/unit/terminal/pseudo_terminal.hpp"
#include "tests/scene_units/agreement/period_board.hpp"
#include "tests/scene_units/agreement/scene_unit.hpp"

#include "target_step/controller_configuration.hpp"

namespace sonoglide::app::scene_units_test {

using Parts = configuration::Parts;

inline constexpr auto design = SONOGLIDE_FIELD_DESIGN(configuration);

struct Over {};

/// A unit whose service comes round once in so many steps. It keeps the largest amplitude that it answers.
class ServedPort : public PortOfParts<Parts> {
 public:
  explicit ServedPort(const unit::PseudoTerminal& terminal) : bytes_(terminal) {}

  void set_target(double /*target*/) override {}
  /// Its loop ends with the next step.
  void end() { over_ = true; }
  std::int32_t largest_amplitude() const { return largest_amplitude_; }
  std::int32_t amplitude() const { return amplitude_; }

 private:
  using ServedUnit = Unit<Parts, Pages, std::atomic, 1024>;
  using Service = LinkService<ServedUnit, unit::TerminalLink, 256>;
  static constexpr int steps_in_service = 64;

  hal::Drive answer(const hal::Sample& sample) override {
    if (over_) {
      throw Over();
    }
    board_.post(sample);
    board_.begin_period();
    loop_.control();
    if (++steps_ % steps_in_service == 0) {
      loop_.service();
    }
    amplitude_ = board_.latest_drive().amplitude;
    largest_amplitude_ = std::max<std::int32_t>(largest_amplitude_, amplitude_);
    return board_.latest_drive();
  }

  Pages pages_;
  ServedUnit unit_{design, pages_};
  unit::TerminalLink bytes_;
  Service service_{unit_, bytes_};
  PeriodBoard<hal::Sample, hal::Drive> board_;
  NeverReset watchdog_;
  TimedLoop<ServedUnit::Supervisor, PeriodBoard<hal::Sample, hal::Drive>, NeverReset, Service>
      loop_{unit_.supervisor(), board_, watchdog_, service_};
  std::uint64_t steps_ = 0;
  std::atomic<std::int32_t> largest_amplitude_{0};
  std::atomic<std::int32_t> amplitude_{0};
  std::atomic<bool> over_{false};
};

/// The unit in a plant of its own, as long as this object lives.
class Stand {
 public:
  explicit Stand(const std::vector<std::string>& plant)
      : experiment_(experiment::read_file(SONOGLIDE_TARGET_STEP, plant)),
        thread_([this] { run(); }) {}
  ~Stand() {
    port_.end();
    thread_.join();
  }
  Stand(const Stand&) = delete;
  Stand& operator=(const Stand&) = delete;

  const std::string& device() const { return terminal_.device(); }
  const ServedPort& port() const { return port_; }

 private:
  void run() try {
    scene::Scene plant = experiment_.plant;
    plant.run.duration_s = 1e6;
    plant.run.record.clear();
    loop::run(plant, *experiment_.design, port_);
  } catch (const Over&) {
  }

  unit::PseudoTerminal terminal_;
  configure::Experiment experiment_;
  ServedPort port_{terminal_};
  std::thread thread_;
};

}  // namespace sonoglide::app::scene_units_test
