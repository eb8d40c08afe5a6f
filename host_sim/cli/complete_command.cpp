/// `complete`: what may follow the words of a command line, for the scripts of `completion`. The kind
/// is printed on a line of its own:
///
/// - `files`, `folders`: the shell knows them
/// - `words`, `keys`: each follows on a line, with its meaning behind a tab where it has one; more
///   may be typed behind a key
///
/// Nothing is printed where anything may be typed.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "host_sim/boards/emulated/board_list.hpp"
#include "host_sim/boards/emulated/unit_image.hpp"
#include "host_sim/cli/commands.hpp"
#include "host_sim/cli/usage.hpp"
#include "host_sim/scene_file/keys.hpp"
#include "host_sim/studies/identify/friction/candidate.hpp"

namespace sonoglide::cli {
namespace {

void offer(std::string_view word, std::string_view meaning) {
  fmt::print("{}\t{}\n", word, meaning);
}

template <class Board>
void offer_names(const std::vector<Board>& boards) {
  for (const Board& board : boards) {
    fmt::print("{}\n", board.name);
  }
}

/// @param command  whose option it is
void offer_boards(const CLI::App& command) {
  fmt::print("words\n");
  if (command.get_name() == "image") {
    offer_names(emulated::unit_boards());
  } else {
    offer_names(emulated::emulated_boards());
    offer_names(emulated::carrier_boards());
  }
}

void offer_laws() {
  fmt::print("words\n");
  for (const std::string_view law : identify::friction::fitted_laws) {
    fmt::print("{}\n", law);
  }
}

/// `drive.frequency_Hz=`; of a key that holds a word, `friction.law=dahl` for each word instead, behind
/// the words that a list already has: `friction.law=dahl,coulomb`.
void offer_scene_keys(const std::string& begun) {
  const std::string list = begun.substr(0, begun.rfind(',') + 1);
  for (const scene_file::KeyTable& table : scene_file::key_tables()) {
    for (const scene_file::Key& key : table.keys) {
      const std::string start = fmt::format("{}.{}=", table.name, key.name);
      const bool listed = list.rfind(start, 0) == 0;
      if (const auto* word = std::get_if<scene_file::Word>(&key.allowed)) {
        for (const std::string_view each : word->allowed) {
          offer((listed ? list : start) + std::string(each), key.meaning);
        }
      } else {
        offer(start, key.meaning);
      }
    }
  }
}

/// Of `a|b|c`; a check of the option may have added what it allows, after a colon.
void offer_alternatives(const std::string& type) {
  fmt::print("words\n");
  for (const std::string& word : CLI::detail::split(type.substr(0, type.find(':')), '|')) {
    fmt::print("{}\n", word);
  }
}

/// The value of an option, or an argument, by the name that its type has in the help.
void offer_value(const CLI::App& command, const CLI::Option& option, const std::string& begun) {
  const std::string type = option.get_type_name();
  if (option.check_lname("board")) {
    offer_boards(command);
  } else if (option.check_lname("law")) {
    offer_laws();
  } else if (type.find('=') != std::string::npos) {
    fmt::print("keys\n");
    if (option.check_lname("vary")) {
      offer("velocity_ratio=", "sliding velocity over peak vibration velocity");
    }
    offer_scene_keys(begun);
  } else if (type.find('|') != std::string::npos && type.rfind("FILE", 0) != 0) {
    offer_alternatives(type);
  } else if (type == "DIR") {
    fmt::print("folders\n");
  } else if (type.rfind("FILE", 0) == 0 || type == "SCENE.toml") {
    fmt::print("files\n");
  }
}

void offer_options(const CLI::App& command) {
  fmt::print("words\n");
  for (const CLI::Option* option : command.get_options()) {
    for (const std::string& name : option->get_lnames()) {
      offer("--" + name, option->get_description());
    }
  }
}

void offer_commands_or_argument(const CLI::App& command, const std::string& begun) {
  const auto commands = commands_of(command);
  if (!commands.empty()) {
    fmt::print("words\n");
    for (const CLI::App* each : commands) {
      offer(each->get_name(), each->get_description());
    }
    return;
  }
  for (const CLI::Option* option : command.get_options()) {
    if (option->get_positional()) {
      offer_value(command, *option, begun);
    }
  }
}

/// The option that takes the next word, or none.
const CLI::Option* option_before_value(const CLI::App& command, const std::string& word) {
  const CLI::Option* option =
      word.rfind("--", 0) == 0 ? command.get_option_no_throw(word) : nullptr;
  return option != nullptr && option->get_items_expected_max() > 0 ? option : nullptr;
}

/// @param words  those before the one that is completed
void offer_next(const CLI::App& program, const std::vector<std::string>& words,
                const std::string& begun) {
  const CLI::App* command = &program;
  const CLI::Option* option = nullptr;
  for (const std::string& word : words) {
    if (option != nullptr) {
      option = nullptr;
    } else if (const CLI::App* inner = command_named(*command, word)) {
      command = inner;
    } else {
      option = option_before_value(*command, word);
    }
  }
  if (option != nullptr) {
    offer_value(*command, *option, begun);
  } else if (begun.rfind('-', 0) == 0) {
    offer_options(*command);
  } else {
    offer_commands_or_argument(*command, begun);
  }
}

}  // namespace

void add_complete_command(CLI::App& program) {
  const auto words = std::make_shared<std::vector<std::string>>();
  CLI::App* command =
      program.add_subcommand("complete", "What may follow the words of a command line");
  command->group("");  // a person has no use for it
  command->add_option("words", *words,
                      "After --: those behind the program's, the last one as begun");
  command->callback([&program, words] {
    const std::string begun = words->empty() ? "" : words->back();
    words->resize(words->size() - (words->empty() ? 0 : 1));
    offer_next(program, *words, begun);
  });
}

}  // namespace sonoglide::cli
