/// What the hand-written Taylor loops with a sliding contact have in common: where a step begins
/// and where it turns.
#pragma once

#include "cost_by_hand_series.hpp"
#include "firmware/plant/taylor/first_reversal.hpp"

namespace sonoglide::cost {

/// Which way a contact slides; 0 where this loop does not serve.
struct Direction {
  double sign;
  std::size_t zero_order;
};

/// Where the previous period ended at V = 0, V is zero here but for rounding.
inline void snap_to_rest(Result& state, const Scene& scene) {
  if (numeric::abs(scene.sliding_velocity + state.velocity) <=
      4.0 * epsilon * numeric::abs(scene.sliding_velocity)) {
    state.velocity = -scene.sliding_velocity;
  }
}

/// From V = 0, by the acceleration there. held: a friction force that could hold the contact.
[[gnu::always_inline]] inline Direction direction_from_rest(const Result& state, const Scene& scene,
                                                            const Phasor& drive, double offset,
                                                            double friction, double held,
                                                            bool driven, bool damped) {
  const double relative_error = epsilon * (16.0 + 2.0 * offset);
  const double spring = scene.stiffness * state.displacement;
  const double contact = scene.friction_force * friction;
  const double damper = scene.damping * state.velocity;
  const double pull = driven ? drive.in_phase : 0.0;
  const double bound = driven ? numeric::abs(drive.in_phase) + numeric::abs(drive.quadrature) : 0.0;
  const double acceleration = (damped ? pull - damper : pull) - spring - contact;
  const double size = damped ? bound + numeric::abs(damper) : bound;
  double error = relative_error * (size + numeric::abs(spring) + numeric::abs(contact));
  if (damped) {
    error += scene.damping * (epsilon * numeric::abs(scene.sliding_velocity));
  }
  if (!(numeric::abs(acceleration) - held > error + relative_error * held)) {
    return {0.0, 0};
  }
  return {acceleration > 0.0 ? 1.0 : -1.0, 1};
}

/// The extent of the step, cut at the first reversal.
[[gnu::always_inline]] inline double up_to_reversal(const Series& s, const Direction& direction,
                                                    double longest) {
  const double end =
      s.travel[0] + longest * (s.travel[1] + longest * beyond_linear(s.travel, longest));
  if (longest <= 1.0 &&
      plant::certainly_keeps_sign(s.travel, direction.sign, direction.zero_order, longest, end)) {
    return longest;
  }
  return plant::first_reversal(s.travel, direction.sign, direction.zero_order, longest);
}

}  // namespace sonoglide::cost
