#include "host_sim/paper/table_1.hpp"

#include "firmware/numeric/turn.hpp"
#include "host_sim/scene/plant_scales.hpp"
#include "host_sim/scene/reader.hpp"

namespace sonoglide::paper {

const std::string_view table_1_text =
    R"(# The paper's Table 1 at 384 N and a velocity ratio of 0.5, from rest.
[plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6

[friction]
law = "dahl"
coefficient = 0.1
contact_stiffness_N_per_m = 0.056e6

[sliding]
velocity_m_per_s = 0.026714794439561918

[drive]
frequency_Hz = 60e3
force_amplitude_N = 384.0

[solver]
method = "event_taylor"
tolerance = 1e-13

[run]
duration_periods = 100
)";

scene::Scene table_1() {
  return scene::read_text(table_1_text, "table_1.toml");
}

scene::Scene at_velocity_ratio(scene::Scene scene, double velocity_ratio) {
  scene.sliding.profile = {{0.0, velocity_ratio * peak_vibration_m_per_s(scene)}};
  return scene;
}

double peak_vibration_m_per_s(const scene::Scene& scene) {
  return scene::peak_vibration_m_per_s(scene.plant, scene.drive->frequency_Hz,
                                       scene.drive->force_amplitude_N);
}

scene::Scene steady(scene::Scene scene) {
  scene.run.start = scene::Start::steady;
  scene.run.duration_s = period_s(scene);
  return scene;
}

double period_s(const scene::Scene& scene) {
  return 1.0 / scene.drive->frequency_Hz;
}

double dahl_number(const scene::Scene& scene) {
  const double amplitude_m =
      scene.drive->force_amplitude_N /
      scene::dynamic_stiffness_N_per_m(scene.plant, numeric::two_pi * scene.drive->frequency_Hz);
  return scene.friction.contact_stiffness_N_per_m * amplitude_m /
         scene::friction_limit_N(scene.friction);
}

}  // namespace sonoglide::paper
