/// What passes between a controller and a board, and what each of them costs.
#pragma once

#include <cstdint>

#include "hal/board.hpp"
#include "hal/start/counter.hpp"
#include "hal/trace_hash.hpp"

namespace sonoglide::image {

/// Smallest, largest and sum of counts, in the unit of the processor's counter.
class CountRange {
 public:
  void add(std::uint32_t count) {
    least_ = count < least_ ? count : least_;
    most_ = count > most_ ? count : most_;
    sum_ += count;
  }
  std::uint32_t least() const { return least_; }
  std::uint32_t most() const { return most_; }
  std::uint64_t sum() const { return sum_; }

 private:
  std::uint32_t least_ = UINT32_MAX;
  std::uint32_t most_ = 0;
  std::uint64_t sum_ = 0;
};

/// A board that hashes its samples and drives, and reads the processor's counter at the begin and
/// the end of every call: sampling is the board's own work, answering the controller's.
template <class Board>
class WatchedBoard {
 public:
  explicit WatchedBoard(Board& board) : board_(board) { start_counter(); }

  bool sample(hal::Sample& sample) {
    const std::uint32_t begin = read_counter();
    if (!board_.sample(sample)) {
      return false;
    }
    const std::uint32_t end = read_counter();
    sampling_.add(end - begin);
    samples_.add(sample);
    sampled_ = read_counter();
    return true;
  }

  void drive(const hal::Drive& drive) {
    answering_.add(read_counter() - sampled_);
    drives_.add(drive);
    board_.drive(drive);
    ++periods_;
  }

  std::uint32_t periods() const { return periods_; }  ///< answered
  std::uint64_t sample_hash() const { return samples_.value(); }
  std::uint64_t trace_hash() const { return drives_.value(); }
  const CountRange& sampling() const { return sampling_; }
  const CountRange& answering() const { return answering_; }

 private:
  Board& board_;
  hal::TraceHash samples_;
  hal::TraceHash drives_;
  CountRange sampling_;
  CountRange answering_;
  std::uint32_t sampled_ = 0;
  std::uint32_t periods_ = 0;
};

}  // namespace sonoglide::image
