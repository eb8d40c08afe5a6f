/// A set of output files that appears whole or not at all.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "host_sim/process/scratch_folder.hpp"
#include "host_sim/process/staged_file.hpp"

namespace sonoglide::process {

/// Files are staged in a hidden folder and moved to the target by commit(); without a commit the
/// destructor removes every trace of them.
///
/// The staging folder stands where the target will, so that moving is renaming: inside the target
/// if that exists, else in its nearest parent that does. Files of the target that are neither
/// written again nor withdrawn stay as they are. So does every file that no earlier OutputFolder
/// has written, or that was changed since (see WrittenFiles): to write or withdraw one of its name
/// is an error.
class OutputFolder {
 public:
  /// @param names  of files that will be written or withdrawn, to be told of early that they cannot
  /// @throws FileError if nothing can be written there; nothing has been changed then.
  explicit OutputFolder(const std::filesystem::path& target,
                        const std::vector<std::string>& names = {});
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Stages a whole file. @param name  a plain file name, used once.
  /// @throws FileError if it cannot be written or there is another's file of that name,
  ///         std::invalid_argument for any other name.
  void write(const std::string& name, std::string_view content);

  /// Stages a file that is written piece by piece, until commit(). Throws as write() does, and so
  /// does the stream, at once.
  std::ostream& open(const std::string& name);

  /// Says that a file is not written this time: commit() takes away an older one of this name,
  /// which would pass for a new one. @param name  as in write()
  void withdraw(const std::string& name);

  /// Moves the staged files into place, creating missing parents; to be called once, last. An old
  /// file of the same name is replaced. The list of what this program wrote there goes with them. Of
  /// several programs that do so at once one is the last, in every file.
  /// @param then  what belongs to it: no signal ends the program between
  /// @throws FileError if a file could not be written or moved; the target is then as before.
  void commit(const std::function<void()>& then = {});

  const std::filesystem::path& target() const { return target_; }

 private:
  class Moves;

  static std::error_code clear(Moves& moves, const std::filesystem::path& place,
                               const std::filesystem::path& aside);
  void require_usable(const std::string& name) const;
  void require_ours(const std::string& name) const;
  void require_listed(const std::string& name) const;
  std::filesystem::path new_file(const std::string& name) const;
  StagedFile& stage(const std::string& name);
  void list_files() const;
  bool place_new_folder();
  void place_list(Moves& moves, bool is_first) const;
  bool replace_files();

  std::filesystem::path target_;
  std::optional<ScratchFolder> staging_;  ///< from the constructor on
  std::map<std::string, std::unique_ptr<StagedFile>> files_;
  std::set<std::string> withdrawn_;
};

/// Creates a folder once it is known that files of these names can be written to it.
/// @throws FileError
void create_folder(const std::filesystem::path& target, const std::vector<std::string>& names);

}  // namespace sonoglide::process
