/// A unit in a plant that nobody has told its controller of, and the program that finds out.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <regex>
#include <string>
#include <thread>
#include <vector>

#include <nlohmann/json.hpp>

#include "firmware/app/link_service.hpp"
#include "firmware/app/timed_loop.hpp"
#include "firmware/app/unit.hpp"
#include "hal/timed/volatile_pages.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/run.hpp"
#include "tests/acceptance/program/program.hpp"
#include "tests/host_sim/unit/terminal/pseudo_terminal.hpp"
#include "tests/scene_units/agreement/period_board.hpp"
#include "tests/scene_units/agreement/scene_unit.hpp"

#include "target_step/controller_configuration.hpp"

namespace sonoglide::app::scene_units_test {
namespace {

using Parts = configuration::Parts;

constexpr auto design = SONOGLIDE_FIELD_DESIGN(configuration);

struct Over {};

/// A unit whose service comes round once in so many steps. It keeps the largest amplitude that it answers.
class ServedPort : public PortOfParts<Parts> {
 public:
  explicit ServedPort(const unit::PseudoTerminal& terminal) : bytes_(terminal) {}

  void set_target(double /*target*/) override {}
  /// Its loop ends with the next step.
  void end() { over_ = true; }
  std::int32_t largest_amplitude() const { return largest_amplitude_; }

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
    largest_amplitude_ = std::max(largest_amplitude_, board_.latest_drive().amplitude);
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
  std::int32_t largest_amplitude_ = 0;
  std::atomic<bool> over_{false};
};

/// The unit in a plant of its own, until the end of the test.
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

TEST(CommissionedUnit, ItsPlantIsFound) {
  const Stand stand({"sensor.adc_bits=12", "true_values.plant.stiffness_N_per_m=120e6",
                     "true_values.friction.coefficient=0.12",
                     "true_values.friction.contact_stiffness_N_per_m=0.04e6",
                     "true_values.plant.damping_N_s_per_m=10"});
  const acceptance::ScratchFolder folder;
  const acceptance::Outcome run =
      folder.run("commission " + stand.device() +
                 " " SONOGLIDE_TARGET_STEP " --set sensor.adc_bits=12 --out found");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto found = nlohmann::json::parse(folder.read("found/identify.json"));
  const auto& all = found["parameters"];
  EXPECT_NEAR(all["plant.stiffness_N_per_m"]["value"], 120e6, 120e6 * 1e-4) << found.dump(1);
  EXPECT_NEAR(all["friction.coefficient"]["value"], 0.12, 0.12 * 1e-3);
  EXPECT_NEAR(all["friction.contact_stiffness_N_per_m"]["value"], 0.04e6, 0.04e6 * 2e-2);
  EXPECT_NEAR(all["plant.damping_N_s_per_m"]["value"], 10.0, 2.0);
  EXPECT_TRUE(found["warnings"].empty()) << found["warnings"];
  // The scene that it leaves settles where that of the unit does not.
  const acceptance::Outcome commissioned = folder.run("run found/commissioned.toml --json");
  ASSERT_EQ(commissioned.exit_code, 0) << commissioned.err;
  for (const auto& step : nlohmann::json::parse(commissioned.out)["control"]["steps"]) {
    EXPECT_LT(step["settling_time_s"], 1e-3);
  }
}

TEST(CommissionedUnit, AStepOfItsLoopIsMeasured) {
  const Stand stand({});
  const acceptance::ScratchFolder folder;
  folder.write("lines", "restart\nstep 0.4 0.7 step.html\n");
  const acceptance::Outcome run = folder.run("connect " + stand.device() + " --quiet < lines");
  ASSERT_EQ(run.exit_code, 0) << run.out << run.err;
  std::smatch found;
  const std::regex pattern(
      "the friction force goes from ([0-9.]+) mN to ([0-9.]+) mN, ripple .*; 10 to 90 % in ([0-9.]+) us, within 5 % of "
      "the step after ([0-9.]+) (us|ms), overshoot");
  ASSERT_TRUE(std::regex_search(run.out, found, pattern)) << run.out;
  constexpr double undriven_mN = 39.24 * 0.5;
  EXPECT_NEAR(std::stod(found[1]), 0.4 * undriven_mN, 0.02 * undriven_mN) << run.out;
  EXPECT_NEAR(std::stod(found[2]), 0.7 * undriven_mN, 0.02 * undriven_mN) << run.out;
  EXPECT_EQ(folder.entries(), (std::vector<std::string>{".sonoglide", "lines", "step.html"}));
}

TEST(CommissionedUnit, OfAnotherSceneIsLeftAlone) {
  const Stand stand({});
  const acceptance::ScratchFolder folder;
  const acceptance::Outcome run =
      folder.run("commission " + stand.device() +
                 " " SONOGLIDE_TARGET_STEP " --set plant.stiffness_N_per_m=120e6 --out found");
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("the unit has another design than the scene"), std::string::npos)
      << run.err;
  EXPECT_TRUE(folder.entries().empty());
  EXPECT_EQ(stand.port().largest_amplitude(), 0);
}

}  // namespace
}  // namespace sonoglide::app::scene_units_test
