// Runs a scene on the workstation and writes what its controller meets, a line for each carrier period:
// force, sliding velocity, force at rail, fresh, velocity at rail; amplitude, commanded ratio, state, limit,
// fault, settling.
//
// Usage: pico_trace SCENE.toml [TABLE.KEY=VALUE ...] > trace
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "hal/board.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/loop/control_port.hpp"
#include "host_sim/loop/run.hpp"

namespace sonoglide {
namespace {

class WritingPort final : public loop::ControlPort {
 public:
  explicit WritingPort(std::unique_ptr<loop::ControlPort> port) : port_(std::move(port)) {}

  void set_target(double friction_ratio) override { port_->set_target(friction_ratio); }

  hal::Drive exchange(const hal::Sample& sample) override {
    const hal::Drive drive = port_->exchange(sample);
    std::cout << sample.friction_force << ' ' << sample.sliding_velocity << ' '
              << sample.force_at_rail << ' ' << sample.fresh << ' ' << sample.velocity_at_rail
              << ' ' << drive.amplitude << ' ' << drive.commanded_ratio << ' ' << int{drive.state}
              << ' ' << int{drive.limit} << ' ' << int{drive.fault} << ' ' << int{drive.settling}
              << '\n';
    return drive;
  }

  std::vector<numeric::SignalRecord> signals() const override { return port_->signals(); }

 private:
  std::unique_ptr<loop::ControlPort> port_;
};

void write(const std::string& scene, const std::vector<std::string>& changes) {
  const configure::Experiment experiment = experiment::read_file(scene, changes);
  WritingPort port(loop::make_control_port(experiment.nominal, *experiment.design));
  loop::run(experiment.plant, *experiment.design, port);
}

}  // namespace
}  // namespace sonoglide

int main(int count, char** words) {
  try {
    sonoglide::write(words[1], {words + 2, words + count});
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
