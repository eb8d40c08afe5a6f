/// Writes the reference of scene keys and the JSON Schema anew.
///
/// Usage: key_writer FOLDER
#include <fstream>
#include <iostream>
#include <string>

#include "host_sim/scene_file/json_schema.hpp"
#include "host_sim/scene_file/key_reference.hpp"

namespace {

bool write(const std::string& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text << std::flush;
  if (!file) {
    std::cerr << path << ": cannot be written\n";
  }
  return file.good();
}

}  // namespace

int main(int argument_count, char** arguments) {
  if (argument_count != 2) {
    std::cerr << "usage: key_writer FOLDER\n";
    return 2;
  }
  const std::string folder = arguments[1];
  const bool written = write(folder + "/keys.md", sonoglide::scene_file::key_reference()) &&
                       write(folder + "/scene.schema.json", sonoglide::scene_file::json_schema());
  return written ? 0 : 1;
}
