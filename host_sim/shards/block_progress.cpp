#include "host_sim/shards/block_progress.hpp"

#include <algorithm>

namespace sonoglide::shards {

std::vector<std::uint64_t> BlockProgress::open_points() const {
  std::vector<std::uint64_t> open;
  for (std::uint64_t point = block_.first; point < block_.end; ++point) {
    if (!known_[point - block_.first]) {
      open.push_back(point);
    }
  }
  return open;
}

bool BlockProgress::take(std::uint64_t point) {
  if (point < block_.first || point >= block_.end || known_[point - block_.first]) {
    return false;
  }
  known_[point - block_.first] = true;
  if (++finished_in_block_ == block_.size()) {
    begin(block_.end);
  }
  return true;
}

void BlockProgress::begin(std::uint64_t first) {
  block_ = {first, std::min<std::uint64_t>(points_.end, first + points_per_block)};
  known_.assign(block_.size(), false);
  finished_in_block_ = 0;
}

}  // namespace sonoglide::shards
