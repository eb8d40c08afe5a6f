#include "host_sim/studies/paper/recorded_run.hpp"

#include "host_sim/loop/run.hpp"

namespace sonoglide::paper {
namespace {

template <class Of>
std::vector<double> column(const loop::Recording& recording, Of of) {
  std::vector<double> values;
  values.reserve(recording.state.size());
  for (const loop::PlantState& state : recording.state) {
    values.push_back(of(state));
  }
  return values;
}

}  // namespace

loop::Recording record(const scene::Scene& scene, double from_s, double interval_s) {
  loop::Recording recording;
  loop::Watch watch;
  watch.samples.push_back({{from_s, scene.run.duration_s, interval_s}, &recording});
  loop::run(scene, watch);
  return recording;
}

std::vector<double> displacements_m(const loop::Recording& recording) {
  return column(recording, [](const loop::PlantState& state) { return state.displacement_m; });
}

std::vector<double> velocities_m_per_s(const loop::Recording& recording) {
  return column(recording, [](const loop::PlantState& state) { return state.velocity_m_per_s; });
}

std::vector<double> friction_forces_N(const loop::Recording& recording) {
  return column(recording, [](const loop::PlantState& state) { return state.friction_force_N; });
}

std::vector<double> dissipated_powers_W(const loop::Recording& recording) {
  std::vector<double> powers;
  powers.reserve(recording.state.size());
  for (std::size_t i = 0; i < recording.state.size(); ++i) {
    powers.push_back(recording.state[i].friction_force_N *
                     (recording.sliding_velocity_m_per_s[i] + recording.state[i].velocity_m_per_s));
  }
  return powers;
}

}  // namespace sonoglide::paper
