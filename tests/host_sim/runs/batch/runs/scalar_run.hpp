/// The scalar solver on a batch plant: what the lanes are measured against.
#pragma once

#include <cstdint>

#include "firmware/friction/dahl.hpp"
#include "firmware/plant/account.hpp"
#include "firmware/plant/drive.hpp"
#include "firmware/plant/model.hpp"
#include "firmware/plant/solver.hpp"
#include "firmware/plant/taylor/event_taylor.hpp"
#include "host_sim/runs/batch/run_dahl_plants.hpp"
#include "tests/common/constants/pi.hpp"

namespace sonoglide::batch {

using tests::two_pi;

/// Order 16, tolerance 1e-12, one interval for each period.
inline DahlRun scalar_run(const DahlPlant& plant, const RunLength& length) {
  using Model = plant::Model<friction::Dahl<double>, plant::Damped<double>, plant::CosineDrive>;
  const Model model = {{{plant.contact_stiffness}, plant.friction_force, plant.vibration_sign},
                       {plant.damping},
                       plant.stiffness};
  plant::EventTaylor<Model, 16> solver;
  solver.configure(model, 1e-12);
  plant::NoObserver observer;
  DahlRun run;
  run.status = RunStatus::solved;
  run.final_state = plant.initial;
  for (std::uint32_t period = 0; period < length.periods; ++period) {
    plant::EnergyAccount<double> account;
    const plant::Interval<double> interval = {0.0, two_pi, plant.drive_amplitude,
                                              plant.sliding_velocity, 0.0};
    if (solver.advance(interval, run.final_state, account, observer).error != plant::Error::none) {
      run.status = RunStatus::not_finite;
      return run;
    }
    const auto add = [&account](FrictionAverages& sums) {
      sums.friction_ratio += account.friction_integral;
      sums.friction_work += account.friction_work;
    };
    add(run.whole);
    if (period >= length.window_start_periods) {
      add(run.window);
    }
  }
  run.whole.friction_ratio /= two_pi * length.periods;
  run.window.friction_ratio /= two_pi * (length.periods - length.window_start_periods);
  return run;
}

}  // namespace sonoglide::batch
