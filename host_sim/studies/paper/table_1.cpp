#include "host_sim/studies/paper/table_1.hpp"

#include <fmt/format.h>

#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/scene_file/reader.hpp"

namespace sonoglide::paper {

namespace {

constexpr std::string_view own_method =
    R"(method = "event_taylor"
tolerance = 1e-13
)";
constexpr std::string_view printed_method =
    R"(method = "rk4"
step_s = 1.667e-8
)";
constexpr std::string_view start_from_rest = "duration_periods = 100\n";
/// The free vibration that a start from rest leaves is then a thousandth of the drive's.
constexpr std::string_view start_from_vibration =
    "duration_periods = 200\nwindow_start_periods = 100\n";

struct Parts {
  std::string_view title;
  std::string_view contact;
  std::string_view solver;
  std::string_view run;
  std::string_view start = "";  ///< of the plant
};

std::string text_of(const Parts& parts) {
  return fmt::format(R"(# {}
[plant]
mass_kg = 0.02
stiffness_N_per_m = 133e6
{}
[friction]
{}
[sliding]
velocity_m_per_s = 0.026714794439561918

[drive]
frequency_Hz = 60e3
force_amplitude_N = 384.0

[solver]
{}
[run]
{})",
                     parts.title, parts.start, parts.contact, parts.solver, parts.run);
}

}  // namespace

std::string table_1_text() {
  return text_of({"The paper's Table 1 at 384 N and a velocity ratio of 0.5, from rest.",
                  dahl_contact, own_method, start_from_rest});
}

std::string table_2_text() {
  return text_of(
      {"The paper's Table 2: Table 1 and the paper's own solver, 1000 steps in a carrier "
       "period.",
       dahl_contact, printed_method, start_from_rest});
}

std::string table_1_text(std::string_view contact) {
  return text_of(
      {"The paper's Table 1 at 384 N and a velocity ratio of 0.5, begun on the vibration.", contact,
       own_method, start_from_vibration,
       "initial_displacement_m = -1.4172638629133863e-7   # -Fe/(m w^2 - Ks)\n"});
}

scene::Scene table_1() {
  return scene_file::read_text(table_1_text(), "table_1.toml");
}

scene::Scene at_velocity_ratio(scene::Scene scene, double velocity_ratio) {
  scene.sliding.profile = {{0.0, velocity_ratio * peak_vibration_m_per_s(scene)}};
  return scene;
}

double peak_vibration_m_per_s(const scene::Scene& scene) {
  return configure::peak_vibration_m_per_s(scene.plant, scene.drive->frequency_Hz,
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
  const double amplitude_m = scene.drive->force_amplitude_N /
                             configure::dynamic_stiffness_N_per_m(
                                 scene.plant, numeric::two_pi * scene.drive->frequency_Hz);
  return scene.friction.contact_stiffness_N_per_m * amplitude_m / scene.friction.limit_N();
}

}  // namespace sonoglide::paper
