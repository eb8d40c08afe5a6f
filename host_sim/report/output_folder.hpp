/// A set of output files that appears whole or not at all.
#pragma once

#include <filesystem>
#include <fstream>
#include <map>
#include <ostream>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sonoglide::report {

/// The file system refused; the message names the path and the reason.
class OutputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Files are staged in a hidden folder and moved to the target by commit(); without a commit the
/// destructor removes every trace of them.
///
/// The staging folder stands where the target will, so that moving is renaming: inside the target
/// if that exists, else in its nearest parent that does. Files of the target that are neither
/// written again nor withdrawn stay as they are.
class OutputFolder {
 public:
  /// @throws OutputError if nothing can be written there; nothing has been changed then.
  explicit OutputFolder(const std::filesystem::path& target);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Stages a whole file. @param name  a plain file name, used once.
  /// @throws OutputError if it cannot be written, std::invalid_argument for any other name.
  void write(const std::string& name, std::string_view content);

  /// Stages a file that is written piece by piece, until commit(). Throws as write() does; a
  /// failure to write later is found by commit().
  std::ostream& open(const std::string& name);

  /// Says that a file is not written this time: commit() takes away an older one of this name,
  /// which would pass for a new one. @param name  as in write()
  void withdraw(const std::string& name);

  /// Moves the staged files into place, creating missing parents; to be called once, last. An old
  /// file of the same name is replaced.
  /// @throws OutputError if a file could not be written or moved; the target is then as before.
  void commit();

  const std::filesystem::path& target() const { return target_; }

 private:
  void require_unused(const std::string& name) const;
  std::ofstream& stage(const std::string& name);
  void close_files();
  void place_new_folder();
  void replace_files();

  std::filesystem::path target_;
  std::filesystem::path staging_;
  std::map<std::string, std::ofstream> files_;
  std::set<std::string> withdrawn_;
};

}  // namespace sonoglide::report
