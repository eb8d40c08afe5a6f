/// The core keeps to its part of the language: no heap, exceptions, run-time types or library that
/// an image could not carry, in any line of code of firmware/ and hal/.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;

/// The text without its comments; each leaves a blank.
std::string code_of(const std::string& text) {
  std::string code;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t comment = std::min(text.find("//", at), text.find("/*", at));
    code += text.substr(at, comment - at) + ' ';
    if (comment == std::string::npos) {
      break;
    }
    const bool whole_line = text[comment + 1] == '/';
    const std::size_t end = text.find(whole_line ? "\n" : "*/", comment + 2);
    at = end == std::string::npos ? text.size() : end + (whole_line ? 0 : 2);
  }
  return code;
}

bool is_word_character(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

std::vector<std::string> words(const std::string& code) {
  std::vector<std::string> found;
  for (std::size_t i = 0; i < code.size(); ++i) {
    if (!is_word_character(code[i])) {
      continue;
    }
    if (i == 0 || !is_word_character(code[i - 1])) {
      found.emplace_back();
    }
    found.back() += code[i];
  }
  return found;
}

std::vector<std::string> forbidden_words(const std::string& code) {
  static const std::set<std::string> forbidden = {
      "new", "malloc", "calloc", "realloc", "throw", "try", "dynamic_cast", "catch", "typeid"};
  std::vector<std::string> found;
  std::string previous;
  for (const std::string& word : words(code)) {
    if (forbidden.count(word) != 0) {
      found.push_back(word);
    } else if (previous == "long" && word == "double") {
      found.push_back("long double");
    }
    previous = word;
  }
  return found;
}

/// Names included between `opening` and `closing`.
std::vector<std::string> included(const std::string& code, char opening, char closing) {
  std::vector<std::string> found;
  std::istringstream lines(code);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t directive = line.find_first_not_of(" \t");
    const std::size_t begin = line.find(opening);
    const std::size_t end = begin == std::string::npos ? begin : line.find(closing, begin + 1);
    if (directive != std::string::npos && line[directive] == '#' && line.find("include") < begin &&
        end != std::string::npos) {
      found.push_back(line.substr(begin + 1, end - begin - 1));
    }
  }
  return found;
}

std::vector<std::string> system_headers(const std::string& code) {
  return included(code, '<', '>');
}

std::vector<std::string> own_headers(const std::string& code) {
  return included(code, '"', '"');
}

bool starts_with(const std::string& text, const std::string& beginning) {
  return text.compare(0, beginning.size(), beginning) == 0;
}

std::string text_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::vector<fs::path> core_files() {
  std::vector<fs::path> files;
  for (const char* folder : {"firmware", "hal"}) {
    for (const auto& entry :
         fs::recursive_directory_iterator(fs::path(SONOGLIDE_SOURCE_DIR) / folder)) {
      const auto ending = entry.path().extension();
      if (ending == ".hpp" || ending == ".cpp") {
        files.push_back(entry.path());
      }
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(CoreWordsCheck, FindsWhatIsForbiddenInCode) {
  EXPECT_EQ(forbidden_words(code_of("int* p = new int;  // fine\nlong  double x;")),
            (std::vector<std::string>{"new", "long double"}));
  EXPECT_EQ(forbidden_words(code_of("a /* throw\n */ = malloc(1); b = typeid(b);")),
            (std::vector<std::string>{"malloc", "typeid"}));
  EXPECT_EQ(system_headers("#include <vector>\n#  include <cmath>\n"),
            (std::vector<std::string>{"vector", "cmath"}));
  EXPECT_EQ(own_headers("#include \"../plant/x.hpp\"\n"),
            (std::vector<std::string>{"../plant/x.hpp"}));
}

TEST(CoreWordsCheck, PassesOverCommentsAndLongerWords) {
  EXPECT_TRUE(
      forbidden_words(code_of("/// the new error\nint newest; /* throw */ renewed();")).empty());
  EXPECT_TRUE(system_headers(code_of("// #include <vector>\n")).empty());
}

TEST(CoreWords, ThereIsACoreToCheck) {
  EXPECT_GT(core_files().size(), 40U);
}

TEST(CoreWords, NoneIsForbidden) {
  for (const fs::path& file : core_files()) {
    for (const std::string& word : forbidden_words(code_of(text_of(file)))) {
      ADD_FAILURE() << file << ": " << word;
    }
  }
}

TEST(CoreWords, OnlyHeadersWithoutCodeOfTheirOwnAreIncluded) {
  // Loads and stores of an atomic word are instructions.
  const std::vector<std::string> allowed = {"array",       "atomic",  "cfloat",           "cstddef",
                                            "cstdint",     "cstring", "initializer_list", "limits",
                                            "type_traits", "utility"};
  for (const fs::path& file : core_files()) {
    for (const std::string& header : system_headers(code_of(text_of(file)))) {
      EXPECT_NE(std::find(allowed.begin(), allowed.end(), header), allowed.end())
          << file << ": <" << header << ">";
    }
  }
}

// A name without a folder is a generated header, which an image's source file may include.
TEST(CoreWords, IncludesAreWrittenFromTheRoot) {
  for (const fs::path& file : core_files()) {
    for (const std::string& header : own_headers(code_of(text_of(file)))) {
      const bool generated = file.extension() == ".cpp" && header.find('/') == std::string::npos;
      EXPECT_TRUE(generated || starts_with(header, "firmware/") || starts_with(header, "hal/"))
          << file << ": \"" << header << "\"";
      EXPECT_EQ(header.find(".."), std::string::npos) << file;
    }
  }
}

}  // namespace
