#include "host_sim/long_work/run_shard.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <optional>
#include <string>
#include <system_error>

#include "host_sim/long_work/record.hpp"
#include "host_sim/long_work/rows_file.hpp"
#include "host_sim/process/file_error.hpp"
#include "host_sim/process/pipe.hpp"
#include "host_sim/process/printable.hpp"

namespace sonoglide::long_work {
namespace {

namespace fs = std::filesystem;

/// As a part of a file's name.
std::string node_name() {
  constexpr std::size_t most_bytes = 64;
  std::array<char, most_bytes + 1> name{};
  if (gethostname(name.data(), most_bytes) != 0 || name.front() == '\0') {
    return "node";
  }
  std::string node = name.data();
  std::replace_if(
      node.begin(), node.end(),
      [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '-');
  return node;
}

Identity identity_of(const ShardHeader& header) {
  return {header.work.program, header.work.scene, header_text(header)};
}

std::uintmax_t size_of(const fs::path& file) {
  std::error_code gone;
  const std::uintmax_t size = fs::file_size(file, gone);
  return gone ? 0 : size;
}

/// The longest of the journals but for one; empty where there is no other.
fs::path longest_but(const fs::path& one, const std::vector<fs::path>& journals) {
  fs::path longest;
  for (const fs::path& each : journals) {
    if (each != one && (longest.empty() || size_of(each) > size_of(longest))) {
      longest = each;
    }
  }
  return longest;
}

}  // namespace

std::vector<fs::path> journals_of(const fs::path& folder, const Shard& shard) {
  std::vector<fs::path> journals;
  std::error_code unknown;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    const auto name = parse_file_name(entry->path().filename().string());
    if (name && entry->is_regular_file(unknown) && name->kind == ShardFileName::Kind::journal &&
        name->shard.number == shard.number && name->shard.count == shard.count) {
      journals.push_back(entry->path());
    }
  }
  if (error) {
    process::fail(folder, error);
  }
  std::sort(journals.begin(), journals.end());
  return journals;
}

std::optional<ShardHeader> journal_header(const fs::path& journal) {
  std::ifstream stream(journal, std::ios::binary);
  std::string line;
  if (!next_line(stream, line)) {
    return std::nullopt;
  }
  const std::optional<Identity> identity = Journal::identity_in(line);
  return identity ? parse_header(identity->options) : std::nullopt;
}

ShardJournal::ShardJournal(const fs::path& folder, const ShardHeader& header,
                           const Journal::Take& take) {
  constexpr int most_copies = 99;
  const std::string kind = fmt::format("{} in shards", header.work.kind);
  const std::string node = node_name();
  const std::vector<fs::path> journals = journals_of(folder, header.shard());
  for (int number = 1; !journal_; ++number) {
    copy_ = number == 1 ? node : fmt::format("{}-{}", node, number);
    const fs::path path = folder / journal_name(header.shard(), copy_);
    try {
      journal_.emplace(path, JournalKind{kind.c_str(), "options, --set or shards"},
                       identity_of(header), take, longest_but(path, journals));
    } catch (const JournalInUse&) {
      if (number == most_copies) {
        throw;
      }
    }
  }
}

void remove_journals(const fs::path& folder, const Shard& shard) {
  for (const fs::path& journal : journals_of(folder, shard)) {
    const process::Descriptor file(open(journal.c_str(), O_RDWR | O_CLOEXEC));
    if (file.number() >= 0 && process::lock(file, LOCK_EX | LOCK_NB) &&
        process::stands(file, journal)) {
      unlink((folder / staged_name(shard, copy_of(shard, journal.filename().string()))).c_str());
      unlink(journal.c_str());
    }
  }
}

namespace {

namespace fs = std::filesystem;

void create(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) {
    process::fail(folder, error);
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
      process::fail(rows_file(), fmt::format("{}; allowed: another folder, or that file out of the "
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
    } catch (const process::FileError&) {
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
