#include "host_sim/long_work/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "host_sim/long_work/pace.hpp"
#include "host_sim/process/pipe.hpp"
#include "host_sim/process/printable.hpp"

namespace sonoglide::long_work {
namespace {

constexpr double sync_interval_s = 1.0;

std::string format_name(const JournalKind& kind) {
  return fmt::format("sonoglide {} journal, format 2", kind.work);
}

}  // namespace

Journal::Journal(std::filesystem::path path, const JournalKind& kind, const Identity& identity,
                 const Take& take, const std::filesystem::path& another)
    : kind_(kind), path_(std::move(path)), last_sync_s_(steady_time_s()) {
  do {
    open();
    lock();
    // Who held it may have removed it: its work was whole.
  } while (!process::stands(file_, path_));
  if (!another.empty()) {
    begin_with(another, identity);
  }
  recover(identity, take);
}

void Journal::open() {
  constexpr mode_t mode = 0666;
  constexpr int flags = O_RDWR | O_CREAT | O_APPEND | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC;
  file_ = process::Descriptor(::open(path_.c_str(), flags, mode));
  const bool link = file_.number() < 0 && errno == ELOOP;
  struct stat facts {};
  if (!link && (file_.number() < 0 || fstat(file_.number(), &facts) != 0)) {
    process::fail(path_);
  }
  if (!S_ISREG(facts.st_mode)) {
    process::fail(
        path_,
        "is no file that can hold a journal; allowed: that out of the way, or another folder");
  }
}

void Journal::append(const std::vector<FinishedPoint>& points) {
  // The text is made before the lock: that is most of the work.
  std::string lines;
  for (const FinishedPoint& each : points) {
    lines += sealed(each.record) + '\n';
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  write_all(file_, path_, lines);
  sync_now_and_then();
}

void Journal::remove() {
  std::error_code error;
  if (!std::filesystem::remove(path_, error) && error) {
    process::fail(path_, error);
  }
}

void Journal::lock() {
  if (process::lock(file_, LOCK_EX | LOCK_NB)) {
    return;
  }
  if (errno == EWOULDBLOCK) {
    throw JournalInUse(fmt::format("{}: another {} is at work in this folder",
                                   process::printable(path_.string()), kind_.work));
  }
  process::fail(path_);
}

std::string Journal::header_text(const Identity& identity) const {
  return nlohmann::ordered_json{{"format", format_name(kind_)},
                                {"program", identity.program},
                                {"scene", identity.scene},
                                {"options", identity.options}}
      .dump();
}

std::optional<Identity> Journal::identity_in(std::string_view first_line) {
  const auto header = unsealed(first_line);
  const auto found =
      nlohmann::ordered_json::parse(header.value_or(std::string_view()), nullptr, false);
  return found.is_object()
             ? std::optional<Identity>({found.value("program", ""), found.value("scene", ""),
                                        found.value("options", "")})
             : std::nullopt;
}

/// Its torn end comes along, and is cut off as that of one's own.
void Journal::begin_with(const std::filesystem::path& another, const Identity& identity) {
  std::ifstream from(another, std::ios::binary);
  std::string line;
  if (!std::getline(from, line) || from.eof()) {
    return;
  }
  const std::optional<std::string_view> header = unsealed(line);
  if (!header || *header != header_text(identity)) {
    refuse(another, difference(header.value_or(""), identity));
  }
  std::error_code gone;
  const auto theirs = std::filesystem::file_size(another, gone);
  if (gone || theirs <= std::filesystem::file_size(path_)) {
    return;
  }
  if (ftruncate(file_.number(), 0) != 0) {
    process::fail(path_);
  }
  constexpr std::size_t part_bytes = std::size_t{1} << 20U;
  std::string part(part_bytes, '\0');
  from.seekg(0);
  while (from) {
    from.read(part.data(), static_cast<std::streamsize>(part_bytes));
    write_all(file_, path_, {part.data(), static_cast<std::size_t>(from.gcount())});
  }
}

/// What an existing journal differs in.
std::string Journal::difference(std::string_view header, const Identity& identity) const {
  const auto found = nlohmann::ordered_json::parse(header, nullptr, false);
  const auto differs = [&found](const char* key, const std::string& value) {
    return !found.is_object() || found.value(key, "") != value;
  };
  if (differs("format", format_name(kind_))) {
    return "another format of journal";
  }
  if (differs("program", identity.program)) {
    return found.value("program", "");
  }
  return differs("scene", identity.scene) ? "another scene"
                                          : fmt::format("other {}", kind_.options);
}

/// Takes what is whole and cuts off the rest.
void Journal::recover(const Identity& identity, const Take& take) {
  std::ifstream journal(path_, std::ios::binary);
  std::string line;
  const std::string first_line = sealed(header_text(identity)) + '\n';
  // Without the end of its first line the journal holds no point yet.
  if (!std::getline(journal, line) || journal.eof()) {
    if (first_line.compare(0, line.size(), line) != 0) {
      refuse(path_, "another format of journal");
    }
    if (ftruncate(file_.number(), 0) != 0) {
      process::fail(path_);
    }
    write_all(file_, path_, first_line);
    sync();
    return;
  }
  const auto header = unsealed(line);
  if (!header || *header != header_text(identity)) {
    refuse(path_, difference(header.value_or(""), identity));
  }
  std::streamoff whole = journal.tellg();
  while (std::getline(journal, line) && !journal.eof()) {
    const auto record = unsealed(line);
    if (!record || !take(*record)) {
      break;
    }
    whole = journal.tellg();
  }
  if (ftruncate(file_.number(), whole) != 0) {
    process::fail(path_);
  }
}

void Journal::refuse(const std::filesystem::path& journal, const std::string& contents) const {
  throw ForeignJournal(
      fmt::format("{}: holds an unfinished {} of {}; allowed: finish that one, remove the file, "
                  "or choose another folder",
                  process::printable(journal.string()), kind_.work, contents));
}

/// As often as a record that costs nothing can bear.
void Journal::sync_now_and_then() {
  if (steady_time_s() - last_sync_s_ < sync_interval_s) {
    return;
  }
  sync();
}

void Journal::sync() {
  if (fdatasync(file_.number()) != 0) {
    process::fail(path_);
  }
  last_sync_s_ = steady_time_s();
}

}  // namespace sonoglide::long_work
