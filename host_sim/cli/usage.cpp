#include "host_sim/cli/usage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "host_sim/process/printable.hpp"
#include "host_sim/scene_file/suggestion.hpp"

namespace sonoglide::cli {
namespace {

/// Words as the parser will take them: options with their values, commands, arguments.
class Words {
 public:
  explicit Words(const CLI::App& program) : app_(&program) {}

  void take(const std::vector<std::string>& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
      const std::string& word = words[i];
      if (word == "--") {
        return;
      }
      if (is_option(word)) {
        i += take_option(word, i + 1 < words.size() ? words[i + 1] : std::string()) ? 1 : 0;
      } else {
        take_argument(word);
      }
    }
  }

  const std::string& errors() const { return errors_; }

 private:
  static bool is_option(const std::string& word) { return word.size() > 1 && word.front() == '-'; }

  /// @return whether the next word is its value
  bool take_option(const std::string& word, const std::string& next) {
    const std::size_t equals = word.find('=');
    const CLI::Option* option = app_->get_option_no_throw(word.substr(0, equals));
    if (option == nullptr) {
      report_option(word.substr(0, equals));
      // Whatever follows an unknown option may be its value.
      return equals == std::string::npos && !is_option(next);
    }
    if (option->get_items_expected_max() == 1 && !given_.insert(option).second) {
      add(fmt::format("{} is given twice; allowed: once", word.substr(0, equals)));
    }
    return equals == std::string::npos && option->get_items_expected_min() > 0;
  }

  void take_argument(const std::string& word) {
    if (const CLI::App* command = command_named(*app_, word)) {
      app_ = command;
      name_ += (name_.empty() ? "" : " ") + word;
      arguments_ = 0;
      return;
    }
    const auto positional =
        app_->get_options([](const CLI::Option* option) { return option->get_positional(); });
    if (++arguments_ > positional.size()) {
      report_argument(word);
    }
  }

  void report_option(const std::string& word) {
    std::vector<std::string> names;
    for (const CLI::Option* option : app_->get_options()) {
      for (const std::string& name : option->get_lnames()) {
        names.push_back(name);
      }
    }
    std::error_code unknown;
    const bool is_file = std::filesystem::exists(word, unknown);
    const std::string allowed = fmt::format("allowed: --{}", fmt::join(names, ", --"));
    add(fmt::format("{} is no option of {}; {}", word, shown_name(),
                    is_file
                        ? fmt::format("the file of that name is ./{}", word)
                        : nearest(word.substr(word.find_first_not_of('-')), names, "--", allowed)));
  }

  void report_argument(const std::string& word) {
    std::vector<std::string> names;
    for (const CLI::App* command : commands_of(*app_)) {
      names.push_back(command->get_name());
    }
    if (names.empty()) {
      add(fmt::format("{} is one argument too many for {}", word, shown_name()));
    } else {
      add(fmt::format(
          "{} is no command; {}", word,
          nearest(word, names, "", fmt::format("allowed: {}", fmt::join(names, ", ")))));
    }
  }

  static std::string nearest(std::string_view name, const std::vector<std::string>& known,
                             std::string_view before, const std::string& otherwise) {
    const auto found = scene_file::nearest_name(name, {known.begin(), known.end()});
    return found ? fmt::format("did you mean {}{}?", before, *found) : otherwise;
  }

  /// Of the command, with its group; of none, the program's.
  std::string shown_name() const { return name_.empty() ? app_->get_name() : name_; }

  /// One line, whatever the word.
  void add(const std::string& error) {
    errors_ += (errors_.empty() ? "" : "\n") + process::printable(error);
  }

  const CLI::App* app_;
  std::string name_;
  std::size_t arguments_ = 0;
  std::set<const CLI::Option*> given_;
  std::string errors_;
};

bool asks_for_help(const std::vector<std::string>& words) {
  for (const std::string& word : words) {
    if (word == "--help" || word == "-h") {
      return true;
    }
  }
  return false;
}

}  // namespace

std::vector<const CLI::App*> commands_of(const CLI::App& command) {
  return command.get_subcommands([](const CLI::App* each) { return !each->get_group().empty(); });
}

const CLI::App* command_named(const CLI::App& command, const std::string& name) {
  const auto found =
      command.get_subcommands([&](const CLI::App* each) { return each->get_name() == name; });
  return found.empty() ? nullptr : found.front();
}

void require_known_words(const CLI::App& program, int argument_count,
                         const char* const* arguments) {
  const std::vector<std::string> all(arguments + std::min(argument_count, 1),
                                     arguments + argument_count);
  if (asks_for_help(all)) {
    return;
  }
  Words words(program);
  words.take(all);
  if (!words.errors().empty()) {
    throw UsageError(words.errors());
  }
}

}  // namespace sonoglide::cli
