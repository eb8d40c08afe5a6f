#pragma once

#include <cstddef>

namespace sonoglide::plant {
template <class Model, std::size_t Order>
class EventTaylor;
template <class Solver, class Turning, int Strictness>
class StiffLinear;
}  // namespace sonoglide::plant

namespace sonoglide::scene {

/// A solver of the core with the method for stiff linear motions before it; declared only. What
/// turns fast and is not linear goes to event_taylor of order 16.
/// @tparam Strictness  the solver's tolerance over that of event_taylor, > 0
template <class Model, class Solver, int Strictness>
using StiffCore = plant::StiffLinear<Solver, plant::EventTaylor<Model, 16>, Strictness>;

}  // namespace sonoglide::scene
