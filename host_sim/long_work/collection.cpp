#include "host_sim/long_work/collection.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <fstream>
#include <system_error>
#include <utility>

#include "host_sim/long_work/rows_file.hpp"
#include "host_sim/long_work/run_shard.hpp"
#include "host_sim/long_work/slurm.hpp"
#include "host_sim/process/file_error.hpp"
#include "host_sim/process/printable.hpp"

namespace sonoglide::long_work {
namespace {

namespace fs = std::filesystem;

std::string printable(const fs::path& path) {
  return process::printable(path.string());
}

struct NamedFile {
  fs::path path;
  ShardFileName name;
};

/// In the order of their shards, rows before journals.
std::vector<NamedFile> files_in(const fs::path& folder) {
  std::vector<NamedFile> files;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end;
       entry.increment(error)) {
    if (const auto name = parse_file_name(entry->path().filename().string())) {
      files.push_back({entry->path(), *name});
    }
  }
  if (error) {
    process::fail(folder, error);
  }
  std::sort(files.begin(), files.end(), [](const NamedFile& a, const NamedFile& b) {
    return std::tie(a.name.shard.number, a.name.kind, a.path) <
           std::tie(b.name.shard.number, b.name.kind, b.path);
  });
  return files;
}

std::uint64_t lines_in(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 1U << 16U> part{};
  std::uint64_t lines = 0;
  while (stream) {
    stream.read(part.data(), part.size());
    lines +=
        static_cast<std::uint64_t>(std::count(part.begin(), part.begin() + stream.gcount(), '\n'));
  }
  return lines;
}

double idle_s(const fs::path& file) {
  std::error_code gone;
  const fs::file_time_type written = fs::last_write_time(file, gone);
  const std::chrono::duration<double> idle = fs::file_time_type::clock::now() - written;
  return gone ? 0.0 : std::max(0.0, idle.count());
}

}  // namespace

Collection::Collection(fs::path folder) : folder_(std::move(folder)) {
  const std::vector<NamedFile> files = files_in(folder_);
  for (const NamedFile& file : files) {
    const Shard& first = files.front().name.shard;
    if (file.name.shard.count != first.count) {
      throw UnusableShards(fmt::format(
          "{} is one of {} shards and {} one of {}; allowed: those of "
          "one sweep in a folder",
          printable(files.front().path), first.count, printable(file.path), file.name.shard.count));
    }
    there_.resize(first.count);
    note(file.path, file.name);
  }
  if (!work_) {
    const std::string message = fmt::format(
        "{} holds no shard; allowed: a folder that --shard wrote to", printable(folder_));
    damages_.empty() ? throw NoShards(message) : throw UnusableShards(message);
  }
}

void Collection::note(const fs::path& file, const ShardFileName& name) {
  if (name.kind == ShardFileName::Kind::journal) {
    std::error_code unknown;
    const auto header =
        fs::is_regular_file(file, unknown) ? journal_header(file) : std::optional<ShardHeader>();
    if (header) {
      compare(file, header->work);
      fs::path& longest = journals_[name.shard.number];
      std::error_code gone;
      if (longest.empty() || fs::file_size(file, gone) > fs::file_size(longest, gone)) {
        longest = file;
      }
    }
    return;
  }
  try {
    const RowsReader rows(file);
    if (rows.header().number != name.shard.number) {
      throw UnusableShards(
          fmt::format("{} is by its header shard {}; allowed: the name that it had",
                      printable(file), rows.header().number));
    }
    compare(file, rows.header().work);
    there_[name.shard.number - 1] = true;
  } catch (const DamagedRows& damage) {
    damages_.push_back(fmt::format("{} {}", printable(file), damage.what()));
  }
}

void Collection::compare(const fs::path& file, const Work& work) {
  if (!work_) {
    work_ = work;
    work_file_ = file;
    return;
  }
  const Difference found = difference(*work_, work);
  if (!found.none()) {
    throw UnusableShards(
        fmt::format("{} has {} and {} has {}; allowed: shards of one command and "
                    "one program",
                    printable(work_file_), found.of_one, printable(file), found.of_other));
  }
}

void Collection::require_kind(const std::string& kind) const {
  if (work().kind != kind) {
    throw UnusableShards(fmt::format("{} is of a {}; allowed: shards of a {}",
                                     printable(work_file_), work().kind, kind));
  }
}

void Collection::require_of(const std::string& kind, const std::string& program,
                            const std::string& arithmetic) const {
  Work asked = work();
  asked.kind = kind;
  asked.program = program;
  asked.arithmetic = arithmetic;
  const Difference found = difference(work(), asked);
  if (!found.none()) {
    throw UnusableShards(
        fmt::format("{} has {}, this command {}; allowed: the program that has "
                    "computed the shards",
                    printable(work_file_), found.of_one, found.of_other));
  }
}

std::vector<std::uint64_t> Collection::missing() const {
  std::vector<std::uint64_t> numbers;
  for (std::uint64_t number = 1; number <= there_.size(); ++number) {
    if (!there_[number - 1]) {
      numbers.push_back(number);
    }
  }
  return numbers;
}

std::uint64_t Collection::points_there() const {
  std::uint64_t points = 0;
  for (std::uint64_t number = 1; number <= there_.size(); ++number) {
    points += there_[number - 1] ? Shard{number, there_.size()}.range(work().points).size() : 0;
  }
  return points;
}

std::vector<BegunShard> Collection::begun() const {
  std::vector<BegunShard> shards;
  for (const auto& [number, journal] : journals_) {
    if (!there_[number - 1]) {
      const std::uint64_t points = Shard{number, there_.size()}.range(work().points).size();
      const std::uint64_t lines = lines_in(journal);
      shards.push_back(
          {number, std::min(points, lines > 0 ? lines - 1 : 0), points, idle_s(journal)});
    }
  }
  return shards;
}

void Collection::for_each_record(const TakeRecord& take) const {
  std::vector<std::uint64_t> absent = missing();
  for (std::uint64_t number = 1; number <= there_.size(); ++number) {
    if (!there_[number - 1]) {
      continue;
    }
    const fs::path file = folder_ / rows_name({number, there_.size()});
    try {
      RowsReader rows(file);
      std::uint64_t point = rows.range().first;
      for (std::string record; rows.next(record); ++point) {
        if (absent.empty() && !take(point, record)) {
          throw DamagedRows(fmt::format("has no record of point {} in its place", point));
        }
      }
    } catch (const DamagedRows& damage) {
      damages_.push_back(fmt::format("{} {}", printable(file), damage.what()));
      absent.push_back(number);
    }
  }
  if (!absent.empty()) {
    std::sort(absent.begin(), absent.end());
    fail(std::move(absent));
  }
}

void Collection::fail(std::vector<std::uint64_t> missing) const {
  std::string message =
      fmt::format("{}: {} of {} shards are missing; run them again: {}", printable(folder_),
                  missing.size(), there_.size(), array_text(missing));
  for (const std::string& damage : damages_) {
    message += '\n' + damage;
  }
  throw Incomplete(message, std::move(missing));
}

}  // namespace sonoglide::long_work
