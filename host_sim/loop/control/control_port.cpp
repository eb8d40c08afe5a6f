#include "host_sim/loop/control/control_port.hpp"

#include <stdexcept>

#include "firmware/numeric/fixed.hpp"

namespace sonoglide::loop {

hal::Drive ControlPort::exchange(const hal::Sample& /*sample*/) {
  throw std::logic_error("a controller that observes the vibration needs a sample of it");
}

hal::ResonantDrive ControlPort::exchange(const hal::VibrationSample& /*sample*/) {
  throw std::logic_error("a controller that observes no vibration has no use for a sample of it");
}

hal::BiasedDrive ControlPort::exchange_biased(const hal::Sample& /*sample*/) {
  throw std::logic_error("this controller answers with no bias, or needs the mean velocity for it");
}

hal::BiasedDrive ControlPort::exchange_biased(const hal::MotionSample& /*sample*/) {
  throw std::logic_error("this controller has no use for the mean velocity");
}

std::optional<FrictionBelief> ControlPort::friction() const {
  return std::nullopt;
}

void ControlPort::copy_state(StateCopy& /*copy*/) {
  throw std::logic_error("the state of this controller is out of reach");
}

std::unique_ptr<ControlPort> make_control_port(const scene::Scene& scene,
                                               const configure::ControlDesign& design) {
  switch (scene.controller->arithmetic) {
    case scene::Arithmetic::float32:
      return make_control<float>(design);
    case scene::Arithmetic::q31:
      return make_control<numeric::Q31<numeric::Counting>>(design);
    case scene::Arithmetic::q15:
      return make_control<numeric::Q15<numeric::Counting>>(design);
    case scene::Arithmetic::float64:
      break;
  }
  return make_control<double>(design);
}

}  // namespace sonoglide::loop
