#include "host_sim/loop/control/sensor.hpp"

#include <optional>
#include <utility>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/turn.hpp"

namespace sonoglide::loop {
namespace {

/// Of a number that an integer can hold. std::floor is a call without SSE4.1.
std::int64_t floored(double value) {
  const auto towards_zero = static_cast<std::int64_t>(value);
  return towards_zero - (value < static_cast<double>(towards_zero) ? 1 : 0);
}

/// A two's-complement converter of the given width that spans ± full scale, rounding to nearest.
Conversion convert(double value, double full_scale, int bits) {
  const auto levels = static_cast<double>(std::int64_t{1} << (bits - 1));
  const double scaled = value / full_scale * levels;
  const bool high = !(scaled < levels - 1.5);
  const bool low = !high && scaled < -levels + 0.5;
  const std::int64_t top = (std::int64_t{1} << (bits - 1)) - 1;
  std::int64_t code = 0;
  if (high || low) {
    code = high ? top : -top - 1;
  } else {
    code = floored(scaled + 0.5);
  }
  return {static_cast<std::int32_t>(code * (std::int64_t{1} << (32 - bits))), high || low};
}

constexpr int ideal_bits = 32;

}  // namespace

Sensor::Sensor(const scene::Sensor& sensor, const configure::ControlScales& scales,
               double vibration_gain)
    : sensor_(sensor),
      scales_(scales),
      vibration_gain_(vibration_gain),
      conversions_(sensor.samples_per_period.value_or(1)),
      pipeline_N_(static_cast<std::size_t>(sensor.delay_periods * conversions_), 0.0),
      generator_(sensor.seed) {
  if (const std::optional<double> low_pass_Hz = sensor.low_pass_Hz()) {
    const double periods = numeric::two_pi * *low_pass_Hz * scales.carrier_period_s;
    filter_decay_ = numeric::exp(-periods);
    filter_new_weight_ = 1.0 + numeric::expm1(-periods) / periods;
  }
}

hal::Sample Sensor::sample(const PeriodForce& force, double sliding_velocity_m_per_s) {
  const Conversion reading = this->reading(force);
  const double velocity_m_per_s =
      sensor_.velocity_gain * sliding_velocity_m_per_s + sensor_.velocity_offset_m_per_s;
  const Conversion velocity = convert(velocity_m_per_s, scales_.velocity_m_per_s,
                                      sensor_.velocity_bits.value_or(ideal_bits));
  return {reading.code, velocity.code, reading.at_rail, true, velocity.at_rail};
}

void Sensor::pass(const PeriodForce& force) {
  for_each_conversion(force, [&](double force_N) { delayed(force_N); });
}

template <class Take>
void Sensor::for_each_conversion(const PeriodForce& force, const Take& take) {
  const double mean_N = force.samples_N.empty() ? filtered(force.mean_N) : 0.0;
  for (int i = 0; i < conversions_; ++i) {
    take(force.samples_N.empty() ? mean_N : force.samples_N[static_cast<std::size_t>(i)]);
  }
}

Conversion Sensor::reading(const PeriodForce& force) {
  if (conversions_ == 1) {
    return converted(force.samples_N.empty() ? filtered(force.mean_N) : force.samples_N.front());
  }
  std::int64_t sum = 0;
  bool at_rail = false;
  for_each_conversion(force, [&](double force_N) {
    const Conversion one = converted(force_N);
    sum += one.code;
    at_rail = at_rail || one.at_rail;
  });
  return {static_cast<std::int32_t>(floored(static_cast<double>(sum) / conversions_ + 0.5)),
          at_rail};
}

/// Delay, wiring, noise and converter.
Conversion Sensor::converted(double force_N) {
  const double seen_N = sensor_.force ? sensor_.force_gain * delayed(force_N) +
                                            sensor_.force_offset_N + noise(sensor_.force_noise_N)
                                      : 0.0;
  return convert(seen_N, scales_.force_N, sensor_.adc_bits.value_or(ideal_bits));
}

hal::VibrationSample Sensor::sample(const PeriodForce& force, double sliding_velocity_m_per_s,
                                    std::complex<double> vibration_m_per_s) {
  const hal::Sample sample = this->sample(force, sliding_velocity_m_per_s);
  const Conversion in_phase = seen(vibration_m_per_s.real());
  const Conversion quadrature = seen(vibration_m_per_s.imag());
  return {sample, in_phase.code, quadrature.code, in_phase.at_rail || quadrature.at_rail, true};
}

hal::MotionSample Sensor::sample(const PeriodForce& force, double sliding_velocity_m_per_s,
                                 std::complex<double> vibration_m_per_s,
                                 double mean_velocity_m_per_s) {
  const hal::VibrationSample sample =
      this->sample(force, sliding_velocity_m_per_s, vibration_m_per_s);
  return {sample, seen(mean_velocity_m_per_s).code};
}

Conversion Sensor::seen(double velocity_m_per_s) {
  return convert(vibration_gain_ * velocity_m_per_s + noise(sensor_.vibration_noise_m_per_s),
                 scales_.velocity_m_per_s, sensor_.vibration_bits.value_or(ideal_bits));
}

void Sensor::copy_state(StateCopy& copy) {
  copy(filter_state_N_, filter_input_N_);
  for (double& force_N : pipeline_N_) {
    copy(force_N);
  }
  copy(oldest_, generator_);
}

/// First-order lag, exact for an input that runs linearly from the last sample to this one.
double Sensor::filtered(double force_N) {
  const double old_weight = 1.0 - filter_decay_ - filter_new_weight_;
  filter_state_N_ =
      filter_decay_ * filter_state_N_ + old_weight * filter_input_N_ + filter_new_weight_ * force_N;
  filter_input_N_ = force_N;
  return filter_state_N_;
}

double Sensor::delayed(double force_N) {
  if (pipeline_N_.empty()) {
    return force_N;
  }
  const double out = std::exchange(pipeline_N_[oldest_], force_N);
  oldest_ = oldest_ + 1 == pipeline_N_.size() ? 0 : oldest_ + 1;
  return out;
}

double Sensor::noise(double rms) {
  if (rms == 0.0) {
    return 0.0;
  }
  constexpr double ln_2 = 0.69314718055994530942;
  constexpr double unit = 1.0 / 9007199254740992.0;  // 2^-53
  const double radius_draw = (static_cast<double>(generator_() >> 11) + 1.0) * unit;
  const double angle_draw = static_cast<double>(generator_() >> 11) * unit;
  const double radius = numeric::sqrt(-2.0 * ln_2 * numeric::log2(radius_draw));
  return rms * radius * numeric::sin_pi(2.0 * angle_draw - 1.0);
}

}  // namespace sonoglide::loop
