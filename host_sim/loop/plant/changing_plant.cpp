#include "host_sim/loop/plant/changing_plant.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "firmware/numeric/turn.hpp"
#include "firmware/plant/state.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/plant/sloping_contact.hpp"
#include "host_sim/scene/solver_facts.hpp"
#include "host_sim/scene/solver_methods.hpp"

namespace sonoglide::loop {
namespace {

/// A piece this part of a carrier period long is next to nothing.
constexpr double shortest = 1e-12;
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

/// Of a piece whose results are `apart` times what is allowed apart: their difference falls with the
/// length to the power of twice the number of parts, less 1.
double shortening(double apart, int parts) {
  return std::clamp(0.9 * std::pow(apart, -1.0 / (2 * parts - 1)), 0.125, 0.5);
}

/// Towards five parts, at which a piece costs the least for its length.
double lengthening(int parts) {
  return parts <= 3 ? 1.6 : parts == 4 ? 1.25 : parts == 5 ? 1.1 : 0.9;
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
  const std::uint64_t events = held_.cost().events;
  const Piece all = scene::is_adaptive(solver_.method)
                        ? adapted(slope, held_.carried(), 0.0, stretch.duration_s, sight)
                        : in_steps(slope, sight);
  energy = all.energy;
  if (all.outcome.error != plant::Error::none) {
    held_.put(all.end);
    return all.outcome;
  }
  arrive(slope, all.end, stretch.duration_s);
  if (sight != nullptr) {
    sight->seen.resize(sight->offsets_s.size(), held_.plant().state());
  }
  tried_events_ += held_.cost().events - events - all.events;
  return {plant::Error::none, stretch.duration_s};
}

/// Of the solver, which takes the values of the middle of each.
ChangingPlant::Piece ChangingPlant::in_steps(const Slope& slope, Sight* sight) {
  const double duration_s = slope.stretch.duration_s;
  const auto count =
      plant::fixed_step_count(duration_s, solver_.step_s, plant::max_steps_per_advance);
  Piece all{0.0, 0.0, held_.carried()};
  if (count > plant::max_steps_per_advance) {
    all.outcome.error = plant::Error::too_many_steps;
  }
  const double length_s = duration_s / count;
  for (std::uint32_t i = 0; i < count && all.outcome.error == plant::Error::none; ++i) {
    const Piece step = taken(slope, all.end, i * length_s, length_s);
    look(slope, all.end, step, sight);
    all = joined(all, step);
  }
  return all;
}

/// The length of each piece follows from how the last one converged.
ChangingPlant::Piece ChangingPlant::adapted(const Slope& slope, const Carried& begin,
                                            double offset_s, double length_s, Sight* sight) {
  const double period_s = numeric::two_pi / scales_.angular_frequency_rad_per_s;
  // What rounding leaves of a stretch is no piece of its own.
  const double rounding_s = std::max(shortest * period_s, 1e-15 * length_s);
  Piece all{offset_s, 0.0, begin};
  double next_s = 0.25 * period_s;
  bool arrived = false;
  while (!arrived && all.outcome.error == plant::Error::none) {
    const double rest_s = length_s - all.length_s;
    const bool is_last = next_s >= rest_s - rounding_s;
    const double tried_s = is_last ? rest_s : next_s;
    const Extrapolated found = extrapolated(slope, all.end, offset_s + all.length_s, tried_s);
    if (!(found.apart <= 1.0) && found.piece.outcome.error == plant::Error::none &&
        tried_s > shortest * period_s) {
      next_s = tried_s * shortening(found.apart, found.parts);
      continue;
    }
    look(slope, all.end, found.piece, sight);
    all = joined(all, found.piece);
    arrived = is_last;
    next_s = std::min(0.25 * period_s, tried_s * lengthening(found.parts));
  }
  return all;
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

/// One after the other, of equal length.
ChangingPlant::Piece ChangingPlant::in_parts(const Slope& slope, const Carried& begin,
                                             double offset_s, double length_s, int parts) {
  const double part_s = length_s / parts;
  Piece all{offset_s, 0.0, begin};
  for (int i = 0; i < parts && all.outcome.error == plant::Error::none; ++i) {
    all = joined(all, taken(slope, all.end, offset_s + i * part_s, part_s));
  }
  return all;
}

/// From 1, 2, 3 ... parts, until two results agree, or are not expected to with most_parts.
ChangingPlant::Extrapolated ChangingPlant::extrapolated(const Slope& slope, const Carried& begin,
                                                        double offset_s, double length_s) {
  Tableau row;
  Extrapolated best{in_parts(slope, begin, offset_s, length_s, 1), 1,
                    std::numeric_limits<double>::infinity()};
  row[0] = best.piece;
  bool ends = false;
  while (!ends && best.parts < most_parts && best.piece.outcome.error == plant::Error::none) {
    const int parts = best.parts + 1;
    const Piece next = in_parts(slope, begin, offset_s, length_s, parts);
    const Piece& newest =
        next.outcome.error == plant::Error::none ? extrapolate(next, parts, row) : next;
    const double apart = difference(best.piece, newest);
    const double expected = apart * std::pow(apart / best.apart, most_parts + 1 - parts);
    ends = parts >= least_parts && (apart <= 1.0 || !(expected <= 1.0));
    best = {newest, parts, apart};
  }
  return best;
}

/// What is to be seen of a piece, each from its beginning on.
void ChangingPlant::look(const Slope& slope, const Carried& begin, const Piece& piece,
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
      at = (scene::is_adaptive(solver_.method)
                ? adapted(beside, begin, piece.offset_s, into_s, nullptr)
                : taken(beside, begin, piece.offset_s, into_s))
               .end;
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
