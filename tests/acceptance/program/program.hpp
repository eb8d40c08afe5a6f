/// The built program, run from outside.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace sonoglide::acceptance {

struct Outcome {
  int exit_code = -1;
  std::string out;
  std::string err;
};

/// The last line of an error of usage. @param command  empty: none was named
std::string usage_hint(const std::string& command);

/// Any text as one word of a shell.
std::string shell_word(const std::string& text);

/// A page or a JSON file without the command line that it came from.
std::string without_command_line(const std::string& text);

/// An empty folder of its own, gone with its owner.
class ScratchFolder {
 public:
  ScratchFolder();
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void write(const std::string& name, const std::string& content) const;
  std::string read(const std::string& name) const;
  /// Everything in it, at any depth, sorted.
  std::vector<std::string> entries() const;
  /// Runs the program in this folder, or in one inside it; `arguments` are shell words.
  Outcome run(const std::string& arguments, const std::string& inside = ".") const;
  /// The same with another program that is built from the same rooms.
  Outcome run_program(const std::string& program, const std::string& arguments,
                      const std::string& inside = ".") const;

 private:
  std::filesystem::path path_;
};

}  // namespace sonoglide::acceptance
