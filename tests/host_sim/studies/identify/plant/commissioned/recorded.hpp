/// What a unit would record, from a simulation of its loop.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "host_sim/configure/experiment.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/run.hpp"
#include "host_sim/studies/identify/plant/stretch.hpp"

namespace sonoglide::identify::plant::test {

/// Keeps what passes between a loop and a controller; without a controller the drive is off.
class Recorder final : public loop::ControlPort {
 public:
  explicit Recorder(loop::ControlPort* controller) : controller_(controller) {}

  using ControlPort::exchange;
  using ControlPort::exchange_biased;

  void set_target(double target) override {
    if (controller_ != nullptr) {
      controller_->set_target(target);
      set_at_.push_back(steps_.size());
    }
  }
  std::vector<numeric::SignalRecord> signals() const override { return {}; }
  hal::Drive exchange(const hal::Sample& sample) override {
    const hal::Drive drive = controller_ != nullptr ? controller_->exchange(sample) : hal::Drive{};
    return kept(sample, drive, 0);
  }
  hal::ResonantDrive exchange(const hal::VibrationSample& sample) override {
    const hal::ResonantDrive drive =
        controller_ != nullptr ? controller_->exchange(sample) : hal::ResonantDrive{};
    return kept(sample, drive, drive.frequency);
  }
  hal::BiasedDrive exchange_biased(const hal::Sample& sample) override { return biased(sample); }
  hal::BiasedDrive exchange_biased(const hal::MotionSample& sample) override {
    return biased(sample);
  }

  const std::vector<RecordedStep>& steps() const { return steps_; }
  /// Steps before each target came into force.
  const std::vector<std::size_t>& set_at() const { return set_at_; }

 private:
  template <class SampleT>
  hal::BiasedDrive biased(const SampleT& sample) {
    const hal::BiasedDrive drive =
        controller_ != nullptr ? controller_->exchange_biased(sample) : hal::BiasedDrive{};
    return kept(sample, drive, drive.bias);
  }
  template <class DriveT>
  DriveT kept(const hal::Sample& sample, const DriveT& drive, std::int32_t other) {
    steps_.push_back({sample.friction_force, sample.sliding_velocity, drive.amplitude, other});
    return drive;
  }

  loop::ControlPort* controller_;
  std::vector<RecordedStep> steps_;
  std::vector<std::size_t> set_at_;
};

/// @param experiment  a closed loop; its plant is what is recorded
/// @param targets     one after the other; the first is only a place to begin at
inline std::vector<Stretch> recorded(const configure::Experiment& experiment,
                                     const std::vector<double>& targets, std::size_t length,
                                     std::size_t before) {
  const double period_s = experiment.design->scales.step_period_s();
  scene::Scene plant = experiment.plant;
  scene::Scene stated = experiment.nominal;
  std::vector<scene::TargetStep> steps;
  const double apart_s = static_cast<double>(length + 100) * period_s;
  for (std::size_t i = 0; i < targets.size(); ++i) {
    steps.push_back({static_cast<double>(i) * apart_s, targets[i]});
  }
  for (scene::Scene* each : {&plant, &stated}) {
    (each->controller->holds_force() ? each->controller->target_friction_force_N
                                     : each->controller->target_friction_ratio) = steps;
    each->run.duration_s = static_cast<double>(targets.size()) * apart_s;
    each->run.record.clear();
    each->run.record_interval_s = 0.0;
  }
  std::vector<Stretch> all;
  Recorder off(nullptr);
  scene::Scene undriven = plant;
  undriven.run.duration_s = 300.0 * period_s;
  loop::run(undriven, *experiment.design, off);
  all.push_back({"undriven", 0, {off.steps().end() - 200, off.steps().end()}});
  const auto port = loop::make_control_port(plant, *experiment.design);
  Recorder recorder(port.get());
  loop::run(plant, *experiment.design, recorder);
  for (std::size_t i = 1; i < targets.size(); ++i) {
    const auto first =
        recorder.steps().begin() + static_cast<std::ptrdiff_t>(recorder.set_at().at(i) - before);
    all.push_back({"step", before, {first, first + static_cast<std::ptrdiff_t>(length)}});
  }
  return all;
}

}  // namespace sonoglide::identify::plant::test
