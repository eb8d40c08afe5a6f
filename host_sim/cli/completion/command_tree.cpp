#include "host_sim/cli/completion/command_tree.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <string_view>
#include <variant>

#include "host_sim/emulated/board_list.hpp"
#include "host_sim/scene_file/keys.hpp"

namespace sonoglide::completion {
namespace {

/// Of `a|b|c`; a check of the option may have added what it allows, after a colon.
std::vector<std::string> alternatives(const std::string& type) {
  return CLI::detail::split(type.substr(0, type.find(':')), '|');
}

std::vector<std::string> boards() {
  std::vector<std::string> names;
  for (const emulated::EmulatedBoard& board : emulated::emulated_boards()) {
    names.emplace_back(board.name);
  }
  return names;
}

/// By the name that its type has in the help.
Value value_of(const CLI::Option& option) {
  if (option.get_items_expected_max() == 0) {
    return {Kind::none};
  }
  if (option.check_lname("board")) {
    return {Kind::words, boards()};
  }
  const std::string type = option.get_type_name();
  if (type.find('=') != std::string::npos) {
    return {Kind::scene_keys};
  }
  if (type.find('|') != std::string::npos) {
    return {Kind::words, alternatives(type)};
  }
  if (type == "DIR") {
    return {Kind::folder};
  }
  const bool file = type.rfind("FILE", 0) == 0 || type == "SCENE.toml";
  return {file ? Kind::file : Kind::text};
}

Command command_of(const CLI::App& app, const std::string& path) {
  Command command{path, {}, {}, {}};
  for (const CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; })) {
    command.commands.push_back({each->get_name(), each->get_description()});
  }
  for (const CLI::Option* option : app.get_options()) {
    if (option->get_positional()) {
      command.argument = value_of(*option);
      continue;
    }
    for (const std::string& name : option->get_lnames()) {
      command.options.push_back({"--" + name, option->get_description(), value_of(*option)});
    }
  }
  return command;
}

void add_commands(const CLI::App& app, const std::string& path, std::vector<Command>& tree) {
  tree.push_back(command_of(app, path));
  for (const CLI::App* each : app.get_subcommands([](const CLI::App*) { return true; })) {
    add_commands(*each, path.empty() ? each->get_name() : path + " " + each->get_name(), tree);
  }
}

}  // namespace

std::vector<Command> command_tree(const CLI::App& program) {
  std::vector<Command> tree;
  add_commands(program, "", tree);
  return tree;
}

std::vector<std::string> scene_keys() {
  std::vector<std::string> keys;
  for (const scene_file::KeyTable& table : scene_file::key_tables()) {
    for (const scene_file::Key& key : table.keys) {
      const std::string start = std::string(table.name) + "." + std::string(key.name) + "=";
      if (const auto* word = std::get_if<scene_file::Word>(&key.allowed)) {
        for (const std::string_view each : word->allowed) {
          keys.push_back(start + std::string(each));
        }
      } else {
        keys.push_back(start);
      }
    }
  }
  return keys;
}

}  // namespace sonoglide::completion
