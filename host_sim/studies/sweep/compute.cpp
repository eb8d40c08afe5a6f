#include "host_sim/studies/sweep/compute.hpp"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/partitioner.h>

#include <mutex>
#include <string>
#include <utility>

namespace sonoglide::sweep {
namespace {

/// Where the threads hand in what they have finished.
class Collection {
 public:
  Collection(std::size_t points, Journal& journal, Pace& pace)
      : rows_(points), known_(points), journal_(journal), pace_(pace) {
    for (const Record& record : journal.finished()) {
      take(record);
    }
  }

  void hand_in(std::vector<Record> records) {
    // The text is made before the lock: that is most of the work.
    const std::string text = Journal::text_of(records);
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      journal_.append(text);
      for (Record& record : records) {
        take(std::move(record));
      }
    }
    pace_.add(records.size());
  }

  Points open_points() const {
    Points open;
    for (std::size_t point = 0; point < known_.size(); ++point) {
      if (!known_[point]) {
        open.push_back(point);
      }
    }
    return open;
  }

  std::vector<Row> take_rows() { return std::move(rows_); }

 private:
  void take(Record record) {
    known_[record.point] = true;
    rows_[record.point] = std::move(record.row);
  }

  std::mutex mutex_;
  std::vector<Row> rows_;
  std::vector<bool> known_;
  Journal& journal_;
  Pace& pace_;
};

}  // namespace

std::vector<Row> compute(const Solve& solve, std::size_t points, Journal& journal, Pace& pace) {
  Collection collection(points, journal, pace);
  const Points open = collection.open_points();
  pace.begin(open.size(), 0.0);
  const std::vector<Points> calls = solve.calls(open);
  // One call to a task: those that take long leave the rest to others.
  tbb::parallel_for(
      tbb::blocked_range<std::size_t>(0, calls.size(), 1),
      [&](const tbb::blocked_range<std::size_t>& range) {
        for (std::size_t index = range.begin(); index < range.end(); ++index) {
          solve(calls[index],
                [&](std::vector<Record> records) { collection.hand_in(std::move(records)); });
        }
      },
      tbb::simple_partitioner());
  return collection.take_rows();
}

}  // namespace sonoglide::sweep
