/// The frames between a board in lockstep and its host: one each way for every carrier period, the
/// host first. Numbers are little-endian and in two's complement, on machines of any byte order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "hal/board.hpp"

namespace sonoglide::hal::lockstep {

/// | byte | sample frame                | drive frame                   |
/// |------|-----------------------------|-------------------------------|
/// | 0    | period, u32, from 0         | period of the sample          |
/// | 4    | friction_force, i32         | amplitude, i32                |
/// | 8    | sliding_velocity, i32       | commanded_ratio, i32          |
/// | 12   | force_at_rail, fresh,       | state, limit, fault, settling |
/// |      | velocity_at_rail, 0         |                               |
/// | 16   |                             | cost of the step, u32         |
/// | 20   |                             | cost of the answer, u32       |
///
/// The frames of a unit that holds the vibration at resonance are longer:
///
/// | byte | sample frame                               | drive frame    |
/// |------|--------------------------------------------|----------------|
/// | 16   | in_phase, i32                              |                |
/// | 20   | quadrature, i32                            |                |
/// | 24   | vibration_at_rail, vibration_fresh, 0, 0   | frequency, i32 |
///
/// Those of a unit that answers with a bias:
///
/// | byte | sample frame, with a vibration sensor      | drive frame    |
/// |------|--------------------------------------------|----------------|
/// | 16   | as above                                   |                |
/// | 24   | as above                                   | bias, i32      |
/// | 28   | mean_velocity, i32                         |                |
inline constexpr std::size_t sample_frame_size = 16;
inline constexpr std::size_t drive_frame_size = 24;
inline constexpr std::size_t resonant_frame_size = 28;  ///< of either
inline constexpr std::size_t motion_frame_size = 32;
inline constexpr std::size_t biased_frame_size = 28;

/// Cost of an answer on the board, in the unit of its counter, the reading of the counter excluded.
/// 0 from a board without a counter.
struct AnswerCost {
  std::uint32_t step;    ///< from the sample handed over to the drive taken
  std::uint32_t answer;  ///< from the arrival of the sample frame to the drive frame being made up
};

/// Over a serial line the board speaks first: this byte says that it is ready to receive. It is repeated until
/// the first frame comes, for a host that listens later.
inline constexpr std::uint8_t greeting = 0xa5;

/// Of the counter of a board at a serial line, which has this many for a clock of its processor, see
/// hal/cortex_m/counter.cpp; 0 if it has none.
inline constexpr double counts_per_clock = 256.0;

/// Aligned, so that a processor without unaligned access takes it by words.
struct alignas(std::uint32_t) SampleFrame : std::array<std::uint8_t, sample_frame_size> {};
struct alignas(std::uint32_t) DriveFrame : std::array<std::uint8_t, drive_frame_size> {};
struct alignas(std::uint32_t) VibrationSampleFrame : std::array<std::uint8_t, resonant_frame_size> {
};
struct alignas(std::uint32_t) ResonantDriveFrame : std::array<std::uint8_t, resonant_frame_size> {};
struct alignas(std::uint32_t) MotionSampleFrame : std::array<std::uint8_t, motion_frame_size> {};
struct alignas(std::uint32_t) BiasedDriveFrame : std::array<std::uint8_t, biased_frame_size> {};

namespace detail {

inline void put(std::uint32_t word, std::uint8_t* bytes) {
  for (std::size_t i = 0; i < 4; ++i) {
    bytes[i] = static_cast<std::uint8_t>(word >> (8 * i));
  }
}

inline std::uint32_t get(const std::uint8_t* bytes) {
  // Written out, it is seen to be one load where the processor has such a load.
  return bytes[0] | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16 |
         std::uint32_t{bytes[3]} << 24;
}

}  // namespace detail

/// Period that a frame of either kind belongs to.
template <class Frame>
std::uint32_t period(const Frame& frame) {
  return detail::get(frame.data());
}

namespace detail {

template <class Frame>
void put_sample(std::uint32_t period, const Sample& sample, Frame& frame) {
  put(period, frame.data());
  put(static_cast<std::uint32_t>(sample.friction_force), frame.data() + 4);
  put(static_cast<std::uint32_t>(sample.sliding_velocity), frame.data() + 8);
  frame[12] = sample.force_at_rail ? 1 : 0;
  frame[13] = sample.fresh ? 1 : 0;
  frame[14] = sample.velocity_at_rail ? 1 : 0;
}

template <class Frame>
void put_vibration(const VibrationSample& sample, Frame& frame) {
  put(static_cast<std::uint32_t>(sample.in_phase), frame.data() + 16);
  put(static_cast<std::uint32_t>(sample.quadrature), frame.data() + 20);
  frame[24] = sample.vibration_at_rail ? 1 : 0;
  frame[25] = sample.vibration_fresh ? 1 : 0;
}

template <class Frame>
void put_drive(std::uint32_t period, const Drive& drive, Frame& frame) {
  put(period, frame.data());
  put(static_cast<std::uint32_t>(drive.amplitude), frame.data() + 4);
  put(static_cast<std::uint32_t>(drive.commanded_ratio), frame.data() + 8);
  frame[12] = drive.state;
  frame[13] = drive.limit;
  frame[14] = drive.fault;
  frame[15] = drive.settling;
}

}  // namespace detail

inline SampleFrame encode(std::uint32_t period, const Sample& sample) {
  SampleFrame frame{};
  detail::put_sample(period, sample, frame);
  return frame;
}

inline VibrationSampleFrame encode(std::uint32_t period, const VibrationSample& sample) {
  VibrationSampleFrame frame{};
  detail::put_sample(period, sample, frame);
  detail::put_vibration(sample, frame);
  return frame;
}

inline MotionSampleFrame encode(std::uint32_t period, const MotionSample& sample) {
  MotionSampleFrame frame{};
  detail::put_sample(period, sample, frame);
  detail::put_vibration(sample, frame);
  detail::put(static_cast<std::uint32_t>(sample.mean_velocity), frame.data() + 28);
  return frame;
}

inline DriveFrame encode(std::uint32_t period, const Drive& drive) {
  DriveFrame frame{};
  detail::put_drive(period, drive, frame);
  return frame;
}

inline ResonantDriveFrame encode(std::uint32_t period, const ResonantDrive& drive) {
  ResonantDriveFrame frame{};
  detail::put_drive(period, drive, frame);
  detail::put(static_cast<std::uint32_t>(drive.frequency), frame.data() + 24);
  return frame;
}

inline BiasedDriveFrame encode(std::uint32_t period, const BiasedDrive& drive) {
  BiasedDriveFrame frame{};
  detail::put_drive(period, drive, frame);
  detail::put(static_cast<std::uint32_t>(drive.bias), frame.data() + 24);
  return frame;
}

template <class Frame>
void put_cost(const AnswerCost& cost, Frame& frame) {
  detail::put(cost.step, frame.data() + 16);
  detail::put(cost.answer, frame.data() + 20);
}

template <class Frame>
AnswerCost cost_of(const Frame& frame) {
  return {detail::get(frame.data() + 16), detail::get(frame.data() + 20)};
}

namespace detail {

template <class Frame>
Sample get_sample(const Frame& frame) {
  return {static_cast<std::int32_t>(get(frame.data() + 4)),
          static_cast<std::int32_t>(get(frame.data() + 8)), frame[12] != 0, frame[13] != 0,
          frame[14] != 0};
}

template <class Frame>
VibrationSample get_vibration(const Frame& frame) {
  return {get_sample(frame), static_cast<std::int32_t>(get(frame.data() + 16)),
          static_cast<std::int32_t>(get(frame.data() + 20)), frame[24] != 0, frame[25] != 0};
}

template <class Frame>
Drive get_drive(const Frame& frame) {
  return {static_cast<std::int32_t>(get(frame.data() + 4)),
          static_cast<std::int32_t>(get(frame.data() + 8)),
          frame[12],
          frame[13],
          frame[14],
          frame[15]};
}

}  // namespace detail

inline Sample sample_of(const SampleFrame& frame) {
  return detail::get_sample(frame);
}

inline VibrationSample sample_of(const VibrationSampleFrame& frame) {
  return detail::get_vibration(frame);
}

inline MotionSample sample_of(const MotionSampleFrame& frame) {
  return {detail::get_vibration(frame), static_cast<std::int32_t>(detail::get(frame.data() + 28))};
}

inline Drive drive_of(const DriveFrame& frame) {
  return detail::get_drive(frame);
}

inline ResonantDrive drive_of(const ResonantDriveFrame& frame) {
  return {detail::get_drive(frame), static_cast<std::int32_t>(detail::get(frame.data() + 24))};
}

inline BiasedDrive drive_of(const BiasedDriveFrame& frame) {
  return {detail::get_drive(frame), static_cast<std::int32_t>(detail::get(frame.data() + 24))};
}

// Which frame carries what.
template <class Signal>
struct FrameOf;
template <>
struct FrameOf<Sample> {
  using Type = SampleFrame;
};
template <>
struct FrameOf<VibrationSample> {
  using Type = VibrationSampleFrame;
};
template <>
struct FrameOf<Drive> {
  using Type = DriveFrame;
};
template <>
struct FrameOf<ResonantDrive> {
  using Type = ResonantDriveFrame;
};
template <>
struct FrameOf<MotionSample> {
  using Type = MotionSampleFrame;
};
template <>
struct FrameOf<BiasedDrive> {
  using Type = BiasedDriveFrame;
};

// How an image in lockstep ends; what the emulator's process returns.

enum class ExitCode : int {
  shut_down = 0,        ///< the host closed the link between two frames
  link_broken = 1,      ///< a frame was cut short, out of turn, or could not be sent
  processor_fault = 2,  ///< an exception was taken; none is expected
};

}  // namespace sonoglide::hal::lockstep
