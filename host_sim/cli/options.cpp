#include "host_sim/cli/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>

#include "host_sim/output/program.hpp"
#include "host_sim/output/study_report.hpp"
#include "host_sim/process/checksum.hpp"
#include "host_sim/process/printable.hpp"
#include "host_sim/process/thread_limit.hpp"
#include "host_sim/scene_file/document.hpp"
#include "host_sim/scene_file/echo.hpp"

namespace sonoglide::cli {

void add_scene_options(CLI::App& command, SceneOptions& options, const std::string& note) {
  command
      .add_option("scene", options.path,
                  "The scene, a TOML file, or - for standard input" +
                      (note.empty() ? std::string() : "; " + note))
      ->required()
      ->type_name("SCENE.toml");
  add_set_option(command, options);
}

CLI::Option* add_set_option(CLI::App& command, SceneOptions& options) {
  return command
      .add_option("--set", options.overrides,
                  "Replace or add one value of the scene, e.g. drive.frequency_Hz=61e3, or, "
                  "without a value, remove it; repeatable")
      ->type_name("TABLE.KEY=VALUE")
      ->allow_extra_args(false);
}

SceneInput::SceneInput(const SceneOptions& options)
    : options_(options), source_(scene_file::read_source(options.path)) {
  tell_changes(source_, options.overrides);
}

void tell_changes(const scene_file::Source& source, const std::vector<std::string>& overrides) {
  output::program().changed = scene_file::changes(source, overrides);
}

scene_file::SceneError SceneInput::placed(const configure::ConfigurationError& error) const {
  return {scene_file::Document(source_, options_.overrides).place_of(error.key()), error.key(),
          error.what()};
}

namespace {

/// A name that is no path, no parent, and leaves room for a suffix in the 255 bytes that file
/// systems allow.
std::string folder_name(const std::string& scene_name) {
  constexpr std::size_t most_bytes = 200;
  std::string name = process::printable(scene_name);
  if (name.find_first_not_of('.') == std::string::npos) {
    return "scene";
  }
  if (name.size() <= most_bytes) {
    return name;
  }
  const auto continues = [&name](std::size_t at) {
    return (static_cast<std::uint8_t>(name[at]) & 0xc0U) == 0x80;
  };
  std::size_t end = most_bytes;
  while (continues(end)) {
    --end;
  }
  return fmt::format("{}-{:016x}", name.substr(0, end), process::checksum(name));
}

}  // namespace

void add_output_option(CLI::App& command, std::string& out, const std::string& contents) {
  command.add_option("--out", out, "Folder for " + contents)
      ->type_name("DIR")
      ->check(not_empty("a folder"));
}

std::filesystem::path output_folder(const std::string& out, const std::string& scene_name,
                                    const std::string& suffix) {
  return out.empty() ? std::filesystem::path("out") / (folder_name(scene_name) + suffix)
                     : std::filesystem::path(out);
}

std::function<std::string(const std::string&)> not_empty(const std::string& allowed) {
  return [allowed](const std::string& text) {
    return text.empty() ? "is empty; allowed: " + allowed : std::string();
  };
}

std::function<std::string(const std::string&)> one_of(const std::vector<std::string>& words) {
  return [words](const std::string& text) {
    return std::find(words.begin(), words.end(), text) != words.end()
               ? std::string()
               : fmt::format("\"{}\"; allowed: {}", text, fmt::join(words, ", "));
  };
}

std::function<std::string(const std::string&)> in_range(double least, double most) {
  return [least, most](const std::string& text) -> std::string {
    char* end = nullptr;
    const double value = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0') {
      return fmt::format("\"{}\" is not a number; allowed: a number, {:g} to {:g}", text, least,
                         most);
    }
    return value >= least && value <= most
               ? std::string()
               : fmt::format("{} is out of range; allowed: {:g} to {:g}", text, least, most);
  };
}

std::string check_whole(const std::string& text, std::uint64_t least, std::uint64_t most) {
  constexpr std::size_t most_digits = 19;
  const bool whole = !text.empty() && text.size() <= most_digits &&
                     text.find_first_not_of("0123456789") == std::string::npos;
  const std::uint64_t value = whole ? std::stoull(text) : 0;
  return whole && value >= least && value <= most
             ? std::string()
             : fmt::format("\"{}\"; allowed: a whole number, {} to {}", text, least, most);
}

void add_threads_option(CLI::App& command, unsigned& threads) {
  command.add_option("--threads", threads, "At most so many threads [one for each core]")
      ->type_name("N")
      ->check(
          [](const std::string& number) { return check_whole(number, 1, process::most_threads); });
}

std::string report_line(const std::filesystem::path& out) {
  return fmt::format("report: {}\n", process::printable((out / "report.html").string()));
}

std::string scene_line(const std::filesystem::path& out, const output::StudyReport& found) {
  const auto scene = found.files.find("scene.toml");
  return scene == found.files.end() || scene->second.empty()
             ? std::string()
             : fmt::format("scene: {}\n", process::printable((out / scene->first).string()));
}

void add_study_options(CLI::App& command, StudyOptions& options, const std::string& contents,
                       const std::string& quiet) {
  add_output_option(command, options.out, contents);
  command.add_flag("--quiet", options.quiet, quiet);
}

}  // namespace sonoglide::cli
