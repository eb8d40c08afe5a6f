#include "host_sim/studies/paper/contact_laws.hpp"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <cstddef>
#include <string>

#include "firmware/friction/coulomb_friction_ratio.hpp"
#include "firmware/friction/dahl_friction_ratio.hpp"
#include "firmware/friction/stribeck_friction_ratio.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/scene_file/reader.hpp"
#include "host_sim/studies/paper/runs.hpp"
#include "host_sim/studies/table_1.hpp"

namespace sonoglide::paper {

double stribeck_vibration_ratio(double velocity_ratio, const StribeckShape& shape) {
  const double fall = 1.5 * shape.drop * shape.vibration;
  const double rise = 0.5 * shape.drop * shape.vibration * shape.vibration * shape.vibration;
  const double r = velocity_ratio;
  return friction::stribeck_friction_ratio(r, fall, rise) / (1.0 - r * (fall - rise * r * r));
}

namespace {

// What no source gives for this contact, the static friction and the curves, is chosen: a static
// friction half as large again, least friction at 50 mm/s, a quarter below the static one.
constexpr const char* lugre_keys = R"(static_coefficient = 0.15
stribeck_velocity_m_per_s = 0.02
bristle_damping_N_s_per_m = 0.01
viscous_friction_N_s_per_m = 0.02
)";
constexpr const char* stribeck_keys = R"(fall_s_per_m = 0.75
rise_s3_per_m3 = 100.0
)";

double stribeck_closed_form(double velocity_ratio) {
  constexpr double speed_of_least_m_per_s = 0.05;
  constexpr double drop = 0.25;
  return stribeck_vibration_ratio(
      velocity_ratio, {drop, peak_vibration_m_per_s(table_1()) / speed_of_least_m_per_s});
}

std::string with_stiffness(const char* keys) {
  return fmt::format("{}{}", table_1::contact_stiffness, keys);
}

std::vector<ContactLaw> make_laws() {
  using table_1::contact;
  const double dahl = dahl_number(table_1());
  return {{"Coulomb", "coulomb", contact("coulomb", ""), friction::coulomb_friction_ratio<double>},
          {"Dahl", "dahl", contact(),
           [dahl](double ratio) { return friction::dahl_friction_ratio(ratio, dahl); }},
          {"LuGre", "lugre", contact("lugre", with_stiffness(lugre_keys)), {}},
          {"Iwan", "iwan", contact("iwan", with_stiffness("elements = 1\n")), {}},
          {"Stribeck", "stribeck", contact("stribeck", stribeck_keys), stribeck_closed_form}};
}

}  // namespace

std::string ContactLaw::scene_file() const {
  return "table_1_" + column + ".toml";
}

std::string ContactLaw::scene_text() const {
  return table_1_text(contact);
}

const std::vector<ContactLaw>& contact_laws() {
  static const std::vector<ContactLaw> laws = make_laws();
  return laws;
}

double vibration_ratio(const scene::Scene& scene) {
  return loop::power_ratios(scene, loop::run(scene).window).friction_ratio;
}

std::vector<double> simulated_ratios(const ContactLaw& law) {
  const scene::Scene scene = scene_file::read_text(law.scene_text(), law.scene_file());
  std::vector<double> simulated(velocity_ratios().size());
  tbb::parallel_for(std::size_t{0}, simulated.size(), [&](std::size_t i) {
    simulated[i] = vibration_ratio(at_velocity_ratio(scene, velocity_ratios()[i]));
  });
  return simulated;
}

}  // namespace sonoglide::paper
