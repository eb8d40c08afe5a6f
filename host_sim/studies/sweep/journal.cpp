#include "host_sim/studies/sweep/journal.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <nlohmann/json.hpp>
#include <system_error>
#include <utility>

#include "host_sim/output/output_folder.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/studies/sweep/pace.hpp"

namespace sonoglide::sweep {
namespace {

constexpr const char* file_name = "sweep.journal";
constexpr const char* format_name = "sonoglide sweep journal, format 1";
constexpr double sync_interval_s = 1.0;

std::string last_reason() {
  return std::generic_category().message(errno);
}

std::string header_text(const Identity& identity) {
  return nlohmann::ordered_json{{"format", format_name},
                                {"program", identity.program},
                                {"scene", identity.scene},
                                {"vary", identity.vary}}
      .dump();
}

/// What an existing journal differs in.
std::string difference(std::string_view header, const Identity& identity) {
  const auto found = nlohmann::ordered_json::parse(header, nullptr, false);
  const auto differs = [&found](const char* key, const std::string& value) {
    return !found.is_object() || found.value(key, "") != value;
  };
  if (differs("format", format_name)) {
    return "another format of journal";
  }
  if (differs("program", identity.program)) {
    return found.value("program", "");
  }
  return differs("scene", identity.scene) ? "another scene" : "other --vary";
}

}  // namespace

Journal::Journal(const std::filesystem::path& folder, const Identity& identity, std::size_t points)
    : path_(folder / file_name), last_sync_s_(steady_time_s()) {
  constexpr mode_t mode = 0666;
  file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, mode);
  if (file_ < 0) {
    fail(last_reason());
  }
  try {
    lock();
    recover(identity, points);
  } catch (...) {
    close(file_);
    throw;
  }
}

Journal::~Journal() {
  close(file_);
}

std::string Journal::text_of(const std::vector<Record>& records) {
  std::string text;
  for (const Record& record : records) {
    text += sealed(record_text(record)) + '\n';
  }
  return text;
}

void Journal::append(const std::string& text) {
  write(text);
  sync_now_and_then();
}

void Journal::remove() {
  std::error_code error;
  if (!std::filesystem::remove(path_, error) && error) {
    fail(error.message());
  }
}

void Journal::lock() {
  if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
    fail(errno == EWOULDBLOCK ? "another sweep is at work in this folder" : last_reason());
  }
}

/// Takes what is whole and cuts off the rest.
void Journal::recover(const Identity& identity, std::size_t points) {
  std::ifstream journal(path_, std::ios::binary);
  std::string line;
  const std::string first_line = sealed(header_text(identity)) + '\n';
  // Without the end of its first line the journal holds no point yet.
  if (!std::getline(journal, line) || journal.eof()) {
    if (first_line.compare(0, line.size(), line) != 0) {
      refuse("another format of journal");
    }
    if (ftruncate(file_, 0) != 0) {
      fail(last_reason());
    }
    write(first_line);
    return;
  }
  const auto header = unsealed(line);
  if (!header || *header != header_text(identity)) {
    refuse(difference(header.value_or(""), identity));
  }
  std::streamoff whole = journal.tellg();
  while (std::getline(journal, line) && !journal.eof()) {
    const auto text = unsealed(line);
    auto record = text ? parse_record(*text) : std::nullopt;
    if (!record || record->point >= points) {
      break;
    }
    finished_.push_back(std::move(*record));
    whole = journal.tellg();
  }
  if (ftruncate(file_, whole) != 0) {
    fail(last_reason());
  }
}

void Journal::refuse(const std::string& contents) const {
  throw ForeignJournal(
      fmt::format("{}: holds an unfinished sweep of {}; allowed: finish that one, remove the file, "
                  "or choose another folder",
                  process::printable(path_.string()), contents));
}

void Journal::write(const std::string& text) {
  std::size_t written = 0;
  while (written < text.size()) {
    const ssize_t count = ::write(file_, text.data() + written, text.size() - written);
    if (count < 0 && errno != EINTR) {
      fail(last_reason());
    }
    written += count > 0 ? static_cast<std::size_t>(count) : 0;
  }
}

/// As often as a point that costs nothing can bear.
void Journal::sync_now_and_then() {
  if (steady_time_s() - last_sync_s_ < sync_interval_s) {
    return;
  }
  if (fdatasync(file_) != 0) {
    fail(last_reason());
  }
  last_sync_s_ = steady_time_s();
}

void Journal::fail(const std::string& reason) const {
  output::fail(path_, reason);
}

}  // namespace sonoglide::sweep
