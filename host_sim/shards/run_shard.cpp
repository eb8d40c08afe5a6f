#include "host_sim/shards/run_shard.hpp"

#include <fmt/format.h>
#include <tbb/info.h>

#include <chrono>
#include <fstream>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "host_sim/long_work/record_text.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/shards/block_progress.hpp"
#include "host_sim/shards/rows_file.hpp"
#include "host_sim/shards/shard_journal.hpp"

namespace sonoglide::shards {
namespace {

namespace fs = std::filesystem;

void create(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    output::fail(folder, error);
  }
}

/// One copy of a shard at work.
class ShardRun {
 public:
  ShardRun(const ShardHeader& header, const Computation& computation, const fs::path& folder)
      : header_(header), computation_(computation), folder_(folder), progress_(range()) {}

  ShardSummary operator()(long_work::Pace& pace) {
    ShardSummary summary;
    summary.points = range();
    summary.was_there = published();
    if (!summary.was_there) {
      check_once(pace);
      create(folder_);
      journal_.emplace(folder_, header_, [this](std::string_view text) { return take(text); });
      summary.found_finished = progress_.finished();
      summary.was_there = !compute_and_publish(pace, summary);
    }
    journal_.reset();
    remove_journals(folder_, header_.shard());
    return summary;
  }

 private:
  PointRange range() const { return header_.shard().range(header_.work.points); }
  fs::path rows_file() const { return folder_ / rows_name(header_.shard()); }

  /// Whether the shard is there, whole.
  bool published() const {
    std::error_code absent;
    if (!fs::exists(fs::symlink_status(rows_file(), absent))) {
      return false;
    }
    try {
      RowsReader rows(rows_file());
      const Difference other = difference(rows.header().work, header_.work);
      if (!other.none()) {
        throw long_work::ForeignJournal(
            fmt::format("{}: has {}, not {}; allowed: that {} or another folder",
                        process::printable(rows_file().string()), other.of_one, other.of_other,
                        header_.work.kind));
      }
      std::string record;
      while (rows.next(record)) {
      }
      return true;
    } catch (const NoRows& error) {
      output::fail(rows_file(), fmt::format("{}; allowed: another folder, or that file out of the "
                                            "way",
                                            error.what()));
    } catch (const DamagedRows&) {
      return false;
    }
  }

  /// A journal was begun only after all points had been checked.
  void check_once(long_work::Pace& pace) const {
    std::error_code absent;
    const bool begun =
        fs::is_directory(folder_, absent) && !journals_of(folder_, header_.shard()).empty();
    if (!begun && range().size() > 0) {
      computation_.check(range(), pace);
    }
  }

  bool take(std::string_view text) {
    const std::optional<RecordFacts> facts = computation_.facts(text);
    return facts && progress_.take(facts->point);
  }

  /// @return false where another copy was faster; it may have removed what this one works with
  bool compute_and_publish(long_work::Pace& pace, ShardSummary& summary) {
    try {
      if (!compute(pace)) {
        return false;
      }
      publish(summary);
      return true;
    } catch (const output::OutputError&) {
      if (published()) {
        return false;
      }
      throw;
    }
  }

  /// @return false where another copy was faster
  bool compute(long_work::Pace& pace) {
    pace.begin(range().size() - progress_.finished(), 0.0);
    while (!progress_.complete()) {
      if (published()) {
        return false;
      }
      const PointRange block = progress_.block();
      computation_.compute(block, progress_.open_points(),
                           [&](const std::vector<FinishedPoint>& points) {
                             hand_in(points);
                             pace.add(points.size());
                           });
    }
    return !published();
  }

  void hand_in(const std::vector<FinishedPoint>& points) {
    // The text is made before the lock: that is most of the work.
    std::string lines;
    for (const FinishedPoint& each : points) {
      lines += long_work::Journal::line_of(each.record);
    }
    const std::lock_guard<std::mutex> lock(mutex_);
    journal_->append(lines);
    for (const FinishedPoint& each : points) {
      progress_.take(each.point);
    }
  }

  /// Brings the journal in order, a block at a time.
  void publish(ShardSummary& summary) const {
    RowsWriter rows(folder_, header_, journal_->copy());
    std::ifstream journal(journal_->path(), std::ios::binary);
    std::string line;
    std::getline(journal, line);
    for (BlockProgress order(range()); !order.complete();) {
      const PointRange block = order.block();
      std::vector<std::string> texts(block.size());
      while (order.block().first == block.first && !order.complete()) {
        std::optional<std::string_view> text;
        if (std::getline(journal, line)) {
          text = long_work::unsealed(line);
        }
        const auto facts = text ? computation_.facts(*text) : std::nullopt;
        if (!facts || !order.take(facts->point)) {
          output::fail(journal_->path(), "was changed by somebody else; the same command goes on");
        }
        texts[facts->point - block.first] = *text;
        summary.failed += facts->failed ? 1 : 0;
      }
      for (const std::string& text : texts) {
        rows.add(text);
      }
    }
    rows.publish();
  }

  const ShardHeader& header_;
  const Computation& computation_;
  const fs::path& folder_;
  BlockProgress progress_;
  std::mutex mutex_;
  std::optional<ShardJournal> journal_;
};

}  // namespace

ThreadLimit::ThreadLimit(unsigned threads)
    : limit_(tbb::global_control::max_allowed_parallelism,
             threads > 0 ? threads : static_cast<std::size_t>(tbb::info::default_concurrency())) {}

ShardSummary run_shard(const ShardHeader& header, const Computation& computation,
                       const fs::path& folder, unsigned threads,
                       const long_work::Progress& progress) {
  const ThreadLimit limit(threads);
  const auto begin = std::chrono::steady_clock::now();
  long_work::Pace pace(progress);
  ShardSummary summary = ShardRun(header, computation, folder)(pace);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  summary.wall_s = wall.count();
  return summary;
}

}  // namespace sonoglide::shards
