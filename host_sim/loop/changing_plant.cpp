#include "host_sim/loop/changing_plant.hpp"

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

ChangingPlant::ChangingPlant(const scene::Scene& scene)
    : friction_(scene.friction),
      spring_(scene),
      asked_method_(scene.solver.method),
      reversing_s_(shortest_period_s(scene)),
      drive_rate_rad_per_s_(scene.drive ? numeric::two_pi * scene.drive->frequency_Hz : 0.0),
      held_(scene) {}

void ChangingPlant::save(SnapshotWriter& state) const {
  state.put(drive_rate_rad_per_s_);
  state.put(time_s_);
  spring_.save(state);
  held_.save(state);
}

void ChangingPlant::restore(SnapshotReader& state) {
  state.get(drive_rate_rad_per_s_);
  state.get(time_s_);
  spring_.restore(state);
  held_.restore(state);
}

plant::Outcome<double> ChangingPlant::advance_sampled(const Stretch& stretch,
                                                      const std::vector<double>& offsets_s,
                                                      EnergyBalance& energy,
                                                      std::vector<PlantState>& seen) {
  Sight sight{offsets_s, seen, stretch.begin_s};
  return follow(stretch, &sight, energy);
}

/// @param sight  null where nothing is wanted
plant::Outcome<double> ChangingPlant::follow(const Stretch& stretch, Sight* sight,
                                             EnergyBalance& energy) {
  const ChangingSpring::Line spring = spring_.over(stretch);
  const double of_spring = spring_.pieces(stretch, spring);
  const double per_period = friction_pieces_per_period(stretch);
  const double of_friction = std::ceil(per_period * stretch.duration_s / reversing_s_);
  const bool changes =
      of_spring > 0.0 || of_friction > 0.0 || stretch.drive_rate_rad_per_s != drive_rate_rad_per_s_;
  drive_rate_rad_per_s_ = stretch.drive_rate_rad_per_s;
  const double count = of_spring > 0.0 ? 2.0 * std::ceil(0.5 * std::max(of_spring, of_friction))
                                       : std::max(1.0, of_friction);
  const int halvings =
      per_period > 0.0 ? static_cast<int>(std::ceil(std::log2(2.0 * per_period))) : 0;
  const double begin_m = held_.plant().state().displacement_m;
  const double length_s = stretch.duration_s / count;
  energy = EnergyBalance();
  for (double i = 0.0; i < count; ++i) {
    const double offset_s = i * length_s;
    const Piece piece{part_of(stretch, offset_s, length_s),
                      of_spring > 0.0 ? ChangingSpring::held_N_per_m(stretch, spring, i, count)
                                      : spring.middle_N_per_m,
                      changes ? method_of_pieces(asked_method_) : asked_method_, i + 1.0 == count};
    EnergyBalance part;
    plant::Outcome<double> outcome = follow_friction(piece, held_.carried(), halvings, sight, part);
    energy.append(part);
    if (outcome.error != plant::Error::none) {
      outcome.offset += offset_s;
      return outcome;
    }
  }
  spring_.settle(stretch, spring, count, begin_m, held_.plant().state().displacement_m, energy);
  return {plant::Error::none, stretch.duration_s};
}

/// @param begin  where it sets out, which a lower limit of before may have cut
plant::Outcome<double> ChangingPlant::follow_friction(const Piece& piece,
                                                      const HeldPlant::Carried& begin, int halvings,
                                                      Sight* sight, EnergyBalance& energy) {
  const Stretch& stretch = piece.stretch;
  const scene::ContactValues contact = configure::contact_at(friction_, middle_s(stretch));
  hold(piece, contact, begin);
  if (halvings <= 0) {
    return advance_piece(piece, sight, energy);
  }
  const std::vector<double> memory = held_.plant().memory();
  const plant::Outcome<double> tried = advance_piece(piece, nullptr, energy);
  // Of the line that holds in the middle: at its end the limit may jump.
  const double fall =
      2.0 * (configure::contact_at(friction_, stretch.begin_s).limit_N() / contact.limit_N() - 1.0);
  const Descent found =
      descent(memory, held_.plant().memory(), held_.plant().memory_limits_N(), fall);
  if (tried.error != plant::Error::none ||
      (!found.leaves && found.lost == 0.0 && sight == nullptr)) {
    return tried;
  }
  if (!found.leaves) {
    scene::ContactValues raised = contact;
    raised.coefficient *= 1.0 + 0.5 * found.lost;
    hold(piece, raised, begin);
    held_.put(begin);
    return advance_piece(piece, sight, energy);
  }
  return halve(piece, begin, halvings - 1, sight, energy);
}

plant::Outcome<double> ChangingPlant::halve(const Piece& piece, const HeldPlant::Carried& begin,
                                            int halvings, Sight* sight, EnergyBalance& energy) {
  const double half_s = 0.5 * piece.stretch.duration_s;
  const auto half = [&](double offset_s, bool last) {
    return Piece{part_of(piece.stretch, offset_s, half_s), piece.stiffness_N_per_m, piece.method,
                 last};
  };
  energy = EnergyBalance();
  plant::Outcome<double> outcome =
      follow_friction(half(0.0, false), begin, halvings, sight, energy);
  if (outcome.error == plant::Error::none) {
    EnergyBalance second;
    outcome = follow_friction(half(half_s, piece.last), held_.carried(), halvings, sight, second);
    energy.append(second);
    outcome.offset += half_s;
  }
  return outcome;
}

void ChangingPlant::hold(const Piece& piece, const scene::ContactValues& contact,
                         const HeldPlant::Carried& from) {
  held_.hold({contact, piece.stiffness_N_per_m, piece.stretch.drive_rate_rad_per_s, piece.method},
             from);
}

/// Under what is held.
plant::Outcome<double> ChangingPlant::advance_piece(const Piece& piece, Sight* sight,
                                                    EnergyBalance& energy) {
  const Stretch& stretch = piece.stretch;
  time_s_ = stretch.begin_s + stretch.duration_s;
  if (sight == nullptr) {
    return held_.plant().advance(stretch, energy);
  }
  const double from_s = stretch.begin_s - sight->begin_s;
  std::vector<double> offsets_s;
  for (; sight->next < sight->offsets_s.size(); ++sight->next) {
    const double offset_s = sight->offsets_s[sight->next] - from_s;
    if (!piece.last && offset_s >= stretch.duration_s) {
      break;
    }
    offsets_s.push_back(std::clamp(offset_s, 0.0, stretch.duration_s));
  }
  const std::size_t before = sight->seen.size();
  const auto outcome = held_.plant().advance_sampled(stretch, offsets_s, energy, sight->seen);
  for (std::size_t i = before; i < sight->seen.size(); ++i) {
    sight->seen[i] = within_limit(sight->seen[i], stretch.begin_s + offsets_s[i - before]);
  }
  return outcome;
}

double ChangingPlant::friction_pieces_per_period(const Stretch& stretch) const {
  const double time_s = middle_s(stretch);
  const double slope_per_s = relative_slope_per_s(friction_.coefficient_profile, time_s) +
                             relative_slope_per_s(friction_.normal_force_profile_N, time_s);
  return std::sqrt(slope_per_s * reversing_s_ / largest_ratio_error);
}

/// What the limit of a piece's middle leaves above that of the moment.
PlantState ChangingPlant::within_limit(PlantState state, double time_s) const {
  if (scene::is_bounded(friction_.law)) {
    const double limit_N = configure::contact_at(friction_, time_s).limit_N();
    state.friction_force_N = std::clamp(state.friction_force_N, -limit_N, limit_N);
  }
  return state;
}

}  // namespace sonoglide::loop
