/// A service and its control side on two threads, under the thread sanitizer; and the replay of what came
/// between them.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdint>
#include <random>
#include <thread>
#include <vector>

#include "firmware/app/commanded_supervisor.hpp"
#include "hal/timed/board.hpp"
#include "tests/firmware/app/unit/simulated_unit.hpp"

namespace sonoglide::app::two_threads_test {
namespace {

using Design = FieldDesign<Parts>;
constexpr std::uint16_t steps_kept = 64;
using Supervised =
    CommandedSupervisor<Design::Controller, Design::Designed, std::atomic, steps_kept>;

constexpr std::uint32_t periods = 200'000;

/// What the control side was told in a carrier period.
struct Event {
  std::uint32_t period;
  bool stop;
  bool ordered;
  Supervised::Order order;
};

/// A contact, the control side at its carrier periods, and a hash of the commands.
class ControlSide {
 public:
  explicit ControlSide(Supervised& supervisor) : supervisor_(supervisor) {}

  void serve(std::uint32_t period, const Supervised::Work& work) {
    contact_.live();
    hal::Sample sample = contact_.sample();
    // Its last byte tells the period to whoever sees a snapshot.
    sample.sliding_velocity = static_cast<std::int32_t>(
        (static_cast<std::uint32_t>(sample.sliding_velocity) & 0xffffff00U) |
        ((period + 1) & 0xffU));
    sample.fresh = period % 499 != 0;
    const hal::Drive& drive = supervisor_.step(sample, work);
    contact_.drive(drive.amplitude);
    for (const std::uint32_t word :
         {static_cast<std::uint32_t>(drive.amplitude),
          static_cast<std::uint32_t>(drive.commanded_ratio),
          std::uint32_t{drive.state} << 16 | std::uint32_t{drive.fault}}) {
      hash_ = (hash_ ^ word) * 0x100000001b3U;
    }
    driven_ += drive.amplitude > 0 ? 1U : 0U;
    supervisor_.publish();
  }

  std::uint64_t hash() const { return hash_; }
  std::uint32_t driven() const { return driven_; }

 private:
  Supervised& supervisor_;
  hal::timed::StandInContact contact_;
  std::uint64_t hash_ = 0xcbf29ce484222325U;
  std::uint32_t driven_ = 0;
};

/// Gives orders at random and looks at what is shown, until control is over.
struct Service {
  Supervised& supervisor;
  std::minstd_rand random;
  int given = 0;
  int ended = 0;
  int overtaken = 0;
  int torn = 0;
  bool pending = false;
  std::uint32_t seen = 0;
  int traces = 0;

  /// Reads a trace that is whole, and arms it anew; now and then one that is not whole.
  void trace() {
    auto& trace = supervisor.trace();
    const auto state = trace.state();
    const bool whole = state.phase == link::TracePhase::whole;
    for (std::uint16_t i = 0; whole && i < steps_kept; ++i) {
      const auto velocity = static_cast<std::uint32_t>(trace.read(i).sliding_velocity);
      torn += (velocity & 0xffU) != ((state.first_period + i) & 0xffU) ? 1 : 0;
    }
    traces += whole ? 1 : 0;
    if (whole || state.phase == link::TracePhase::empty || random() % 64 == 0) {
      trace.arm(static_cast<std::uint8_t>(1 + random() % link::all_triggers),
                static_cast<std::uint16_t>(random() % steps_kept));
    }
  }

  /// @return whether a carrier period has passed since the last look
  bool look() {
    const Snapshot shown = supervisor.snapshot();
    const bool passed = shown.periods != seen;
    const bool whole = shown.periods == 0 || (static_cast<std::uint32_t>(shown.sliding_velocity) &
                                              0xffU) == (shown.periods & 0xffU);
    torn += !whole || shown.periods < seen ? 1 : 0;
    seen = shown.periods;
    FaultEntry entry{};
    std::uint32_t count = 0;
    if (supervisor.faults().read(random() % 16, entry, count)) {
      const bool missing =
          entry.fault == static_cast<std::uint8_t>(control::Fault::measurement_missing);
      torn += missing != (entry.period % 499 == 1) ? 1 : 0;
    }
    return passed;
  }

  /// More often than a period passes, every order would be overtaken by a stop.
  void act() {
    const bool passed = look();
    if (pending) {
      const OrderEnd end = supervisor.order_end();
      pending = end == OrderEnd::pending;
      ended += pending ? 0 : 1;
      overtaken += end == OrderEnd::overtaken ? 1 : 0;
    }
    if (!passed) {
      return;
    }
    trace();
    const auto chance = random() % 16;
    if (chance == 0) {
      supervisor.order_stop();
    }
    if (pending || chance < 8) {
      return;
    }
    const std::uint32_t faults = supervisor.faults().count();
    if (chance < 11) {
      supervisor.order_restart(faults);
    } else if (chance < 14) {
      supervisor.trace().expect_target(static_cast<std::uint32_t>(given));
      supervisor.order_target(0.01F * static_cast<float>(5 + random() % 45), faults);
    } else if (!supervisor.snapshot().driving()) {
      ParameterValues values = field_design.presets();
      values[static_cast<std::size_t>(Parameter::drive_limit)] =
          200'000 + static_cast<std::uint32_t>(random() % 800'000);
      supervisor.order_parameters(field_design.controller_parameters(values), 0.2F, 0);
    } else {
      return;
    }
    ++given;
    pending = true;
  }
};

std::uint64_t replayed(const std::vector<Event>& events) {
  Supervised supervisor(field_design.controller_parameters(field_design.presets()), designed, 0,
                        UINT32_MAX);
  ControlSide control(supervisor);
  auto next = events.begin();
  for (std::uint32_t period = 0; period < periods; ++period) {
    Supervised::Work work{false, nullptr};
    if (next != events.end() && next->period == period) {
      work = {next->stop, next->ordered ? &next->order : nullptr};
      ++next;
    }
    control.serve(period, work);
  }
  return control.hash();
}

class TwoThreads : public testing::TestWithParam<unsigned> {};

TEST_P(TwoThreads, NeverTearWhatPassesBetweenThemAndAReplayIsTheSame) {
  Supervised supervisor(field_design.controller_parameters(field_design.presets()), designed, 0,
                        UINT32_MAX);
  std::atomic<bool> over{false};
  Service service{supervisor, std::minstd_rand(GetParam())};
  std::thread thread([&] {
    while (!over.load(std::memory_order_relaxed)) {
      service.act();
    }
  });
  ControlSide control(supervisor);
  std::vector<Event> events;
  const Supervised::Order no_order(field_design.controller_parameters(field_design.presets()));
  for (std::uint32_t period = 0; period < periods; ++period) {
    const Supervised::Work work = supervisor.look();
    if (work.stop || work.order != nullptr) {
      events.push_back({period, work.stop, work.order != nullptr,
                        work.order != nullptr ? *work.order : no_order});
    }
    control.serve(period, work);
    if (period % 64 == 0) {
      std::this_thread::yield();  // to a service that has no processor of its own
    }
  }
  over = true;
  thread.join();
  EXPECT_EQ(service.torn, 0);
  EXPECT_GT(service.traces, 10);
  EXPECT_GT(service.given, 100);
  EXPECT_LE(service.given - service.ended, 1);
  EXPECT_GT(control.driven(), 1000U);
  EXPECT_GE(supervisor.faults().count(), 1U);
  EXPECT_EQ(replayed(events), control.hash());
  RecordProperty("orders", service.given);
  RecordProperty("overtaken", service.overtaken);
  RecordProperty("traces", service.traces);
}

INSTANTIATE_TEST_SUITE_P(Seeds, TwoThreads, testing::Range(1U, 3U));
INSTANTIATE_TEST_SUITE_P(MoreSeeds, TwoThreads, testing::Range(3U, 11U));

}  // namespace
}  // namespace sonoglide::app::two_threads_test
