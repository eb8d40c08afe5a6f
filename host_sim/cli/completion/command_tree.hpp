/// The commands of the program and what may follow each, as a shell that completes words needs it.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace sonoglide::completion {

/// What the value of an option, or an argument, is completed with.
enum class Kind {
  none,  ///< a flag has no value, and most commands have no argument
  text,  ///< anything: nothing can be offered
  words,
  scene_keys,
  file,
  folder,
};

struct Value {
  Kind kind = Kind::none;
  std::vector<std::string> words = {};  ///< of Kind::words
};

struct Option {
  std::string name;  ///< with its dashes
  std::string meaning;
  Value value;
};

struct Word {
  std::string name;
  std::string meaning;
};

struct Command {
  std::string path;  ///< its words, without the program: empty, `run`, `identify impedance`
  std::vector<Word> commands;
  std::vector<Option> options;
  Value argument;
};

/// Every command, the program itself first.
std::vector<Command> command_tree(const CLI::App& program);

/// `drive.frequency_Hz=` for each key of a scene; of a key that holds a word, `friction.law=dahl`
/// for each word instead.
std::vector<std::string> scene_keys();

}  // namespace sonoglide::completion
