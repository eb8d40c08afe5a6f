/// Every message byte for byte: what hosts of other makes rely on. The bytes were made by a program
/// of its own, from the tables of firmware/link/README.md and the CRC-32 of zlib.
#include "firmware/link/messages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace sonoglide::link::messages_test {
namespace {

std::string hexadecimal(const Frame& frame) {
  constexpr const char* digits = "0123456789abcdef";
  const WireFrame wire = encode(frame);
  std::string text;
  for (std::size_t i = 0; i < wire.size; ++i) {
    const std::uint8_t byte = wire.bytes.at(i);
    text += {digits[byte >> 4], digits[byte & 15]};
  }
  return text;
}

// Fields are set by name: their order is what is tested.

Telemetry telemetry() {
  Telemetry message{};
  message.period = 0x01020304;
  message.friction_force = -2;
  message.sliding_velocity = 0x11121314;
  message.amplitude = 0x21222324;
  message.target = 400000;
  message.state = 3;
  message.limit = 5;
  message.fault = 16;
  message.parameters = 2;
  message.lost_frames = 0x3132;
  message.settling = 1;
  message.mismatch = 1250;
  return message;
}

ParameterValue parameter_value() {
  ParameterValue message{};
  message.parameter = 7;
  message.decimal_places = 3;
  message.value = 100;
  message.lowest = 0;
  message.highest = 60000;
  message.preset = 250;
  return message;
}

Identity identity() {
  Identity message{};
  message.major_number = 1;
  message.minor_number = 2;
  message.patch_number = 3;
  message.design = 0x89abcdef;
  message.serial_number = 4711;
  message.board = {'r', 'a', 'i', 'l', '-', '2'};
  return message;
}

Streaming streaming() {
  Streaming message{};
  message.channels = 0x25;
  message.every = 600;
  return message;
}

TraceArmed trace_armed() {
  TraceArmed message{};
  message.triggers = 2;
  message.before = 512;
  return message;
}

TraceRecord trace_record() {
  TraceRecord message{};
  message.index = 1023;
  message.friction_force = -2;
  message.sliding_velocity = 0x11121314;
  message.amplitude = 0x21222324;
  message.target = 400000;
  message.codes = 0x04220503;
  message.other = -5;
  return message;
}

template <class Message>
Message of_target() {
  Message message{};
  message.target = 450000;
  return message;
}

template <class Message>
Message of_parameter() {
  Message message{};
  message.parameter = 1;
  message.value = 800000;
  return message;
}

LoggedFault logged_fault() {
  LoggedFault message{};
  message.age = 15;
  message.fault = 34;
  message.period = 0x01020304;
  message.count = 77;
  return message;
}

KeptException kept_exception() {
  return {{3, 0x01020304, 0x11121315, 0x61000003, 0x00010000, 0x40000000, 0x40000000}};
}

History history() {
  History message{};
  message.boots = 18;
  message.seconds = 0x01020304;
  message.watchdog_resets = 3;
  message.exceptions = 2;
  message.exception_boot = 17;
  message.cause = 2;
  message.saved = 1;
  message.began_anew = 1;
  return message;
}

Refusal refusal() {
  Refusal message{};
  message.request = 4;
  message.reason = 3;
  message.lowest = 977;
  message.highest = 1000000;
  return message;
}

TEST(MessageBytes, AreThoseOfTheReference) {
  const struct {
    Frame frame;
    const char* bytes;
  } rows[] = {
      {frame_of(ReadTelemetry{}, 0x1234), "0009020134121fff1cc200"},
      {frame_of(telemetry(), 0x1234),
       "00180281341204030201feffffff1413121124232221801a060e03051002323101e2045d70dda500"},
      {frame_of(of_target<SetTarget>(), 0x0203), "000802020302d0dd06058f5093b900"},
      {frame_of(of_target<TargetSet>(), 0x0203), "000802820302d0dd06057dba853100"},
      {frame_of(ReadParameter{7}, 1), "0004020301060707f4f13100"},
      {frame_of(parameter_value(), 1),
       "0004028301040703640101010101010360ea0102fa010105a763976b00"},
      {frame_of(of_parameter<WriteParameter>(), 0xFFFF), "00060204ffff0103350c05e992328900"},
      {frame_of(of_parameter<ParameterWritten>(), 0xFFFF), "00060284ffff0103350c05331709da00"},
      {frame_of(Restart{}, 5), "0004020505053921f1f000"},
      {frame_of(Restarted{}, 5), "000402850505b93ac41100"},
      {frame_of(Stop{}, 6), "000402060605a3cc9ad900"},
      {frame_of(Stopped{}, 6), "00040286060523d7af3800"},
      {frame_of(ReadFault{15}, 7), "0004020707060fd097c5b400"},
      {frame_of(logged_fault(), 7), "0004028707080f22040302014d0101053e9a2c6800"},
      {frame_of(Confirm{}, 8), "00040208080527cc874d00"},
      {frame_of(Confirmed{}, 8), "000402880805a7d7b2ac00"},
      {frame_of(Hello{0x1234}, 9), "0004020909073412ecaf81c400"},
      {frame_of(Greeted{0x1234, 0x89abcdef}, 9), "00040289090b3412efcdab89f69ef17900"},
      {frame_of(ReadIdentity{}, 10), "0004020a0a05cb7a357c00"},
      {frame_of(identity(), 10),
       "0004028a0a0a010203efcdab89671201077261696c2d32010101010101010101055f16594500"},
      {frame_of(Stream{0x25, 600}, 11), "0004020b0b08255802fe3d0eb500"},
      {frame_of(streaming(), 11), "0004028b0b082558022629beab00"},
      {frame_of(Streamed{0x0102, 0x25, 0x01020304, {0xfffffffe, 7, 0x21222324, 7, 7, 0x01100003}}),
       "001302c002012504030201feffffff24232221030710018e64c54600"},
      {frame_of(Streamed{0xFFFF, 0x3F, 600, {1, 2, 3, 4, 400000, 6}}),
       "000802c0ffff3f5802010201010102020101020301010204010104801a060206010105fd49c0b200"},
      {frame_of(ArmTrace{2, 512}, 12), "0004020c0c020206026f564b5500"},
      {frame_of(trace_armed(), 12), "0004028c0c02020602b742fb4b00"},
      {frame_of(ReadTraceState{}, 13), "0004020d0d0589fa3b3600"},
      {frame_of(TraceState{3, 1, 1024, 2, 512, 0x01020304}, 13),
       "0004028d0d0303010304020a02040302012777d0db00"},
      {frame_of(ReadTraceRecord{1023}, 14), "0004020e0e07ff033265c8a900"},
      {frame_of(trace_record(), 14),
       "0004028e0e12ff03feffffff1413121124232221801a060d03052204fbffffffcd496cda00"},
      {frame_of(ReadScale{3}, 15), "0004020f0f0603aca2d47600"},
      {frame_of(scale_of(3, {ScaleUnit::newton, 0.03924}), 15),
       "0004028f0f0f030248dc63e94317a43f793fe0d100"},
      {frame_of(scale_of(4, {ScaleUnit::none, 0.0}), 15),
       "0004028f0f02040101010101010101054372b0cc00"},
      {frame_of(ReadException{}, 16), "000402101005b6a6a9dd00"},
      {frame_of(kept_exception(), 16),
       "0004029010020301010a040302011513121103010261010201010101024001010640871442f600"},
      {frame_of(ReadHistory{}, 17), "000402111105c0fd70c500"},
      {frame_of(history(), 17),
       "0004029111021201010604030201030101020201010211010108020101b1f30a5500"},
      {frame_of(refusal(), 9), "000402ff09050403d103010440420f05a1e6393400"},
  };
  for (const auto& row : rows) {
    EXPECT_EQ(hexadecimal(row.frame), row.bytes) << int{row.frame.kind};
  }
}

TEST(ScaleFrame, IsReadToTheLastBit) {
  for (const double value : {0.0, 1.0, 0.03924, 1920.0, 1.0 / 3.0, 5e-324, 1.7e308}) {
    for (const ScaleUnit unit : {ScaleUnit::none, ScaleUnit::ratio, ScaleUnit::newton,
                                 ScaleUnit::metre_per_second, ScaleUnit::volt}) {
      const FullScale told{unit, value};
      Scale found{};
      ASSERT_TRUE(read(frame_of(scale_of(2, told), 7), found));
      EXPECT_EQ(found.quantity, 2);
      EXPECT_EQ(full_scale_of(found).unit, unit);
      EXPECT_EQ(full_scale_of(found).value, value);
    }
  }
}

TEST(StreamedFrame, IsReadAsItWasMadeForEverySetOfChannels) {
  for (std::uint8_t channels = 0; channels <= all_channels; ++channels) {
    Streamed made{};
    made.number = 0x1234;
    made.channels = channels;
    made.period = 0xfedcba98;
    for (std::size_t i = 0; i < channel_count; ++i) {
      made.values.at(i) = made.has(i) ? 0x80000001U + static_cast<std::uint32_t>(i) : 0;
    }
    Frame frame = frame_of(made);
    Streamed found{};
    ASSERT_TRUE(read(frame, found)) << int{channels};
    EXPECT_EQ(found.number, made.number);
    EXPECT_EQ(found.channels, channels);
    EXPECT_EQ(found.period, made.period);
    EXPECT_EQ(found.values, made.values);
    for (const int more : {-1, 1}) {
      Frame other = frame;
      other.payload_bytes = static_cast<std::uint8_t>(other.payload_bytes + more);
      EXPECT_FALSE(read(other, found)) << int{channels} << ' ' << more;
    }
    frame.payload[0] = 0xFF;  // channels that there are not
    EXPECT_FALSE(channels != all_channels && read(frame, found)) << int{channels};
    frame.kind = Telemetry::kind;
    EXPECT_FALSE(read(frame, found));
  }
}

TEST(MessageBytes, ReasonsHaveTheNumbersOfTheReference) {
  const Reason reasons[] = {
      Reason::unknown_request,
      Reason::wrong_length,
      Reason::out_of_range,
      Reason::unknown_parameter,
      Reason::no_such_fault,
      Reason::drive_not_stopped,
      Reason::not_saved,
      Reason::out_of_turn,
      Reason::parameters_not_confirmed,
      Reason::overtaken_by_fault,
      Reason::no_such_record,
      Reason::self_test_failed,
      Reason::tripped,
  };
  int number = 0;
  for (const Reason reason : reasons) {
    EXPECT_EQ(static_cast<int>(reason), ++number);
  }
}

/// The codes, each as a number.
template <class... Codes>
std::vector<int> numbers(Codes... codes) {
  return {static_cast<int>(codes)...};
}

TEST(MessageBytes, CodesHaveTheNumbersOfTheReference) {
  const std::vector<int> from_zero{0, 1, 2, 3, 4, 5};
  EXPECT_EQ(numbers(Quantity::friction_force, Quantity::sliding_velocity, Quantity::amplitude,
                    Quantity::target, Quantity::bias, Quantity::step),
            from_zero);
  EXPECT_EQ(numbers(ScaleUnit::none, ScaleUnit::ratio, ScaleUnit::newton,
                    ScaleUnit::metre_per_second, ScaleUnit::volt, ScaleUnit::second),
            from_zero);
  EXPECT_EQ(numbers(Channel::friction_force, Channel::sliding_velocity, Channel::amplitude,
                    Channel::commanded_ratio, Channel::target, Channel::codes),
            from_zero);
  EXPECT_EQ(all_channels, 0x3FU);
  EXPECT_EQ(numbers(Trigger::now, Trigger::fault, Trigger::target), (std::vector<int>{1, 2, 4}));
  EXPECT_EQ(all_triggers, 7);
  EXPECT_EQ(
      numbers(TracePhase::empty, TracePhase::waiting, TracePhase::recording, TracePhase::whole),
      (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(numbers(TraceExtra::none, TraceExtra::bias, TraceExtra::frequency),
            (std::vector<int>{0, 1, 2}));
}

// A doubled reading is answered anew; a doubled request that changes the unit must not act again.
TEST(MessageKinds, OnlyThoseThatReadAreReadings) {
  const std::vector<int> readings =
      numbers(ReadTelemetry::kind, ReadParameter::kind, ReadFault::kind, ReadIdentity::kind,
              ReadTraceState::kind, ReadTraceRecord::kind, ReadScale::kind, ReadException::kind,
              ReadHistory::kind);
  for (int kind = 0; kind <= 0xFF; ++kind) {
    const bool reads = std::find(readings.begin(), readings.end(), kind) != readings.end();
    EXPECT_EQ(is_reading(static_cast<std::uint8_t>(kind)), reads) << kind;
  }
}

}  // namespace
}  // namespace sonoglide::link::messages_test
