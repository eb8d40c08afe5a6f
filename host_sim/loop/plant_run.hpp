/// The plant along the time axis of a run, with what is measured on the way.
#pragma once

#include <memory>
#include <vector>

#include "host_sim/loop/energy.hpp"
#include "host_sim/loop/plant_port.hpp"
#include "host_sim/loop/recorder.hpp"
#include "host_sim/loop/run_result.hpp"
#include "host_sim/loop/sliding_profile.hpp"
#include "host_sim/scene/scene.hpp"

namespace sonoglide::loop {

class PlantRun {
 public:
  /// Both must outlive it; recordings, energies and final values go into the result.
  PlantRun(const scene::Scene& scene, RunResult& result);

  /// The carrier period; where there is no drive, one thousandth of the run.
  double period_s() const { return period_s_; }
  const SlidingProfile& sliding() const { return sliding_; }

  /// Advances to end_s, at most one carrier period on, under one drive amplitude.
  /// @param begin_s  where the last call ended, at drive phase 0
  /// @throws ComputationError
  EnergyBalance advance(double begin_s, double end_s, double amplitude_N);

  /// Fills in what the run ends with.
  void finish();

 private:
  void request_recordings();
  std::vector<double> target_steps_s() const;
  void request_close_up(double step_s, Recording& into);
  void request_ending(double last_step_s);
  void stretch(double period_begin_s, double begin_s, double end_s, double amplitude_N,
               EnergyBalance& total);
  [[noreturn]] void fail(plant::Error error, double time_s) const;

  const scene::Scene& scene_;
  RunResult& result_;
  std::unique_ptr<PlantPort> plant_;
  SlidingProfile sliding_;
  double period_s_;
  std::vector<double> cuts_s_;  ///< times inside carrier periods at which a stretch must end
  Recorder recorder_;
};

}  // namespace sonoglide::loop
