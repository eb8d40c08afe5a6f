#include "host_sim/loop/plant/changing_plant.hpp"

#include "firmware/numeric/turn.hpp"
#include "firmware/plant/state.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/plant/sloping_contact.hpp"
#include "host_sim/scene/solver_facts.hpp"
#include "host_sim/scene/solver_methods.hpp"

namespace sonoglide::loop {
namespace {

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

double elastic_J(double stiffness_N_per_m, double displacement_m) {
  return 0.5 * stiffness_N_per_m * displacement_m * displacement_m;
}

}  // namespace

void ChangingSpring::settle(const Course& course, const PlantState& begin, const PlantState& end,
                            EnergyBalance& energy) {
  const Line& stiffness_N_per_m = course.stiffness_N_per_m;
  const double duration_s = course.duration_s;
  const double first_N_per_m = stiffness_N_per_m.at(-0.5 * duration_s);
  const double last_N_per_m = stiffness_N_per_m.at(0.5 * duration_s);
  const double jump_J = elastic_J(first_N_per_m - reached_N_per_m_, begin.displacement_m);
  if (course.slopes()) {
    const auto stored_J = [this](double stiffness, const PlantState& state) {
      return 0.5 * mass_kg_ * state.velocity_m_per_s * state.velocity_m_per_s +
             elastic_J(stiffness, state.displacement_m);
    };
    energy.stored_begin_J = stored_J(first_N_per_m, begin);
    energy.stored_end_J = stored_J(last_N_per_m, end);
  }
  energy.stored_begin_J -= jump_J;
  energy.spring_work_J =
      jump_J + 0.5 * stiffness_N_per_m.slope_per_s * energy.displacement_square_m2_s;
  reached_N_per_m_ = last_N_per_m;
}

ChangingPlant::ChangingPlant(const scene::Scene& scene)
    : friction_(scene.friction),
      plant_(scene.plant),
      solver_(scene.solver),
      scales_(configure::plant_scales(scene)),
      largest_limit_N_(scene.friction.largest_limit_N()),
      spring_(scene),
      drive_rate_rad_per_s_(scene.drive ? scene.drive->rate_rad_per_s() : 0.0),
      held_(scene) {}

void ChangingPlant::copy_state(StateCopy& copy) {
  copy(drive_rate_rad_per_s_, tried_events_);
  spring_.copy_state(copy);
  held_.copy_state(copy);
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
