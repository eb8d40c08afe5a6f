#include "host_sim/long_work/shard_journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <system_error>

#include "host_sim/long_work/record.hpp"
#include "host_sim/output/written_files.hpp"
#include "host_sim/process/pipe.hpp"

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
    output::fail(folder, error);
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

}  // namespace sonoglide::long_work
