#include "host_sim/loop/plant/plant_port.hpp"

#include <cmath>
#include <variant>

#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/plant/changing_plant.hpp"
#include "host_sim/loop/plant/plant_description.hpp"
#include "host_sim/scene/solver_methods.hpp"

namespace sonoglide::loop {
namespace {

constexpr double half_turn = 0.5 * numeric::two_pi;

/// By its middle: an end may lie beyond the corner, by a rounding.
bool in_second_half(const Stretch& stretch) {
  return stretch.drive_phase_rad + 0.5 * stretch.drive_rate_rad_per_s * stretch.duration_s >
         half_turn;
}

}  // namespace

DrivePiece drive_piece(const Stretch& stretch) {
  const double amplitude = stretch.drive_amplitude_N;
  const double phase = stretch.drive_phase_rad;
  const bool second = in_second_half(stretch);
  switch (stretch.drive_waveform) {
    case scene::Waveform::square:
      return {second ? -amplitude : amplitude, 0.0, phase};
    case scene::Waveform::triangle:
      return second ? DrivePiece{0.0, amplitude / (0.5 * half_turn), phase - 1.5 * half_turn}
                    : DrivePiece{0.0, -amplitude / (0.5 * half_turn), phase - 0.5 * half_turn};
    case scene::Waveform::sawtooth:
      return {0.0, -amplitude / half_turn, phase - half_turn};
    case scene::Waveform::cosine:
      break;
  }
  return {amplitude, stretch.drive_slope_N_per_rad, phase};
}

double drive_force_N(const Stretch& stretch, double offset_s) {
  const DrivePiece piece = drive_piece(stretch);
  const double phase_rad = piece.phase_rad + stretch.drive_rate_rad_per_s * offset_s;
  const double linear_N = piece.at_zero_N + piece.slope_N_per_rad * phase_rad;
  return stretch.drive_waveform == scene::Waveform::cosine
             ? linear_N * std::cos(phase_rad) + stretch.drive_bias_N
             : linear_N;
}

namespace {

std::unique_ptr<PlantPort> make_unchanging(const scene::Scene& scene) {
  const PlantDescription description(scene);
  return std::visit(
      [&](const auto& law) {
        return scene.load ? make_loaded_plant(description, law) : make_law_plant(description, law);
      },
      configure::acting_law(scene.friction));
}

}  // namespace

std::unique_ptr<PlantPort> make_plant_port(const scene::Scene& scene) {
  if (scene.profile_key() != nullptr || scene.carrier_changes()) {
    return std::make_unique<ChangingPlant>(scene);
  }
  if (scene.solver.method == scene::method_of<scene::solvers::EventGauss> &&
      scene.friction.limit_N() == 0.0) {
    // Without friction event_gauss has nothing to cut at reversals, and event_taylor's one step in a period takes
    // its place.
    scene::Scene acting = scene;
    acting.solver.method = scene::method_of<scene::solvers::EventTaylor>;
    acting.solver.order.reset();
    return make_unchanging(acting);
  }
  return make_unchanging(scene);
}

}  // namespace sonoglide::loop
