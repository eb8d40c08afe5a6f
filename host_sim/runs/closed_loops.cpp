#include "host_sim/runs/closed_loops.hpp"

#include <algorithm>
#include <cstddef>
#include <memory>
#include <optional>
#include <utility>

#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/control/control_port.hpp"
#include "host_sim/loop/engine.hpp"
#include "host_sim/loop/plant/carrier_grid.hpp"
#include "host_sim/loop/plant/period_drive.hpp"
#include "host_sim/runs/batch/run_dahl_plants.hpp"
#include "host_sim/runs/lane_scene.hpp"

namespace sonoglide::runs {
namespace {

/// A loop without its plant, from one carrier period to the next.
class RunningLoop {
 public:
  explicit RunningLoop(const ClosedLoop& loop)
      : loop_(loop),
        drive_(loop.scene, 0.0, 0.0, 0.0),
        scales_(configure::plant_scales(loop.scene)),
        sliding_m_per_s_(loop.scene.sliding.profile.front().velocity_m_per_s),
        port_(loop::make_control_port(loop.scene, loop.design)),
        result_(loop::begun_result(loop.design)),
        engine_(loop.scene, false, port_.get(), watch_, result_) {
    watch_.periods.push_back(&loop.periods);
  }

  /// @return amplitude of the next period; absent where no whole one follows
  std::optional<batch::DriveAmplitude> next_amplitude(double mean_friction) {
    loop::PlantPeriod period = engine_.begun(engine_.control()->amplitude_N());
    period.mean_friction_force_N = mean_friction * scales_.friction_N;
    period.friction_ratio = sliding_m_per_s_ < 0.0 ? -mean_friction : mean_friction;
    period.friction_force_N = period.friction_ratio * scales_.friction_N;
    period.begin_velocity_m_per_s = sliding_m_per_s_;
    period.end_velocity_m_per_s = sliding_m_per_s_;
    engine_.conclude(period);
    if (engine_.clock().over() || !engine_.clock().is_whole()) {
      return std::nullopt;
    }
    drive_ = loop::PeriodDrive(loop_.scene, drive_.end_N(), engine_.control()->amplitude_N(), 0.0);
    const loop::DrivePart part = drive_.part(0);
    return batch::DriveAmplitude{part.amplitude_N / scales_.force_N,
                                 part.slope_N_per_rad / scales_.force_N};
  }

  loop::ControlRecord finish() {
    engine_.finish();
    return std::move(*result_.control);
  }

 private:
  const ClosedLoop& loop_;
  loop::PeriodDrive drive_;  ///< of the period that comes next
  scene::PlantScales scales_;
  double sliding_m_per_s_;
  loop::Watch watch_;
  std::unique_ptr<loop::ControlPort> port_;
  loop::RunResult result_;
  loop::Engine engine_;
};

/// The controllers of all loops; there are those of the loops that run.
class Controllers final : public batch::DriveSource {
 public:
  Controllers(const std::vector<ClosedLoop>& loops, std::vector<LoopRun>& runs)
      : loops_(loops), runs_(runs), running_(loops.size()) {}

  std::optional<batch::DriveAmplitude> next_amplitude(std::size_t plant,
                                                      double mean_friction) override {
    std::unique_ptr<RunningLoop>& running = running_[plant];
    if (!running) {
      running = std::make_unique<RunningLoop>(loops_[plant]);
    }
    const std::optional<batch::DriveAmplitude> amplitude = running->next_amplitude(mean_friction);
    if (!amplitude) {
      runs_[plant].control = running->finish();
      running.reset();
    }
    return amplitude;
  }

  bool ramps() const override {
    return std::any_of(loops_.begin(), loops_.end(),
                       [](const ClosedLoop& loop) { return loop.scene.drive->is_ramped(); });
  }

 private:
  const std::vector<ClosedLoop>& loops_;
  std::vector<LoopRun>& runs_;
  std::vector<std::unique_ptr<RunningLoop>> running_;
};

}  // namespace

bool runs_in_lanes(const scene::Scene& closed_loop) {
  return closed_loop.controller && !closed_loop.sensor.vibration &&
         closed_loop.solver.tolerance >= closed_loop_tolerance &&
         loop::CarrierClock(closed_loop).is_whole() && lane_plant(closed_loop);
}

std::vector<LoopRun> run_closed_loops(const std::vector<ClosedLoop>& loops) {
  std::vector<batch::DahlPlant> plants;
  plants.reserve(loops.size());
  for (const ClosedLoop& loop : loops) {
    plants.push_back(lane_plant(loop.scene).value());
  }
  std::vector<LoopRun> runs(loops.size());
  Controllers controllers(loops, runs);
  const std::vector<batch::RunStatus> statuses = batch::run_driven_plants(plants, controllers);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    runs[i].status = statuses[i];
  }
  return runs;
}

}  // namespace sonoglide::runs
