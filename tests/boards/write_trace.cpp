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
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/run.hpp"
#include "trace_line.hpp"

namespace sonoglide {
namespace {

void write_fields(const hal::Sample& sample) {
  std::cout << sample.friction_force << ", " << sample.sliding_velocity << ", "
            << sample.force_at_rail << ", " << sample.fresh << ", " << sample.velocity_at_rail;
}

void write_initialiser(const hal::Sample& sample) {
  std::cout << "    {";
  write_fields(sample);
  std::cout << "},\n";
}

void write_initialiser(const hal::VibrationSample& sample) {
  std::cout << "    {{";
  write_fields(sample);
  std::cout << "}, " << sample.in_phase << ", " << sample.quadrature << ", "
            << sample.vibration_at_rail << ", " << sample.vibration_fresh << "},\n";
}

enum class Form { lines, header };

class WritingPort final : public loop::ControlPort {
  template <class Sample>
  auto answer(const Sample& sample) {
    const auto drive = port_->exchange(sample);
    if (form_ == Form::lines) {
      boards_test::write_line(sample, drive);
    } else {
      write_initialiser(sample);
    }
    return drive;
  }

 public:
  WritingPort(std::unique_ptr<loop::ControlPort> port, Form form)
      : port_(std::move(port)), form_(form) {}

  void set_target(double friction_ratio) override { port_->set_target(friction_ratio); }

  hal::Drive exchange(const hal::Sample& sample) override { return answer(sample); }
  hal::ResonantDrive exchange(const hal::VibrationSample& sample) override {
    return answer(sample);
  }

  std::vector<numeric::SignalRecord> signals() const override { return port_->signals(); }

 private:
  std::unique_ptr<loop::ControlPort> port_;
  Form form_;
};

configure::Experiment read(const std::vector<std::string>& words) {
  return experiment::read_file(words.front(), {words.begin() + 1, words.end()});
}

/// @return hash of the commands
std::uint64_t write(const configure::Experiment& experiment, Form form) {
  WritingPort port(loop::make_control_port(experiment.nominal, *experiment.design), form);
  return loop::run(experiment.plant, *experiment.design, port).control->trace_hash;
}

void write_header(const configure::Experiment& experiment) {
  std::cout << "#pragma once\n\n#include <cstdint>\n\n#include \"hal/board.hpp\"\n\n"
               "namespace sonoglide::recorded {\n\n"
               "inline constexpr hal::"
            << (experiment.nominal.sensor.vibration ? "VibrationSample" : "Sample")
            << " samples[] = {\n";
  const std::uint64_t hash = write(experiment, Form::header);
  std::cout << "};\ninline constexpr std::uint64_t trace_hash = " << hash
            << "U;\n\n}  // namespace sonoglide::recorded\n";
}

}  // namespace
}  // namespace sonoglide

int main(int count, char** words) {
  try {
    const std::vector<std::string> all(words + 1, words + count);
    if (all.at(0) == "--header") {
      sonoglide::write_header(sonoglide::read({all.begin() + 1, all.end()}));
    } else {
      sonoglide::write(sonoglide::read(all), sonoglide::Form::lines);
    }
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
