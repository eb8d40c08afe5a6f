/// The loop by hand of the Taylor series, order 16.
#pragma once

#include <cstdint>
#include <utility>

#include "cost_by_hand.hpp"
#include "cost_by_hand_dahl.hpp"
#include "cost_by_hand_reversals.hpp"
#include "cost_by_hand_series.hpp"
#include "cost_scene.hpp"

namespace sonoglide::cost::by_hand {

[[gnu::always_inline]] inline void add_term(Series& s, const Scene& scene, const Arc& arc,
                                            std::size_t n, const Named& named) {
  if (named.law == Law::dahl && n > 0) {
    add_friction(s, arc, n);
  }
  s.travel[n + 1] = free_term(s, scene, n, named.driven, named.damped);
  // Coulomb friction is a constant: it acts on the first term alone.
  if (named.law == Law::dahl || (named.law == Law::coulomb && n == 0)) {
    const double coupling =
        (1.0 / static_cast<double>(n + 1)) * (scene.friction_force * (s.unit * s.unit));
    s.travel[n + 1] -= coupling * s.friction[n];
  }
}

template <std::size_t... n>
[[gnu::always_inline]] inline void expand(Series& s, const Scene& scene, const Arc& arc,
                                          const Named& named, std::index_sequence<n...> /*terms*/) {
  s.friction[0] = arc.friction;
  (add_term(s, scene, arc, n, named), ...);
  close_shift(s);
}

/// Which way the contact slides in the step that begins, its friction being that of the state.
[[gnu::always_inline]] inline Direction direction_of(const Result& state, const Scene& scene,
                                                     const Phasor& drive, double offset,
                                                     double velocity, const Named& named) {
  if (velocity != 0.0) {
    return {velocity > 0.0 ? 1.0 : -1.0, 0};
  }
  const bool held = named.law == Law::coulomb;
  return direction_from_rest(state, scene, drive, offset, held ? 0.0 : state.friction,
                             held ? scene.friction_force : 0.0, named.driven, named.damped);
}

/// What the vibration reaches in a step is known once the step is: where that is far less than in a
/// unit, a second pass.
[[gnu::always_inline]] inline double allowed_extent(const Series& s, const Scene& scene,
                                                    double longest, double remaining,
                                                    const Named& named) {
  const double rounding = epsilon * numeric::abs(s.velocity);
  const auto extent_at = [&](double speed) __attribute__((always_inline)) {
    double last = numeric::abs(s.rate * s.travel[order + 1]);
    double last_but_one = numeric::abs(s.rate * s.travel[order]);
    if (named.law == Law::dahl) {
      const double weight = numeric::clamp(scene.friction_force, 1e-3, 0.125);
      last = numeric::max(last, speed * weight * numeric::abs(s.friction[order]));
      last_but_one =
          numeric::max(last_but_one, speed * weight * numeric::abs(s.friction[order - 1]));
    }
    return step_extent(last, last_but_one, numeric::max(allowed_term * speed, rounding), s.unit,
                       longest, remaining);
  };
  const double fastest = speed_within(s, 1.0);
  const double extent = extent_at(fastest);
  const double within = speed_within(s, extent);
  return within < 0.5 * fastest ? extent_at(within) : extent;
}

/// One carrier period; false where it fails.
[[gnu::always_inline]] inline bool advance(Result& state, const Scene& scene, double longest,
                                           double* record, const Named& named) {
  const bool touches = named.law != Law::none;
  const bool dahl = named.law == Law::dahl;
  if (touches) {
    snap_to_rest(state, scene);
  }
  int sample = 0;
  double offset = 0.0;
  for (std::uint32_t steps = 0; offset < two_pi; ++steps) {
    const double rest = two_pi - offset;
    const double velocity = scene.sliding_velocity + state.velocity;
    if (dahl) {
      settle(state, velocity);
    }
    Phasor drive = {};
    if (named.driven) {
      drive = drive_at(scene.drive_amplitude, offset);
    }
    Direction direction = {};
    Arc arc = {};
    if (touches) {
      direction = direction_of(state, scene, drive, offset, velocity, named);
      arc = arc_of(scene, direction.sign, dahl ? state.friction : direction.sign);
    }
    Series s;
    s.unit = numeric::min(longest, rest);
    if (dahl) {
      s.unit = series_unit(scene, velocity, state.friction, s.unit);
    }
    s.rate = 1.0 / s.unit;
    s.displacement = state.displacement;
    s.velocity = state.velocity;
    s.vibration = s.unit * s.velocity;
    s.travel[0] = s.unit * velocity;
    if (named.driven) {
      set_drive(s, drive);
    }
    expand(s, scene, arc, named, std::make_index_sequence<order + 1>());

    const double remaining = rest / s.unit;
    const double end = allowed_extent(s, scene, longest, remaining, named);
    const double extent = touches ? up_to_reversal(s, direction, end) : end;
    state.displacement = displacement_at(s, extent);
    state.velocity = velocity_at(s, extent);
    if (named.law == Law::coulomb) {
      state.friction = direction.sign;
    }
    if (dahl) {
      const double travel = travelled(s, arc, extent);
      state.friction = friction_after(scene, arc, travel);
      if (named.mean_friction) {
        state.friction_integral += s.unit * friction_integral(s, scene, arc, extent);
      }
      if (named.energy) {
        add_energy(state, s, scene, arc, extent, travel, named);
      }
    }
    if (named.recorded) {
      for (; sample < samples_per_period && sample * sample_spacing <= offset + s.unit * extent;
           ++sample) {
        record[sample] = displacement_at(s, (sample * sample_spacing - offset) / s.unit);
      }
    }
    ++state.steps;
    const double next = extent == remaining ? two_pi : offset + s.unit * extent;
    const bool stands = touches && (next == offset || direction.sign == 0.0);
    if (steps == step_limit || stands || !numeric::is_finite(state.displacement) ||
        !numeric::is_finite(state.velocity) || !numeric::is_finite(state.friction)) {
      return false;
    }
    offset = next;
    if (touches && extent < end) {
      state.velocity = -scene.sliding_velocity;
    }
  }
  return true;
}

[[gnu::always_inline]] inline Result taylor(const Scene& scene, double* record,
                                            const Named& named) {
  const double longest = longest_step();
  Result state;
  for (int i = 0; i < periods; ++i) {
    if (!advance(state, scene, longest, record, named)) {
      return {};
    }
    if (named.recorded) {
      record += samples_per_period;
    }
  }
  return state;
}

}  // namespace sonoglide::cost::by_hand
