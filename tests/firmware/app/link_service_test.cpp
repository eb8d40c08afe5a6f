/// A unit with a host on its link: what is asked is done, kept over a reset, or refused by name.
#include "firmware/app/link_service.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <array>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "firmware/app/timed_loop.hpp"
#include "firmware/numeric/scalar.hpp"
#include "tests/firmware/app/unit/simulated_unit.hpp"

namespace sonoglide::app::link_service_test {
namespace {

using link::Reason;

/// From reset to the next reset; the flash outlives it.
template <class UnitT>
class PoweredUnitOf {
 public:
  template <class... More>
  explicit PoweredUnitOf(SimulatedFlash& flash, const FieldDesign<Parts>& design = field_design,
                         const More&... more)
      : unit(with_power(flash, design), flash, more...) {}

  /// As a host would, but without the link.
  void start(int periods = 300) {
    EXPECT_EQ(unit.restart(unit.supervisor().faults().count()), Answer::taken);
    serve(1 + periods);
  }

  void serve(int periods) {
    for (int i = 0; i < periods; ++i) {
      loop_.serve();
    }
  }

  /// A sample that does not arrive: a fault.
  void miss_a_sample() {
    board.fresh = false;
    serve(1);
    board.fresh = true;
  }

  void put(const link::Frame& frame) {
    const link::WireFrame encoded = link::encode(frame);
    wire.to_unit.insert(wire.to_unit.end(), encoded.bytes.begin(),
                        encoded.bytes.begin() + static_cast<std::ptrdiff_t>(encoded.size));
  }

  /// What the unit sends within some periods, in which it serves whatever was put.
  std::vector<link::Frame> answers() {
    serve(600);
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
  /// The value that the answer tells.
  std::uint32_t write(Parameter parameter, std::uint32_t value) {
    return ask<link::ParameterWritten>(writing(parameter, value)).value;
  }
  static link::WriteParameter writing(Parameter parameter, std::uint32_t value) {
    return {static_cast<std::uint8_t>(parameter), value};
  }

  UnitT unit;
  TimedBoard board;
  CountingWatchdog watchdog;
  Wire wire;
  std::uint16_t sequence = 100;

 private:
  static const FieldDesign<Parts>& with_power(SimulatedFlash& flash,
                                              const FieldDesign<Parts>& design) {
    flash.restore_power();
    return design;
  }

  /// Of one byte each way, so that every byte has a period of its own.
  using Service = LinkService<UnitT, Wire, 1, TestedProduct>;

  Service service_{unit, wire};
  TimedLoop<typename UnitT::Supervisor, TimedBoard, CountingWatchdog, Service> loop_{
      unit.supervisor(), board, watchdog, service_};
};

using PoweredUnit = PoweredUnitOf<TestedUnit>;

constexpr auto off = static_cast<std::uint8_t>(control::State::off);
constexpr auto running = static_cast<std::uint8_t>(control::State::running);
constexpr auto limited = static_cast<std::uint8_t>(control::State::limited);
constexpr auto faulted = static_cast<std::uint8_t>(control::State::fault);

/// Erase; format, sequence, design; identity and value of each parameter; checksum.
constexpr int operations_of_a_save = 1 + 3 + 2 * static_cast<int>(parameter_count) + 1;

void expect_refusal(const link::Frame& frame, std::uint8_t request, Reason reason,
                    std::uint32_t lowest, std::uint32_t highest) {
  link::Refusal refusal{};
  ASSERT_TRUE(link::read(frame, refusal));
  EXPECT_EQ(refusal.request, request);
  EXPECT_EQ(refusal.reason, static_cast<std::uint8_t>(reason));
  EXPECT_EQ(refusal.lowest, lowest);
  EXPECT_EQ(refusal.highest, highest);
}

/// A unit whose flash was blank at power-on.
class UnitOnALink : public testing::Test {
 protected:
  SimulatedFlash flash_;
  PoweredUnit powered_{flash_};
};

TEST_F(UnitOnALink, TelemetryShowsTheRunningUnit) {
  powered_.start();
  const link::Telemetry told = powered_.telemetry();
  EXPECT_GT(told.period, 300U);
  EXPECT_LT(told.period, powered_.unit.supervisor().periods());
  EXPECT_EQ(told.state, running);
  EXPECT_EQ(told.fault, 0);
  EXPECT_EQ(told.target, 400000U);
  EXPECT_EQ(told.parameters, static_cast<std::uint8_t>(store::Origin::blank));
  EXPECT_EQ(told.lost_frames, 0);
  EXPECT_NEAR(numeric::from_code<double>(told.friction_force), 0.4 * TimedBoard::friction, 1e-3);
  EXPECT_NEAR(numeric::from_code<double>(told.sliding_velocity), TimedBoard::speed, 1e-9);
  EXPECT_NEAR(told.amplitude, powered_.board.latest_drive().amplitude, numeric::to_code(1e-3));
  EXPECT_EQ(told.settling, static_cast<std::uint8_t>(control::Settling::settled));
  EXPECT_NEAR(told.mismatch, 1000, 1);
}

TEST(LinkServiceTest, TheMismatchIsKnownOfASettledRatioAlone) {
  hal::Drive drive{};
  drive.commanded_ratio = numeric::to_code(0.25);  // 2^31 is a ratio of 2
  EXPECT_EQ(mismatch_thousandths(drive, 400000), 0);
  drive.settling = static_cast<std::uint8_t>(control::Settling::settled);
  EXPECT_EQ(mismatch_thousandths(drive, 400000), 1250);
  EXPECT_EQ(mismatch_thousandths(drive, 0), 0);
  EXPECT_EQ(mismatch_thousandths(drive, 1), UINT16_MAX);
}

TEST_F(UnitOnALink, SaysWhatItIs) {
  const auto told = powered_.ask<link::Identity>(link::ReadIdentity{});
  EXPECT_EQ(std::to_string(told.major_number) + '.' + std::to_string(told.minor_number) + '.' +
                std::to_string(told.patch_number),
            SONOGLIDE_VERSION);
  EXPECT_EQ(told.design, field_design.design());
  EXPECT_EQ(told.serial_number, 4711U);
  EXPECT_STREQ(told.board.data(), "test-stand");
}

TEST_F(UnitOnALink, TellsTheFullScalesOfItsDesign) {
  for (std::uint8_t i = 0; i < link::quantity_count; ++i) {
    const auto told = powered_.ask<link::Scale>(link::ReadScale{i});
    EXPECT_EQ(told.quantity, i);
    EXPECT_EQ(link::full_scale_of(told).unit, full_scales[i].unit);
    EXPECT_EQ(link::full_scale_of(told).value, full_scales[i].value);
  }
  expect_refusal(powered_.answer_to(link::ReadScale{link::quantity_count}), link::ReadScale::kind,
                 Reason::out_of_range, 0, link::quantity_count - 1);
}

TEST_F(UnitOnALink, TellsTheExceptionThatWasKeptOverTheReset) {
  expect_refusal(powered_.answer_to(link::ReadException{}), link::ReadException::kind,
                 Reason::no_such_fault, 0, 0);
  const hal::KeptException kept{3, 0x1234, 0x5679, 0x61000003, 1U << 16, 1U << 30, 0xe000ed00};
  TestedProduct::exception = &kept;
  const auto told = powered_.ask<link::KeptException>(link::ReadException{});
  TestedProduct::exception = nullptr;
  EXPECT_EQ(told.words, hal::words_of(kept));
}

TEST(LinkServiceTest, AnImageThatKeepsNoExceptionDoesNotKnowTheRequest) {
  SimulatedFlash flash;
  TestedUnit unit(field_design, flash);
  UnitRequests<TestedUnit, Unnamed> requests(unit);
  requests.take(link::frame_of(link::ReadException{}, 1), 0);
  expect_refusal(requests.answer(), link::ReadException::kind, Reason::unknown_request, 0, 0);
}

TEST(LinkServiceTest, HasNoNameWhereNoneWasGiven) {
  EXPECT_STREQ(Unnamed::board, "");
  EXPECT_EQ(Unnamed::serial_number(), 0U);
  EXPECT_EQ(padded<4>(Unnamed::board), (std::array<char, 4>{}));
  EXPECT_EQ(padded<4>("unit"), (std::array<char, 4>{'u', 'n', 'i', 't'}));
}

TEST_F(UnitOnALink, ATargetSetInMidRunIsReached) {
  powered_.start();
  for (const std::uint32_t target : {600000U, 123456U, 990000U}) {
    EXPECT_EQ(powered_.ask<link::TargetSet>(link::SetTarget{target}).target, target);
    powered_.serve(300);
    EXPECT_NEAR(powered_.board.ratio(), target / 1e6, 1e-3);
    const link::Telemetry told = powered_.telemetry();
    EXPECT_EQ(told.target, target);
    EXPECT_NEAR(told.mismatch, 1000, 10) << target;
  }
  EXPECT_EQ(powered_.watchdog.feeds, static_cast<int>(powered_.unit.supervisor().periods()));
}

TEST_F(UnitOnALink, ATargetOutOfRangeIsRefusedAndChangesNothing) {
  expect_refusal(powered_.answer_to(link::SetTarget{1000001}), link::SetTarget::kind,
                 Reason::out_of_range, 0, 1000000);
  EXPECT_EQ(powered_.telemetry().target, 400000U);
}

TEST_F(UnitOnALink, StopTakesTheDriveAwayUntilARestart) {
  powered_.start();
  powered_.ask<link::Stopped>(link::Stop{});
  EXPECT_EQ(powered_.board.latest_drive().amplitude, 0);
  EXPECT_EQ(powered_.telemetry().state, off);
  powered_.ask<link::Restarted>(link::Restart{});
  EXPECT_EQ(powered_.telemetry().state, running);
  EXPECT_NEAR(powered_.board.ratio(), 0.4, 1e-3);
}

TEST_F(UnitOnALink, AFaultIsReportedLoggedAndLeftByARestart) {
  expect_refusal(powered_.answer_to(link::ReadFault{0}), link::ReadFault::kind,
                 Reason::no_such_fault, 0, 0);
  powered_.start();
  powered_.miss_a_sample();
  const std::uint32_t period = powered_.unit.supervisor().periods();
  const link::Telemetry told = powered_.telemetry();
  EXPECT_EQ(told.state, faulted);
  EXPECT_EQ(told.fault, static_cast<std::uint8_t>(control::Fault::measurement_missing));
  EXPECT_EQ(told.amplitude, 0);
  const auto logged = powered_.ask<link::LoggedFault>(link::ReadFault{0});
  EXPECT_EQ(logged.fault, told.fault);
  EXPECT_EQ(logged.period, period);
  EXPECT_EQ(logged.count, 1U);
  powered_.ask<link::Restarted>(link::Restart{});
  EXPECT_EQ(powered_.telemetry().state, running);
  EXPECT_EQ(powered_.ask<link::LoggedFault>(link::ReadFault{0}).count, 1U);

  powered_.miss_a_sample();
  const auto latest = powered_.ask<link::LoggedFault>(link::ReadFault{0});
  const auto before = powered_.ask<link::LoggedFault>(link::ReadFault{1});
  EXPECT_EQ(latest.count, 2U);
  EXPECT_EQ(latest.age, 0);
  EXPECT_GT(latest.period, period);
  EXPECT_EQ(before.age, 1);
  EXPECT_EQ(before.period, period);
}

TEST_F(UnitOnALink, EveryParameterIsReadWithItsRange) {
  for (std::uint8_t i = 0; i < parameter_count; ++i) {
    const auto told = powered_.ask<link::ParameterValue>(link::ReadParameter{i});
    const ParameterRange& range = field_design.range(i);
    EXPECT_EQ(told.parameter, i);
    EXPECT_EQ(told.decimal_places, parameter_labels[i].decimal_places);
    EXPECT_EQ(told.value, range.preset);
    EXPECT_EQ(told.lowest, range.lowest);
    EXPECT_EQ(told.highest, range.highest);
    EXPECT_EQ(told.preset, range.preset);
  }
  for (const int unknown : {11, 12, 255}) {
    const auto parameter = static_cast<std::uint8_t>(unknown);
    expect_refusal(powered_.answer_to(link::ReadParameter{parameter}), link::ReadParameter::kind,
                   Reason::unknown_parameter, 0, 10);
    expect_refusal(powered_.answer_to(link::WriteParameter{parameter, 0}),
                   link::WriteParameter::kind, Reason::unknown_parameter, 0, 10);
  }
}

TEST(LinkServiceTest, ParametersNeedAStopAndAreKeptOverAReset) {
  SimulatedFlash flash;
  {
    PoweredUnit powered(flash);
    powered.start();
    const auto write = PoweredUnit::writing(Parameter::drive_limit, 120000);
    expect_refusal(powered.answer_to(write), link::WriteParameter::kind, Reason::drive_not_stopped,
                   0, 0);
    EXPECT_EQ(flash.operations(), 0);
    powered.ask<link::Stopped>(link::Stop{});
    EXPECT_EQ(powered.ask<link::ParameterWritten>(write).value, 120000U);
    powered.write(Parameter::target, 500000);
    EXPECT_EQ(powered.read(Parameter::drive_limit), 120000U);
  }
  PoweredUnit powered(flash);
  EXPECT_EQ(powered.read(Parameter::drive_limit), 120000U);
  powered.start();
  const link::Telemetry told = powered.telemetry();
  EXPECT_EQ(told.parameters, static_cast<std::uint8_t>(store::Origin::stored));
  EXPECT_EQ(told.target, 500000U);
  // A ratio of 0.5 would take 0.141 of the actuator's limit.
  EXPECT_EQ(told.state, limited);
  EXPECT_EQ(told.limit, static_cast<std::uint8_t>(control::Limit::actuator));
  EXPECT_NEAR(numeric::from_code<double>(powered.board.latest_drive().amplitude), 0.12, 1e-7);
}

TEST_F(UnitOnALink, TheAnswerToAWriteBearsItsParameterAndValue) {
  for (std::uint8_t i = 0; i < parameter_count; ++i) {
    const std::uint32_t value = field_design.range(i).highest;
    const auto written = powered_.ask<link::ParameterWritten>(link::WriteParameter{i, value});
    EXPECT_EQ(written.parameter, i);
    EXPECT_EQ(written.value, value) << int{i};
  }
}

TEST_F(UnitOnALink, AWrittenParameterIsInForceFromTheNextRestart) {
  powered_.ask<link::TargetSet>(link::SetTarget{500000});
  powered_.ask<link::Stopped>(link::Stop{});
  powered_.write(Parameter::drive_limit, 120000);
  EXPECT_EQ(powered_.board.latest_drive().amplitude, 0);
  powered_.ask<link::Restarted>(link::Restart{});
  EXPECT_NEAR(numeric::from_code<double>(powered_.board.latest_drive().amplitude), 0.12, 1e-7);
  EXPECT_EQ(powered_.telemetry().target, 500000U);
}

TEST_F(UnitOnALink, AValueOutOfRangeIsRefusedByItsRangeAndChangesNothing) {
  for (std::uint8_t i = 0; i < parameter_count; ++i) {
    const ParameterRange& range = field_design.range(i);
    expect_refusal(powered_.answer_to(link::WriteParameter{i, range.highest + 1}),
                   link::WriteParameter::kind, Reason::out_of_range, range.lowest, range.highest);
    EXPECT_EQ(powered_.ask<link::ParameterValue>(link::ReadParameter{i}).value, range.preset);
  }
  EXPECT_EQ(flash_.operations(), 0);
}

TEST(LinkServiceTest, FlashThatDoesNotKeepAValueIsReported) {
  SimulatedFlash flash;
  flash.wear_out();
  PoweredUnit powered(flash);
  expect_refusal(powered.answer_to(PoweredUnit::writing(Parameter::gain_scale, 1)),
                 link::WriteParameter::kind, Reason::not_saved, 0, 0);
  EXPECT_EQ(powered.read(Parameter::gain_scale), one_in_millionths);
}

// In every step of a save: the answer comes after 10 s, and the link goes on.
TEST(LinkServiceTest, AFlashThatStaysBusyIsReportedAndDoesNotMuteTheLink) {
  constexpr int save_periods = 600'000;
  for (const int when : {0, 30, 60}) {
    SimulatedFlash flash;
    PoweredUnit powered(flash);
    const std::uint32_t before = powered.read(Parameter::gain_scale);
    powered.put(link::frame_of(PoweredUnit::writing(Parameter::gain_scale, 111), 1000));
    powered.serve(16 + when);
    flash.hang();
    powered.serve(save_periods - 700 - when);
    ASSERT_TRUE(powered.answers().empty()) << when;
    powered.serve(when + 100);
    const std::vector<link::Frame> frames = powered.answers();
    ASSERT_EQ(frames.size(), 1U) << when;
    expect_refusal(frames.front(), link::WriteParameter::kind, Reason::not_saved, 0, 0);
    powered.sequence = 1000;
    EXPECT_EQ(powered.read(Parameter::gain_scale), before);
    powered.ask<link::Restarted>(link::Restart{});
    EXPECT_EQ(powered.telemetry().state, running);
    powered.ask<link::Stopped>(link::Stop{});
    flash.hang(false);
    EXPECT_EQ(powered.write(Parameter::gain_scale, 222), 222U);
    EXPECT_EQ(PoweredUnit(flash).read(Parameter::gain_scale), 222U);
  }
}

TEST(LinkServiceTest, APowerCutWhileWritingLeavesTheOldValueOrTheNew) {
  for (int operation = 0; operation < operations_of_a_save; ++operation) {
    for (const Torn torn : every_tear) {
      SimulatedFlash flash;
      {
        PoweredUnit powered(flash);
        powered.write(Parameter::gain_scale, 111);
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

TEST_F(UnitOnALink, ARepeatedRequestIsAnsweredAgainAndNotDoneAgain) {
  const auto write = link::frame_of(PoweredUnit::writing(Parameter::gain_scale, 111), 7);
  powered_.put(write);
  powered_.put(write);
  powered_.put(write);
  const std::vector<link::Frame> frames = powered_.answers();
  ASSERT_EQ(frames.size(), 3U);
  for (const link::Frame& frame : frames) {
    link::ParameterWritten written{};
    EXPECT_TRUE(link::read(frame, written));
    EXPECT_EQ(frame.sequence, 7);
  }
  EXPECT_EQ(flash_.operations(), operations_of_a_save);
}

// A host whose answer was lost goes on from the number that it is told.
TEST_F(UnitOnALink, ARepeatedRestartIsRefusedAndNotAnsweredFromMemory) {
  powered_.put(link::frame_of(link::Restart{}, 7));
  powered_.put(link::frame_of(link::Restart{}, 7));
  const std::vector<link::Frame> frames = powered_.answers();
  ASSERT_EQ(frames.size(), 2U);
  EXPECT_EQ(frames[0].kind, link::Restarted::kind);
  expect_refusal(frames[1], link::Restart::kind, Reason::out_of_turn, 7, 7);
}

// Each counts from 0, whatever the one before it did.
TEST_F(UnitOnALink, ThreeHostsThatBeginAtZeroGetFreshAnswers) {
  std::uint32_t period = 0;
  for (std::uint16_t host = 0; host < 3; ++host) {
    for (const bool greets : {true, false}) {
      std::uint16_t sequence = 0;
      if (greets) {
        powered_.put(link::frame_of(link::Hello{host}, sequence++));
        link::Greeted greeted{};
        ASSERT_TRUE(link::read(powered_.answers().at(0), greeted));
        EXPECT_EQ(greeted.session, host);
        EXPECT_EQ(greeted.design, field_design.design());
        powered_.put(link::frame_of(link::Restart{}, sequence++));
        EXPECT_EQ(powered_.answers().at(0).kind, link::Restarted::kind);
      } else {
        sequence = 2;  // a host that only reads, with the number of the one before it
      }
      powered_.put(link::frame_of(link::ReadTelemetry{}, sequence));
      link::Telemetry told{};
      ASSERT_TRUE(link::read(powered_.answers().at(0), told));
      EXPECT_GT(told.period, period);
      period = told.period;
    }
  }
}

TEST_F(UnitOnALink, ALateOrReusedNumberIsRefusedWithTheLast) {
  powered_.put(link::frame_of(link::SetTarget{600000}, 1000));
  powered_.put(link::frame_of(link::SetTarget{700000}, 999));
  powered_.put(link::frame_of(link::SetTarget{800000}, 1000));
  powered_.put(link::frame_of(link::SetTarget{600000}, 1000));
  const std::vector<link::Frame> frames = powered_.answers();
  ASSERT_EQ(frames.size(), 4U);
  expect_refusal(frames[1], link::SetTarget::kind, Reason::out_of_turn, 1000, 1000);
  EXPECT_EQ(frames[1].sequence, 999);
  expect_refusal(frames[2], link::SetTarget::kind, Reason::out_of_turn, 1000, 1000);
  link::TargetSet set{};
  EXPECT_TRUE(link::read(frames[3], set));
  EXPECT_EQ(powered_.unit.target(), 600000U);
}

TEST_F(UnitOnALink, UnknownAndMisshapenRequestsAreRefused) {
  for (const int kind : {0, 0x3F, 0x7F, 0x81, 0xFF}) {
    link::Frame frame;
    frame.kind = static_cast<std::uint8_t>(kind);
    frame.sequence = ++powered_.sequence;
    powered_.put(frame);
    expect_refusal(powered_.answers().at(0), frame.kind, Reason::unknown_request, 0, 0);
  }
  for (std::uint8_t kind = 1; kind <= link::Stream::kind; ++kind) {
    link::Frame frame;
    frame.kind = kind;
    frame.sequence = ++powered_.sequence;
    frame.payload_bytes = 6;
    powered_.put(frame);
    expect_refusal(powered_.answers().at(0), kind, Reason::wrong_length, 0, 0);
  }
}

TEST_F(UnitOnALink, DamagedFramesAreCountedAndCostNoStep) {
  powered_.start();
  powered_.put(link::frame_of(link::Stop{}, 1));
  powered_.wire.to_unit[4] ^= 0x40U;
  EXPECT_TRUE(powered_.answers().empty());
  EXPECT_EQ(powered_.telemetry().lost_frames, 1);
  EXPECT_EQ(powered_.telemetry().state, running);
  EXPECT_EQ(powered_.watchdog.feeds, static_cast<int>(powered_.unit.supervisor().periods()));
}

class StreamTest : public UnitOnALink {
 protected:
  /// The samples among what the unit sends in some periods, its answers left out.
  std::vector<link::Streamed> samples() {
    std::vector<link::Streamed> found;
    for (const link::Frame& frame : powered_.answers()) {
      link::Streamed sample{};
      if (link::read(frame, sample)) {
        found.push_back(sample);
      }
    }
    return found;
  }
  std::vector<link::Streamed> samples_of(link::Stream stream) {
    powered_.put(link::frame_of(stream, ++powered_.sequence));
    return samples();
  }
};

TEST_F(StreamTest, ShowsTheChosenChannelsOfEachSoManySteps) {
  powered_.start();
  const std::vector<link::Streamed> found = samples_of({0x3F, 150});
  ASSERT_GE(found.size(), 3U);
  for (std::size_t i = 0; i < found.size(); ++i) {
    EXPECT_EQ(found[i].number, i);
    EXPECT_EQ(found[i].channels, 0x3F);
    // The line was taken by the answer when the first was due.
    if (i > 0) {
      EXPECT_EQ(found[i].period, found[1].period + 150 * (i - 1));
    }
    EXPECT_EQ(found[i].values[4], 400000U);
    EXPECT_EQ(found[i].values[5] & 0xFFU, running);
    EXPECT_NEAR(static_cast<std::int32_t>(found[i].values[0]), 0.4 * TimedBoard::friction * 0x1p31,
                1e-3 * 0x1p31);
    EXPECT_NEAR(static_cast<std::int32_t>(found[i].values[3]), 0.4 * 0x1p30, 1e-3 * 0x1p30);
  }
  EXPECT_EQ(
      samples_of({0x04, 200}).at(2).values,
      (std::array<std::uint32_t, link::channel_count>{
          0, 0, static_cast<std::uint32_t>(powered_.board.latest_drive().amplitude), 0, 0, 0}));
}

TEST_F(StreamTest, EndsWithNoChannelAndWithAHello) {
  EXPECT_FALSE(samples_of({0x01, 10}).empty());
  EXPECT_FALSE(samples().empty());
  samples_of({0, 1});
  EXPECT_TRUE(samples().empty());
  EXPECT_FALSE(samples_of({0x01, 10}).empty());
  powered_.put(link::frame_of(link::Hello{7}, 3));
  samples();
  EXPECT_TRUE(samples().empty());
}

TEST_F(StreamTest, LeavesOutWhatTheLineHasNoRoomForAndItsNumber) {
  // A frame of 37 bytes and its stuffing takes the wire of the test twice as many periods.
  const std::vector<link::Streamed> found = samples_of({0x3F, 1});
  ASSERT_GT(found.size(), 4U);
  for (std::size_t i = 1; i < found.size(); ++i) {
    EXPECT_GT(found[i].number - found[i - 1].number, 40);
    EXPECT_EQ(static_cast<std::uint32_t>(found[i].number - found[i - 1].number),
              found[i].period - found[i - 1].period);
  }
  powered_.wire.blocked = true;
  powered_.serve(70000);
  powered_.wire.blocked = false;
  const std::vector<link::Streamed> after = samples();
  EXPECT_EQ(static_cast<std::uint16_t>(after.at(1).number - found.back().number),
            static_cast<std::uint16_t>(after.at(1).period - found.back().period));
}

TEST_F(StreamTest, IsCutShortByAnAnswer) {
  samples_of({0x3F, 1});
  powered_.serve(10);  // in the middle of a sample
  for (int i = 0; i < 100; ++i) {
    powered_.serve(i);
    powered_.wire.from_unit.clear();
    powered_.put(link::frame_of(link::ReadFault{0}, ++powered_.sequence));
    // A byte a period to come, and every other period one to go.
    powered_.serve(12 + 2 * 21 + 1);
    link::FrameDecoder decoder;
    bool answered = false;
    for (const std::uint8_t byte : powered_.wire.from_unit) {
      answered = answered || (decoder.take(byte) == link::Reception::frame &&
                              decoder.frame().sequence == powered_.sequence &&
                              decoder.frame().kind == link::Refusal::kind);
    }
    EXPECT_TRUE(answered) << i;
  }
}

TEST_F(StreamTest, RefusesWhatThereIsNot) {
  expect_refusal(powered_.answer_to(link::Stream{0x40, 1}), link::Stream::kind,
                 Reason::out_of_range, 0, 63);
  expect_refusal(powered_.answer_to(link::Stream{0x01, 0}), link::Stream::kind,
                 Reason::out_of_range, 1, 65535);
  EXPECT_TRUE(samples().empty());
}

// The bound on what a carrier period spends on the link.
TEST_F(UnitOnALink, APeriodMovesOneByteEachWayOrOneStepOfASave) {
  powered_.put(link::frame_of(PoweredUnit::writing(Parameter::gain_scale, 111), 7));
  for (int i = 0; i < 400; ++i) {
    const std::size_t to = powered_.wire.to_unit.size();
    const std::size_t from = powered_.wire.from_unit.size();
    const int operations = flash_.operations();
    powered_.serve(1);
    const std::size_t sent = powered_.wire.from_unit.size() - from;
    ASSERT_LE(to - powered_.wire.to_unit.size(), 1U);
    ASSERT_LE(sent + static_cast<std::size_t>(flash_.operations() - operations), 1U);
  }
  EXPECT_EQ(flash_.operations(), operations_of_a_save);
}

/// A request of each kind, told apart by its answer.
std::vector<link::Frame> every_request(std::uint16_t sequence) {
  return {link::frame_of(link::ReadTelemetry{}, sequence),
          link::frame_of(link::SetTarget{450000}, sequence),
          link::frame_of(link::SetTarget{2000000}, sequence),  // refused
          link::frame_of(link::ReadParameter{1}, sequence),
          link::frame_of(PoweredUnit::writing(Parameter::gain_scale, 111), sequence),
          link::frame_of(link::Restart{}, sequence),
          link::frame_of(link::ReadFault{0}, sequence),
          link::frame_of(link::Confirm{}, sequence)};
}

std::size_t wire_size(const link::Frame& frame) {
  return link::encode(frame).size;
}

/// Serves until the drive is off: in the period after the stop's last byte.
void expect_stopped_within(PoweredUnit& powered, std::size_t bytes, const char* what, int when) {
  powered.serve(static_cast<int>(bytes));
  powered.serve(1);
  ASSERT_FALSE(powered.unit.supervisor().driving()) << what << " after " << when;
  ASSERT_EQ(powered.board.latest_drive().amplitude, 0) << what << " after " << when;
}

// The first byte of a stop comes so many periods after the request: with each byte of it, while it
// waits, while it is carried out, and with each byte of its answer, sent to a host that does not
// read, too.
TEST(LinkServiceTest, AStopActsWithItsLastByteWhateverIsBeingAnswered) {
  const std::size_t stop_bytes = wire_size(link::frame_of(link::Stop{}, 0));
  for (const bool host_reads : {true, false}) {
    for (std::size_t request = 0; request < every_request(0).size(); ++request) {
      for (int when = 0; when < 170; ++when) {
        SimulatedFlash flash;
        PoweredUnit powered(flash);
        powered.start(50);
        powered.wire.blocked = !host_reads;
        powered.put(every_request(1)[request]);
        powered.serve(when);
        const std::size_t in_front = powered.wire.to_unit.size();
        powered.put(link::frame_of(link::Stop{}, 2));
        expect_stopped_within(powered, in_front + stop_bytes, "request", when);
        ASSERT_EQ(powered.board.latest_drive().state, off);
        powered.wire.blocked = false;
        const std::vector<link::Frame> frames = powered.answers();
        ASSERT_EQ(frames.size(), 2U) << request << " after " << when;
        // The answers in either order, but each with its own number.
        ASSERT_EQ(frames[0].sequence + frames[1].sequence, 3) << request << " after " << when;
        link::Stopped stopped{};
        ASSERT_TRUE(link::read(frames[frames[0].sequence == 2 ? 0 : 1], stopped));
        ASSERT_EQ(powered.telemetry().state, off);
      }
    }
  }
}

// The drive does not run during a save, but a restart that waits behind it must not outlive a stop.
TEST(LinkServiceTest, AStopOvertakesARestartThatWaitsInEveryPhaseOfASave) {
  for (int when = 0; when < 200; ++when) {
    SimulatedFlash flash;
    PoweredUnit powered(flash);
    powered.put(link::frame_of(PoweredUnit::writing(Parameter::gain_scale, 111), 1));
    powered.put(link::frame_of(link::Restart{}, 2));
    powered.serve(when);
    const std::size_t in_front = powered.wire.to_unit.size();
    powered.put(link::frame_of(link::Stop{}, 3));
    expect_stopped_within(powered, in_front + wire_size(link::frame_of(link::Stop{}, 3)), "save",
                          when);
    ASSERT_EQ(powered.answers().size() + powered.wire.to_unit.size(), 3U) << when;
    powered.serve(300);
    ASSERT_EQ(powered.board.latest_drive().state, off) << when;
    ASSERT_EQ(powered.unit.value(Parameter::gain_scale), 111U) << when;
    ASSERT_FALSE(flash.misused());
  }
}

// With every byte of the second restart, while it waits, and after it: the drive stays at zero.
TEST(LinkServiceTest, AFaultCancelsTheRestartThatWasSentBeforeIt) {
  const std::size_t restart_bytes = wire_size(link::frame_of(link::Restart{}, 0));
  int refused = 0;
  for (int when = static_cast<int>(restart_bytes) + 2; when < 100; ++when) {
    SimulatedFlash flash;
    PoweredUnit powered(flash);
    powered.put(link::frame_of(link::Restart{}, 1));
    powered.put(link::frame_of(link::Restart{}, 2));
    powered.serve(when);
    powered.board.fresh = false;
    powered.serve(2);  // the period of a restart looks at no sample
    powered.board.fresh = true;
    const std::vector<link::Frame> frames = powered.answers();
    ASSERT_EQ(frames.size(), 2U) << when;
    ASSERT_EQ(powered.board.latest_drive().state, faulted) << when;
    ASSERT_EQ(powered.board.latest_drive().amplitude, 0) << when;
    ASSERT_EQ(powered.unit.supervisor().faults().count(), 1U) << when;
    if (frames[1].kind == link::Refusal::kind) {
      expect_refusal(frames[1], link::Restart::kind, Reason::overtaken_by_fault, 0, 0);
      ++refused;
      // A repetition is refused, a new request is carried out.
      powered.put(link::frame_of(link::Restart{}, 2));
      expect_refusal(powered.answers().at(0), link::Restart::kind, Reason::out_of_turn, 2, 2);
    }
    powered.ask<link::Restarted>(link::Restart{});
    ASSERT_EQ(powered.telemetry().state, running) << when;
  }
  EXPECT_GE(refused, static_cast<int>(restart_bytes));
}

// Two faults in a row, and what was sent before the second.
TEST_F(UnitOnALink, EveryFaultCancelsWhatWasSentBeforeIt) {
  for (std::uint32_t fault = 1; fault <= 2; ++fault) {
    powered_.ask<link::Restarted>(link::Restart{});
    powered_.put(link::frame_of(link::SetTarget{600000}, ++powered_.sequence));
    powered_.put(link::frame_of(link::Restart{}, ++powered_.sequence));
    powered_.serve(5);
    powered_.miss_a_sample();
    const std::vector<link::Frame> frames = powered_.answers();
    ASSERT_EQ(frames.size(), 2U);
    expect_refusal(frames[0], link::SetTarget::kind, Reason::overtaken_by_fault, 0, 0);
    EXPECT_EQ(frames[1].kind, link::Restarted::kind);  // its first byte came later
    powered_.ask<link::Stopped>(link::Stop{});
    EXPECT_EQ(powered_.unit.supervisor().faults().count(), fault);
    EXPECT_EQ(powered_.telemetry().target, 400000U);
  }
}

// A fault between the first byte of a question and its last one cancels orders alone.
TEST_F(UnitOnALink, WhatIsReadIsAnsweredWhateverFaultCame) {
  powered_.ask<link::Restarted>(link::Restart{});
  powered_.put(link::frame_of(link::ReadTelemetry{}, ++powered_.sequence));
  auto& wire = powered_.wire.to_unit;
  constexpr int first_bytes = 4;
  const std::vector<std::uint8_t> rest(wire.begin() + first_bytes, wire.end());
  wire.erase(wire.begin() + first_bytes, wire.end());
  powered_.serve(1);
  powered_.miss_a_sample();
  wire.insert(wire.end(), rest.begin(), rest.end());
  const std::vector<link::Frame> frames = powered_.answers();
  ASSERT_EQ(frames.size(), 1U);
  EXPECT_EQ(frames[0].kind, link::Telemetry::kind);
  EXPECT_EQ(powered_.unit.supervisor().faults().count(), 1U);
}

RC_GTEST_PROP(LinkServiceTest, AStopActsBehindAnyBytes, ()) {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  powered.start(50);
  const auto noise = *rc::gen::arbitrary<std::vector<std::uint8_t>>();
  powered.wire.to_unit.insert(powered.wire.to_unit.end(), noise.begin(), noise.end());
  powered.put(link::frame_of(link::Stop{}, *rc::gen::arbitrary<std::uint16_t>()));
  powered.serve(static_cast<int>(powered.wire.to_unit.size()) + 1);
  RC_ASSERT(!powered.unit.supervisor().driving());
}

// A host that was started anew counts from the beginning: its stop is in doubt, and acts.
TEST(LinkServiceTest, AStopActsWhateverItsNumber) {
  for (const int number : {999, 1000, 1001, 40000}) {
    SimulatedFlash flash;
    PoweredUnit powered(flash);
    powered.start(50);
    powered.sequence = 999;
    powered.ask<link::TargetSet>(link::SetTarget{600000});
    powered.put(link::frame_of(link::Stop{}, static_cast<std::uint16_t>(number)));
    const std::vector<link::Frame> frames = powered.answers();
    ASSERT_EQ(frames.size(), 1U);
    link::Stopped stopped{};
    EXPECT_TRUE(link::read(frames[0], stopped));
    EXPECT_EQ(frames[0].sequence, number);
    EXPECT_FALSE(powered.unit.supervisor().driving());
  }
}

TEST_F(UnitOnALink, WhatComesWhileThreeRequestsWaitIsCountedAsLost) {
  powered_.wire.blocked = true;
  for (std::uint16_t sequence = 1; sequence <= 7; ++sequence) {
    powered_.put(link::frame_of(link::ReadTelemetry{}, sequence));
  }
  powered_.serve(400);
  powered_.wire.blocked = false;
  EXPECT_EQ(powered_.answers().size(), 4U);
  EXPECT_EQ(powered_.telemetry().lost_frames, 3);
}

TEST(LinkServiceTest, AHealthyUnitDrivesFromPowerOnOnlyWhereThatIsStored) {
  SimulatedFlash flash;
  for (const bool starts : {false, true, false}) {
    PoweredUnit powered(flash);
    powered.ask<link::Stopped>(link::Stop{});
    powered.write(Parameter::start_on_power, starts ? 1 : 0);
    PoweredUnit after(flash);
    after.serve(300);
    EXPECT_EQ(after.telemetry().state, starts ? running : off);
    EXPECT_EQ(after.board.latest_drive().amplitude > 0, starts);
  }
}

TEST(LinkServiceTest, AfterAResetByTheWatchdogStartOnPowerDoesNotCount) {
  SimulatedFlash flash;
  PoweredUnit(flash).write(Parameter::start_on_power, 1);
  TestedUnit unit(field_design, flash);
  TimedBoard board;
  CountingWatchdog watchdog;
  watchdog.reset = true;
  NoService service;
  TimedLoop loop(unit.supervisor(), board, watchdog, service);
  ASSERT_TRUE(loop.serve());
  EXPECT_EQ(board.latest_drive().fault, static_cast<std::uint8_t>(UnitFault::watchdog_reset));
  EXPECT_EQ(board.latest_drive().amplitude, 0);
}

/// A unit with a strict drive limit that starts by itself.
SimulatedFlash limited_flash() {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  powered.write(Parameter::start_on_power, 1);
  powered.write(Parameter::drive_limit, 120000);
  powered.write(Parameter::gain_scale, 500000);
  powered.write(Parameter::target, 700000);
  return flash;
}

void expect_held_off(PoweredUnit& powered, UnitFault fault, store::Origin origin) {
  powered.serve(300);
  const link::Telemetry told = powered.telemetry();
  EXPECT_EQ(told.state, faulted);
  EXPECT_EQ(told.fault, static_cast<std::uint8_t>(fault));
  EXPECT_EQ(told.parameters, static_cast<std::uint8_t>(origin));
  EXPECT_EQ(powered.ask<link::LoggedFault>(link::ReadFault{0}).fault, told.fault);
  expect_refusal(powered.answer_to(link::Restart{}), link::Restart::kind,
                 Reason::parameters_not_confirmed, 0, 0);
  powered.ask<link::Stopped>(link::Stop{});
  expect_refusal(powered.answer_to(link::Restart{}), link::Restart::kind,
                 Reason::parameters_not_confirmed, 0, 0);
  for (const std::int32_t amplitude : powered.board.in_force) {
    ASSERT_EQ(amplitude, 0);
  }
}

void expect_drives(PoweredUnit& powered) {
  powered.ask<link::Restarted>(link::Restart{});
  powered.serve(300);
  EXPECT_GT(powered.board.latest_drive().amplitude, 0);
  EXPECT_LE(powered.board.latest_drive().amplitude, numeric::to_code(0.12) + 1);
}

constexpr FieldDesign<Parts> other_design(designed, 0.2F, 2, full_scales, carrier_period_s,
                                          default_timeout_ms);

TEST(LinkServiceTest, UnderAnotherDesignLimitsHoldAndTheUnitWaitsToBeTold) {
  SimulatedFlash flash = limited_flash();
  {
    PoweredUnit powered(flash, other_design);
    expect_held_off(powered, UnitFault::parameters_of_other_design, store::Origin::other_design);
    EXPECT_EQ(powered.read(Parameter::drive_limit), 120000U);
    EXPECT_EQ(powered.read(Parameter::gain_scale), 500000U);
    EXPECT_EQ(powered.read(Parameter::target), 400000U);
    EXPECT_EQ(powered.read(Parameter::start_on_power), 1U);
    powered.ask<link::Confirmed>(link::Confirm{});
    EXPECT_EQ(powered.telemetry().parameters, static_cast<std::uint8_t>(store::Origin::stored));
    expect_drives(powered);
    expect_refusal(powered.answer_to(link::Confirm{}), link::Confirm::kind,
                   Reason::drive_not_stopped, 0, 0);
  }
  PoweredUnit powered(flash, other_design);
  powered.serve(300);
  EXPECT_EQ(powered.read(Parameter::drive_limit), 120000U);
  EXPECT_GT(powered.board.latest_drive().amplitude, 0);
}

TEST(LinkServiceTest, AWriteConfirmsTheOtherParameters) {
  SimulatedFlash flash = limited_flash();
  PoweredUnit powered(flash, other_design);
  powered.write(Parameter::target, 500000);
  EXPECT_EQ(powered.telemetry().state, faulted);
  expect_drives(powered);
}

TEST(LinkServiceTest, AnyDamageToTheStoreHoldsTheUnitOff) {
  const SimulatedFlash intact = limited_flash();
  std::minstd_rand random(7);
  for (std::size_t i = 0; i < 60; ++i) {
    SimulatedFlash flash = intact;
    const bool both = i % 2 == 0;
    for (std::size_t page = i / 2 % 2; page < (both ? 2U : i / 2 % 2 + 1U); ++page) {
      flash.page(page)[random() % 20] ^= 1U << random() % 32;
    }
    if (both) {
      flash.page(0)[random() % 20] ^= 0x10101U;
    }
    PoweredUnit powered(flash);
    expect_held_off(powered, UnitFault::parameters_lost, store::Origin::damaged);
  }
}

TEST(LinkServiceTest, OfADamagedStoreTheRecordThatIsLeftGivesTheLimits) {
  SimulatedFlash flash = limited_flash();
  flash.page(0).fill(0);
  flash.page(1)[5] ^= 1U;
  PoweredUnit nothing_left(flash);
  EXPECT_EQ(nothing_left.read(Parameter::drive_limit), 1000000U);
  flash = limited_flash();
  flash.page(1)[5] ^= 1U;  // the newest, with the target
  PoweredUnit powered(flash);
  expect_held_off(powered, UnitFault::parameters_lost, store::Origin::damaged);
  EXPECT_EQ(powered.read(Parameter::drive_limit), 120000U);
  EXPECT_EQ(powered.read(Parameter::target), 400000U);
}

// On a board whose flash no longer takes anything somebody can still vouch for the parameters.
TEST(LinkServiceTest, AConfirmationThatCannotBeSavedHoldsUntilReset) {
  SimulatedFlash flash = limited_flash();
  flash.page(0)[5] ^= 1U;
  flash.page(1)[5] ^= 1U;
  flash.wear_out();
  for (int reset = 0; reset < 2; ++reset) {
    PoweredUnit powered(flash);
    powered.serve(10);
    EXPECT_EQ(powered.telemetry().fault, static_cast<std::uint8_t>(UnitFault::parameters_lost));
    expect_refusal(powered.answer_to(link::Confirm{}), link::Confirm::kind, Reason::not_saved, 0,
                   0);
    powered.ask<link::Restarted>(link::Restart{});
    EXPECT_EQ(powered.telemetry().state, running);
  }
}

struct KnownSelfTest {
  bool passes = false;
  bool passed() const { return passes; }
};
using SelfTestedUnit = Unit<Parts, SimulatedFlash, std::atomic, 0, OrderedTargets, KnownSelfTest>;

TEST(LinkServiceTest, AfterASelfTestThatFailedNothingStartsTheDrive) {
  SimulatedFlash flash = limited_flash();  // it starts by itself
  PoweredUnitOf<SelfTestedUnit> powered(flash, field_design, OrderedTargets(), KnownSelfTest{});
  const auto expect_refused = [&powered] {
    expect_refusal(powered.answer_to(link::Restart{}), link::Restart::kind,
                   Reason::self_test_failed, 0, 0);
  };
  powered.serve(300);
  EXPECT_EQ(powered.telemetry().state, faulted);
  EXPECT_EQ(powered.telemetry().fault, static_cast<std::uint8_t>(UnitFault::image_damaged));
  EXPECT_EQ(powered.ask<link::LoggedFault>(link::ReadFault{0}).fault, powered.telemetry().fault);
  expect_refused();
  powered.ask<link::Confirmed>(link::Confirm{});
  expect_refused();
  powered.write(Parameter::target, 500000);
  expect_refused();
  powered.ask<link::Stopped>(link::Stop{});
  EXPECT_EQ(powered.telemetry().state, off);
  expect_refused();
  powered.ask<link::TargetSet>(link::SetTarget{600000});
  powered.serve(300);
  for (const std::int32_t amplitude : powered.board.in_force) {
    ASSERT_EQ(amplitude, 0);
  }
}

TEST(LinkServiceTest, AfterASelfTestThatItHasPassedAUnitDoesAsOneWithout) {
  SimulatedFlash flash = limited_flash();
  PoweredUnitOf<SelfTestedUnit> powered(flash, field_design, OrderedTargets(), KnownSelfTest{true});
  powered.serve(300);
  EXPECT_GT(powered.board.latest_drive().amplitude, 0);
  powered.ask<link::Stopped>(link::Stop{});
  powered.ask<link::Restarted>(link::Restart{});
  powered.serve(300);
  EXPECT_GT(powered.board.latest_drive().amplitude, 0);
}

/// Carrier periods of the preset, 0.1 s.
constexpr int timeout_periods = 6000;

TEST_F(UnitOnALink, AHostThatFallsSilentLosesTheDriveByARamp) {
  powered_.ask<link::Restarted>(link::Restart{});
  // Whatever is whole counts as life, an older frame too.
  for (int i = 0; i < 3; ++i) {
    powered_.serve(timeout_periods - 600);
    powered_.put(link::frame_of(link::ReadTelemetry{}, 1));
    powered_.answers();
    ASSERT_EQ(powered_.board.latest_drive().state, running);
  }
  powered_.serve(timeout_periods - 600);
  ASSERT_EQ(powered_.board.latest_drive().state, running);
  const std::int32_t amplitude = powered_.board.latest_drive().amplitude;
  while (powered_.board.latest_drive().state == running) {
    powered_.serve(1);
  }
  int falling = 0;
  for (std::int32_t last = amplitude; powered_.board.latest_drive().amplitude > 0; ++falling) {
    ASSERT_LE(last - powered_.board.latest_drive().amplitude,
              amplitude / HostRamp::periods + HostRamp::periods);
    last = powered_.board.latest_drive().amplitude;
    powered_.serve(1);
  }
  EXPECT_EQ(falling, HostRamp::periods - 1);
  const link::Telemetry told = powered_.telemetry();
  EXPECT_EQ(told.state, faulted);
  EXPECT_EQ(told.fault, static_cast<std::uint8_t>(UnitFault::host_silent));
  EXPECT_EQ(told.amplitude, 0);
  powered_.serve(100);
  EXPECT_EQ(powered_.telemetry().state, faulted);  // a host that is heard again is not enough
  powered_.ask<link::Restarted>(link::Restart{});
  EXPECT_EQ(powered_.telemetry().state, running);
  EXPECT_EQ(powered_.ask<link::LoggedFault>(link::ReadFault{0}).count, 1U);
}

TEST(LinkServiceTest, SilenceIsCountedToThePeriod) {
  for (const std::uint32_t timeout_ms : {1U, 7U, 100U}) {
    SimulatedFlash flash;
    PoweredUnit powered(flash);
    powered.write(Parameter::host_timeout, timeout_ms);
    powered.start(static_cast<int>(60 * timeout_ms));
    EXPECT_EQ(powered.unit.supervisor().faults().count(), 0U) << timeout_ms;
    powered.serve(1);
    EXPECT_EQ(powered.unit.supervisor().faults().count(), 1U) << timeout_ms;
  }
}

TEST_F(UnitOnALink, DamagedFramesAreNoLife) {
  powered_.start(0);
  const link::WireFrame frame = link::encode(link::frame_of(link::ReadTelemetry{}, 1));
  for (int i = 0; i < timeout_periods / 10; ++i) {
    for (std::size_t k = 0; k < frame.size; ++k) {
      powered_.wire.to_unit.push_back(k == 4 ? frame.bytes[k] ^ 0x10U : frame.bytes[k]);
    }
    powered_.serve(20);
  }
  EXPECT_EQ(powered_.board.latest_drive().fault, static_cast<std::uint8_t>(UnitFault::host_silent));
}

TEST_F(UnitOnALink, WithoutATimeoutOrADriveSilenceIsNoFault) {
  powered_.serve(2 * timeout_periods);
  EXPECT_EQ(powered_.unit.supervisor().faults().count(), 0U);
  powered_.write(Parameter::host_timeout, 0);
  powered_.ask<link::Restarted>(link::Restart{});
  powered_.serve(4 * timeout_periods);
  EXPECT_EQ(powered_.telemetry().state, running);
}

TEST_F(UnitOnALink, NothingIsWrittenOnTheRamp) {
  powered_.start(timeout_periods + 2);
  ASSERT_GT(powered_.board.latest_drive().amplitude, 0);
  EXPECT_EQ(powered_.unit.write(0, 1), Answer::drive_not_stopped);
  EXPECT_EQ(powered_.unit.confirm(), Answer::drive_not_stopped);
}

// ---- Between the order of a request and the carrier period that takes it ----

/// A unit whose service and carrier periods come when a test says so.
class OrderedUnit : public testing::Test {
 protected:
  OrderedUnit() { EXPECT_EQ(unit_.restart(0), Answer::taken); }

  template <class Request>
  void ask(const Request& request) {
    requests_.take(link::frame_of(request, 7), unit_.supervisor().faults().count());
  }
  void pass_period() { unit_.supervisor().step({1 << 30, 1 << 28, false, true}); }

  static constexpr std::uint16_t last_stop = 8;

  SimulatedFlash flash_;
  TestedUnit unit_{field_design, flash_};
  UnitRequests<TestedUnit, TestedProduct> requests_{unit_};
};

TEST_F(OrderedUnit, AnswersWhenThePeriodHasTakenTheOrder) {
  pass_period();
  ask(link::SetTarget{300000});
  requests_.proceed(0);
  EXPECT_TRUE(requests_.in_hand());
  EXPECT_EQ(unit_.target(), 400000U);
  pass_period();
  requests_.proceed(0);
  link::TargetSet set{};
  ASSERT_TRUE(link::read(requests_.answer(), set));
  EXPECT_EQ(set.target, 300000U);
}

TEST_F(OrderedUnit, AFaultOvertakesTheOrder) {
  pass_period();
  ask(link::SetTarget{300000});
  unit_.supervisor().trip(UnitFault::overrun);
  pass_period();
  requests_.proceed(0);
  expect_refusal(requests_.answer(), link::SetTarget::kind, Reason::overtaken_by_fault, 0, 0);
  EXPECT_EQ(unit_.target(), 400000U);
  EXPECT_FALSE(unit_.supervisor().driving());
}

TEST_F(OrderedUnit, AStopOvertakesTheOrder) {
  pass_period();
  ask(link::Restart{});
  unit_.stop();
  pass_period();
  requests_.proceed(last_stop);
  expect_refusal(requests_.answer(), link::Restart::kind, Reason::out_of_turn, last_stop,
                 last_stop);
  EXPECT_FALSE(unit_.supervisor().driving());
}

TEST_F(OrderedUnit, WhatIsSavedIsInForceWhateverStopComes) {
  pass_period();
  unit_.stop();
  pass_period();
  unit_.supervisor().publish();
  ask(PoweredUnit::writing(Parameter::target, 300000));
  for (int i = 0; i < 1000 && unit_.origin() != store::Origin::stored; ++i) {
    requests_.proceed(0);
  }
  unit_.stop();
  pass_period();
  requests_.proceed(last_stop);
  EXPECT_TRUE(requests_.in_hand());
  pass_period();
  requests_.proceed(last_stop);
  link::ParameterWritten written{};
  ASSERT_TRUE(link::read(requests_.answer(), written));
  EXPECT_EQ(written.value, 300000U);
  EXPECT_EQ(unit_.target(), 300000U);
}

TEST(UnitTest, ARecordOfItsDesignWithoutOneOfItsParametersIsDamaged) {
  SimulatedFlash flash;
  store::TwoPageStore<SimulatedFlash, parameter_count> pages(flash, field_design.design());
  pages.load();
  std::array<store::Entry, parameter_count> record{};
  for (std::size_t i = 0; i < parameter_count; ++i) {
    record[i] = {parameter_identities[i], field_design.range(i).preset};
  }
  const auto limit = static_cast<std::size_t>(Parameter::drive_limit);
  record[limit].value = 250000;
  record[static_cast<std::size_t>(Parameter::gain_scale)].identity ^= 1U;
  pages.save(record);
  while (pages.proceed() == store::Saving::busy) {
  }
  const TestedUnit unit(field_design, flash);
  EXPECT_EQ(unit.origin(), store::Origin::damaged);
  EXPECT_EQ(unit.value(limit), 250000U);
  EXPECT_EQ(unit.value(Parameter::gain_scale), one_in_millionths);
}

RC_GTEST_PROP(LinkServiceTest, AnyRequestIsAnsweredAndNoneHarms, ()) {
  SimulatedFlash flash;
  PoweredUnit powered(flash);
  const int requests = *rc::gen::inRange(1, 30);
  for (int i = 0; i < requests; ++i) {
    link::Frame frame;
    frame.kind = *rc::gen::weightedOneOf<std::uint8_t>(
        {{4, rc::gen::inRange<std::uint8_t>(1, 9)}, {1, rc::gen::arbitrary<std::uint8_t>()}});
    frame.sequence = ++powered.sequence;
    frame.payload_bytes = *rc::gen::element<std::uint8_t>(0, 1, 4, 5, 32);
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
    RC_ASSERT(powered.unit.range(i).allows(powered.unit.value(i)));
  }
}

}  // namespace
}  // namespace sonoglide::app::link_service_test
