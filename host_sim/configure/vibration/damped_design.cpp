#include "host_sim/configure/vibration/damped_design.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/configure/sensor_noise.hpp"
#include "host_sim/configure/vibration/mode_model.hpp"

namespace sonoglide::configure {
namespace {

namespace mode = control::mode;

ObserverGains observer_gains_of(const ModeModel& model, double noise) {
  constexpr double process = 1e-3;  // of full drive's velocity: friction, and what is not modelled
  constexpr double model_error = 3e-3;
  const double velocity = model.forced.norm();
  const double variance = std::max(model_error * velocity, noise);
  return observer_gains(model, process * process * velocity * velocity, variance * variance);
}

template <class Matrix>
void put(const Matrix& matrix, std::size_t index, control::ModeRow<double>& row) {
  for (Eigen::Index i = 0; i < matrix.rows(); ++i) {
    for (Eigen::Index k = 0; k < matrix.cols(); ++k) {
      row[index++] = matrix(i, k);
    }
  }
}

control::ModeRow<double> row_of(const ModeModel& model, double noise) {
  const ObserverGains observer = observer_gains_of(model, noise);
  const double velocity = model.forced.norm();
  control::ModeRow<double> row{};
  put(Eigen::Vector2d(model.rotation.col(0)), mode::rotation, row);
  put(model.input_gain, mode::input_gain, row);
  put(model.forced, mode::forced, row);
  put(model.output, mode::output, row);
  put(observer.mode, mode::mode_gain, row);
  put(observer.offset, mode::offset_gain, row);
  put(feedback_of(model, vibration_error(model)), mode::feedback, row);
  put(Eigen::Vector2d(model.forced / (velocity * velocity)), mode::inverse, row);
  row[mode::per_velocity] = 1.0 / velocity;
  return row;
}

/// Largest magnitude of these numbers of a row, in all rows.
double largest(const control::ModeTable<double>& table, std::size_t begin, std::size_t end) {
  double most = 0.0;
  for (const control::ModeRow<double>& row : table) {
    for (std::size_t i = begin; i < end; ++i) {
      most = std::max(most, std::abs(row[i]));
    }
  }
  return most;
}

/// Bound of the magnitude that the slope of a forecast over the frequency parameter has where
/// neither part of the mode, nor the change of the amplitude, is larger than 1. From one row to the
/// next the frequency parameter moves by 2/(rows - 1), and the numbers are straight.
double steepest(const control::ModeTable<double>& table) {
  double most = 0.0;
  for (std::size_t k = 0; k + 1 < mode::rows; ++k) {
    const auto value = [&](std::size_t i) {
      return std::max(std::abs(table[k][i]), std::abs(table[k + 1][i]));
    };
    const auto slope = [&](std::size_t i) {
      return std::abs(table[k + 1][i] - table[k][i]) * (mode::rows - 1) / 2.0;
    };
    const double rotated = value(mode::rotation) + value(mode::rotation + 1);
    const double rotated_slope = slope(mode::rotation) + slope(mode::rotation + 1);
    for (std::size_t part = 0; part < 2; ++part) {
      double tilt = slope(mode::forced + part);
      for (std::size_t i = 0; i < 2; ++i) {
        const std::size_t output = mode::output + 2 * part + i;
        tilt += slope(output) * (rotated + value(mode::input_gain + i)) +
                value(output) * (rotated_slope + slope(mode::input_gain + i));
      }
      most = std::max(most, tilt);
    }
  }
  return most;
}

/// The table in multiples of a mode that leaves the input gain an eighth.
void scale_mode(control::ModeTable<double>& table) {
  const double unit = 8.0 * largest(table, mode::input_gain, mode::forced);
  const auto scale = [&](std::size_t begin, std::size_t end, double factor) {
    for (control::ModeRow<double>& row : table) {
      for (std::size_t i = begin; i < end; ++i) {
        row[i] *= factor;
      }
    }
  };
  scale(mode::input_gain, mode::forced, 1.0 / unit);
  scale(mode::output, mode::mode_gain, unit);
  scale(mode::mode_gain, mode::offset_gain, 1.0 / unit);
  scale(mode::feedback, mode::feedback + 2, unit);
}

}  // namespace

double damped_full_scale_m_per_s(const scene::Scene& scene, const NominalPlant& plant) {
  constexpr double room = 4.0;  // for what feedback may ask for, and for what a knock adds
  constexpr double least_room = 2.0;
  constexpr double most_room = 64.0;
  const scene::Drive& drive = *scene.drive;
  const double full_m_per_s = peak_vibration_m_per_s(
      plant, drive.frequency_Hz, scene.max_drive_force_N() * plant.force_factor);
  if (const auto& given_m_per_s = scene.sensor.vibration_full_scale_m_per_s) {
    const double least_m_per_s = least_room * full_m_per_s;
    const double most_m_per_s = most_room * full_m_per_s;
    if (*given_m_per_s < least_m_per_s || *given_m_per_s > most_m_per_s) {
      throw ConfigurationError(
          "sensor.vibration_full_scale_m_per_s",
          fmt::format("{:g} m/s does not suit full drive, whose steady vibration is {:.4g} m/s; "
                      "allowed: {} to {} m/s",
                      *given_m_per_s, full_m_per_s, scene::at_least(least_m_per_s, 4),
                      scene::at_most(most_m_per_s, 4)));
    }
    return *given_m_per_s;
  }
  const double fastest_m_per_s = scene.sliding.fastest_m_per_s();
  const double full_scale_m_per_s = room * std::max(full_m_per_s, fastest_m_per_s);
  if (full_scale_m_per_s > most_room * full_m_per_s) {
    const double amplitude =
        scene.transducer ? drive.max_voltage_amplitude_V : drive.max_force_amplitude_N;
    throw ConfigurationError(
        scene.transducer ? "drive.max_voltage_amplitude_V" : "drive.max_force_amplitude_N",
        fmt::format("vibrates at {:.3g} m/s, too little for a sliding of {:g} m/s; allowed: at "
                    "least {} {} with controller.vibration = \"damped\"",
                    full_m_per_s, fastest_m_per_s,
                    scene::at_least(amplitude * room / most_room * fastest_m_per_s / full_m_per_s),
                    scene.transducer ? "V" : "N"));
  }
  return full_scale_m_per_s;
}

DampedDesign design_damping(const scene::Scene& scene, const NominalPlant& plant,
                            double full_scale_m_per_s) {
  require_mode(plant);
  const Resonator middle = nominal_resonator(scene, plant, full_scale_m_per_s);
  DampedDesign design;
  design.stiffness_range = stiffness_range(middle.stiffness);
  design.noise = vibration_noise_m_per_s(scene.sensor, full_scale_m_per_s) / full_scale_m_per_s;
  for (std::size_t i = 0; i < mode::rows; ++i) {
    const double frequency_parameter = 2.0 * static_cast<double>(i) / (mode::rows - 1) - 1.0;
    Resonator resonator = middle;
    resonator.stiffness *= 1.0 + frequency_parameter * design.stiffness_range;
    design.table[i] = row_of(mode_model(resonator), design.noise);
  }
  scale_mode(design.table);
  const ModeModel model = mode_model(middle);
  const double velocity = model.forced.norm();
  design.quick = is_quick(model);
  constexpr double heard = 6.0;
  constexpr double inaudible = 1e-5;
  constexpr double deviations = 4.0;
  constexpr double quiet = 1e-3;
  constexpr double missing = 0.25 * 0.25;  // of a quarter of the drive a quarter
  design.audible = heard * std::max(design.noise, inaudible * velocity);
  constexpr double rounded = 0.99;
  design.quiet = std::min(0.5, rounded * design.audible / steepest(design.table));
  design.settled = std::max(deviations * design.noise, quiet * velocity);
  design.missing = missing * velocity;
  design.delay_periods = static_cast<std::uint8_t>(scene.drive->delay_periods);
  return design;
}

}  // namespace sonoglide::configure
