/// A unit's trace is what its steps were, around what triggered it.
#include "firmware/app/trace.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <random>
#include <type_traits>
#include <utility>
#include <vector>

#include "firmware/app/link_service.hpp"
#include "firmware/app/timed_loop.hpp"
#include "tests/firmware/app/unit/simulated_unit.hpp"

namespace sonoglide::app::trace_test {
namespace {

using link::Reason;
using link::Trigger;

constexpr std::size_t length = 64;
using TracedUnit = Unit<Parts, SimulatedFlash, std::atomic, length>;

constexpr std::uint8_t bit(Trigger trigger) {
  return static_cast<std::uint8_t>(trigger);
}

/// A unit whose every step is written down beside the trace.
class WatchedUnit {
 public:
  /// A step.
  void control() {
    loop_.control();
    const auto& supervisor = unit.supervisor();
    const hal::Drive& drive = supervisor.drive();
    steps.push_back(
        {0, supervisor.friction_force(), supervisor.sliding_velocity(), drive.amplitude,
         unit.target(),
         drive.state + 0x100U * drive.limit + 0x10000U * drive.fault + 0x1000000U * drive.settling,
         0});
    // What is ordered is in force from the step on that ends the order.
    if (pending_target && supervisor.order_end() == OrderEnd::done) {
      steps.back().target = *pending_target;
      pending_target.reset();
    }
  }
  void control(int count) {
    for (; count > 0; --count) {
      control();
    }
  }

  /// Asks, and serves without a step until there is an answer.
  link::Frame ask(const link::Frame& request) {
    const link::WireFrame encoded = link::encode(request);
    wire.to_unit.insert(wire.to_unit.end(), encoded.bytes.begin(),
                        encoded.bytes.begin() + static_cast<std::ptrdiff_t>(encoded.size));
    link::FrameDecoder decoder;
    for (int i = 0; i < 1000; ++i) {
      loop_.service();
      for (const std::uint8_t byte : std::exchange(wire.from_unit, {})) {
        if (decoder.take(byte) == link::Reception::frame) {
          return decoder.frame();
        }
      }
    }
    ADD_FAILURE() << "no answer";
    return {};
  }
  template <class Answer, class Request>
  Answer answer(const Request& request) {
    Answer answer{};
    EXPECT_TRUE(link::read(ask(link::frame_of(request, ++sequence_)), answer));
    return answer;
  }
  Reason refusal(const link::ArmTrace& request) {
    link::Refusal refusal{};
    EXPECT_TRUE(link::read(ask(link::frame_of(request, ++sequence_)), refusal));
    return static_cast<Reason>(refusal.reason);
  }
  link::TraceState state() { return answer<link::TraceState>(link::ReadTraceState{}); }
  link::TracePhase phase() { return static_cast<link::TracePhase>(state().phase); }
  void arm(std::uint8_t triggers, std::uint16_t before) {
    const auto armed = answer<link::TraceArmed>(link::ArmTrace{triggers, before});
    EXPECT_EQ(armed.triggers, triggers);
    EXPECT_EQ(armed.before, before);
  }

  void restart() {
    EXPECT_EQ(unit.restart(unit.supervisor().faults().count()), Answer::taken);
    control();
  }
  void aim(std::uint32_t target) {
    EXPECT_EQ(unit.set_target(target, unit.supervisor().faults().count()), Answer::taken);
    pending_target = target;
    control();
    unit.order_end();  // as the service takes note of it
  }
  void lose_a_sample() {
    board.fresh = false;
    control();
    board.fresh = true;
  }

  /// The whole trace is that of the steps that were written down, and its trigger where it is said to be.
  void expect_true_trace(std::uint32_t trigger_step) {
    const link::TraceState told = state();
    ASSERT_EQ(static_cast<link::TracePhase>(told.phase), link::TracePhase::whole);
    ASSERT_EQ(told.records, length);
    ASSERT_EQ(told.first_period + told.before, trigger_step + 1);  // periods are counted from 1
    for (std::uint16_t i = 0; i < length; ++i) {
      const auto found = answer<link::TraceRecord>(link::ReadTraceRecord{i});
      const link::TraceRecord& step = steps.at(told.first_period - 1 + i);
      ASSERT_EQ(found.index, i);
      ASSERT_EQ(found.friction_force, step.friction_force) << i;
      ASSERT_EQ(found.sliding_velocity, step.sliding_velocity) << i;
      ASSERT_EQ(found.amplitude, step.amplitude) << i;
      ASSERT_EQ(found.target, step.target) << i;
      ASSERT_EQ(found.codes, step.codes) << i;
      ASSERT_EQ(found.other, 0) << i;
    }
  }

  std::uint32_t last_step() const { return static_cast<std::uint32_t>(steps.size() - 1); }

  SimulatedFlash flash;
  TracedUnit unit{field_design, flash};
  TimedBoard board;
  Wire wire;
  std::vector<link::TraceRecord> steps;
  std::optional<std::uint32_t> pending_target;

 private:
  using Service = LinkService<TracedUnit, Wire>;

  std::uint16_t sequence_ = 0;
  CountingWatchdog watchdog_;
  Service service_{unit, wire};
  TimedLoop<TracedUnit::Supervisor, TimedBoard, CountingWatchdog, Service> loop_{
      unit.supervisor(), board, watchdog_, service_};
};

TEST(TraceTest, IsEmptyUntilItIsArmed) {
  WatchedUnit watched;
  watched.control(200);
  EXPECT_EQ(watched.phase(), link::TracePhase::empty);
  const link::Frame frame = watched.ask(link::frame_of(link::ReadTraceRecord{0}, 100));
  link::Refusal refusal{};
  ASSERT_TRUE(link::read(frame, refusal));
  EXPECT_EQ(refusal.reason, static_cast<std::uint8_t>(Reason::no_such_record));
  EXPECT_EQ(refusal.highest, 0U);
}

TEST(TraceTest, BeginsNow) {
  WatchedUnit watched;
  watched.restart();
  watched.control(7);
  watched.arm(bit(Trigger::now), 20);
  EXPECT_EQ(watched.phase(), link::TracePhase::waiting);
  watched.control();
  const std::uint32_t first = watched.last_step();
  EXPECT_EQ(watched.phase(), link::TracePhase::recording);
  watched.control(length - 2);
  EXPECT_EQ(watched.phase(), link::TracePhase::recording);
  watched.control();
  EXPECT_EQ(watched.state().cause, bit(Trigger::now));
  EXPECT_EQ(watched.state().before, 0);
  watched.expect_true_trace(first);
  watched.control(1000);  // it stays
  watched.expect_true_trace(first);
}

TEST(TraceTest, KeepsWhatLedToAFault) {
  for (const std::uint16_t before : std::array<std::uint16_t, 5>{0, 1, 40, 62, 63}) {
    WatchedUnit watched;
    watched.restart();
    watched.arm(bit(Trigger::fault), before);
    watched.control(300);
    watched.aim(600'000);  // no trigger
    watched.control(50);
    EXPECT_EQ(watched.phase(), link::TracePhase::waiting);
    watched.lose_a_sample();
    const std::uint32_t fault = watched.last_step();
    EXPECT_EQ(watched.unit.supervisor().faults().count(), 1U);
    watched.restart();
    watched.control(length);
    EXPECT_EQ(watched.state().before, before);
    EXPECT_EQ(watched.state().cause, bit(Trigger::fault));
    watched.expect_true_trace(fault);
  }
}

TEST(TraceTest, HasFewerRecordsBeforeATriggerThatComesEarlyAndIsWholeAllTheSame) {
  WatchedUnit watched;
  watched.restart();
  watched.control(10);
  watched.arm(bit(Trigger::target), 40);
  watched.control(5);
  watched.lose_a_sample();
  watched.restart();
  watched.aim(700'000);
  EXPECT_EQ(watched.state().before, 7);
  const std::uint32_t step = watched.last_step();
  watched.control(length);
  EXPECT_EQ(watched.state().cause, bit(Trigger::target));
  watched.expect_true_trace(step);
  EXPECT_EQ(watched.steps.at(step - 1).target, 400'000U);
  EXPECT_EQ(watched.steps.at(step).target, 700'000U);
}

// Armed and ordered in services between the same two steps, it misses nothing.
TEST(TraceTest, SeesATriggerInItsFirstStep) {
  WatchedUnit watched;
  watched.restart();
  watched.arm(bit(Trigger::target) | bit(Trigger::fault), 10);
  watched.aim(300'000);
  EXPECT_EQ(watched.phase(), link::TracePhase::recording);
  watched.arm(bit(Trigger::fault), 10);
  watched.lose_a_sample();
  EXPECT_EQ(watched.phase(), link::TracePhase::recording);
  const std::uint32_t fault = watched.last_step();
  watched.control(length);
  watched.expect_true_trace(fault);
}

// A fault that is there already is none.
TEST(TraceTest, WaitsForANewFault) {
  WatchedUnit watched;
  watched.restart();
  watched.lose_a_sample();
  watched.arm(bit(Trigger::fault), 10);
  watched.control(300);
  EXPECT_EQ(watched.phase(), link::TracePhase::waiting);
  watched.restart();
  watched.control(100);
  EXPECT_EQ(watched.phase(), link::TracePhase::waiting);
  watched.lose_a_sample();
  EXPECT_EQ(watched.phase(), link::TracePhase::recording);
}

TEST(TraceTest, OfAnyCourseIsThatOfTheStepsAndOutlivesStopsAndHosts) {
  std::minstd_rand random(3);
  WatchedUnit watched;
  watched.restart();
  for (int turn = 0; turn < 600; ++turn) {
    const auto triggers = static_cast<std::uint8_t>(1 + random() % link::all_triggers);
    const auto before = static_cast<std::uint16_t>(random() % length);
    watched.arm(triggers, before);
    std::optional<std::uint32_t> step;
    for (int act = 0; act < 40; ++act) {
      bool happened = (triggers & bit(Trigger::now)) != 0;
      const bool running = watched.unit.supervisor().driving();
      switch (random() % 8) {
        case 0:
          if (running) {
            watched.lose_a_sample();
            happened = happened || (triggers & bit(Trigger::fault)) != 0;
            break;
          }
          watched.control();
          break;
        case 1:
          watched.aim(100'000 + static_cast<std::uint32_t>(random() % 800'000));
          happened = happened || (triggers & bit(Trigger::target)) != 0;
          break;
        case 2:
          watched.restart();
          break;
        case 3:
          watched.unit.stop();
          watched.control();
          break;
        default:
          watched.control();
      }
      if (happened && !step) {
        step = watched.last_step();
      }
      if (!happened && !step) {
        watched.control(static_cast<int>(random() % 10));
      }
    }
    ASSERT_EQ(watched.phase() == link::TracePhase::waiting, !step.has_value()) << turn;
    if (step && random() % 2 == 0) {  // else it is armed again in mid record
      watched.control(length);
      watched.answer<link::Greeted>(link::Hello{1});
      watched.expect_true_trace(*step);
    }
    if (testing::Test::HasFatalFailure()) {
      FAIL() << turn;
    }
  }
}

TEST(TraceTest, RefusesWhatItCannotKeep) {
  WatchedUnit watched;
  EXPECT_EQ(watched.refusal({0, 10}), Reason::out_of_range);
  EXPECT_EQ(watched.refusal({8, 10}), Reason::out_of_range);
  EXPECT_EQ(watched.refusal({1, length}), Reason::out_of_range);
  EXPECT_EQ(watched.phase(), link::TracePhase::empty);
}

TEST(TraceTest, TakesNoRoomWhereThereIsNone) {
  EXPECT_TRUE(std::is_empty_v<TestedUnit::Supervisor::Recorder>);
  EXPECT_GE(sizeof(TracedUnit), sizeof(TestedUnit) + length * 20);
  EXPECT_LE(sizeof(TracedUnit), sizeof(TestedUnit) + length * 20 + 64);
}

TEST(TraceTest, RecordsABiasOrAFrequencyToo) {
  EXPECT_EQ((Trace<8, hal::Drive, std::atomic>::extra), link::TraceExtra::none);
  EXPECT_EQ((Trace<8, hal::BiasedDrive, std::atomic>::extra), link::TraceExtra::bias);
  EXPECT_EQ((Trace<8, hal::ResonantDrive, std::atomic>::extra), link::TraceExtra::frequency);
}

}  // namespace
}  // namespace sonoglide::app::trace_test
