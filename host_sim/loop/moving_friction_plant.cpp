#include "host_sim/loop/moving_friction_plant.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "firmware/numeric/turn.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/configure/solver_methods.hpp"

namespace sonoglide::loop {
namespace {

/// Of the drive, of the natural mode or of a stuck contact, the shortest.
double shortest_period_s(const scene::Scene& scene) {
  const double stiffness_N_per_m =
      std::max(scene.plant.stiffness_N_per_m, scene.friction.contact_stiffness_N_per_m);
  return numeric::two_pi / std::max(configure::plant_scales(scene).angular_frequency_rad_per_s,
                                    std::sqrt(stiffness_N_per_m / scene.plant.mass_kg));
}

/// The scene with the friction that it has at 0 s.
scene::Scene held(scene::Scene scene) {
  scene.friction.coefficient_profile.clear();
  scene.friction.normal_force_profile_N.clear();
  return scene;
}

/// What event_gauss leaves to event_taylor anyhow, but without making tables for whole periods.
scene::SolverMethod method_of_pieces(scene::SolverMethod asked) {
  return asked == configure::method_of<configure::solvers::EventGauss>
             ? configure::method_of<configure::solvers::EventTaylor>
             : asked;
}

/// A part of a stretch.
Stretch part_of(const Stretch& stretch, double offset_s, double duration_s) {
  Stretch part = stretch;
  part.duration_s = duration_s;
  part.drive_phase_rad += stretch.drive_rate_rad_per_s * offset_s;
  part.sliding_velocity_m_per_s += stretch.sliding_acceleration_m_per_s2 * offset_s;
  part.begin_s += offset_s;
  return part;
}

double middle_s(const Stretch& stretch) {
  return stretch.begin_s + 0.5 * stretch.duration_s;
}

/// What becomes of the forces that begin a piece at the limit of its middle.
struct Descent {
  bool leaves = false;  ///< one of them falls by more than the limit
  double lost = 0.0;    ///< by all of them, in parts of their limits
};

/// @param before, after  parts of the limits, at the beginning of the piece and at its end
/// @param fall           of the limit, over the piece, in parts of itself
Descent descent(const std::vector<double>& before, const std::vector<double>& after,
                const std::vector<double>& limits_N, double fall) {
  constexpr double rounding = 1e-12;
  Descent all;
  double lost_N = 0.0;
  double most_N = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (std::abs(before[i]) >= 1.0 - rounding) {
      all.leaves = all.leaves || std::abs(after[i]) < 1.0 - fall - rounding;
      lost_N += (1.0 - std::abs(after[i])) * limits_N[i];
      most_N += limits_N[i];
    }
  }
  all.lost = most_N > 0.0 ? lost_N / most_N : 0.0;
  return all;
}

}  // namespace

MovingFrictionPlant::MovingFrictionPlant(const scene::Scene& scene)
    : friction_(scene.friction),
      scene_(held(scene)),
      asked_method_(scene.solver.method),
      method_(scene.solver.method),
      reversing_s_(shortest_period_s(scene)),
      held_(make_plant_port(scene_)) {}

plant::Outcome<double> MovingFrictionPlant::advance_sampled(const Stretch& stretch,
                                                            const std::vector<double>& offsets_s,
                                                            EnergyBalance& energy,
                                                            std::vector<PlantState>& seen) {
  Sight sight{offsets_s, seen, stretch.begin_s};
  return follow(stretch, &sight, energy);
}

plant::Cost MovingFrictionPlant::cost() const {
  const plant::Cost now = held_->cost();
  return {spent_.steps + now.steps, spent_.events + now.events};
}

/// @param sight  null where nothing is wanted
plant::Outcome<double> MovingFrictionPlant::follow(const Stretch& stretch, Sight* sight,
                                                   EnergyBalance& energy) {
  const double per_period = pieces_per_period(stretch);
  method_ = per_period > 0.0 ? method_of_pieces(asked_method_) : asked_method_;
  const double count = std::max(1.0, std::ceil(per_period * stretch.duration_s / reversing_s_));
  const int halvings =
      per_period > 0.0 ? static_cast<int>(std::ceil(std::log2(2.0 * per_period))) : 0;
  const double length_s = stretch.duration_s / count;
  energy = EnergyBalance();
  for (double i = 0.0; i < count; ++i) {
    const double offset_s = i * length_s;
    EnergyBalance part;
    plant::Outcome<double> outcome = follow_piece(part_of(stretch, offset_s, length_s), carried(),
                                                  halvings, i + 1.0 == count, sight, part);
    energy.append(part);
    if (outcome.error != plant::Error::none) {
      outcome.offset += offset_s;
      return outcome;
    }
  }
  return {plant::Error::none, stretch.duration_s};
}

/// @param begin  where it sets out, which a lower limit of before may have cut
/// @param last   of the stretch
plant::Outcome<double> MovingFrictionPlant::follow_piece(const Stretch& piece, const Carried& begin,
                                                         int halvings, bool last, Sight* sight,
                                                         EnergyBalance& energy) {
  const scene::ContactValues contact = configure::contact_at(friction_, middle_s(piece));
  hold(contact, begin);
  if (halvings <= 0) {
    return hold_piece(piece, last, sight, energy);
  }
  const std::vector<double> memory = held_->memory();
  const plant::Outcome<double> tried = hold_piece(piece, last, nullptr, energy);
  // Of the line that holds in the middle: at its end the limit may jump.
  const double fall =
      2.0 * (configure::contact_at(friction_, piece.begin_s).limit_N() / contact.limit_N() - 1.0);
  const Descent found = descent(memory, held_->memory(), held_->memory_limits_N(), fall);
  if (tried.error != plant::Error::none ||
      (!found.leaves && found.lost == 0.0 && sight == nullptr)) {
    return tried;
  }
  if (!found.leaves) {
    scene::ContactValues raised = contact;
    raised.coefficient *= 1.0 + 0.5 * found.lost;
    hold(raised, begin);
    put(begin);
    return hold_piece(piece, last, sight, energy);
  }
  const double half_s = 0.5 * piece.duration_s;
  energy = EnergyBalance();
  plant::Outcome<double> outcome =
      follow_piece(part_of(piece, 0.0, half_s), begin, halvings - 1, false, sight, energy);
  if (outcome.error == plant::Error::none) {
    EnergyBalance second;
    outcome =
        follow_piece(part_of(piece, half_s, half_s), carried(), halvings - 1, last, sight, second);
    energy.append(second);
    outcome.offset += half_s;
  }
  return outcome;
}

/// Under the limit that is held.
plant::Outcome<double> MovingFrictionPlant::hold_piece(const Stretch& piece, bool last,
                                                       Sight* sight, EnergyBalance& energy) {
  time_s_ = piece.begin_s + piece.duration_s;
  if (sight == nullptr) {
    return held_->advance(piece, energy);
  }
  const double from_s = piece.begin_s - sight->begin_s;
  std::vector<double> offsets_s;
  for (; sight->next < sight->offsets_s.size(); ++sight->next) {
    const double offset_s = sight->offsets_s[sight->next] - from_s;
    if (!last && offset_s >= piece.duration_s) {
      break;
    }
    offsets_s.push_back(std::clamp(offset_s, 0.0, piece.duration_s));
  }
  const std::size_t before = sight->seen.size();
  const auto outcome = held_->advance_sampled(piece, offsets_s, energy, sight->seen);
  for (std::size_t i = before; i < sight->seen.size(); ++i) {
    sight->seen[i] = within_limit(sight->seen[i], piece.begin_s + offsets_s[i - before]);
  }
  return outcome;
}

double MovingFrictionPlant::pieces_per_period(const Stretch& stretch) const {
  const double time_s = middle_s(stretch);
  const double slope_per_s = relative_slope_per_s(friction_.coefficient_profile, time_s) +
                             relative_slope_per_s(friction_.normal_force_profile_N, time_s);
  return std::sqrt(slope_per_s * reversing_s_ / largest_ratio_error);
}

MovingFrictionPlant::Carried MovingFrictionPlant::carried() const {
  Carried now{held_->state(), held_->memory()};
  const std::vector<double> limits_N = held_->memory_limits_N();
  for (std::size_t i = 0; i < limits_N.size(); ++i) {
    now.forces_N[i] *= limits_N[i];
  }
  return now;
}

/// The contact's forces as far as the limits let them.
void MovingFrictionPlant::put(const Carried& from) {
  const double limit_N = scene_.friction.limit_N();
  PlantState state = from.state;
  state.friction_force_N = std::clamp(state.friction_force_N, -limit_N, limit_N);
  // The limits of some depend on the displacement, which therefore goes first.
  std::vector<double> parts(held_->memory().size(), 0.0);
  held_->begin_at(state, parts);
  const std::vector<double> limits_N = held_->memory_limits_N();
  for (std::size_t i = 0; i < std::min(parts.size(), from.forces_N.size()); ++i) {
    parts[i] = limits_N[i] > 0.0 ? std::clamp(from.forces_N[i] / limits_N[i], -1.0, 1.0) : 0.0;
  }
  held_->begin_at(state, parts);
}

void MovingFrictionPlant::hold(const scene::ContactValues& contact, const Carried& from) {
  if (contact.coefficient != scene_.friction.coefficient ||
      contact.normal_force_N != scene_.friction.normal_force_N || method_ != scene_.solver.method) {
    spent_ = cost();
    scene_.solver.method = method_;
    scene_.friction.coefficient = contact.coefficient;
    scene_.friction.normal_force_N = contact.normal_force_N;
    held_ = make_plant_port(scene_);
    put(from);
  }
}

/// What the limit of a piece's middle leaves above that of the moment.
PlantState MovingFrictionPlant::within_limit(PlantState state, double time_s) const {
  if (scene::is_bounded(friction_.law)) {
    const double limit_N = configure::contact_at(friction_, time_s).limit_N();
    state.friction_force_N = std::clamp(state.friction_force_N, -limit_N, limit_N);
  }
  return state;
}

}  // namespace sonoglide::loop
