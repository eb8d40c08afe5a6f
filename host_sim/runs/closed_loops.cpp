#include "host_sim/runs/closed_loops.hpp"

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <optional>

#include "firmware/numeric/turn.hpp"
#include "host_sim/batch/run_driven_plants.hpp"
#include "host_sim/configure/plant_scales.hpp"
#include "host_sim/loop/carrier_clock.hpp"
#include "host_sim/loop/control_port.hpp"
#include "host_sim/loop/control_run.hpp"
#include "host_sim/runs/lane_scene.hpp"

namespace sonoglide::runs {
namespace {

/// A loop without its plant, from one carrier period to the next.
class RunningLoop {
 public:
  RunningLoop(const ClosedLoop& loop, loop::ControlRecord& record)
      : periods_(loop.periods),
        scales_(configure::plant_scales(loop.scene)),
        sliding_m_per_s_(loop.scene.sliding.profile.front().velocity_m_per_s),
        natural_Hz_(std::sqrt(loop.scene.plant.stiffness_N_per_m / loop.scene.plant.mass_kg) /
                    numeric::two_pi),
        clock_(loop.scene),
        port_(loop::make_control_port(loop.scene, loop.design)),
        control_(loop.scene, loop::CarrierGrid(loop.scene), *port_, record) {}

  /// @return amplitude of the next period; absent where no whole one follows
  std::optional<double> next_amplitude(double mean_friction) {
    show(mean_friction);
    control_.step(clock_.end_s(), mean_friction * scales_.friction_N, sliding_m_per_s_);
    clock_.next();
    if (clock_.over() || !clock_.is_whole()) {
      control_.finish();
      return std::nullopt;
    }
    return control_.amplitude_N() / scales_.force_N;
  }

 private:
  void show(double mean_friction) {
    loop::Period period;
    period.begin_s = clock_.begin_s();
    period.end_s = clock_.end_s();
    period.friction_ratio = sliding_m_per_s_ < 0.0 ? -mean_friction : mean_friction;
    period.begin_velocity_m_per_s = sliding_m_per_s_;
    period.end_velocity_m_per_s = sliding_m_per_s_;
    period.drive_amplitude_N = control_.amplitude_N();
    period.frequency_Hz = clock_.frequency_Hz();
    period.whole = true;
    period.natural_Hz = natural_Hz_;
    control_.label(period);
    periods_.take(period);
  }

  loop::PeriodSink& periods_;
  scene::PlantScales scales_;
  double sliding_m_per_s_;
  double natural_Hz_;
  loop::CarrierClock clock_;
  std::unique_ptr<loop::ControlPort> port_;
  loop::ControlRun control_;
};

/// The controllers of all loops; there are those of the loops that run.
class Controllers final : public batch::DriveSource {
 public:
  Controllers(const std::vector<ClosedLoop>& loops, std::vector<LoopRun>& runs)
      : loops_(loops), runs_(runs), running_(loops.size()) {}

  std::optional<double> next_amplitude(std::size_t plant, double mean_friction) override {
    std::unique_ptr<RunningLoop>& running = running_[plant];
    if (!running) {
      loop::ControlRecord& record = runs_[plant].control;
      record.design = loops_[plant].design;
      running = std::make_unique<RunningLoop>(loops_[plant], record);
    }
    const std::optional<double> amplitude = running->next_amplitude(mean_friction);
    if (!amplitude) {
      running.reset();
    }
    return amplitude;
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
