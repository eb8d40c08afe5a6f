/// Which points of a shard are finished, a block after the other.
#pragma once

#include <cstdint>
#include <vector>

#include "host_sim/shards/shard.hpp"

namespace sonoglide::shards {

/// Points that are read, computed and kept together: the memory of a shard. Enough for hundreds of
/// calls over SIMD lanes, so that no core waits for long at a block's end.
inline constexpr std::uint64_t points_per_block = 65536;

/// A block is begun when the one before it is finished, so that what is known of a shard is the
/// number of its block and which of the points in there are finished.
class BlockProgress {
 public:
  explicit BlockProgress(const PointRange& points) : points_(points) { begin(points.first); }

  bool complete() const { return block_.first == points_.end; }
  /// Empty where all is complete.
  const PointRange& block() const { return block_; }
  std::vector<std::uint64_t> open_points() const;
  std::uint64_t finished() const { return block_.first - points_.first + finished_in_block_; }

  /// @return false for a point that is not in the block or is finished already
  bool take(std::uint64_t point);

 private:
  void begin(std::uint64_t first);

  PointRange points_;
  PointRange block_;
  std::vector<bool> known_;
  std::uint64_t finished_in_block_ = 0;
};

}  // namespace sonoglide::shards
