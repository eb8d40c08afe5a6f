#include "host_sim/python/controller_unit.hpp"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "host_sim/configure/configuration_error.hpp"

namespace sonoglide::python {
namespace {

configure::Experiment with_controller(configure::Experiment experiment) {
  if (!experiment.design) {
    throw configure::ConfigurationError("controller", "missing; allowed: a scene in closed loop");
  }
  if (experiment.design->bias) {
    throw configure::ConfigurationError(
        "drive.bias_limit_N", "a Unit has no bias force among its answers; allowed: 0, or a Loop");
  }
  return experiment;
}

}  // namespace

ControllerUnit::ControllerUnit(configure::Experiment experiment)
    : experiment_(with_controller(std::move(experiment))),
      port_(loop::make_control_port(scene(), *experiment_.design)) {
  set_target(scene().controller->target_friction_ratio.front().friction_ratio);
}

void ControllerUnit::set_target(double friction_ratio) {
  if (!(friction_ratio > 0.0 && friction_ratio <= 1.0)) {
    throw std::invalid_argument(
        fmt::format("target is {}; allowed: a friction ratio above 0, at most 1", friction_ratio));
  }
  target_ = friction_ratio;
  port_->set_target(friction_ratio);
}

loop::Snapshot ControllerUnit::save() const {
  loop::SnapshotWriter writer;
  writer.put(target_);
  writer.put(answer_);
  port_->save(writer);
  return writer.take();
}

void ControllerUnit::restore(const loop::Snapshot& state) {
  loop::SnapshotReader reader(state);
  reader.get(target_);
  reader.get(answer_);
  port_->restore(reader);
  if (!reader.over()) {
    throw std::invalid_argument("the state that is to be restored is too long");
  }
}

}  // namespace sonoglide::python
