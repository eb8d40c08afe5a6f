#include "host_sim/report/output_folder.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <random>
#include <system_error>
#include <utility>

namespace sonoglide::report {
namespace {

namespace fs = std::filesystem;

constexpr int kNameAttempts = 100;
constexpr const char* kNewFiles = "new";  // in the staging folder
constexpr const char* kOldFiles = "old";

[[noreturn]] void fail(const fs::path& path, const std::string& reason) {
  throw OutputError(path.string() + ": " + reason);
}

[[noreturn]] void fail(const fs::path& path, const std::error_code& error) {
  fail(path, error.message());
}

/// Absolute, links and ".." resolved as far as the path exists, without a trailing separator.
fs::path normal(const fs::path& path) {
  if (path.empty()) {
    throw OutputError("the output folder has an empty name");
  }
  std::error_code error;
  const fs::path result = fs::weakly_canonical(fs::absolute(path, error), error);
  if (error) {
    fail(path, error);
  }
  return result.has_filename() ? result : result.parent_path();
}

/// The path itself or its nearest parent that exists; must be a folder.
fs::path nearest_folder(const fs::path& path) {
  fs::path candidate = path;
  while (true) {
    std::error_code error;
    const fs::file_status status = fs::status(candidate, error);
    if (fs::is_directory(status)) {
      return candidate;
    }
    if (fs::exists(status)) {
      fail(candidate, "is a file, not a folder");
    }
    if (status.type() == fs::file_type::none) {
      fail(candidate, error);
    }
    if (fs::is_symlink(fs::symlink_status(candidate, error))) {
      fail(candidate, "is a symbolic link to nothing");
    }
    if (candidate == candidate.parent_path()) {
      fail(path, "no parent folder exists");
    }
    candidate = candidate.parent_path();
  }
}

/// A new hidden folder with a name that is not taken.
fs::path create_staging(const fs::path& parent, const fs::path& target) {
  std::random_device random;
  for (int attempt = 0; attempt < kNameAttempts; ++attempt) {
    fs::path path = parent / fmt::format(".{}.{:08x}", target.filename().string(), random());
    std::error_code error;
    if (fs::create_directory(path, error)) {
      return path;
    }
    if (error) {
      fail(target, "cannot be written: " + error.message());
    }
  }
  fail(target, "no free name for a staging folder");
}

/// Creates what is missing of a folder's path; returns the created folders, outermost first.
std::vector<fs::path> create_parents(const fs::path& folder) {
  std::vector<fs::path> missing;
  std::error_code unknown;
  for (fs::path path = folder; !fs::exists(path, unknown); path = path.parent_path()) {
    if (unknown) {
      fail(path, unknown);
    }
    missing.insert(missing.begin(), path);
  }
  for (std::size_t i = 0; i < missing.size(); ++i) {
    std::error_code error;
    fs::create_directory(missing[i], error);
    if (error) {
      missing.resize(i);
      for (auto made = missing.rbegin(); made != missing.rend(); ++made) {
        std::error_code ignored;
        fs::remove(*made, ignored);
      }
      fail(folder, error);
    }
  }
  return missing;
}

/// Renames that are undone, last one first, unless kept.
class Moves {
 public:
  Moves() = default;
  Moves(const Moves&) = delete;
  Moves& operator=(const Moves&) = delete;
  ~Moves() {
    for (auto move = moves_.rbegin(); move != moves_.rend(); ++move) {
      std::error_code ignored;
      fs::rename(move->second, move->first, ignored);
    }
  }

  std::error_code move(const fs::path& from, const fs::path& to) {
    std::error_code error;
    fs::rename(from, to, error);
    if (!error) {
      moves_.emplace_back(from, to);
    }
    return error;
  }

  void keep() { moves_.clear(); }

 private:
  std::vector<std::pair<fs::path, fs::path>> moves_;  // from, to
};

/// Puts the file of this name, if there is one, aside.
std::error_code clear(Moves& moves, const fs::path& place, const fs::path& aside) {
  std::error_code absent;
  if (fs::is_directory(place, absent)) {
    return std::make_error_code(std::errc::is_a_directory);
  }
  return fs::exists(fs::symlink_status(place, absent)) ? moves.move(place, aside)
                                                       : std::error_code();
}

/// What the last failed system call said.
std::string last_reason() {
  return errno == 0 ? "cannot be written" : std::generic_category().message(errno);
}

}  // namespace

OutputFolder::OutputFolder(const fs::path& target) : target_(normal(target)) {
  staging_ = create_staging(nearest_folder(target_), target_);
  std::error_code error;
  if (!fs::create_directory(staging_ / kNewFiles, error) ||
      !fs::create_directory(staging_ / kOldFiles, error)) {
    std::error_code ignored;
    fs::remove_all(staging_, ignored);
    fail(target_, error);
  }
}

OutputFolder::~OutputFolder() {
  files_.clear();
  std::error_code ignored;
  fs::remove_all(staging_, ignored);
}

void OutputFolder::write(const std::string& name, std::string_view content) {
  std::ofstream& file = stage(name);
  errno = 0;
  file.write(content.data(), static_cast<std::streamsize>(content.size()));
  file.close();
  if (!file) {
    fail(target_ / name, last_reason());
  }
}

std::ostream& OutputFolder::open(const std::string& name) {
  return stage(name);
}

void OutputFolder::withdraw(const std::string& name) {
  require_unused(name);
  withdrawn_.insert(name);
}

void OutputFolder::require_unused(const std::string& name) const {
  const fs::path path(name);
  if (name.empty() || path != path.filename() || name == "." || name == "..") {
    throw std::invalid_argument("'" + name + "' is not a plain file name");
  }
  if (files_.count(name) + withdrawn_.count(name) > 0) {
    throw std::invalid_argument("'" + name + "' is named twice");
  }
}

std::ofstream& OutputFolder::stage(const std::string& name) {
  require_unused(name);
  std::ofstream& file = files_[name];
  errno = 0;
  file.open(staging_ / kNewFiles / name, std::ios::binary);
  if (!file) {
    fail(target_ / name, last_reason());
  }
  return file;
}

void OutputFolder::commit() {
  close_files();
  std::error_code error;
  if (fs::exists(target_, error)) {
    replace_files();
  } else {
    place_new_folder();
  }
}

void OutputFolder::close_files() {
  for (auto& [name, file] : files_) {
    if (file.is_open()) {
      file.close();
    }
    if (!file) {
      fail(target_ / name, "could not be written in full");
    }
  }
}

void OutputFolder::place_new_folder() {
  const std::vector<fs::path> created = create_parents(target_.parent_path());
  std::error_code error;
  fs::rename(staging_ / kNewFiles, target_, error);
  if (error) {
    for (auto path = created.rbegin(); path != created.rend(); ++path) {
      std::error_code ignored;
      fs::remove(*path, ignored);
    }
    fail(target_, error);
  }
}

void OutputFolder::replace_files() {
  Moves moves;
  const auto clear_place = [&](const std::string& name) {
    if (const std::error_code error = clear(moves, target_ / name, staging_ / kOldFiles / name)) {
      fail(target_ / name, error);
    }
  };
  for (const std::string& name : withdrawn_) {
    clear_place(name);
  }
  for (const auto& [name, file] : files_) {
    clear_place(name);
    if (const std::error_code error = moves.move(staging_ / kNewFiles / name, target_ / name)) {
      fail(target_ / name, error);
    }
  }
  moves.keep();
}

}  // namespace sonoglide::report
