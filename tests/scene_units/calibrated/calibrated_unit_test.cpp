/// A unit whose force sensor is wrong does, once it is calibrated, what one with an ideal sensor does.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "host_sim/boards/unit/tare.hpp"
#include "host_sim/boards/unit/unit_scales.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/run.hpp"
#include "tests/scene_units/agreement/scene_unit.hpp"

#include "target_step/controller_configuration.hpp"

namespace sonoglide::app::scene_units_test {
namespace {

using Parts = configuration::Parts;

constexpr auto design = SONOGLIDE_FIELD_DESIGN(configuration);
constexpr double full_scale_N = configuration::full_scales[0].value;

constexpr double sensor_offset = 0.03;  ///< of full scale
constexpr double sensor_gain = 1.1;

/// A unit that its host calibrates before the run.
class Calibrated : public UnitPort<Parts> {
 public:
  Calibrated() : UnitPort(design, 1.0) {}

  /// With a contact that is lifted: as `tare` of the program does.
  void tare() {
    halt();
    std::array<double, unit::tare_readings> forces_N{};
    for (double& force_N : forces_N) {
      step(unit, hal::Sample{static_cast<std::int32_t>(sensor_offset * 0x1p31), 0, false, true});
      force_N = scales_.value_of(link::Quantity::friction_force,
                                 static_cast<std::uint32_t>(unit.supervisor().friction_force()));
    }
    const double gain = unit.value(Parameter::force_gain) * 1e-6;
    const double offset_N = unit::offset_that_is(
        scales_.value_of_parameter(unit::offset_parameter, unit.value(Parameter::force_offset)),
        unit::mean_of(forces_N).value, gain);
    save(Parameter::force_offset, offset_N);
    restart(unit);
  }

  void set(Parameter parameter, double value) {
    halt();
    save(parameter, value);
    restart(unit);
  }

 private:
  void halt() {
    unit.stop();
    pass(unit);
  }
  void save(Parameter parameter, double value) {
    const auto number = static_cast<std::size_t>(parameter);
    ASSERT_EQ(unit.write(number, scales_.count_of_parameter(number, value)), Answer::taken);
    store::Saving saving = store::Saving::busy;
    while (saving == store::Saving::busy) {
      saving = unit.proceed();
      step(unit, hal::Sample{});
    }
    ASSERT_EQ(saving, store::Saving::saved);
  }

  unit::UnitScales scales_{configuration::full_scales};
};

/// Carrier periods in which the loop has settled: the last quarter of each step of the scene.
class Settled : public loop::PeriodSink {
 public:
  void take(const loop::Period& period) override {
    constexpr int periods_in_step = 120;
    if (taken_++ % periods_in_step >= 3 * periods_in_step / 4) {
      ratios.push_back(period.friction_ratio);
      drives_N.push_back(period.drive_amplitude_N);
    }
  }

  std::vector<double> ratios;
  std::vector<double> drives_N;

 private:
  int taken_ = 0;
};

Settled settled(Calibrated& unit, const std::vector<std::string>& changes) {
  const configure::Experiment experiment = experiment::read_file(SONOGLIDE_TARGET_STEP, changes);
  EXPECT_EQ(experiment.design->scales.force_N, full_scale_N);
  Settled periods;
  loop::Watch watch;
  watch.periods = {&periods};
  const loop::RunResult result = loop::run(experiment.plant, *experiment.design, unit, watch);
  EXPECT_TRUE(result.control->faults.empty());
  EXPECT_EQ(periods.ratios.size(), 90U);
  return periods;
}

/// The largest relative difference.
double difference(const std::vector<double>& found, const std::vector<double>& ideal) {
  double largest = 0.0;
  for (std::size_t i = 0; i < ideal.size(); ++i) {
    largest = std::max(largest, std::abs(found.at(i) / ideal.at(i) - 1.0));
  }
  return largest;
}

const std::vector<std::string>& of_wrong_sensor() {
  static const std::vector<std::string> changes{
      fmt::format("sensor.force_offset_N={}", sensor_offset * full_scale_N),
      fmt::format("sensor.force_gain={}", sensor_gain)};
  return changes;
}

TEST(CalibratedUnit, MeetsTheIdealOneToOneInAThousand) {
  Calibrated with_ideal_sensor;
  const Settled ideal = settled(with_ideal_sensor, {});
  for (const bool gain_first : {false, true}) {
    Calibrated unit;
    if (gain_first) {
      unit.set(Parameter::force_gain, 1.0 / sensor_gain);
      unit.tare();
    } else {
      unit.tare();
      unit.set(Parameter::force_gain, 1.0 / sensor_gain);
    }
    const Settled found = settled(unit, of_wrong_sensor());
    EXPECT_LE(difference(found.ratios, ideal.ratios), 1e-3);
    EXPECT_LE(difference(found.drives_N, ideal.drives_N), 1e-3);
  }
}

TEST(CalibratedUnit, WouldMissItByOneInAHundredOtherwise) {
  Calibrated with_ideal_sensor;
  const Settled ideal = settled(with_ideal_sensor, {});
  Calibrated unit;
  EXPECT_GE(difference(settled(unit, of_wrong_sensor()).ratios, ideal.ratios), 1e-2);
  unit.tare();
  EXPECT_GE(difference(settled(unit, of_wrong_sensor()).ratios, ideal.ratios), 1e-2);
}

}  // namespace
}  // namespace sonoglide::app::scene_units_test
