/// Which points of a shard are finished, a block after the other.
#pragma once

#include <cstddef>
#include <vector>

#include "host_sim/studies/sweep/plan.hpp"
#include "host_sim/studies/sweep/solve.hpp"

namespace sonoglide::sweep {

/// Points that are read, solved and kept together: the memory of a shard. Enough for hundreds of
/// calls over SIMD lanes, so that no core waits for long at a block's end.
inline constexpr std::size_t points_per_block = 65536;

/// A block is begun when the one before it is finished, so that what is known of a shard is the
/// number of its block and which of the points in there are finished.
class BlockProgress {
 public:
  explicit BlockProgress(const PointRange& points) : points_(points) { begin(points.first); }

  bool complete() const { return block_.first == points_.end; }
  /// Empty where all is complete.
  const PointRange& block() const { return block_; }
  Points open_points() const;
  std::size_t finished() const { return block_.first - points_.first + finished_in_block_; }

  /// @return false for a point that is not in the block or is finished already
  bool take(std::size_t point);

 private:
  void begin(std::size_t first);

  PointRange points_;
  PointRange block_;
  std::vector<bool> known_;
  std::size_t finished_in_block_ = 0;
};

}  // namespace sonoglide::sweep
