#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/process/regular_expression.hpp"
#include "host_sim/scene/bound.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/control_design.hpp"
#include "host_sim/scene_file/keys.hpp"

namespace sonoglide::configure::allowed_bounds_test {
namespace {

double read(const std::string& text) {
  return std::strtod(text.c_str(), nullptr);
}

TEST(Bound, IsNeverBeyondWhatItTells) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> exponent(-300.0, 300.0);
  for (int i = 0; i < 20000; ++i) {
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    const double bound = sign * std::pow(10.0, exponent(random));
    for (const int digits : {1, 3, 6, 17}) {
      const double unit = std::pow(10.0, 1.0 - digits) * std::abs(bound);
      EXPECT_GE(read(scene::at_least(bound, digits)), bound);
      EXPECT_LE(read(scene::at_least(bound, digits)), bound + 1.1 * unit);
      EXPECT_LE(read(scene::at_most(bound, digits)), bound);
      EXPECT_GE(read(scene::at_most(bound, digits)), bound - 1.1 * unit);
    }
  }
}

TEST(Bound, OfFewDigitsIsToldAsItIs) {
  EXPECT_EQ(scene::at_least(0.1), "0.1");
  EXPECT_EQ(scene::at_most(1e-12), "1e-12");
  EXPECT_EQ(scene::at_least(0.0), "0");
  EXPECT_EQ(scene::at_most(-133e6), "-1.33e+08");
  EXPECT_EQ(scene::at_least(std::numeric_limits<double>::infinity()), "inf");
  EXPECT_EQ(scene::at_least(0.12345678, 3), "0.124");
  EXPECT_EQ(scene::at_most(0.12345678, 3), "0.123");
}

/// The key that a scene is refused for, and what is said of it; empty where it serves.
struct Refusal {
  std::string key;
  std::string message;
};

Refusal refusal_of(const scene_file::Source& source, const std::vector<std::string>& overrides) {
  try {
    experiment::read(source, overrides);
    return {};
  } catch (const scene_file::SceneError& error) {
    return {error.key(), error.message()};
  }
}

/// The numbers that a message allows of a key, each once above, once below what it may not reach.
std::vector<double> allowed_in(const std::string& message) {
  static const process::RegularExpression lower(R"((at least|above) (-?[0-9.]+(e[-+]?[0-9]+)?))");
  static const process::RegularExpression upper(
      R"((at most|below|less than) (-?[0-9.]+(e[-+]?[0-9]+)?))");
  static const process::RegularExpression range(
      R"((-?[0-9.]+(?:e[-+]?[0-9]+)?) to (below )?(-?[0-9.]+(?:e[-+]?[0-9]+)?))");
  constexpr double beside = 1e-9;
  constexpr double least = 1e-30;  // where above 0 is allowed
  const std::string allowed = message.substr(message.find("allowed: "));
  std::vector<double> values;
  if (const process::Match found = range.search(allowed); !found.empty()) {
    values.push_back(read(found[1]));
    values.push_back(read(found[3]) * (!found[2].empty() ? 1.0 - beside : 1.0));
  }
  if (const process::Match found = lower.search(allowed); !found.empty()) {
    values.push_back(read(found[2]) * (found[1] == "above" ? 1.0 + beside : 1.0) +
                     (found[1] == "above" && read(found[2]) == 0.0 ? least : 0.0));
  }
  if (const process::Match found = upper.search(allowed); !found.empty()) {
    values.push_back(read(found[2]) * (found[1] == "at most" ? 1.0 : 1.0 - beside));
  }
  return values;
}

/// Up to the first figure: what is wrong.
std::string finding_of(const std::string& message) {
  return message.substr(message.find_first_not_of("0123456789.e+- "), 12);
}

struct Trial {
  const char* scene;
  const char* key;
};

/// Sets a key to a value that it may not take, and then to each that the refusal allows: that is
/// accepted, or refused for another reason.
/// @return how many values a refusal allowed
int feed_back(const scene_file::Source& source, const std::vector<std::string>& overrides,
              const std::string& key, const std::string& odd, bool whole) {
  const auto with = [&](const std::string& value) {
    std::vector<std::string> all = overrides;
    all.push_back(key + "=" + value);
    return refusal_of(source, all);
  };
  const Refusal refusal = with(odd);
  if (refusal.key != key || refusal.message.find("allowed: ") == std::string::npos) {
    return 0;
  }
  int fed_back = 0;
  for (const double value : allowed_in(refusal.message)) {
    const std::string text = whole ? fmt::format("{:.0f}", value) : fmt::format("{}", value);
    const Refusal again = with(text);
    EXPECT_FALSE(again.key == refusal.key &&
                 finding_of(again.message) == finding_of(refusal.message))
        << source.name() << ": " << fmt::format("{}", fmt::join(overrides, " ")) << " " << key
        << "=" << text << "\n"
        << refusal.message << "\n"
        << again.message;
    ++fed_back;
  }
  return fed_back;
}

/// In every example, one key after the other.
TEST(Bound, WhatAMessageAllowsOfAnyKeyIsAccepted) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> decades(-9.0, 12.0);
  int fed_back = 0;
  for (const auto& entry : std::filesystem::directory_iterator(SONOGLIDE_SCENES)) {
    if (entry.path().extension() != ".toml") {
      continue;
    }
    const auto source = scene_file::read_source(entry.path().string());
    for (const scene_file::KeyTable& table : scene_file::key_tables()) {
      for (const scene_file::Key& key : table.keys) {
        const bool whole = std::holds_alternative<scene_file::Integer>(key.allowed);
        if (table.of_others ||
            (!whole && !std::holds_alternative<scene_file::Number>(key.allowed))) {
          continue;
        }
        const double size = std::pow(10.0, decades(random));
        const std::string path = fmt::format("{}.{}", table.name, key.name);
        for (const double odd : {size, -size}) {
          fed_back += feed_back(source, {}, path,
                                whole ? fmt::format("{:.0f}", odd) : fmt::format("{}", odd), whole);
        }
      }
    }
  }
  EXPECT_GT(fed_back, 2500);
}

/// What another key of the scene decides.
TEST(Bound, WhatAMessageAllowsIsAccepted) {
  const std::vector<Trial> trials = {
      {"target_step", "controller.relearn_every_s"},
      {"target_step", "controller.calibration_s"},
      {"target_step", "controller.speed_floor_m_per_s"},
      {"target_step", "sensor.force_full_scale_N"},
      {"target_step", "sensor.adc_bits"},
      {"target_step", "run.duration_s"},
      {"target_step", "run.window_start_s"},
      {"target_step", "run.record_interval_s"},
      {"target_step", "friction.initial_force_N"},
      {"lugre_open_loop", "friction.static_coefficient"},
      {"stick_slip_open_loop", "friction.rise_s3_per_m3"},
      {"langevin", "drive.max_current_amplitude_A"},
      {"langevin", "drive.max_voltage_amplitude_V"},
      {"langevin", "drive.frequency_resolution_Hz"},
      {"langevin", "sensor.vibration_full_scale_m_per_s"},
      {"langevin", "sensor.vibration_bits"},
      {"langevin", "sensor.vibration_noise_m_per_s"},
      {"haptic_plate", "drive.max_voltage_amplitude_V"},
      {"haptic_plate", "sensor.vibration_full_scale_m_per_s"},
      {"wire_bonder", "drive.max_current_amplitude_A"},
      {"damped_step", "sensor.vibration_full_scale_m_per_s"},
      {"damped_step", "plant.damping_N_s_per_m"},
      {"damped_step", "drive.max_force_amplitude_N"},
  };
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> decades(-6.0, 6.0);
  std::uniform_real_distribution<double> near(0.8, 1.25);
  int fed_back = 0;
  for (const Trial& trial : trials) {
    const auto source =
        scene_file::read_source(std::string(SONOGLIDE_SCENES) + "/" + trial.scene + ".toml");
    const bool whole = std::string(trial.key).find("_bits") != std::string::npos;
    for (int i = 0; i < 60; ++i) {
      const std::string plant = "plant.mass_kg=" + std::to_string(0.02 * near(random));
      const double odd = whole ? 1.0 + i % 12 : std::pow(10.0, decades(random)) * near(random);
      fed_back += feed_back(source, {plant}, trial.key,
                            whole ? fmt::format("{:.0f}", odd) : fmt::format("{}", odd), whole);
    }
  }
  EXPECT_GT(fed_back, 400);
}

}  // namespace
}  // namespace sonoglide::configure::allowed_bounds_test
