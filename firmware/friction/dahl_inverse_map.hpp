/// Inverse friction-ratio map of a Dahl contact, for the controller.
#pragma once

#include <cstdint>

#include "firmware/friction/dahl_inverse_table.hpp"
#include "firmware/friction/inverse_table.hpp"
#include "firmware/numeric/floating.hpp"
#include "firmware/numeric/scalar.hpp"

namespace sonoglide::friction {

/// Peak vibration velocity v̂ at which a Dahl contact that slides at Vt has the given friction
/// ratio.
///
/// The vibration amplitude is unknown, so λ = Kt·Vt/(ω·Fc) describes the contact: it is the Dahl
/// number times r = Vt/v̂ and does not depend on the amplitude. v̂ = Vt/r = Vt + (Vt/ρ)·z², with z
/// from a table against λ/ρ and ρ (InverseGrid, 3944 bytes). This takes one division and no
/// sine.
///
/// @param half_ratio   ρ on base 2, at most 1/2.
/// @param speed        Vt, > 0, on the base of the result.
/// @param half_travel  λ/(2 Vt), > 0.
/// @return v̂, at least Vt and at most 1 (fixed point: the largest value). Falls as ρ rises; 1 for
///         ρ <= 0.
/// Error: the map at r = Vt/v̂ differs from ρ by at most 0.002 for Dahl numbers λ/r in [0.01, 1000],
/// in float64, float32 and Q31 alike (tested over velocity ratios 0 to 2); in Q15, for which Vt is
/// coarser, 0.002 for Vt from 0.1 and 0.008 for Vt from 0.0125 on.
template <class Scalar>
Scalar dahl_vibration_velocity(Scalar half_ratio, Scalar speed,
                               const numeric::Floating<Scalar>& half_travel) {
  using namespace inverse_table_detail;
  if (!(Scalar{} < half_ratio)) {
    return numeric::from_code<Scalar>(INT32_MAX);
  }
  const numeric::Floating<Scalar> stretched =
      numeric::quotient(numeric::floating_positive(speed), numeric::floating_positive(half_ratio));
  const GridPosition row = position<Grid::Row>(numeric::product(half_travel, stretched));
  return limited_sum(speed, stretched,
                     square<Scalar>(interpolate(dahl_inverse_table, row, column(half_ratio))));
}

}  // namespace sonoglide::friction
