#include "host_sim/long_work/run_shard.hpp"

#include <fmt/format.h>

#include <optional>
#include <string>
#include <system_error>

#include "host_sim/long_work/rows_file.hpp"
#include "host_sim/long_work/shard_journal.hpp"
#include "host_sim/process/printable.hpp"

namespace sonoglide::long_work {
namespace {

namespace fs = std::filesystem;

void create(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    output::fail(folder, error);
  }
}

/// What a file in the folder says that it is a part of; absent where it is damaged or no such file.
std::optional<Work> work_in(const fs::directory_entry& file, ShardFileName::Kind kind) try {
  std::error_code unknown;
  if (kind == ShardFileName::Kind::rows) {
    return RowsReader(file.path()).header().work;
  }
  const auto header =
      file.is_regular_file(unknown) ? journal_header(file.path()) : std::optional<ShardHeader>();
  return header ? std::optional(header->work) : std::nullopt;
} catch (const NoRows&) {
  return std::nullopt;
}

/// @throws ForeignJournal  the file is a part of other work
void require_same(const fs::path& file, const Work& found, const Work& work) {
  const Difference other = difference(found, work);
  if (!other.none()) {
    throw ForeignJournal(fmt::format("{}: has {}, not {}; allowed: that {} or another folder",
                                     process::printable(file.string()), other.of_one,
                                     other.of_other, work.kind));
  }
}

/// Asks one of the other shards in the folder, as each was asked when it came.
/// @throws ForeignJournal  it is of other work
void require_place(const fs::path& folder, const ShardHeader& header) {
  std::error_code absent;
  for (fs::directory_iterator entry(folder, absent), end; !absent && entry != end;
       entry.increment(absent)) {
    const auto name = parse_file_name(entry->path().filename().string());
    const bool own =
        name && name->shard.number == header.number && name->shard.count == header.work.shards;
    const auto work = name && !own ? work_in(*entry, name->kind) : std::nullopt;
    if (work) {
      require_same(entry->path(), *work, header.work);
      return;
    }
  }
}

/// One copy of a shard at work.
class ShardRun {
 public:
  ShardRun(const ShardHeader& header, const Computation& computation, const fs::path& folder)
      : header_(header),
        computation_(computation),
        folder_(folder),
        points_(range(), computation) {}

  ShardSummary operator()(const CheckPoints& check, Pace& pace) {
    ShardSummary summary;
    summary.points = range();
    summary.was_there = published();
    if (!summary.was_there) {
      require_place(folder_, header_);
      check_once(check, pace);
      create(folder_);
      journal_.emplace(folder_, header_,
                       [this](std::string_view record) { return points_.take(record); });
      summary.found_finished = points_.finished();
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
      require_same(rows_file(), rows.header().work, header_.work);
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
  void check_once(const CheckPoints& check, Pace& pace) const {
    std::error_code absent;
    const bool begun =
        fs::is_directory(folder_, absent) && !journals_of(folder_, header_.shard()).empty();
    if (!begun && range().size() > 0) {
      check(range(), pace);
    }
  }

  /// @return false where another copy was faster; it may have removed what this one works with
  bool compute_and_publish(Pace& pace, ShardSummary& summary) {
    try {
      if (!points_.compute(journal_->file(), pace, 0, [this] { return !published(); })) {
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

  void publish(ShardSummary& summary) {
    RowsWriter rows(folder_, header_, journal_->copy());
    points_.for_each_record(journal_->file(), [&](std::uint64_t, const std::string& record) {
      rows.add(record);
      summary.failed += computation_.facts(record)->failed ? 1 : 0;
      return true;
    });
    rows.publish();
  }

  const ShardHeader& header_;
  const Computation& computation_;
  const fs::path& folder_;
  KeptPoints points_;
  std::optional<ShardJournal> journal_;
};

}  // namespace

ShardSummary run_shard(const ShardHeader& header, const CheckPoints& check,
                       const Computation& computation, const fs::path& folder,
                       const Progress& progress) {
  const double begin_s = steady_time_s();
  Pace pace(progress);
  ShardSummary summary = ShardRun(header, computation, folder)(check, pace);
  summary.wall_s = steady_time_s() - begin_s;
  return summary;
}

}  // namespace sonoglide::long_work
