/// A texture along the distance that an encoder counts lies where the sliding is, whatever the velocity sensor
/// reads; one along the velocity goes astray with the error of that sensor.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/report/texture_metrics.hpp"
#include "tests/scene_units/agreement/encoder.hpp"
#include "tests/scene_units/agreement/scene_unit.hpp"

#define configuration target_step_configuration
#include "target_step/controller_configuration.hpp"
#undef configuration
#define configuration speed_reversal_configuration
#include "speed_reversal/controller_configuration.hpp"
#undef configuration
#define configuration fingertip_configuration
#include "fingertip/controller_configuration.hpp"
#undef configuration

namespace sonoglide::app::scene_units_test {
namespace {

/// The first harmonic of what the plant shows, in the second half of a run.
struct Rendered {
  double amplitude;  ///< over the wanted one
  double lag_deg;
};

Rendered rendered(const configure::Experiment& experiment, loop::ControlPort& port,
                  std::vector<loop::PeriodSink*> watching = {}) {
  report::TextureMeter meter(experiment.plant);
  loop::Watch watch;
  watch.periods = std::move(watching);
  watch.periods.push_back(&meter);
  const loop::RunResult result = loop::run(experiment.plant, *experiment.design, port, watch);
  EXPECT_TRUE(result.control->faults.empty());
  const report::TextureHarmonic first = meter.harmonics().at(1);
  return {first.amplitude_ratio(), first.lag_deg()};
}

struct Both {
  Rendered integrated;  ///< along the velocity that is read, as `run` does
  Rendered counted;     ///< by a unit with an encoder
};

/// The commands of a unit are those of an image without a host whose count begins five periods lower: it wraps.
///
/// @tparam counts_per_m  of the encoder
template <std::int64_t counts_per_m, class Parts, class Targets>
Both of(const std::string& name, const std::vector<std::string>& changes,
        const FieldDesign<Parts>& design,
        const typename control::Controller<Parts>::Parameters& parameters, const Targets& targets) {
  using Counter = Encoder<counts_per_m>;
  const configure::Experiment experiment =
      experiment::read_file(SONOGLIDE_SCENES "/" + name + ".toml", changes);
  const auto run = loop::make_control_port(experiment.nominal, *experiment.design);

  const auto course = course_of<Counter>(targets);
  UnitPort<Parts, std::decay_t<decltype(course)>, Counter> unit(design, 1.0, course);
  Recorded<PortOfParts<Parts>> by_unit(unit);
  const Both both{rendered(experiment, *run), rendered(experiment, by_unit, {&unit.board})};

  const double lower = 5.0 * Targets::Length::period_m * Counter::travel_counts_per_m;
  ImagePort<Parts, Targets, Counter> image(parameters, targets, Counter(-std::llround(lower)));
  Recorded<PortOfParts<Parts>> by_image(image);
  rendered(experiment, by_image, {&image.board});
  expect_same(by_unit.drives, by_image.drives);
  return both;
}

/// The texture of CMakeLists.txt.
std::vector<std::string> textured(std::vector<std::string> changes) {
  changes.insert(changes.end(), {SONOGLIDE_TEXTURE});
  return changes;
}

/// Of a scene, whose controller is compiled in.
#define SONOGLIDE_BOTH(scene, counts_per_m, changes)                               \
  of<counts_per_m>(#scene, changes, SONOGLIDE_FIELD_DESIGN(scene##_configuration), \
                   scene##_configuration::parameters, scene##_configuration::target_steps)

Both of_target_step(const std::vector<std::string>& changes) {
  return SONOGLIDE_BOTH(target_step, 25'000'000, textured(changes));
}

Both of_speed_reversal(const std::vector<std::string>& changes) {
  return SONOGLIDE_BOTH(speed_reversal, 25'000'000, textured(changes));
}

Both of_fingertip(const std::vector<std::string>& changes) {
  return SONOGLIDE_BOTH(fingertip, 1'000'000, changes);
}

void expect_in_place(const Rendered& rendered, double amplitude_error, double lag_deg) {
  EXPECT_NEAR(rendered.amplitude, 1.0, amplitude_error);
  EXPECT_NEAR(rendered.lag_deg, 0.0, lag_deg);
}

/// Of eight to ten ridges a fifth more or less are rendered: hardly any of the wanted harmonic is left.
void expect_astray(const Rendered& rendered) {
  EXPECT_LT(rendered.amplitude, 0.3);
}

// The skin speeds up and slows down on each ridge. An encoder of 1 um: see what_the_friction_is_for.md.
TEST(TextureAlongAnEncoder, StaysInPlaceUnderAFinger) {
  const Both exact = of_fingertip({});
  EXPECT_NEAR(exact.integrated.lag_deg, -4.5, 0.05);
  expect_in_place(exact.counted, 0.005, 0.3);
  const Both gain = of_fingertip({"sensor.velocity_gain=0.98"});
  EXPECT_NEAR(gain.integrated.lag_deg, 45.2, 0.05);
  expect_in_place(gain.counted, 0.005, 0.3);
  for (const char* change : {"sensor.velocity_gain=0.8", "sensor.velocity_gain=1.2"}) {
    const Both wrong = of_fingertip({change});
    expect_astray(wrong.integrated);
    expect_in_place(wrong.counted, 0.01, 0.5);
  }
}

// Here the ratio itself hangs on the velocity that is read, and with it the amplitude.
TEST(TextureAlongAnEncoder, StaysInPlaceAtAnySpeed) {
  const std::vector<std::string> constant{"run.duration_s=20e-3"};
  const std::vector<std::string> varying{
      "run.duration_s=40e-3", "sliding.velocity_m_per_s=",
      "sliding.profile=[[0.0, 0.01], [10e-3, 0.02672], [20e-3, 0.015], [30e-3, 0.02672]]"};
  for (const std::vector<std::string>& sliding : {constant, varying}) {
    for (const char* gain : {"0.8", "1.2"}) {
      std::vector<std::string> changes = sliding;
      changes.push_back(std::string("sensor.velocity_gain=") + gain);
      const Both wrong = of_target_step(changes);
      expect_astray(wrong.integrated);
      expect_in_place(wrong.counted, 0.15, 3.0);
    }
    expect_in_place(of_target_step(sliding).counted, 0.01, 1.5);
  }
}

// What an offset adds on the way there it adds on the way back, too.
TEST(TextureAlongAnEncoder, StaysInPlaceOnTheWayBack) {
  const std::vector<std::string> turning{
      "run.duration_s=40e-3",
      "sliding.profile=[[0.0, 0.02672], [10e-3, 0.02672], [14e-3, -0.02672]]"};
  expect_in_place(of_speed_reversal(turning).counted, 0.01, 1.5);
  std::vector<std::string> changes = turning;
  changes.push_back("sensor.velocity_offset_m_per_s=5e-3");
  const Both wrong = of_speed_reversal(changes);
  expect_astray(wrong.integrated);
  expect_in_place(wrong.counted, 0.15, 3.0);
}

}  // namespace
}  // namespace sonoglide::app::scene_units_test
