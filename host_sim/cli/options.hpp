/// The options that commands share: the scene, the output folder, the board.
#pragma once

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "host_sim/cli/progress_bar.hpp"
#include "host_sim/configure/configuration_error.hpp"
#include "host_sim/configure/read/experiment.hpp"
#include "host_sim/output/study_report.hpp"
#include "host_sim/process/output_folder.hpp"

namespace sonoglide::cli {

struct SceneOptions {
  std::string path;  ///< `-`: standard input
  std::vector<std::string> overrides;
};

/// Adds the scene, required, and `--set` to a command.
/// @param note  what of the scene plays no part, or nothing
void add_scene_options(CLI::App& command, SceneOptions& options, const std::string& note = "");

/// Adds `--set` alone.
CLI::Option* add_set_option(CLI::App& command, SceneOptions& options);

/// The scene that the options name, its text read once.
class SceneInput {
 public:
  /// @param options  outlive this
  /// @throws scene_file::SceneError  the text cannot be read
  explicit SceneInput(const SceneOptions& options);

  /// @throws scene_file::SceneError
  experiment::Experiment read() const { return experiment::read(source_, options_.overrides); }

  /// What a call makes of the scene that read() gave.
  /// @throws scene_file::SceneError  at the place of its key, where the call throws a
  ///         configure::ConfigurationError
  template <class Call>
  auto with_places(const Call& call) const {
    try {
      return call();
    } catch (const configure::ConfigurationError& error) {
      throw placed(error);
    }
  }

 private:
  scene_file::SceneError placed(const configure::ConfigurationError& error) const;

  const SceneOptions& options_;
  scene_file::Source source_;
};

/// Pages and JSON files mark what `--set` changes in a scene. SceneInput does so itself.
/// @throws scene_file::SceneError
void tell_changes(const scene_file::Source& source, const std::vector<std::string>& overrides);

/// Adds `--out DIR` to a command; an empty name is an error of usage.
/// @param contents  what the folder will hold, and in brackets where it is by default
void add_output_option(CLI::App& command, std::string& out, const std::string& contents);

/// @param out  as the option has it; empty where it was not given: then out/NAMESUFFIX in the
///             working folder, where NAME is the scene's name as a plain folder can have it:
///             `scene` for one of nothing but dots, and one too long for a file system is cut, with
///             its checksum at the end
std::filesystem::path output_folder(const std::string& out, const std::string& scene_name,
                                    const std::string& suffix = "");

/// Adds `--threads N`, 1 to 1024; 0 where it is not given: one for each core.
void add_threads_option(CLI::App& command, unsigned& threads);

/// A check of an option that takes any text but none.
/// @param allowed  what it takes
std::function<std::string(const std::string&)> not_empty(const std::string& allowed);

/// A check of an option that takes one of these words.
std::function<std::string(const std::string&)> one_of(const std::vector<std::string>& words);

/// A check of an option that takes a number in these bounds.
std::function<std::string(const std::string&)> in_range(double least, double most);

/// What is wrong with a text as a whole number in these bounds; empty for one.
std::string check_whole(const std::string& text, std::uint64_t least, std::uint64_t most);

/// Where the report in a folder is, as a line for the terminal.
std::string report_line(const std::filesystem::path& out);

/// Where the scene is that a study has written, as a line for the terminal; empty if it has none.
std::string scene_line(const std::filesystem::path& out, const output::StudyReport& found);

/// Where a study leaves its files, and whether it says so.
struct StudyOptions {
  std::string out;  ///< empty: as output_folder() has it
  bool quiet = false;
};

/// Adds `--out` and `--quiet` to a command.
/// @param quiet  what there is not then
void add_study_options(CLI::App& command, StudyOptions& options, const std::string& contents,
                       const std::string& quiet = "No progress bar and no printed summary");

/// Computes a study under the progress bar, once it is known that its files can be written; writes
/// them, all or none, and prints its text and where it is.
/// @param files    their names
/// @param compute  gives the study; it is told how to say how far it is
/// @param report   makes an output::StudyReport of it
/// @throws process::FileError
template <class Compute, class Report>
void run_study(const StudyOptions& options, const std::filesystem::path& out,
               const std::vector<std::string>& files, const Compute& compute,
               const Report& report) {
  { const process::OutputFolder probe(out, files); }
  const output::StudyReport found = report(with_bar(options.quiet, compute));
  output::write(out, found);
  if (!options.quiet) {
    fmt::print("{}{}{}", found.text, scene_line(out, found), report_line(out));
  }
}

}  // namespace sonoglide::cli
