#include "host_sim/loop/control_port.hpp"

#include "firmware/numeric/fixed.hpp"

namespace sonoglide::loop {

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
