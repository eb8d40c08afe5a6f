/// A unit with a host on its link: what is asked is done, kept over a reset, or refused by name.
#include "firmware/app/link_service.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cstdint>
#include <optional>
#include <vector>

#include "firmware/app/timed_loop.hpp"
#include "tests/app/unit/simulated_unit.hpp"

namespace sonoglide::app {
namespace {

using link::Reason;

/// From reset to the next reset; the flash outlives it.
class PoweredUnit {
 public:
  explicit PoweredUnit(SimulatedFlash& flash, const FieldDesign<Parts>& design = field_design)
      : unit(design, flash) {
    flash.restore_power();
  }

  void serve(int periods) {
    for (int i = 0; i < periods; ++i) {
      loop_.serve();
    }
  }

  void put(const link::Frame& frame) {
    const link::WireFrame encoded = link::encode(frame);
    wire.to_unit.insert(wire.to_unit.end(), encoded.bytes.begin(),
                        encoded.bytes.begin() + static_cast<std::ptrdiff_t>(encoded.size));
  }

  /// What the unit sends within some periods, in which it serves whatever was put.
  std::vector<link::Frame> answers() {
    serve(400);
    link::FrameDecoder decoder;
    std::vector<link::Frame> frames;
    for (const std::uint8_t byte : wire.from_unit) {
      if (decoder.take(byte) == link::Reception::frame) {
        frames.push_back(decoder.frame());
      }
    }
    wire.from_unit.clear();
    return frames;
  }

  /// The one frame that answers a request.
  template <class Request>
  link::Frame answer_to(const Request& request) {
    put(link::frame_of(request, ++sequence));
    const std::vector<link::Frame> frames = answers();
    EXPECT_EQ(frames.size(), 1U);
    if (frames.size() != 1) {
      return {};
    }
    EXPECT_EQ(frames.front().sequence, sequence);
    return frames.front();
  }

  /// The answer of the kind that is expected.
  template <class Answer, class Request>
  Answer ask(const Request& request) {
    Answer answer{};
    EXPECT_TRUE(link::read(answer_to(request), answer));
    return answer;
  }

  link::Telemetry telemetry() { return ask<link::Telemetry>(link::ReadTelemetry{}); }
  std::uint32_t read(Parameter parameter) {
    return ask<link::ParameterValue>(link::ReadParameter{static_cast<std::uint8_t>(parameter)})
        .value;
  }
  static link::WriteParameter writing(Parameter parameter, std::uint32_t value) {
    return {static_cast<std::uint8_t>(parameter), value};
  }

  TestedUnit unit;
  TimedBoard board;
  CountingWatchdog watchdog;
  Wire wire;
  std::uint16_t sequence = 100;

 private:
  using Service = LinkService<TestedUnit, Wire>;

  Service service_{unit, wire};
  TimedLoop<TestedUnit::Supervisor, TimedBoard, CountingWatchdog, Service> loop_{
      unit.supervisor(), board, watchdog, service_};
};

constexpr auto off = static_cast<std::uint8_t>(control::State::off);
constexpr auto running = static_cast<std::uint8_t>(control::State::running);
constexpr auto limited = static_cast<std::uint8_t>(control::State::limited);
constexpr auto faulted = static_cast<std::uint8_t>(control::State::fault);

void expect_refusal(const link::Frame& frame, std::uint8_t request, Reason reason,
                    std::uint32_t lowest, std::uint32_t highest) {
  link::Refusal refusal{};
  ASSERT_TRUE(link::read(frame, refusal));
  EXPECT_EQ(refusal.request, request);
  EXPECT_EQ(refusal.reason, static_cast<std::uint8_t>(reason));
  EXPECT_EQ(refusal.lowest, lowest);
  EXPECT_EQ(refusal.highest, highest);
}

TEST(LinkServiceTest, TelemetryShowsTheRunningUnit) {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  powered.serve(300);
  const link::Telemetry told = powered.telemetry();
  EXPECT_GT(told.period, 300U);
  EXPECT_LT(told.period, powered.unit.supervisor().periods());
  EXPECT_EQ(told.state, running);
  EXPECT_EQ(told.fault, 0);
  EXPECT_EQ(told.target, 400000U);
  EXPECT_EQ(told.parameters, static_cast<std::uint8_t>(store::Origin::blank));
  EXPECT_EQ(told.damaged_frames, 0);
  EXPECT_NEAR(told.friction_force * 0x1p-31, 0.4 * TimedBoard::friction, 1e-3);
  EXPECT_NEAR(told.sliding_velocity * 0x1p-31, TimedBoard::speed, 1e-9);
  EXPECT_NEAR(told.amplitude, powered.board.latest_drive().amplitude, 0x1p31 * 1e-3);
}

TEST(LinkServiceTest, ATargetSetInMidRunIsReached) {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  powered.serve(300);
  for (const std::uint32_t target : {600000U, 123456U, 990000U}) {
    EXPECT_EQ(powered.ask<link::TargetSet>(link::SetTarget{target}).ratio, target);
    powered.serve(300);
    EXPECT_NEAR(powered.board.ratio(), target / 1e6, 1e-3);
    EXPECT_EQ(powered.telemetry().target, target);
  }
  EXPECT_EQ(powered.watchdog.feeds, static_cast<int>(powered.unit.supervisor().periods()));
}

TEST(LinkServiceTest, ATargetOutOfRangeIsRefusedAndChangesNothing) {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  expect_refusal(powered.answer_to(link::SetTarget{1000001}), link::SetTarget::kind,
                 Reason::out_of_range, 0, 1000000);
  EXPECT_EQ(powered.telemetry().target, 400000U);
}

TEST(LinkServiceTest, StopTakesTheDriveAwayUntilARestart) {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  powered.serve(300);
  powered.ask<link::Stopped>(link::Stop{});
  EXPECT_EQ(powered.board.latest_drive().amplitude, 0);
  EXPECT_EQ(powered.telemetry().state, off);
  powered.ask<link::Restarted>(link::Restart{});
  EXPECT_EQ(powered.telemetry().state, running);
  EXPECT_NEAR(powered.board.ratio(), 0.4, 1e-3);
}

TEST(LinkServiceTest, AFaultIsReportedLoggedAndLeftByARestart) {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  expect_refusal(powered.answer_to(link::ReadFault{0}), link::ReadFault::kind,
                 Reason::no_such_fault, 0, 0);
  powered.board.fresh = false;
  powered.serve(1);
  const std::uint32_t period = powered.unit.supervisor().periods();
  powered.board.fresh = true;
  const link::Telemetry told = powered.telemetry();
  EXPECT_EQ(told.state, faulted);
  EXPECT_EQ(told.fault, static_cast<std::uint8_t>(control::Fault::measurement_missing));
  EXPECT_EQ(told.amplitude, 0);
  const auto logged = powered.ask<link::LoggedFault>(link::ReadFault{0});
  EXPECT_EQ(logged.fault, told.fault);
  EXPECT_EQ(logged.period, period);
  EXPECT_EQ(logged.count, 1U);
  powered.ask<link::Restarted>(link::Restart{});
  EXPECT_EQ(powered.telemetry().state, running);
  EXPECT_EQ(powered.ask<link::LoggedFault>(link::ReadFault{0}).count, 1U);
}

TEST(LinkServiceTest, EveryParameterIsReadWithItsRange) {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  for (std::uint8_t i = 0; i < parameter_count; ++i) {
    const auto told = powered.ask<link::ParameterValue>(link::ReadParameter{i});
    const ParameterInfo& info = field_design.info(i);
    EXPECT_EQ(told.parameter, i);
    EXPECT_EQ(told.decimal_places, info.decimal_places);
    EXPECT_EQ(told.value, info.preset);
    EXPECT_EQ(told.lowest, info.lowest);
    EXPECT_EQ(told.highest, info.highest);
    EXPECT_EQ(told.preset, info.preset);
  }
  for (const int unknown : {6, 7, 255}) {
    const auto parameter = static_cast<std::uint8_t>(unknown);
    expect_refusal(powered.answer_to(link::ReadParameter{parameter}), link::ReadParameter::kind,
                   Reason::unknown_parameter, 0, 5);
    powered.unit.supervisor().stop();
    expect_refusal(powered.answer_to(link::WriteParameter{parameter, 0}),
                   link::WriteParameter::kind, Reason::unknown_parameter, 0, 5);
  }
}

TEST(LinkServiceTest, ParametersNeedAStopAndAreKeptOverAReset) {
  SimulatedFlash flash;
  {
    PoweredUnit powered(flash);
    const auto write = PoweredUnit::writing(Parameter::drive_limit, 120000);
    expect_refusal(powered.answer_to(write), link::WriteParameter::kind, Reason::drive_not_stopped,
                   0, 0);
    EXPECT_EQ(flash.operations(), 0);
    powered.ask<link::Stopped>(link::Stop{});
    EXPECT_EQ(powered.ask<link::ParameterWritten>(write).value, 120000U);
    powered.ask<link::ParameterWritten>(PoweredUnit::writing(Parameter::target, 500000));
    EXPECT_EQ(powered.read(Parameter::drive_limit), 120000U);
  }
  PoweredUnit powered(flash);
  EXPECT_EQ(powered.read(Parameter::drive_limit), 120000U);
  powered.serve(300);
  const link::Telemetry told = powered.telemetry();
  EXPECT_EQ(told.parameters, static_cast<std::uint8_t>(store::Origin::stored));
  EXPECT_EQ(told.target, 500000U);
  // A ratio of 0.5 would take 0.141 of the actuator's limit.
  EXPECT_EQ(told.state, limited);
  EXPECT_EQ(told.limit, static_cast<std::uint8_t>(control::Limit::actuator));
  EXPECT_NEAR(powered.board.latest_drive().amplitude * 0x1p-31, 0.12, 1e-7);
}

TEST(LinkServiceTest, AWrittenParameterIsInForceFromTheNextRestart) {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  powered.ask<link::TargetSet>(link::SetTarget{500000});
  powered.ask<link::Stopped>(link::Stop{});
  powered.ask<link::ParameterWritten>(PoweredUnit::writing(Parameter::drive_limit, 120000));
  EXPECT_EQ(powered.board.latest_drive().amplitude, 0);
  powered.ask<link::Restarted>(link::Restart{});
  EXPECT_NEAR(powered.board.latest_drive().amplitude * 0x1p-31, 0.12, 1e-7);
  EXPECT_EQ(powered.telemetry().target, 500000U);
}

TEST(LinkServiceTest, AValueOutOfRangeIsRefusedByItsRangeAndChangesNothing) {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  powered.unit.supervisor().stop();
  for (std::uint8_t i = 0; i < parameter_count; ++i) {
    const ParameterInfo& info = field_design.info(i);
    expect_refusal(powered.answer_to(link::WriteParameter{i, info.highest + 1}),
                   link::WriteParameter::kind, Reason::out_of_range, info.lowest, info.highest);
    EXPECT_EQ(powered.ask<link::ParameterValue>(link::ReadParameter{i}).value, info.preset);
  }
  EXPECT_EQ(flash.operations(), 0);
}

TEST(LinkServiceTest, FlashThatDoesNotKeepAValueIsReported) {
  SimulatedFlash flash;
  flash.wear_out();
  PoweredUnit powered(flash);
  powered.unit.supervisor().stop();
  expect_refusal(powered.answer_to(PoweredUnit::writing(Parameter::gain_scale, 1)),
                 link::WriteParameter::kind, Reason::not_saved, 0, 0);
  EXPECT_EQ(powered.read(Parameter::gain_scale), one_in_millionths);
}

TEST(LinkServiceTest, APowerCutWhileWritingLeavesTheOldValueOrTheNew) {
  for (int operation = 0; operation < 10; ++operation) {
    for (const Torn torn : every_tear) {
      SimulatedFlash flash;
      {
        PoweredUnit powered(flash);
        powered.unit.supervisor().stop();
        powered.ask<link::ParameterWritten>(PoweredUnit::writing(Parameter::gain_scale, 111));
        powered.put(link::frame_of(PoweredUnit::writing(Parameter::gain_scale, 222), 200));
        flash.cut_after(operation, torn);
        for (int i = 0; i < 400 && flash.powered(); ++i) {
          powered.serve(1);
        }
      }
      PoweredUnit powered(flash);
      const std::uint32_t value = powered.read(Parameter::gain_scale);
      EXPECT_TRUE(value == 111 || value == 222) << operation;
    }
  }
}

TEST(LinkServiceTest, AnotherDesignsParametersAreNotUsedAndThatIsReported) {
  SimulatedFlash flash;
  {
    PoweredUnit powered(flash);
    powered.unit.supervisor().stop();
    powered.ask<link::ParameterWritten>(PoweredUnit::writing(Parameter::gain_scale, 111));
  }
  static constexpr FieldDesign<Parts> other(designed, 0.2F, 2);
  PoweredUnit powered(flash, other);
  EXPECT_EQ(powered.telemetry().parameters, static_cast<std::uint8_t>(store::Origin::other_layout));
  EXPECT_EQ(powered.read(Parameter::gain_scale), one_in_millionths);
}

TEST(LinkServiceTest, ARepeatedRequestIsAnsweredAgainAndNotDoneAgain) {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  powered.unit.supervisor().stop();
  const auto write = link::frame_of(PoweredUnit::writing(Parameter::gain_scale, 111), 7);
  powered.put(write);
  powered.put(write);
  powered.put(write);
  const std::vector<link::Frame> frames = powered.answers();
  ASSERT_EQ(frames.size(), 3U);
  for (const link::Frame& frame : frames) {
    link::ParameterWritten written{};
    EXPECT_TRUE(link::read(frame, written));
    EXPECT_EQ(frame.sequence, 7);
  }
  EXPECT_EQ(flash.operations(), 10);
}

TEST(LinkServiceTest, ALateOrReusedNumberIsRefusedWithTheLast) {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  powered.put(link::frame_of(link::SetTarget{600000}, 1000));
  powered.put(link::frame_of(link::SetTarget{700000}, 999));
  powered.put(link::frame_of(link::SetTarget{800000}, 1000));
  powered.put(link::frame_of(link::SetTarget{600000}, 1000));
  const std::vector<link::Frame> frames = powered.answers();
  ASSERT_EQ(frames.size(), 4U);
  expect_refusal(frames[1], link::SetTarget::kind, Reason::out_of_turn, 1000, 1000);
  EXPECT_EQ(frames[1].sequence, 999);
  expect_refusal(frames[2], link::SetTarget::kind, Reason::out_of_turn, 1000, 1000);
  link::TargetSet set{};
  EXPECT_TRUE(link::read(frames[3], set));
  EXPECT_EQ(powered.unit.target(), 600000U);
}

TEST(LinkServiceTest, UnknownAndMisshapenRequestsAreRefused) {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  for (const int kind : {0, 8, 0x7F, 0x81, 0xFF}) {
    link::Frame frame;
    frame.kind = static_cast<std::uint8_t>(kind);
    frame.sequence = ++powered.sequence;
    powered.put(frame);
    expect_refusal(powered.answers().at(0), frame.kind, Reason::unknown_request, 0, 0);
  }
  for (std::uint8_t kind = 1; kind < 8; ++kind) {
    link::Frame frame;
    frame.kind = kind;
    frame.sequence = ++powered.sequence;
    frame.payload_bytes = 6;
    powered.put(frame);
    expect_refusal(powered.answers().at(0), kind, Reason::wrong_length, 0, 0);
  }
}

TEST(LinkServiceTest, DamagedFramesAreCountedAndCostNoStep) {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  powered.put(link::frame_of(link::Stop{}, 1));
  powered.wire.to_unit[4] ^= 0x40U;
  EXPECT_TRUE(powered.answers().empty());
  EXPECT_EQ(powered.telemetry().damaged_frames, 1);
  EXPECT_EQ(powered.telemetry().state, running);
  EXPECT_EQ(powered.watchdog.feeds, static_cast<int>(powered.unit.supervisor().periods()));
}

// The bound on what a carrier period spends on the link.
TEST(LinkServiceTest, APeriodMovesOneByteOrOneStepOfASave) {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  powered.unit.supervisor().stop();
  powered.put(link::frame_of(PoweredUnit::writing(Parameter::gain_scale, 111), 7));
  for (int i = 0; i < 400; ++i) {
    const std::size_t to = powered.wire.to_unit.size();
    const std::size_t from = powered.wire.from_unit.size();
    const int operations = flash.operations();
    powered.serve(1);
    const std::size_t moved =
        (to - powered.wire.to_unit.size()) + (powered.wire.from_unit.size() - from);
    ASSERT_LE(moved + static_cast<std::size_t>(flash.operations() - operations), 1U);
  }
  EXPECT_EQ(flash.operations(), 10);
}

RC_GTEST_PROP(LinkServiceTest, AnyRequestIsAnsweredAndNoneHarms, ()) {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  const int requests = *rc::gen::inRange(1, 30);
  for (int i = 0; i < requests; ++i) {
    link::Frame frame;
    frame.kind = *rc::gen::weightedOneOf<std::uint8_t>(
        {{4, rc::gen::inRange<std::uint8_t>(1, 8)}, {1, rc::gen::arbitrary<std::uint8_t>()}});
    frame.sequence = ++powered.sequence;
    frame.payload_bytes = *rc::gen::element<std::uint8_t>(0, 1, 4, 5, 28);
    for (auto& byte : frame.payload) {
      byte = *rc::gen::weightedOneOf<std::uint8_t>(
          {{2, rc::gen::inRange<std::uint8_t>(0, 7)}, {1, rc::gen::arbitrary<std::uint8_t>()}});
    }
    powered.put(frame);
    RC_ASSERT(powered.answers().size() == 1U);
  }
  RC_ASSERT(!flash.misused());
  RC_ASSERT(powered.watchdog.feeds == static_cast<int>(powered.unit.supervisor().periods()));
  for (std::size_t i = 0; i < parameter_count; ++i) {
    RC_ASSERT(powered.unit.info(i).allows(powered.unit.value(i)));
  }
}

}  // namespace
}  // namespace sonoglide::app
