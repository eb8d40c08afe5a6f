#include "host_sim/loop/plant/changing_plant.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "firmware/numeric/turn.hpp"
#include "firmware/plant/state.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/plant/sloping_contact.hpp"
#include "host_sim/scene/solver_facts.hpp"
#include "host_sim/scene/solver_methods.hpp"

namespace sonoglide::loop {
namespace {

/// Part of the solver's tolerance within which the whole of a piece and its halves agree; what one
/// carrier period collects in its pieces then stays below the tolerance.
constexpr double share_of_tolerance = 1.0 / 16.0;
/// 2^-40 of a quarter of a carrier period, which the longest pieces are, is next to nothing.
constexpr int most_halvings = 40;
/// A friction force is seen this part of a carrier period after the instant.
constexpr double glance = 1e-12;

constexpr scene::SolverMethod event_taylor = scene::method_of<scene::solvers::EventTaylor>;

/// Tables of event_gauss for one carrier period are not worth making.
scene::SolverMethod method_of_period(scene::SolverMethod asked) {
  return asked == scene::method_of<scene::solvers::EventGauss> ? event_taylor : asked;
}

/// The results of pieces can be compared where a tolerance bounds their error.
scene::SolverMethod method_of_pieces(scene::SolverMethod asked) {
  return scene::is_adaptive(asked) ? event_taylor : asked;
}

Stretch part_of(const Stretch& stretch, double offset_s, double duration_s) {
  Stretch part = stretch;
  part.duration_s = duration_s;
  part.drive_phase_rad += stretch.drive_rate_rad_per_s * offset_s;
  part.sliding_velocity_m_per_s += stretch.sliding_acceleration_m_per_s2 * offset_s;
  part.begin_s += offset_s;
  return part;
}

}  // namespace

/// What comes after `first` is `second`.
ChangingPlant::Piece ChangingPlant::joined(const Piece& first, const Piece& second) {
  Piece both = second;
  both.offset_s = first.offset_s;
  both.length_s += first.length_s;
  both.energy = first.energy;
  both.energy.append(second.energy);
  both.events += first.events;
  return both;
}

/// fine + part (fine - coarse)
void ChangingPlant::extrapolate(const Piece& coarse, double part, Piece& fine) {
  const auto move = [part](double from, double& to) { to += part * (to - from); };
  move(coarse.end.state.displacement_m, fine.end.state.displacement_m);
  move(coarse.end.state.velocity_m_per_s, fine.end.state.velocity_m_per_s);
  for (std::size_t i = 0; i < coarse.end.forces_N.size(); ++i) {
    move(coarse.end.forces_N[i], fine.end.forces_N[i]);
  }
  const double duration_s = fine.energy.duration_s;
  fine.energy.add(fine.energy, part);
  fine.energy.add(coarse.energy, -part);
  fine.energy.duration_s = duration_s;
}

ChangingPlant::ChangingPlant(const scene::Scene& scene)
    : friction_(scene.friction),
      plant_(scene.plant),
      solver_(scene.solver),
      scales_(configure::plant_scales(scene)),
      largest_limit_N_(scene.friction.largest_limit_N()),
      spring_(scene),
      drive_rate_rad_per_s_(scene.drive ? numeric::two_pi * scene.drive->frequency_Hz : 0.0),
      held_(scene) {}

void ChangingPlant::save(SnapshotWriter& state) const {
  state.put(drive_rate_rad_per_s_);
  state.put(tried_events_);
  spring_.save(state);
  held_.save(state);
}

void ChangingPlant::restore(SnapshotReader& state) {
  state.get(drive_rate_rad_per_s_);
  state.get(tried_events_);
  spring_.restore(state);
  held_.restore(state);
}

plant::Cost ChangingPlant::cost() const {
  const plant::Cost all = held_.cost();
  return {all.steps, all.events - tried_events_};
}

/// @param sight  null where nothing is wanted
plant::Outcome<double> ChangingPlant::follow(const Stretch& stretch, Sight* sight,
                                             EnergyBalance& energy) {
  const double duration_s = stretch.duration_s;
  const Course course{
      duration_s,
      line_over(plant_.stiffness_profile, plant_.stiffness_N_per_m, stretch.begin_s, duration_s),
      line_over(friction_.coefficient_profile, friction_.coefficient, stretch.begin_s, duration_s),
      line_over(friction_.normal_force_profile_N, friction_.normal_force_N, stretch.begin_s,
                duration_s)};
  const PlantState begin = held_.plant().state();
  const plant::Outcome<double> outcome = course.slopes()
                                             ? follow_slope(stretch, course, sight, energy)
                                             : hold_throughout(stretch, course, sight, energy);
  drive_rate_rad_per_s_ = stretch.drive_rate_rad_per_s;
  if (outcome.error == plant::Error::none) {
    spring_.settle(course, begin, held_.plant().state(), energy);
  }
  return outcome;
}

plant::Outcome<double> ChangingPlant::hold_throughout(const Stretch& stretch, const Course& course,
                                                      Sight* sight, EnergyBalance& energy) {
  const bool new_carrier = stretch.drive_rate_rad_per_s != drive_rate_rad_per_s_;
  // NOLINTNEXTLINE(cppcoreguidelines-slicing): the values alone are meant
  held_.hold({course.contact_at(0.5 * course.duration_s, friction_),
              course.stiffness_N_per_m.middle, stretch.drive_rate_rad_per_s,
              new_carrier ? method_of_period(solver_.method) : solver_.method, solver_.tolerance},
             held_.carried());
  return sight == nullptr
             ? held_.plant().advance(stretch, energy)
             : held_.plant().advance_sampled(stretch, sight->offsets_s, energy, sight->seen);
}

plant::Outcome<double> ChangingPlant::follow_slope(const Stretch& stretch, const Course& course,
                                                   Sight* sight, EnergyBalance& energy) {
  const Slope slope{stretch, course};
  const bool adaptive = scene::is_adaptive(solver_.method);
  const double quarter_s = 0.25 * numeric::two_pi / scales_.angular_frequency_rad_per_s;
  const auto count = plant::fixed_step_count(
      stretch.duration_s, adaptive ? quarter_s : solver_.step_s, plant::max_steps_per_advance);
  if (count > plant::max_steps_per_advance) {
    return {plant::Error::too_many_steps, 0.0};
  }
  const double length_s = stretch.duration_s / count;
  const std::uint64_t events = held_.cost().events;
  std::uint64_t real_events = 0;
  Carried now = held_.carried();
  energy = EnergyBalance();
  for (std::uint32_t i = 0; i < count; ++i) {
    const Piece whole = taken(slope, now, i * length_s, length_s);
    const Piece piece =
        adaptive ? refined(slope, now, doubled(slope, now, whole), most_halvings, sight) : whole;
    if (!adaptive) {
      look(slope, now, whole, 0, sight);
    }
    energy.append(piece.energy);
    real_events += piece.events;
    now = piece.end;
    if (piece.outcome.error != plant::Error::none) {
      held_.put(now);
      return piece.outcome;
    }
  }
  arrive(slope, now, stretch.duration_s);
  if (sight != nullptr) {
    sight->seen.resize(sight->offsets_s.size(), held_.plant().state());
  }
  tried_events_ += held_.cost().events - events - real_events;
  return {plant::Error::none, stretch.duration_s};
}

/// The values of its middle.
ChangingPlant::Piece ChangingPlant::taken(const Slope& slope, const Carried& begin, double offset_s,
                                          double length_s) {
  const Stretch part = part_of(slope.stretch, offset_s, length_s);
  const Held middle = values(slope, offset_s + 0.5 * length_s);
  held_.begin(middle, begin);
  SlopingContact contact(
      friction_, plant_.mass_kg,
      {values(slope, offset_s).contact, middle.contact, values(slope, offset_s + length_s).contact},
      part);
  contact.set_out(begin, held_.plant());
  Piece piece{offset_s, length_s};
  const std::uint64_t events = held_.cost().events;
  piece.outcome = held_.plant().advance(part, piece.energy);
  piece.events = held_.cost().events - events;
  piece.outcome.offset += offset_s;
  piece.end = contact.arrive(begin.state, held_.plant(), piece.energy);
  return piece;
}

/// Of fourth order: once whole and once in halves.
/// @param whole  from the same beginning
ChangingPlant::Doubled ChangingPlant::doubled(const Slope& slope, const Carried& begin,
                                              const Piece& whole) {
  Doubled both{whole, whole};
  if (whole.outcome.error != plant::Error::none) {
    return both;
  }
  const double half_s = 0.5 * whole.length_s;
  both.first_half = taken(slope, begin, whole.offset_s, half_s);
  both.piece =
      joined(both.first_half, taken(slope, both.first_half.end, whole.offset_s + half_s, half_s));
  if (both.piece.outcome.error == plant::Error::none) {
    extrapolate(whole, 1.0 / 3.0, both.piece);
  }
  return both;
}

/// @param coarse    from the same beginning
/// @param halvings  at most
ChangingPlant::Piece ChangingPlant::refined(const Slope& slope, const Carried& begin,
                                            const Doubled& coarse, int halvings, Sight* sight) {
  if (halvings == 0 || coarse.piece.outcome.error != plant::Error::none) {
    look(slope, begin, coarse.piece, halvings, sight);
    return coarse.piece;
  }
  const double half_s = 0.5 * coarse.piece.length_s;
  const double middle_s = coarse.piece.offset_s + half_s;
  const auto second_half = [&](const Carried& middle) {
    return doubled(slope, middle, taken(slope, middle, middle_s, half_s));
  };
  const Doubled first = doubled(slope, begin, coarse.first_half);
  Piece fine = joined(first.piece, second_half(first.piece.end).piece);
  if (fine.outcome.error == plant::Error::none && agree(coarse.piece, fine)) {
    look(slope, begin, coarse.piece, halvings, sight);
    extrapolate(coarse.piece, 1.0 / 15.0, fine);
    return fine;
  }
  const Piece left = refined(slope, begin, first, halvings - 1, sight);
  return left.outcome.error != plant::Error::none
             ? left
             : joined(left, refined(slope, left.end, second_half(left.end), halvings - 1, sight));
}

/// Each number relative to the size that the motion, the friction or a period's impulse has.
bool ChangingPlant::agree(const Piece& coarse, const Piece& fine) const {
  constexpr double rounding = 1e-12;
  const double allowed = std::max(rounding, share_of_tolerance * solver_.tolerance);
  const auto near = [allowed](double one, double other, double size) {
    return std::abs(one - other) <= allowed * size + 4e-16 * std::abs(one);
  };
  const PlantState& one = coarse.end.state;
  const PlantState& other = fine.end.state;
  const double omega = scales_.angular_frequency_rad_per_s;
  const double velocity_m_per_s =
      std::max(scales_.velocity_m_per_s(), std::abs(one.velocity_m_per_s));
  if (!near(one.velocity_m_per_s, other.velocity_m_per_s, velocity_m_per_s) ||
      !near(one.displacement_m, other.displacement_m, velocity_m_per_s / omega) ||
      !near(coarse.energy.friction_impulse_N_s, fine.energy.friction_impulse_N_s,
            largest_limit_N_ * numeric::two_pi / omega)) {
    return false;
  }
  return std::equal(coarse.end.forces_N.begin(), coarse.end.forces_N.end(),
                    fine.end.forces_N.begin(), fine.end.forces_N.end(),
                    [&](double a, double b) { return near(a, b, largest_limit_N_); });
}

/// What is to be seen of a piece, each from its beginning on.
void ChangingPlant::look(const Slope& slope, const Carried& begin, const Piece& piece, int halvings,
                         Sight* sight) {
  if (sight == nullptr) {
    return;
  }
  const plant::Cost cost = held_.cost();
  Stretch unmetered = slope.stretch;
  unmetered.meter = nullptr;
  const Slope beside{unmetered, slope.course};
  while (sight->seen.size() < sight->offsets_s.size()) {
    const double offset_s = sight->offsets_s[sight->seen.size()];
    const double into_s = offset_s - piece.offset_s;
    if (into_s >= piece.length_s) {
      break;
    }
    Carried at = begin;
    if (into_s > 0.0) {
      const Piece whole = taken(beside, begin, piece.offset_s, into_s);
      at = halvings == 0
               ? whole.end
               : refined(beside, begin, doubled(beside, begin, whole), halvings, nullptr).end;
    }
    arrive(beside, at, offset_s);
    sight->seen.push_back(held_.plant().state());
  }
  held_.set_cost(cost);
}

/// Holds the values of an instant, with the friction force that acts there.
void ChangingPlant::arrive(const Slope& slope, const Carried& at, double offset_s) {
  held_.begin(values(slope, offset_s), at);
  const double instant_s = glance * numeric::two_pi / scales_.angular_frequency_rad_per_s;
  EnergyBalance unused;
  held_.plant().advance(part_of(slope.stretch, offset_s, instant_s), unused);
  Carried seen = at;
  seen.state.friction_force_N = held_.plant().state().friction_force_N;
  held_.begin(values(slope, offset_s), seen);
}

Held ChangingPlant::values(const Slope& slope, double offset_s) const {
  // NOLINTNEXTLINE(cppcoreguidelines-slicing): likewise
  return {slope.course.contact_at(offset_s, friction_), slope.course.stiffness_at(offset_s),
          slope.stretch.drive_rate_rad_per_s, method_of_pieces(solver_.method),
          share_of_tolerance * solver_.tolerance};
}

}  // namespace sonoglide::loop
