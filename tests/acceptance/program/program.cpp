#include "tests/acceptance/program/program.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <utility>

namespace sonoglide::acceptance {
namespace {

namespace fs = std::filesystem;

std::string read_all(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

fs::path make_folder() {
  std::string name = (fs::temp_directory_path() / "sonoglide_acceptance_XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) {
    throw std::runtime_error("no scratch folder can be made");
  }
  return name;
}

}  // namespace

std::string usage_hint(const std::string& command) {
  return command.empty() ? "sonoglide --help lists the commands\n"
                         : "sonoglide " + command + " --help lists the options\n";
}

std::string shell_word(const std::string& text) {
  std::string word = "'";
  for (const char each : text) {
    word += each == '\'' ? "'\\''" : std::string(1, each);
  }
  return word + '\'';
}

std::string without_command_line(const std::string& text) {
  std::string rest = text;
  for (const auto& [begin, end] :
       {std::pair("<dt>Command</dt><dd>", "</dd>"), std::pair("\"command_line\": ", "\n")}) {
    if (const std::size_t at = rest.find(begin); at != std::string::npos) {
      rest.erase(at, rest.find(end, at) - at);
    }
  }
  return rest;
}

ScratchFolder::ScratchFolder() : path_(make_folder()) {}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

void ScratchFolder::write(const std::string& name, const std::string& content) const {
  std::ofstream file(path_ / name, std::ios::binary);
  file << content;
}

std::string ScratchFolder::read(const std::string& name) const {
  return read_all(path_ / name);
}

std::vector<std::string> ScratchFolder::entries() const {
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(path_)) {
    names.push_back(entry.path().lexically_relative(path_).string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

Outcome ScratchFolder::run(const std::string& arguments, const std::string& inside) const {
  return run_program(SONOGLIDE_PROGRAM, arguments, inside);
}

Outcome ScratchFolder::run_program(const std::string& program, const std::string& arguments,
                                   const std::string& inside) const {
  const ScratchFolder streams;
  const std::string command = "cd '" + (path_ / inside).string() + "' && '" + program + "' " +
                              arguments + " >'" + (streams.path() / "out").string() + "' 2>'" +
                              (streams.path() / "err").string() + "'";
  const int status = std::system(command.c_str());
  Outcome outcome;
  outcome.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  outcome.out = streams.read("out");
  outcome.err = streams.read("err");
  return outcome;
}

}  // namespace sonoglide::acceptance
