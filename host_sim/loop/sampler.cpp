#include "host_sim/loop/sampler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "host_sim/loop/plant/plant_port.hpp"

namespace sonoglide::loop {
namespace {

/// A sample that is meant to fall on an end may miss it by rounding, relative to the interval.
constexpr double rounding = 1e-9;

std::uint64_t sample_count(const SampleGrid& grid) {
  const double intervals = std::floor((grid.end_s - grid.begin_s) / grid.interval_s + rounding);
  return static_cast<std::uint64_t>(intervals) + 1;
}

}  // namespace

Sampler::Sampler(const std::vector<Sampling>& wanted, bool has_load) : has_load_(has_load) {
  for (const Sampling& sampling : wanted) {
    requests_.push_back({sampling.grid, sample_count(sampling.grid), sampling.sink});
  }
  foresee();
}

const std::vector<double>& Sampler::plan(double begin_s, double end_s, bool last) {
  planned_.clear();
  for (Request& request : requests_) {
    const double limit_s = end_s + (last ? rounding : -rounding) * request.grid.interval_s;
    for (; request.next < request.count && request.next_time_s() < limit_s; ++request.next) {
      const double offset_s = std::clamp(request.next_time_s() - begin_s, 0.0, end_s - begin_s);
      planned_.push_back({offset_s, request.sink});
    }
  }
  std::stable_sort(planned_.begin(), planned_.end(),
                   [](const Planned& a, const Planned& b) { return a.offset_s < b.offset_s; });
  offsets_s_.clear();
  for (const Planned& planned : planned_) {
    offsets_s_.push_back(planned.offset_s);
  }
  foresee();
  return offsets_s_;
}

void Sampler::deliver(double begin_s, const Stretch& stretch, const std::vector<PlantState>& seen,
                      double pulled_m) const {
  for (std::size_t i = 0; i < planned_.size(); ++i) {
    const double offset_s = planned_[i].offset_s;
    const double given_m_per_s =
        stretch.sliding_velocity_m_per_s + stretch.sliding_acceleration_m_per_s2 * offset_s;
    const double pulled_here_m =
        pulled_m + 0.5 * (stretch.sliding_velocity_m_per_s + given_m_per_s) * offset_s;
    planned_[i].sink->take({begin_s + offset_s, seen[i], drive_force_N(stretch, offset_s),
                            has_load_ ? seen[i].load_velocity_m_per_s : given_m_per_s,
                            has_load_ ? seen[i].load_extension_m + pulled_here_m : 0.0});
  }
}

void Sampler::foresee() {
  next_s_ = std::numeric_limits<double>::infinity();
  for (const Request& request : requests_) {
    if (request.next < request.count) {
      next_s_ = std::min(next_s_, request.next_time_s() - rounding * request.grid.interval_s);
    }
  }
}

}  // namespace sonoglide::loop
