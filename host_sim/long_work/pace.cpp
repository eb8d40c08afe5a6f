#include "host_sim/long_work/pace.hpp"

#include <utility>

namespace sonoglide::long_work {

Pace::Pace(const Progress& progress, std::function<double()> now_s)
    : progress_(progress), now_s_(std::move(now_s)), start_s_(now_s_()), stage_start_s_(start_s_) {}

void Pace::begin(std::size_t points, double later) {
  stage_start_s_ = now_s_();
  later_ = later;
  points_ = points;
  done_ = 0;
}

void Pace::add(std::size_t points) {
  const std::lock_guard<std::mutex> lock(mutex_);
  done_ += points;
  if (!progress_ || done_ == 0) {
    return;
  }
  const double now = now_s_();
  const double per_point_s = (now - stage_start_s_) / static_cast<double>(done_);
  const double left_s =
      per_point_s * (static_cast<double>(points_ - done_) + later_ * static_cast<double>(points_));
  const double gone_s = now - start_s_;
  progress_(gone_s > 0.0 ? gone_s / (gone_s + left_s) : 0.0);
}

}  // namespace sonoglide::long_work
