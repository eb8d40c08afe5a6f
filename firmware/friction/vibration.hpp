/// Which way the mass vibrates, seen from the sliding.
#pragma once

namespace sonoglide::friction {

enum class Vibration {
  along,   ///< in line with it: the vibration adds to the sliding velocity
  across,  ///< in the plane of the contact, at right angles to it: the slip is a vector
  normal   ///< towards the surface: what vibrates is the normal force
};

}  // namespace sonoglide::friction
