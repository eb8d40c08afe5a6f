#include "host_sim/process/output_folder.hpp"

#include <algorithm>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "host_sim/process/ending.hpp"
#include "host_sim/process/file_error.hpp"
#include "host_sim/process/written_files.hpp"

namespace sonoglide::process {
namespace {

namespace fs = std::filesystem;

constexpr const char* kNewFiles = "new";  // in the staging folder
constexpr const char* kOldFiles = "old";
/// Other programs remove folders that they have made, where they fail: between a look and a step.
constexpr int kMostTries = 1000;

/// Absolute, links and ".." resolved as far as the path exists, without a trailing separator.
fs::path normal(const fs::path& path) {
  if (path.empty()) {
    throw FileError("the output folder has an empty name");
  }
  std::error_code error;
  fs::path result;
  int tries = 0;
  do {
    result = fs::weakly_canonical(fs::absolute(path, error), error);
  } while (error == std::errc::no_such_file_or_directory && ++tries < kMostTries);
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

/// Creates what is missing of a folder's path; returns the created folders, outermost first.
std::vector<fs::path> create_parents(const fs::path& folder, int tries = 1) {
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
      const bool went = error == std::errc::no_such_file_or_directory ||
                        error == std::errc::file_exists;  // when it was made, not when looked at
      if (went && tries < kMostTries) {
        return create_parents(folder, tries + 1);
      }
      fail(folder, error);
    }
  }
  return missing;
}

}  // namespace

/// Renames that are undone, last one first, unless kept.
class OutputFolder::Moves {
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
std::error_code OutputFolder::clear(Moves& moves, const fs::path& place, const fs::path& aside) {
  std::error_code absent;
  if (fs::is_directory(place, absent)) {
    return std::make_error_code(std::errc::is_a_directory);
  }
  return fs::exists(fs::symlink_status(place, absent)) ? moves.move(place, aside)
                                                       : std::error_code();
}

OutputFolder::OutputFolder(const fs::path& target, const std::vector<std::string>& names)
    : target_(normal(target)) {
  fs::path parent = nearest_folder(target_);
  const WrittenFiles list(target_);  // one that cannot be read is refused before all else
  std::for_each(names.begin(), names.end(), [this](const auto& name) { require_ours(name); });
  for (int tries = 1; !staging_; ++tries) {
    try {
      staging_.emplace(parent);
    } catch (const ScratchError& error) {
      if (tries == kMostTries) {
        fail(target_, "cannot be written: " + error.reason());
      }
      parent = nearest_folder(target_);
    }
  }
  std::error_code error;
  if (!fs::create_directory(staging_->path() / kNewFiles, error) ||
      !fs::create_directory(staging_->path() / kOldFiles, error)) {
    fail(target_, error);
  }
}

OutputFolder::~OutputFolder() {
  files_.clear();
}

void OutputFolder::write(const std::string& name, std::string_view content) {
  StagedFile& file = stage(name);
  file << content;
  file.close();
}

std::ostream& OutputFolder::open(const std::string& name) {
  return stage(name);
}

void OutputFolder::withdraw(const std::string& name) {
  require_usable(name);
  withdrawn_.insert(name);
}

void OutputFolder::require_usable(const std::string& name) const {
  const fs::path path(name);
  const bool plain = path == path.filename() && name.find('\n') == std::string::npos;
  if (name.empty() || !plain || name == "." || name == "..") {
    throw std::invalid_argument("'" + name + "' is not a plain file name");
  }
  if (files_.count(name) + withdrawn_.count(name) > 0) {
    throw std::invalid_argument("'" + name + "' is named twice");
  }
  require_ours(name);
}

void OutputFolder::require_ours(const std::string& name) const {
  const ListLock held(target_, ListLock::Kind::shared);
  require_listed(name);
}

void OutputFolder::require_listed(const std::string& name) const {
  const fs::path place = target_ / name;
  std::error_code absent;
  const fs::file_status status = fs::symlink_status(place, absent);
  if (fs::exists(status) && !fs::is_directory(status) && !WrittenFiles(target_).has(name)) {
    fail(place,
         "was not written by an earlier run, or was changed since; allowed: another folder, or "
         "that file out of the way");
  }
}

StagedFile& OutputFolder::stage(const std::string& name) {
  require_usable(name);
  return *files_.try_emplace(name, std::make_unique<StagedFile>(new_file(name), target_ / name))
              .first->second;
}

fs::path OutputFolder::new_file(const std::string& name) const {
  return staging_->path() / kNewFiles / name;
}

void OutputFolder::commit(const std::function<void()>& then) {
  for (auto& [name, file] : files_) {
    file->close();
  }
  std::optional<Undisturbed> now;
  if (then) {
    now.emplace();
  }
  std::error_code unknown;
  while (fs::exists(target_, unknown) ? !replace_files() : !place_new_folder()) {
  }
  if (then) {
    then();
  }
}

/// Puts the list beside the new files.
void OutputFolder::list_files() const {
  WrittenFiles list(target_);
  for (const auto& [name, file] : files_) {
    list.add(name, new_file(name));
  }
  std::error_code absent;
  fs::remove(new_file(WrittenFiles::file_name), absent);
  StagedFile file(new_file(WrittenFiles::file_name), target_ / WrittenFiles::file_name);
  file << list.text();
  file.close();
}

/// @return false where somebody else has made the folder, or removed its parent, meanwhile
bool OutputFolder::place_new_folder() {
  list_files();
  const Undisturbed now;
  const std::vector<fs::path> created = create_parents(target_.parent_path());
  std::error_code error;
  fs::rename(staging_->path() / kNewFiles, target_, error);
  std::error_code unknown;
  const bool parent_went = error == std::errc::no_such_file_or_directory &&
                           fs::exists(staging_->path() / kNewFiles, unknown);
  if (error == std::errc::directory_not_empty || error == std::errc::file_exists || parent_went) {
    return false;
  }
  if (error) {
    for (auto path = created.rbegin(); path != created.rend(); ++path) {
      std::error_code ignored;
      fs::remove(*path, ignored);
    }
    fail(target_, error);
  }
  return true;
}

/// First of all, and in one step: it speaks of the old files as well as of the new ones.
void OutputFolder::place_list(Moves& moves, bool is_first) const {
  const fs::path from = new_file(WrittenFiles::file_name);
  const fs::path to = target_ / WrittenFiles::file_name;
  std::error_code error;
  if (is_first) {
    error = moves.move(from, to);
  } else {
    fs::rename(from, to, error);
  }
  if (error) {
    fail(to, error);
  }
}

/// @return false where somebody else has removed the folder meanwhile
bool OutputFolder::replace_files() {
  ListLock held(target_, ListLock::Kind::alone);
  std::error_code unknown;
  if (!fs::exists(target_, unknown)) {
    return false;
  }
  list_files();
  held.hold_next(new_file(WrittenFiles::file_name));
  const Undisturbed now;
  Moves moves;
  place_list(moves, held.began());
  const auto clear_place = [&](const std::string& name) {
    require_listed(name);
    if (const std::error_code error =
            clear(moves, target_ / name, staging_->path() / kOldFiles / name)) {
      fail(target_ / name, error);
    }
  };
  for (const std::string& name : withdrawn_) {
    clear_place(name);
  }
  for (const auto& [name, file] : files_) {
    clear_place(name);
    if (const std::error_code error = moves.move(new_file(name), target_ / name)) {
      fail(target_ / name, error);
    }
  }
  moves.keep();
  return true;
}

void create_folder(const std::filesystem::path& target, const std::vector<std::string>& names) {
  { const OutputFolder probe(target, names); }
  create_parents(normal(target));
}

}  // namespace sonoglide::process
