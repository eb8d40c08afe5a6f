#include "host_sim/studies/work_precision/comparison.hpp"

#include <fmt/format.h>

#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/plant/carrier_grid.hpp"
#include "host_sim/scene/names.hpp"

namespace sonoglide::work_precision {
namespace {

using configure::ConfigurationError;

void require_comparable(const scene::Scene& scene) {
  if (scene.controller) {
    throw ConfigurationError(
        "controller", "solvers are compared in open loop; allowed: a scene without [controller]");
  }
  if (scene.run.start != scene::Start::given) {
    throw ConfigurationError("run.start",
                             "the solvers set out from one initial state; allowed: \"given\"");
  }
  if (!scene.drive) {
    throw ConfigurationError(
        "drive", "missing; required: a table [drive], whose period is the unit of work");
  }
  if (scene.drive->waveform != scene::Waveform::cosine) {
    throw ConfigurationError("drive.waveform",
                             "solvers are compared under a cosine; allowed: \"cosine\"");
  }
  if (!scene::is<scene::laws::Dahl>(scene.friction.law)) {
    throw ConfigurationError(
        "friction.law", fmt::format("\"{}\" is not solved by every method here; allowed: \"dahl\"",
                                    scene::name_of(scene.friction.law)));
  }
  if (scene.load) {
    throw ConfigurationError("load",
                             "solvers are compared at a sliding velocity that is given; "
                             "required: a table [sliding] in its place");
  }
  if (const char* key = scene.profile_key()) {
    throw ConfigurationError(
        key,
        "solvers are compared on a plant and a drive that do not change; allowed: "
        "a constant value in place of a profile");
  }
  if (!(scene.friction.limit_N() > 0.0)) {
    throw ConfigurationError("friction.coefficient",
                             "without a friction force there is no friction ratio to compare; "
                             "allowed: coefficient and normal_force_N above 0");
  }
  if (scene.sliding.profile.size() != 1) {
    throw ConfigurationError("sliding.profile",
                             "solvers are compared at a constant sliding velocity; allowed: "
                             "velocity_m_per_s");
  }
}

int whole_periods(const scene::Scene& scene) {
  const auto whole = loop::CarrierGrid(scene).whole_periods(scene.run.duration_s);
  if (!whole || *whole < 1 || *whole > most_periods) {
    throw ConfigurationError(
        "run",
        fmt::format("lasts {:.12g} carrier periods; allowed: a whole number of them, 1 to {}",
                    scene.run.duration_s * scene.drive->frequency_Hz, most_periods));
  }
  return static_cast<int>(*whole);
}

}  // namespace

peers::Problem problem_of(const scene::Scene& scene) {
  require_comparable(scene);
  const scene::PlantScales scales = configure::plant_scales(scene);
  const configure::PlantNumbers numbers = configure::plant_numbers(scene, scales);
  const plant::State<double> initial = configure::initial_state(scene, scales);
  peers::Problem problem{};
  problem.stiffness = numbers.stiffness;
  problem.damping = numbers.damping;
  problem.friction_force = numbers.friction_force;
  problem.contact_stiffness = numbers.contact_stiffness;
  problem.vibration_sign = configure::vibration_sign(scene.friction.sign_convention);
  problem.drive_amplitude = scene.drive_force_N() / scales.force_N;
  problem.sliding_velocity = scene.sliding.profile[0].velocity_m_per_s / scales.velocity_m_per_s();
  problem.displacement = initial.displacement;
  problem.velocity = initial.velocity;
  problem.friction = initial.friction;
  problem.periods = whole_periods(scene);
  return problem;
}

}  // namespace sonoglide::work_precision
