/// From a plant in double to the integers of FixedStrang. For the host.
#pragma once

#include <cstddef>
#include <cstdint>

#include "firmware/numeric/float_elementary.hpp"
#include "firmware/numeric/growth_matrix.hpp"
#include "firmware/numeric/scalar.hpp"
#include "firmware/numeric/turn.hpp"
#include "firmware/plant/state.hpp"
#include "firmware/plant/strang/fixed_point_strang.hpp"

namespace sonoglide::plant {

/// What keeps a plant out of the integers.
enum class FixedStrangRefusal {
  none,
  oscillator,  ///< natural frequency or damping: h k or h d reaches 1/4
  contact,     ///< kappa S reaches 2048
  friction,    ///< beta is too large, or a stuck contact rings faster than the steps can follow
  range,       ///< the initial state is out of the state scale, or sliding out of half of it
};

/// The parameters, or why there are none.
struct FixedStrangDesign {
  FixedStrangRefusal refusal;
  FixedStrangParameters parameters;
};

/// The state scale is a power of two, at least four times the steady vibration at full drive: what
/// the free vibration adds to it, up to twice that again, leaves room.
///
/// @param model             in dimensionless numbers
/// @param full_drive        drive force at code 2^31, in units of m L omega^2
/// @param sliding_velocity  in units of L omega, constant
/// @param initial           state at drive phase 0
template <class Model>
FixedStrangDesign design_fixed_strang(const Model& model, double full_drive,
                                      double sliding_velocity, const State<double>& initial) {
  constexpr double h = numeric::two_pi / static_cast<double>(FixedStrangParameters::steps);
  const double reactive = 1.0 - model.stiffness;
  const double damping = model.damping_force(1.0);
  const double vibration = full_drive / numeric::sqrt(reactive * reactive + damping * damping);
  double scale = 1.0;
  while (scale < 4.0 * vibration && scale < 1e9) {
    scale *= 2.0;
  }
  const double kappa = model.law.contact_stiffness * scale;
  const double stuck = model.friction_force * model.law.contact_stiffness;
  const auto inside = [](double value, double bound) { return numeric::abs(value) < bound; };
  const auto integer = [](double value, int bits) {
    return static_cast<std::int32_t>(
        numeric::round_half_up<std::int64_t>(numeric::scale_by_power_of_two(value, bits)));
  };

  FixedStrangDesign design{};
  if (!inside(h * model.stiffness, 0.25) || !inside(h * damping, 0.25)) {
    design.refusal = FixedStrangRefusal::oscillator;
  } else if (!inside(kappa, 2048.0)) {
    design.refusal = FixedStrangRefusal::contact;
  } else if (!inside(h * model.friction_force / scale, 1.0 / 512.0) || !(stuck * h * h <= 1.0)) {
    design.refusal = FixedStrangRefusal::friction;
  } else if (!inside(sliding_velocity, 0.5 * scale) || !inside(initial.displacement, scale) ||
             !inside(initial.velocity, scale)) {
    design.refusal = FixedStrangRefusal::range;
  }
  if (design.refusal != FixedStrangRefusal::none) {
    return design;
  }

  const numeric::SquareMatrix<double, 4> growth =
      numeric::growth_matrix<double, 4>({{{0.0, 1.0, 0.0, 0.0},
                                          {-model.stiffness, -damping, 1.0, 0.0},
                                          {0.0, 0.0, 0.0, -1.0},
                                          {0.0, 0.0, 1.0, 0.0}}},
                                        h);
  FixedStrangParameters& p = design.parameters;
  for (std::size_t row = 0; row < 2; ++row) {
    for (std::size_t column = 0; column < 2; ++column) {
      p.growth[row][column] = integer(growth[row][column], 33);
    }
    for (std::size_t i = 0; i < FixedStrangParameters::steps; ++i) {
      const double turns = 2.0 * static_cast<double>(i) / FixedStrangParameters::steps;
      const double unit = full_drive / scale;
      p.driven[i][row] = integer(unit * (growth[row][2] * numeric::cos_pi(turns) +
                                         growth[row][3] * numeric::sin_pi(turns)),
                                 33);
    }
  }
  p.kick = integer(h * model.friction_force / scale, 40);
  p.contact_stiffness = integer(kappa, 20);
  p.step = integer(h, 30);
  p.sliding_velocity = integer(sliding_velocity / scale, 30);
  p.sliding_travel = integer(h * sliding_velocity / scale, 30);
  p.side = model.side() < 0.0 ? -1 : 1;
  p.initial = {integer(initial.displacement / scale, 30), integer(initial.velocity / scale, 30),
               integer(initial.friction, 30)};
  return design;
}

}  // namespace sonoglide::plant
