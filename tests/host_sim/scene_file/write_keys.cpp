/// Writes the reference of scene keys and the JSON Schema anew.
///
/// Usage: key_writer FOLDER
#include <exception>
#include <fstream>
#include <iostream>
#include <stdexcept>
#include <string>

#include "host_sim/scene_file/key_reference.hpp"

namespace {

void write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text << std::flush;
  if (!file) {
    throw std::runtime_error(path + ": cannot be written");
  }
}

void write_files(const std::string& folder) {
  write(folder + "/keys.md", sonoglide::scene_file::key_reference());
  write(folder + "/scene.schema.json", sonoglide::scene_file::json_schema());
}

}  // namespace

int main(int argument_count, char** arguments) {
  try {
    if (argument_count != 2) {
      throw std::runtime_error("usage: key_writer FOLDER");
    }
    write_files(arguments[1]);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}
