#include "documents.hpp"

#include <fstream>

namespace sonoglide::acceptance {

namespace fs = std::filesystem;

std::vector<fs::path> documents_in(const fs::path& root) {
  std::vector<fs::path> found;
  const auto take = [&found](const fs::directory_entry& entry) {
    if (entry.path().extension() == ".md") {
      found.push_back(entry.path());
    }
  };
  for (const fs::directory_entry& entry : fs::directory_iterator(root)) {
    take(entry);
  }
  for (const char* folder : {"firmware", "hal", "host_sim", "tests"}) {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
      take(entry);
    }
  }
  return found;
}

std::vector<std::string> lines_of(const fs::path& document) {
  std::ifstream file(document);
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) {
    lines.push_back(line);
  }
  return lines;
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) {
    text += line + '\n';
  }
  return text;
}

}  // namespace sonoglide::acceptance
