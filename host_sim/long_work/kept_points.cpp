#include "host_sim/long_work/kept_points.hpp"

#include <algorithm>
#include <fstream>
#include <mutex>
#include <string>

#include "host_sim/process/file_error.hpp"

namespace sonoglide::long_work {

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

bool KeptPoints::take(std::string_view record) {
  const std::optional<RecordFacts> facts = computation_.facts(record);
  return facts && progress_.take(facts->point);
}

bool KeptPoints::compute(Journal& journal, Pace& pace, std::uint64_t later_points,
                         const std::function<bool()>& goes_on) {
  const std::uint64_t open = points_.size() - finished();
  pace.begin(open, static_cast<double>(later_points) / std::max(1.0, static_cast<double>(open)));
  std::mutex mutex;
  while (!complete()) {
    if (!goes_on()) {
      return false;
    }
    // A copy: the last of its points begins the next block.
    const PointRange block = progress_.block();
    computation_.compute(block, progress_.open_points(),
                         [&](const std::vector<FinishedPoint>& points) {
                           journal.append(points);
                           {
                             const std::lock_guard<std::mutex> lock(mutex);
                             for (const FinishedPoint& each : points) {
                               progress_.take(each.point);
                             }
                           }
                           pace.add(points.size());
                         });
  }
  return goes_on();
}

/// Brings the journal in order, a block at a time.
void KeptPoints::for_each_record(const Journal& journal, const TakeRecord& take) const {
  const auto require = [&journal](bool holds) {
    if (!holds) {
      process::fail(journal.path(), "was changed by somebody else; the same command goes on");
    }
  };
  std::ifstream stream(journal.path(), std::ios::binary);
  std::string line;
  std::getline(stream, line);
  for (BlockProgress order(points_); !order.complete();) {
    const PointRange block = order.block();
    std::vector<std::string> texts(block.size());
    while (order.block().first == block.first && !order.complete()) {
      std::optional<std::string_view> text;
      if (std::getline(stream, line)) {
        text = unsealed(line);
      }
      const auto facts = text ? computation_.facts(*text) : std::nullopt;
      require(facts && order.take(facts->point));
      texts[facts->point - block.first] = *text;
    }
    for (std::uint64_t point = block.first; point < block.end; ++point) {
      require(take(point, texts[point - block.first]));
    }
  }
}

}  // namespace sonoglide::long_work
