/// The closed loop at Table 1: plant and controller written out. Only the number type is a
/// parameter of the controller, so that one text serves both arithmetics.

#include <array>
#include <cstdint>

#include "cost_by_hand_taylor.hpp"
#include "cost_scene.hpp"
#include "firmware/friction/dahl_inverse_map.hpp"
#include "firmware/numeric/fixed.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::cost::by_hand {
namespace {

/// Inverse Dahl map, notch, integral and supervision; no calibration, slew limit or relearning.
template <class Number>
struct Control {
  Number target;
  Number speed_floor;
  Number lead;
  Number gain;
  Number inverse;  ///< 1 / (2 Fc), Fc the believed friction force; in fixed point 1 / (4 mantissa)
  int exponent;    ///< of that force
  numeric::Floating<Number> half_travel;
  Number outer_tap;
  Number middle_tap;

  Number integral = Number{};
  Number last_velocity = Number{};
  Number last_change = Number{};
  Number past_target = Number{};
  Number last_amplitude = Number{};
  Number last_but_one = Number{};
  Number last_reading = Number{};
  Number ratio_at_reading = numeric::from_real<Number>(0.5);
  Number commanded = numeric::from_real<Number>(0.5);
  std::uint16_t held = control_numbers.hold_periods;
  std::uint16_t rest = 0;
  std::uint16_t still = 0;
  std::uint16_t implausible = 0;
  std::uint32_t outside = 1;
  int samples = 0;
  bool above = false;
  bool below = false;
  bool limited = false;
  bool begun = false;
  bool warned = false;
  bool failed = false;
};

template <class Number>
Control<Number> control_of(const ControlNumbers& numbers) {
  const auto number = [](double value) { return numeric::from_real<Number>(value); };
  const numeric::Split<Number> force = numeric::split(number(numbers.friction_force));
  const numeric::Split<double> contact = numeric::split(numbers.contact_force);
  Control<Number> c = {};
  c.target = number(0.5 * numbers.target_friction_ratio);
  c.speed_floor = number(numbers.speed_floor);
  c.lead = number(numbers.lead_periods / 64.0);
  c.gain = number(numbers.gain);
  c.past_target = number(0.5);
  c.inverse = numeric::is_fixed_point_v<Number> ? number(0.25) / force.mantissa
                                                : number(0.5) / number(numbers.friction_force);
  c.exponent = force.exponent;
  c.half_travel = numeric::quotient(
      numeric::floating(numeric::Split<Number>{number(contact.mantissa), contact.exponent - 1}),
      numeric::floating(force));
  c.outer_tap = number(numbers.outer_tap);
  c.middle_tap = number(numbers.middle_tap);
  return c;
}

/// The speed at which the answer acts.
template <class Number>
Number foreseen(Control<Number>& c, Number velocity) {
  const auto ahead = [&c](Number change) {
    return numeric::scale_by_power_of_two(change * c.lead, 6);
  };
  const Number change = c.samples > 0 ? velocity - c.last_velocity : Number{};
  const bool same_way = (change < Number{}) == (c.last_change < Number{});
  Number agreed = Number{};
  if (c.samples > 1 && same_way) {
    agreed = numeric::abs(change) < numeric::abs(c.last_change) ? change : c.last_change;
  }
  c.last_velocity = velocity;
  c.last_change = change;
  c.samples += c.samples < 2 ? 1 : 0;
  Number speed = velocity + ahead(agreed);
  if (change != agreed) {
    const Number most = numeric::scale_by_power_of_two(numeric::abs(velocity), -3);
    speed += numeric::clamp(ahead(change - agreed), -most, most);
  }
  return speed;
}

/// A ratio that no contact has, for longer than is granted.
template <class Number>
bool is_implausible(Control<Number>& c, Number measured) {
  if (numeric::from_real<Number>(-0.075) < measured &&
      measured < numeric::from_real<Number>(0.65)) {
    c.implausible = 0;
    return false;
  }
  return ++c.implausible > control_numbers.implausible_periods;
}

/// Whether the ratio comes to its target, and what the command says of the friction force.
template <class Number>
bool is_settled(Control<Number>& c, Number measured) {
  const Number band = numeric::from_real<Number>(control_numbers.settling_band);
  const Number agreement = numeric::from_real<Number>(control_numbers.agreement);
  const std::uint32_t limit = 4U * control_numbers.patience_periods;
  const bool above = c.target + band < measured;
  const bool below = measured < c.target - band;
  if (above || below) {
    c.outside = c.outside + 4 < limit ? c.outside + 4 : limit + 128;
    c.above = c.above || above;
    c.below = c.below || below;
  } else if (c.outside > 0) {
    --c.outside;
    c.outside = c.outside + 1 == limit ? 0 : c.outside;
  }
  const bool disagrees = c.commanded < c.target ? c.commanded < agreement * c.target
                                                : c.target < agreement * c.commanded;
  return c.outside == 0 ? !disagrees : c.outside < limit;
}

/// A reading that stands still although the command has moved far.
template <class Number>
bool is_stuck(Control<Number>& c, Number reading, Number measured) {
  if (!c.begun || reading != c.last_reading) {
    c.begun = true;
    c.last_reading = reading;
    c.ratio_at_reading = c.commanded;
    c.still = 0;
    return false;
  }
  const Number telling = measured < numeric::from_real<Number>(0.46875)
                             ? numeric::from_real<Number>(0.125)
                             : numeric::from_real<Number>(0.375);
  const bool told = c.still > 0 || telling <= numeric::abs(c.commanded - c.ratio_at_reading);
  if (told && !c.limited) {
    ++c.still;
  }
  return c.still >= control_numbers.stuck_periods;
}

/// The drive amplitude, as a code, that answers one carrier period.
template <class Number>
std::int32_t answer(Control<Number>& c, std::int32_t force_code, std::int32_t velocity_code) {
  const Number half = numeric::from_real<Number>(0.5);
  const Number full = numeric::from_code<Number>(INT32_MAX);
  const Number force = numeric::from_code<Number>(force_code);
  const Number velocity = numeric::from_code<Number>(velocity_code);
  const Number speed = foreseen(c, velocity);
  Number measured = force * c.inverse;
  if constexpr (numeric::is_fixed_point_v<Number>) {
    measured = numeric::scale_by_power_of_two(measured, 1 - c.exponent);
  }
  if (velocity < Number{} || speed < c.speed_floor || is_implausible(c, measured) ||
      is_stuck(c, force, measured)) {
    c.failed = true;
    return 0;
  }

  const Number error = c.past_target - measured;
  c.past_target = c.target;
  const Number proposed = c.held == 0 ? c.integral + c.gain * error : c.integral;
  const Number ratio = numeric::clamp(c.target + proposed, Number{}, half);
  const Number amplitude = friction::dahl_vibration_velocity(ratio, speed, c.half_travel);
  const bool full_drive = full <= amplitude;
  const bool winding_up = (full_drive && error < Number{}) || (half <= ratio && Number{} < error);
  c.integral = winding_up ? c.integral : proposed;
  c.held = static_cast<std::uint16_t>(c.held > 0 ? c.held - 1 : 0);
  c.rest = static_cast<std::uint16_t>(c.rest > 0 ? c.rest - 1 : 0);
  c.commanded = ratio;
  const bool settled = is_settled(c, measured);

  const std::array<Number, 3> taps{c.outer_tap, c.middle_tap, c.outer_tap};
  const std::array<Number, 3> inputs{amplitude, c.last_amplitude, c.last_but_one};
  const Number shaped = numeric::dot(taps, inputs);
  c.last_but_one = c.last_amplitude;
  c.last_amplitude = amplitude;
  c.limited = full_drive || shaped < Number{} || (full <= shaped && amplitude < full);
  c.warned = !settled;
  return numeric::to_code(numeric::clamp(shaped, Number{}, full));
}

/// One carrier period of the plant; false where it fails.
[[gnu::noinline]] bool advance_plant(Result& state, const Scene& scene, double longest) {
  static constexpr Named named = {Law::dahl, true, false, true, false, false};
  return advance(state, scene, longest, nullptr, named);
}

}  // namespace

template <class Number>
Result controlled(Scene scene) {
  Control<Number> control = control_of<Number>(control_numbers);
  const std::int32_t velocity_code = numeric::to_code(control_numbers.speed);
  const double longest = longest_step();
  Result state;
  double integral = 0.0;
  for (int i = 0; i < periods; ++i) {
    if (!advance_plant(state, scene, longest) || control.failed) {
      return {};
    }
    const double mean = (state.friction_integral - integral) / two_pi;
    integral = state.friction_integral;
    const std::int32_t code = answer(control, numeric::to_code(0.5 * mean), velocity_code);
    scene.drive_amplitude = control_numbers.full_drive_amplitude * numeric::from_code<double>(code);
  }
  state.drive_amplitude = scene.drive_amplitude;
  return state;
}
template Result controlled<float>(Scene scene);
template Result controlled<numeric::Q31<numeric::Saturating>>(Scene scene);

}  // namespace sonoglide::cost::by_hand
