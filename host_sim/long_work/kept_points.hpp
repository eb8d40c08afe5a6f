/// Numbered points, computed block after block and kept in a journal.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "host_sim/long_work/journal.hpp"
#include "host_sim/long_work/pace.hpp"
#include "host_sim/long_work/record.hpp"
#include "host_sim/long_work/work.hpp"

namespace sonoglide::long_work {

/// Points that are computed and kept together: the memory of a shard. Enough for hundreds of calls
/// over SIMD lanes, so that no core waits for long at a block's end.
inline constexpr std::uint64_t points_per_block = 65536;

/// A block is begun when the one before it is finished, so that what is known of a range is the
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

/// Takes finished points, from any thread.
using Sink = std::function<void(const std::vector<FinishedPoint>& points)>;

/// How points are computed. A record depends on its point alone, to the bit.
struct Computation {
  /// Computes the open points of a block, on all threads.
  std::function<void(const PointRange& block, const std::vector<std::uint64_t>& open,
                     const Sink& sink)>
      compute;
  /// Absent for a text that is no record.
  std::function<std::optional<RecordFacts>(std::string_view record)> facts;
};

/// The points of a whole study or of a shard: those that the journal holds and, into it, the others.
/// The records are the same to the bit for any number of threads and after any interruption.
class KeptPoints {
 public:
  KeptPoints(const PointRange& points, Computation computation)
      : points_(points), computation_(std::move(computation)), progress_(points) {}

  /// Takes a record that the journal holds, as Journal::Take.
  bool take(std::string_view record);

  bool complete() const { return progress_.complete(); }
  std::uint64_t finished() const { return progress_.finished(); }

  /// Computes what is open.
  /// @param pace          told of the points computed, a stage
  /// @param later_points  to be computed in later stages
  /// @param goes_on       asked before each block and at the end; false ends it
  /// @return what goes_on has said last
  /// @throws process::FileError  the journal cannot be written
  bool compute(
      Journal& journal, Pace& pace, std::uint64_t later_points = 0,
      const std::function<bool()>& goes_on = [] { return true; });

  /// All points are finished: gives each record in their order, as Collection does.
  /// @throws process::FileError  somebody else has changed the journal
  void for_each_record(const Journal& journal, const TakeRecord& take) const;

 private:
  PointRange points_;
  Computation computation_;
  BlockProgress progress_;
};

}  // namespace sonoglide::long_work
