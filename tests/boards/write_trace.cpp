// Runs a scene on the workstation and writes what its controller meets, a line for each of its steps:
// force, sliding velocity, force at rail, fresh, velocity at rail; amplitude, commanded ratio, state, limit,
// fault, settling. One that observes the vibration has in phase and quadrature behind the velocity's rail, and the
// frequency at the end. Or, with --header, the samples as C++ for an image, and the hash of the commands.
//
// Usage: board_trace [--header] SCENE.toml [TABLE.KEY=VALUE ...] > trace
#include <cstdint>
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

void write_sample(const hal::Sample& sample) {
  std::cout << sample.friction_force << ' ' << sample.sliding_velocity << ' '
            << sample.force_at_rail << ' ' << sample.fresh << ' ' << sample.velocity_at_rail << ' ';
}

void write_answer(const hal::Drive& drive) {
  std::cout << drive.amplitude << ' ' << drive.commanded_ratio << ' ' << int{drive.state} << ' '
            << int{drive.limit} << ' ' << int{drive.fault} << ' ' << int{drive.settling};
}

void write_line(const hal::Sample& sample, const hal::Drive& drive) {
  write_sample(sample);
  write_answer(drive);
  std::cout << '\n';
}

void write_line(const hal::VibrationSample& sample, const hal::ResonantDrive& drive) {
  write_sample(sample);
  std::cout << sample.in_phase << ' ' << sample.quadrature << ' ';
  write_answer(drive);
  std::cout << ' ' << drive.frequency << '\n';
}

void write_initialiser(const hal::Sample& sample, const hal::Drive& /*drive*/) {
  std::cout << "    {" << sample.friction_force << ", " << sample.sliding_velocity << ", "
            << sample.force_at_rail << ", " << sample.fresh << ", " << sample.velocity_at_rail
            << "},\n";
}

class WritingPort final : public loop::ControlPort {
 public:
  using Write = void (*)(const hal::Sample&, const hal::Drive&);

  WritingPort(std::unique_ptr<loop::ControlPort> port, Write write)
      : port_(std::move(port)), write_(write) {}

  void set_target(double friction_ratio) override { port_->set_target(friction_ratio); }

  hal::Drive exchange(const hal::Sample& sample) override {
    const hal::Drive drive = port_->exchange(sample);
    write_(sample, drive);
    return drive;
  }

  hal::ResonantDrive exchange(const hal::VibrationSample& sample) override {
    const hal::ResonantDrive drive = port_->exchange(sample);
    write_line(sample, drive);
    return drive;
  }

  std::vector<numeric::SignalRecord> signals() const override { return port_->signals(); }

 private:
  std::unique_ptr<loop::ControlPort> port_;
  Write write_;
};

/// @return hash of the commands
std::uint64_t write(const std::vector<std::string>& words, WritingPort::Write write_step) {
  const configure::Experiment experiment =
      experiment::read_file(words.front(), {words.begin() + 1, words.end()});
  WritingPort port(loop::make_control_port(experiment.nominal, *experiment.design), write_step);
  return loop::run(experiment.plant, *experiment.design, port).control->trace_hash;
}

void write_header(const std::vector<std::string>& words) {
  std::cout << "#pragma once\n\n#include <cstdint>\n\n#include \"hal/board.hpp\"\n\n"
               "namespace sonoglide::recorded {\n\n"
               "inline constexpr hal::Sample samples[] = {\n";
  const std::uint64_t hash = write(words, write_initialiser);
  std::cout << "};\ninline constexpr std::uint64_t trace_hash = " << hash
            << "U;\n\n}  // namespace sonoglide::recorded\n";
}

}  // namespace
}  // namespace sonoglide

int main(int count, char** words) {
  try {
    const std::vector<std::string> all(words + 1, words + count);
    if (all.at(0) == "--header") {
      sonoglide::write_header({all.begin() + 1, all.end()});
    } else {
      sonoglide::write(all, sonoglide::write_line);
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
