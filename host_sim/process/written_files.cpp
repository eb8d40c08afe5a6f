#include "host_sim/process/written_files.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "host_sim/process/checksum.hpp"
#include "host_sim/process/file_error.hpp"

namespace sonoglide::process {
namespace {

constexpr const char* heading =
    "Written by sonoglide, which replaces or removes these files as it left them, and no others: "
    "checksum, bytes, name.";

}  // namespace

WrittenFiles::WrittenFiles(const std::filesystem::path& folder) : folder_(folder) {
  const std::filesystem::path place = folder / file_name;
  std::error_code absent;
  const std::filesystem::file_status status = std::filesystem::symlink_status(place, absent);
  if (!std::filesystem::exists(status)) {
    return;
  }
  const bool regular = std::filesystem::is_regular_file(status);
  std::ifstream list;
  std::string line;
  if (regular) {
    list.open(place, std::ios::binary);
    if (list.peek() == std::ifstream::traits_type::eof()) {
      return;
    }
    line.resize(std::string_view(heading).size() + 1);
    list.read(line.data(), static_cast<std::streamsize>(line.size()));
  }
  if (line != std::string(heading) + '\n') {
    fail(place,
         "is not a list of files that this program wrote; allowed: another "
         "folder, or that file out of the way");
  }
  while (std::getline(list, line)) {
    std::istringstream words(line);
    Content content{};
    std::string name;
    words >> std::hex >> content.checksum >> std::dec >> content.bytes >> std::ws;
    if (std::getline(words, name)) {
      files_[name].push_back(content);
    }
  }
}

bool WrittenFiles::has(const std::string& name) const {
  const auto found = files_.find(name);
  const std::filesystem::path file = folder_ / name;
  std::error_code unknown;
  if (found == files_.end() ||
      !std::filesystem::is_regular_file(std::filesystem::symlink_status(file, unknown))) {
    return false;
  }
  const std::vector<Content>& known = found->second;
  return std::find(known.begin(), known.end(), content_of(file)) != known.end();
}

void WrittenFiles::add(const std::string& name, const std::filesystem::path& file) {
  std::vector<Content> contents;
  if (has(name)) {
    contents.push_back(content_of(folder_ / name));
  }
  contents.push_back(content_of(file));
  files_[name] = std::move(contents);
}

std::string WrittenFiles::text() const {
  std::string lines = std::string(heading) + '\n';
  for (const auto& [name, contents] : files_) {
    for (const Content& content : contents) {
      lines += fmt::format("{:016x} {} {}\n", content.checksum, content.bytes, name);
    }
  }
  return lines;
}

WrittenFiles::Content WrittenFiles::content_of(const std::filesystem::path& file) {
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::array<char, 1U << 16U> part{};
  Content content{};
  Checksum sum;
  while (stream) {
    stream.read(part.data(), part.size());
    const auto count = static_cast<std::size_t>(stream.gcount());
    sum.add({part.data(), count});
    content.bytes += count;
  }
  if (!stream.eof()) {
    fail(file, "cannot be read: " + std::generic_category().message(errno));
  }
  content.checksum = sum.value();
  return content;
}

ListLock::ListLock(const std::filesystem::path& folder, Kind kind)
    : list_(folder / WrittenFiles::file_name) {
  constexpr mode_t mode = 0666;
  const bool alone = kind == Kind::alone;
  do {
    // A lock on the writers of a network's file system takes a file that is open for writing.
    file_ = Descriptor(
        open(list_.c_str(), (alone ? O_RDWR : O_RDONLY) | O_NONBLOCK | O_NOFOLLOW | O_CLOEXEC));
    began_ = false;
    if (file_.number() < 0 && errno == ENOENT && alone) {
      file_ = Descriptor(open(list_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode));
      began_ = file_.number() >= 0;
      if (!began_ && errno == EEXIST) {
        continue;
      }
    }
    if (file_.number() < 0 || !lock(file_, alone ? LOCK_EX : LOCK_SH)) {
      return;
    }
    // Who held it may have put another in its place.
  } while (!stands(file_, list_));
}

ListLock::~ListLock() {
  if (began_ && stands(file_, list_)) {
    unlink(list_.c_str());
  }
}

void ListLock::hold_next(const std::filesystem::path& list) {
  next_ = Descriptor(open(list.c_str(), O_RDWR | O_CLOEXEC));
  lock(next_, LOCK_EX);
}

}  // namespace sonoglide::process
