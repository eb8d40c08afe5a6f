/// A driven oscillator on a Coulomb contact that slides throughout, by Taylor series.

#include "cost_by_hand.hpp"
#include "cost_by_hand_reversals.hpp"

namespace sonoglide::cost::by_hand {
namespace {

/// Friction is a constant: it acts on the first term alone.
[[gnu::always_inline]] inline void expand(Series& s, const Scene& scene, double friction) {
  const double first = free_term(s, scene, 0, true, false);
  s.travel[1] = first - scene.friction_force * (s.unit * s.unit) * friction;
  s.travel[2] = free_term(s, scene, 1, true, false);
  s.travel[3] = free_term(s, scene, 2, true, false);
  s.travel[4] = free_term(s, scene, 3, true, false);
  s.travel[5] = free_term(s, scene, 4, true, false);
  s.travel[6] = free_term(s, scene, 5, true, false);
  s.travel[7] = free_term(s, scene, 6, true, false);
  s.travel[8] = free_term(s, scene, 7, true, false);
  s.travel[9] = free_term(s, scene, 8, true, false);
  s.travel[10] = free_term(s, scene, 9, true, false);
  s.travel[11] = free_term(s, scene, 10, true, false);
  s.travel[12] = free_term(s, scene, 11, true, false);
  s.travel[13] = free_term(s, scene, 12, true, false);
  s.travel[14] = free_term(s, scene, 13, true, false);
  s.travel[15] = free_term(s, scene, 14, true, false);
  s.travel[16] = free_term(s, scene, 15, true, false);
  s.travel[17] = free_term(s, scene, order, true, false);
  close_shift(s);
}

bool advance(Result& state, const Scene& scene, double longest) {
  snap_to_rest(state, scene);
  double offset = 0.0;
  for (std::uint32_t steps = 0; offset < two_pi; ++steps) {
    const double rest = two_pi - offset;
    const double velocity = scene.sliding_velocity + state.velocity;
    const Phasor drive = drive_at(scene.drive_amplitude, offset);
    Direction direction = {velocity > 0.0 ? 1.0 : -1.0, 0};
    if (velocity == 0.0) {
      direction =
          direction_from_rest(state, scene, drive, offset, 0.0, scene.friction_force, true, false);
    }
    Series s;
    s.unit = numeric::min(longest, rest);
    s.rate = 1.0 / s.unit;
    s.displacement = state.displacement;
    s.velocity = state.velocity;
    s.vibration = s.unit * s.velocity;
    s.travel[0] = s.unit * velocity;
    set_drive(s, drive);
    expand(s, scene, direction.sign);

    const double remaining = rest / s.unit;
    const double rounding = epsilon * numeric::abs(s.rate * s.travel[0]);
    const double allowed = numeric::max(allowed_term, rounding);
    const double last = numeric::abs(s.rate * s.travel[order + 1]);
    const double last_but_one = numeric::abs(s.rate * s.travel[order]);
    const double end = step_extent(last, last_but_one, allowed, s.unit, longest, remaining);
    const double extent = up_to_reversal(s, direction, end);
    state.displacement = displacement_at(s, extent);
    state.velocity = velocity_at(s, extent);
    state.friction = direction.sign;
    ++state.steps;
    const double next = extent == remaining ? two_pi : offset + s.unit * extent;
    if (steps == step_limit || next == offset || direction.sign == 0.0 ||
        !numeric::is_finite(state.displacement) || !numeric::is_finite(state.velocity)) {
      return false;
    }
    offset = next;
    if (extent < end) {
      state.velocity = -scene.sliding_velocity;
    }
  }
  return true;
}

}  // namespace

Result coulomb(const Scene& scene) {
  const double longest = longest_step();
  Result state;
  for (int i = 0; i < periods; ++i) {
    if (!advance(state, scene, longest)) {
      return {};
    }
  }
  return state;
}

}  // namespace sonoglide::cost::by_hand
