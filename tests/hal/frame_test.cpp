/// The frames of lockstep byte for byte, as firmware on boards of other makes sends them.
#include "hal/lockstep/frame.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace sonoglide::hal::lockstep::frame_test {
namespace {

using Bytes = std::vector<std::uint8_t>;

template <class Frame>
Bytes bytes_of(const Frame& frame) {
  return {frame.begin(), frame.end()};
}

// Fields are set by name: their order is what is tested.

template <class SampleT>
SampleT sample() {
  SampleT sample{};
  sample.friction_force = 0x11121314;
  sample.sliding_velocity = -2;
  sample.force_at_rail = true;
  sample.velocity_at_rail = true;
  return sample;
}

VibrationSample vibration_sample() {
  auto sample = frame_test::sample<VibrationSample>();
  sample.in_phase = 0x21222324;
  sample.quadrature = 0x31323334;
  sample.vibration_at_rail = true;
  return sample;
}

template <class DriveT>
DriveT drive() {
  DriveT drive{};
  drive.amplitude = 0x41424344;
  drive.commanded_ratio = 0x51525354;
  drive.state = 4;
  drive.limit = 5;
  drive.fault = 18;
  drive.settling = 2;
  return drive;
}

const Bytes sample_bytes{4, 3, 2, 1, 0x14, 0x13, 0x12, 0x11, 0xfe, 0xff, 0xff, 0xff, 1, 0, 1, 0};
const Bytes drive_bytes{4, 3, 2,  1, 0x44, 0x43, 0x42, 0x41, 0x54, 0x53, 0x52, 0x51,
                        4, 5, 18, 2, 0x64, 0x63, 0x62, 0x61, 0x74, 0x73, 0x72, 0x71};
constexpr AnswerCost cost{0x61626364, 0x71727374};

Bytes with(Bytes bytes, const Bytes& more) {
  bytes.insert(bytes.end(), more.begin(), more.end());
  return bytes;
}

TEST(LockstepFrame, OfASampleIsLaidOutAsDocumented) {
  EXPECT_EQ(bytes_of(encode(0x01020304, sample<Sample>())), sample_bytes);
  // Each flag alone.
  for (const std::size_t flag : {12U, 13U, 14U}) {
    Bytes bytes = sample_bytes;
    bytes[12] = bytes[14] = 0;
    bytes[flag] = 1;
    auto other = sample<Sample>();
    other.force_at_rail = flag == 12;
    other.fresh = flag == 13;
    other.velocity_at_rail = flag == 14;
    const SampleFrame frame = encode(0x01020304, other);
    EXPECT_EQ(bytes_of(frame), bytes);
    EXPECT_EQ(sample_of(frame).force_at_rail, flag == 12);
    EXPECT_EQ(sample_of(frame).fresh, flag == 13);
    EXPECT_EQ(sample_of(frame).velocity_at_rail, flag == 14);
  }
}

TEST(LockstepFrame, OfAVibrationSampleIsLaidOutAsDocumented) {
  const Bytes more{0x24, 0x23, 0x22, 0x21, 0x34, 0x33, 0x32, 0x31, 1, 0, 0, 0};
  EXPECT_EQ(bytes_of(encode(0x01020304, vibration_sample())), with(sample_bytes, more));
}

TEST(LockstepFrame, OfASampleWithTheMeanVelocityIsLaidOutAsDocumented) {
  const MotionSample sample{vibration_sample(), -4};
  const Bytes more{0x24, 0x23, 0x22, 0x21, 0x34, 0x33, 0x32, 0x31,
                   1,    0,    0,    0,    0xfc, 0xff, 0xff, 0xff};
  const MotionSampleFrame frame = encode(0x01020304, sample);
  EXPECT_EQ(bytes_of(frame), with(sample_bytes, more));
  const MotionSample read = sample_of(frame);
  EXPECT_EQ(read.mean_velocity, -4);
  EXPECT_EQ(read.quadrature, 0x31323334);
  EXPECT_TRUE(read.vibration_at_rail);
  EXPECT_EQ(read.friction_force, 0x11121314);
}

TEST(LockstepFrame, OfABiasedDriveIsLaidOutAsDocumented) {
  auto biased = drive<BiasedDrive>();
  biased.bias = -3;
  BiasedDriveFrame frame = encode(0x01020304, biased);
  put_cost(cost, frame);
  EXPECT_EQ(bytes_of(frame), with(drive_bytes, {0xfd, 0xff, 0xff, 0xff}));
  const BiasedDrive read = drive_of(frame);
  EXPECT_EQ(read.bias, -3);
  EXPECT_EQ(read.amplitude, 0x41424344);
  EXPECT_EQ(read.fault, 18);
  EXPECT_EQ(cost_of(frame).answer, cost.answer);
}

TEST(LockstepFrame, OfADriveIsLaidOutAsDocumented) {
  DriveFrame frame = encode(0x01020304, drive<Drive>());
  put_cost(cost, frame);
  EXPECT_EQ(bytes_of(frame), drive_bytes);
}

TEST(LockstepFrame, OfAResonantDriveIsLaidOutAsDocumented) {
  auto resonant = drive<ResonantDrive>();
  resonant.frequency = -3;
  ResonantDriveFrame frame = encode(0x01020304, resonant);
  put_cost(cost, frame);
  EXPECT_EQ(bytes_of(frame), with(drive_bytes, {0xfd, 0xff, 0xff, 0xff}));
}

TEST(LockstepFrame, IsReadAsItIsWritten) {
  const VibrationSample read = sample_of(encode(7, vibration_sample()));
  EXPECT_EQ(read.friction_force, 0x11121314);
  EXPECT_EQ(read.sliding_velocity, -2);
  EXPECT_TRUE(read.force_at_rail);
  EXPECT_FALSE(read.fresh);
  EXPECT_TRUE(read.velocity_at_rail);
  EXPECT_EQ(read.in_phase, 0x21222324);
  EXPECT_EQ(read.quadrature, 0x31323334);
  EXPECT_TRUE(read.vibration_at_rail);
  EXPECT_FALSE(read.vibration_fresh);
  const ResonantDriveFrame frame = [] {
    ResonantDriveFrame encoded = encode(7, drive<ResonantDrive>());
    put_cost(cost, encoded);
    return encoded;
  }();
  EXPECT_EQ(period(frame), 7U);
  const ResonantDrive answer = drive_of(frame);
  EXPECT_EQ(answer.amplitude, 0x41424344);
  EXPECT_EQ(answer.commanded_ratio, 0x51525354);
  EXPECT_EQ(answer.state, 4);
  EXPECT_EQ(answer.limit, 5);
  EXPECT_EQ(answer.fault, 18);
  EXPECT_EQ(answer.settling, 2);
  EXPECT_EQ(cost_of(frame).step, 0x61626364U);
  EXPECT_EQ(cost_of(frame).answer, 0x71727374U);
}

}  // namespace
}  // namespace sonoglide::hal::lockstep::frame_test
