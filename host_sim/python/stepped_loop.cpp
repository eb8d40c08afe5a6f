#include "host_sim/python/stepped_loop.hpp"

#include <fmt/format.h>

#include <stdexcept>

#include "host_sim/loop/carrier_grid.hpp"
#include "host_sim/loop/stepped.hpp"

namespace sonoglide::python {
namespace {

const configure::Experiment& usable(const configure::Experiment& experiment) {
  loop::require_usable(experiment.plant, loop::Kind::loop);
  loop::require_constant_carrier(experiment.plant);
  return experiment;
}

}  // namespace

SteppedLoop::SteppedLoop(const configure::Experiment& experiment)
    : experiment_(usable(experiment)),
      period_s_(1.0 / experiment.plant.drive->frequency_Hz),
      scene_periods_(loop::CarrierGrid(experiment.plant).count()),
      schedule_(loop::target_schedule(experiment.plant, loop::CarrierGrid(experiment.plant))) {
  reset(std::nullopt);
}

void SteppedLoop::reset(std::optional<std::uint64_t> seed) {
  std::uint64_t& own = experiment_.plant.sensor.seed;
  own = seed.value_or(own);
  engine_ = std::make_unique<loop::SteppedScene>(experiment_, loop::Kind::loop);
  periods_ = 0;
  wanted_ratio_ = coming_ratio();
}

void SteppedLoop::step(double target) {
  if (!(target >= 0.0 && target <= 1.0)) {
    throw std::invalid_argument(
        fmt::format("target is {}; allowed: a friction ratio above 0, at most 1, or None", target));
  }
  loop::Inputs inputs;
  inputs.target_friction_ratio = target;
  wanted_ratio_ = coming_ratio();
  engine_->advance(inputs);
  ++periods_;
}

double SteppedLoop::coming_ratio() const {
  double wanted = schedule_.front().friction_ratio;
  for (const loop::ScheduledTarget& each : schedule_) {
    if (each.place <= periods_) {
      wanted = each.friction_ratio;
    }
  }
  return wanted;
}

loop::Snapshot SteppedLoop::save() const {
  loop::SnapshotWriter writer;
  writer.put(periods_);
  writer.put(wanted_ratio_);
  engine_->save(writer);
  return writer.take();
}

void SteppedLoop::restore(const loop::Snapshot& state) {
  loop::SnapshotReader reader(state);
  reader.get(periods_);
  reader.get(wanted_ratio_);
  engine_->restore(reader);
  if (!reader.over()) {
    throw std::invalid_argument("the state that is to be restored is too long");
  }
}

}  // namespace sonoglide::python
