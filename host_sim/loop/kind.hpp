/// What of a closed loop is stepped from outside.
#pragma once

#include <array>

#include "host_sim/scene/names.hpp"

namespace sonoglide::loop {

enum class Kind {
  plant,       ///< oscillator and contact
  controller,  ///< sensors, controller, actuator
  loop         ///< both, joined as in `run`
};

inline constexpr std::array kinds = {scene::Named<Kind>{"plant", Kind::plant},
                                     scene::Named<Kind>{"controller", Kind::controller},
                                     scene::Named<Kind>{"loop", Kind::loop}};

constexpr bool has_plant(Kind kind) {
  return kind != Kind::controller;
}
constexpr bool has_controller(Kind kind) {
  return kind != Kind::plant;
}

}  // namespace sonoglide::loop
