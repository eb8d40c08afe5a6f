/// The core's side of every solver that a scene chooses among, for what composes plants. Scenes do
/// not include it: a change in a solver leaves them as they are.
#pragma once

#include "firmware/friction/none.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/gauss/event_gauss.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/rk4/rk4.hpp"
#include "firmware/plant/rk4/rk4_event.hpp"
#include "firmware/plant/stiff/stiff_linear.hpp"
#include "firmware/plant/strang/strang.hpp"
#include "firmware/plant/taylor/event_taylor.hpp"

namespace sonoglide::scene {

/// Whether a solver takes a law of the core.
template <class Described, class Law>
inline constexpr bool takes_law = [] {
  // It is no type for a law that it does not take, but answers for every law elsewhere.
  using Scalar = typename Law::Scalar;
  using AnyModel = plant::Model<friction::None<Scalar>, plant::Undamped<Scalar>, plant::NoDrive>;
  return Described::template Core<AnyModel, Described::orders[0]>::template solves<Law>;
}();

}  // namespace sonoglide::scene
