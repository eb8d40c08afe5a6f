/// Orders and stops, wherever the control side interrupts the service that gives them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <vector>

#include "firmware/app/commanded_supervisor.hpp"
#include "tests/firmware/app/unit/preempted_atomic.hpp"
#include "tests/firmware/app/unit/simulated_unit.hpp"

namespace sonoglide::app::orders_test {
namespace {

using Design = FieldDesign<Parts>;
using Supervised = CommandedSupervisor<Design::Controller, Design::Designed, PreemptedAtomic>;

enum class Act : std::uint8_t { restart, target, parameters, stop };

/// A unit whose service gives three orders and a stop in some order, each order when the one before has
/// ended, and what must be true of it whenever control() comes.
class Scene {
 public:
  explicit Scene(std::vector<Act> acts) : acts_(std::move(acts)) {}

  /// The service.
  void give_all() {
    for (const Act act : acts_) {
      give(act);
    }
    await_order();
  }

  /// A carrier period. A sample of a contact that is driven to its target.
  void control() {
    const bool told_before = stops_told_;
    const hal::Drive drive =
        supervisor_.step({INT32_C(429496730), INT32_C(214748365), false, true});
    supervisor_.publish();
    const bool driving = supervisor_.driving();
    // A stop that was told, and after which no restart was given, leaves no drive.
    if (told_before && !restart_given_since_stop_) {
      EXPECT_FALSE(driving);
      EXPECT_EQ(drive.amplitude, 0);
    }
    // Nothing drives before it was told to.
    if (!restart_given_) {
      EXPECT_FALSE(driving);
    }
  }

  void check_end() {
    for (int i = 0; i < 2; ++i) {
      control();
    }
    const Snapshot shown = supervisor_.snapshot();
    EXPECT_EQ(shown.periods, supervisor_.periods());
    EXPECT_EQ(shown.driving(), supervisor_.driving());
    EXPECT_EQ(shown.driving(), expected_drive_);
    EXPECT_EQ(ended_ + refused_, 3);
    // Only a stop overtakes, and only what was given before it.
    EXPECT_LE(overtaken_, 1);
  }

  int overtaken() const { return overtaken_; }

 private:
  void give(Act act) {
    if (act == Act::stop) {
      restart_given_since_stop_ = false;
      supervisor_.order_stop();
      stops_told_ = true;
      expected_drive_ = false;
      return;
    }
    await_order();
    switch (act) {
      case Act::restart:
        restart_given_ = true;
        restart_given_since_stop_ = true;
        last_ = act;
        supervisor_.order_restart(0);
        expected_drive_ = true;
        break;
      case Act::target:
        last_ = act;
        supervisor_.order_target(0.3F, 0);
        break;
      case Act::parameters:
        if (supervisor_.snapshot().driving()) {
          ++refused_;
          return;
        }
        last_ = act;
        supervisor_.order_parameters(field_design.controller_parameters(field_design.presets()),
                                     0.25F, 0);
        break;
      case Act::stop:
        break;
    }
    pending_ = true;
  }

  /// As long as it is not taken, time passes.
  void await_order() {
    while (pending_) {
      const OrderEnd end = supervisor_.order_end();
      if (end == OrderEnd::pending) {
        Interleavings::interrupt_idle_program();
        continue;
      }
      pending_ = false;
      ++ended_;
      overtaken_ += end == OrderEnd::overtaken ? 1 : 0;
      EXPECT_TRUE(end == OrderEnd::done || stops_told_);
      EXPECT_EQ(supervisor_.order_end(), end);  // and it stays so
    }
  }

  std::vector<Act> acts_;
  Supervised supervisor_{field_design.controller_parameters(field_design.presets()), designed, 0,
                         UINT32_MAX};
  Act last_ = Act::stop;
  bool pending_ = false;
  bool stops_told_ = false;
  bool restart_given_ = false;
  bool restart_given_since_stop_ = false;
  bool expected_drive_ = false;
  int ended_ = 0;
  int refused_ = 0;
  int overtaken_ = 0;
};

TEST(Orders, AndAStopAreCarriedOutOnceHoweverTheyAreInterrupted) {
  std::vector<Act> acts = {Act::restart, Act::target, Act::parameters, Act::stop};
  std::size_t runs = 0;
  int overtaken = 0;
  do {
    std::unique_ptr<Scene> scene;
    runs += Interleavings::play([&] { scene = std::make_unique<Scene>(acts); },
                                [&] { scene->give_all(); }, [&] { scene->control(); },
                                [&] {
                                  scene->check_end();
                                  overtaken += scene->overtaken();
                                },
                                3);
  } while (std::next_permutation(acts.begin(), acts.end()));
  EXPECT_GT(runs, 24U * 1000U);
  EXPECT_GT(overtaken, 0);
  RecordProperty("runs", std::to_string(runs));
}

}  // namespace
}  // namespace sonoglide::app::orders_test
