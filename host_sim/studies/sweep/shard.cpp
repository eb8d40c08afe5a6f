#include "host_sim/studies/sweep/shard.hpp"

#include <fmt/format.h>
#include <tbb/global_control.h>
#include <tbb/info.h>

#include <chrono>
#include <fstream>
#include <mutex>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "host_sim/batch/run_dahl_plants.hpp"
#include "host_sim/long_work/record_text.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/shards/rows_file.hpp"
#include "host_sim/shards/shard_journal.hpp"
#include "host_sim/studies/sweep/block_progress.hpp"
#include "host_sim/studies/sweep/journal.hpp"
#include "host_sim/studies/sweep/solve.hpp"

namespace sonoglide::sweep {
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
  ShardRun(const Plan& plan, const shards::ShardHeader& header, const fs::path& folder)
      : plan_(plan), header_(header), folder_(folder), progress_(range()) {}

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
    shards::remove_journals(folder_, header_.shard());
    return summary;
  }

 private:
  PointRange range() const { return header_.shard().range(header_.work.points); }
  fs::path rows_file() const { return folder_ / shards::rows_name(header_.shard()); }

  /// Whether the shard is there, whole.
  bool published() const {
    std::error_code absent;
    if (!fs::exists(fs::symlink_status(rows_file(), absent))) {
      return false;
    }
    try {
      shards::RowsReader rows(rows_file());
      const shards::Difference other = shards::difference(rows.header().work, header_.work);
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
    } catch (const shards::NoRows& error) {
      output::fail(rows_file(), fmt::format("{}; allowed: another folder, or that file out of the "
                                            "way",
                                            error.what()));
    } catch (const shards::DamagedRows&) {
      return false;
    }
  }

  /// A journal was begun only after all points had been checked.
  void check_once(long_work::Pace& pace) const {
    std::error_code absent;
    const bool begun =
        fs::is_directory(folder_, absent) && !shards::journals_of(folder_, header_.shard()).empty();
    if (!begun && range().size() > 0) {
      pace.begin(range().size(), 1.0 + expected_solving_cost(plan_, range()));
      plan_.visit(
          range(), [](std::size_t, const scene::Scene&) {}, &pace);
    }
  }

  bool take(std::string_view text) {
    const std::optional<Record> record = parse_record(text);
    return record && progress_.take(record->point);
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
      const Points open = progress_.open_points();
      const Solve solve(plan_, progress_.block(), nullptr);
      solve_all(solve, open, [&](const std::vector<Record>& records) {
        hand_in(records);
        pace.add(records.size());
      });
    }
    return !published();
  }

  void hand_in(const std::vector<Record>& records) {
    // The text is made before the lock: that is most of the work.
    const std::string text = Journal::text_of(records);
    const std::lock_guard<std::mutex> lock(mutex_);
    journal_->append(text);
    for (const Record& record : records) {
      progress_.take(record.point);
    }
  }

  /// Brings the journal in order, a block at a time.
  void publish(ShardSummary& summary) const {
    shards::RowsWriter rows(folder_, header_, journal_->copy());
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
        const auto record = text ? parse_record(*text) : std::nullopt;
        if (!record || !order.take(record->point)) {
          output::fail(journal_->path(), "was changed by somebody else; the same command goes on");
        }
        texts[record->point - block.first] = *text;
        summary.failed += record->row.ok() ? 0 : 1;
      }
      for (const std::string& text : texts) {
        rows.add(text);
      }
    }
    rows.publish();
  }

  const Plan& plan_;
  const shards::ShardHeader& header_;
  const fs::path& folder_;
  BlockProgress progress_;
  std::mutex mutex_;
  std::optional<shards::ShardJournal> journal_;
};

}  // namespace

shards::Work work_of(const Plan& plan, const std::string& program, std::uint64_t shards) {
  return {"sweep",
          program,
          batch::arithmetic,
          plan.source().name(),
          plan.source().text,
          plan.overrides(),
          plan.vary(),
          plan.grid().size(),
          shards};
}

ShardSummary run_shard(const Plan& plan, const shards::Shard& shard, const fs::path& folder,
                       const std::string& program, unsigned threads,
                       const long_work::Progress& progress) {
  const tbb::global_control limit(
      tbb::global_control::max_allowed_parallelism,
      threads > 0 ? threads : static_cast<std::size_t>(tbb::info::default_concurrency()));
  const auto begin = std::chrono::steady_clock::now();
  long_work::Pace pace(progress);
  const shards::ShardHeader header{work_of(plan, program, shard.count), shard.number};
  ShardSummary summary = ShardRun(plan, header, folder)(pace);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - begin;
  summary.wall_s = wall.count();
  return summary;
}

}  // namespace sonoglide::sweep
