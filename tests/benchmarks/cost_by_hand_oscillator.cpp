/// Oscillators without a contact, by Taylor series.

#include "cost_by_hand.hpp"
#include "cost_by_hand_series.hpp"

namespace sonoglide::cost::by_hand {
namespace {

[[gnu::always_inline]] inline void add_term(Series& s, const Scene& scene, std::size_t n,
                                            bool driven, bool damped) {
  s.travel[n + 1] = free_term(s, scene, n, driven, damped);
}

[[gnu::always_inline]] inline void expand(Series& s, const Scene& scene, bool driven, bool damped) {
  add_term(s, scene, 0, driven, damped);
  add_term(s, scene, 1, driven, damped);
  add_term(s, scene, 2, driven, damped);
  add_term(s, scene, 3, driven, damped);
  add_term(s, scene, 4, driven, damped);
  add_term(s, scene, 5, driven, damped);
  add_term(s, scene, 6, driven, damped);
  add_term(s, scene, 7, driven, damped);
  add_term(s, scene, 8, driven, damped);
  add_term(s, scene, 9, driven, damped);
  add_term(s, scene, 10, driven, damped);
  add_term(s, scene, 11, driven, damped);
  add_term(s, scene, 12, driven, damped);
  add_term(s, scene, 13, driven, damped);
  add_term(s, scene, 14, driven, damped);
  add_term(s, scene, 15, driven, damped);
  add_term(s, scene, order, driven, damped);
  close_shift(s);
}

/// One carrier period; false where it fails.
[[gnu::always_inline]] inline bool advance(Result& state, const Scene& scene, double longest,
                                           bool driven, bool damped) {
  double offset = 0.0;
  for (std::uint32_t steps = 0; offset < two_pi; ++steps) {
    const double rest = two_pi - offset;
    Series s;
    s.unit = numeric::min(longest, rest);
    s.rate = 1.0 / s.unit;
    s.displacement = state.displacement;
    s.velocity = state.velocity;
    s.vibration = s.unit * s.velocity;
    if (driven) {
      set_drive(s, drive_at(scene.drive_amplitude, offset));
    }
    expand(s, scene, driven, damped);

    const double remaining = rest / s.unit;
    const double extent = step_extent(numeric::abs(s.rate * s.travel[order + 1]),
                                      numeric::abs(s.rate * s.travel[order]), allowed_term, s.unit,
                                      longest, remaining);
    state.displacement = displacement_at(s, extent);
    state.velocity = velocity_at(s, extent);
    ++state.steps;
    offset = extent == remaining ? two_pi : offset + s.unit * extent;
    if (steps == step_limit || !numeric::is_finite(state.displacement) ||
        !numeric::is_finite(state.velocity)) {
      return false;
    }
  }
  return true;
}

[[gnu::always_inline]] inline Result run(const Scene& scene, bool driven, bool damped) {
  const double longest = longest_step();
  Result state;
  for (int i = 0; i < periods; ++i) {
    if (!advance(state, scene, longest, driven, damped)) {
      return {};
    }
  }
  return state;
}

}  // namespace

Result free_oscillator(const Scene& scene) {
  return run(scene, false, false);
}
Result damped_oscillator(const Scene& scene) {
  return run(scene, false, true);
}
Result driven_oscillator(const Scene& scene) {
  return run(scene, true, false);
}
Result driven_damped_oscillator(const Scene& scene) {
  return run(scene, true, true);
}

}  // namespace sonoglide::cost::by_hand
