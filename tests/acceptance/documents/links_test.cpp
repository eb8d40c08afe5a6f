/// Every relative link of a document leads to a file, and to a heading of it where it names one: among
/// the sources, and where the documents are installed.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "documents.hpp"
#include "host_sim/process/regular_expression.hpp"
#include "tests/acceptance/program/program.hpp"

namespace sonoglide::acceptance::links_test {
namespace {

namespace fs = std::filesystem;

/// What a heading is called in a link: its words in small letters, joined by dashes.
std::string anchor_of(const std::string& heading) {
  std::string anchor;
  for (const char c : process::RegularExpression(R"(\]\([^)]*\))").replace(heading, "")) {
    const auto letter = static_cast<unsigned char>(c);
    if (letter >= 0x80U || std::isalnum(letter) != 0 || c == '_' || c == '-') {
      anchor += static_cast<char>(std::tolower(letter));
    } else if (c == ' ') {
      anchor += '-';
    }
  }
  return anchor;
}

bool has_anchor(const fs::path& document, const std::string& anchor) {
  bool code = false;
  for (const std::string& line : lines_of(document)) {
    code = code != (line.rfind("```", 0) == 0);
    const std::size_t text = line.find_first_not_of('#');
    if (!code && text != 0 && text != std::string::npos && line[text] == ' ' &&
        anchor_of(line.substr(text + 1)) == anchor) {
      return true;
    }
  }
  return false;
}

struct Links {
  int count = 0;
  std::vector<std::string> dead;
};

Links links_in(const fs::path& root) {
  const process::RegularExpression link(R"(\]\(([^)#\s]*)(#([^)\s]*))?\))");
  Links links;
  for (const fs::path& document : documents_in(root)) {
    const std::string text = joined(lines_of(document));
    for (const process::Match& each : link.search_all(text)) {
      const std::string& file = each[1];
      const std::string& anchor = each[3];
      if (file.find("://") != std::string::npos || (file.empty() && anchor.empty())) {
        continue;
      }
      ++links.count;
      const fs::path target = file.empty() ? document : document.parent_path() / file;
      const bool alive = fs::exists(target) && (!fs::is_directory(target) || !fs::is_empty(target));
      if (!alive || (!anchor.empty() && !has_anchor(target, anchor))) {
        links.dead.push_back(document.lexically_relative(root).string() + ": " + each[0]);
      }
    }
  }
  return links;
}

void expect_none_dead(const Links& links) {
  EXPECT_GT(links.count, 300);
  for (const std::string& link : links.dead) {
    ADD_FAILURE() << link;
  }
}

TEST(Links, OfTheSourcesLeadSomewhere) {
  expect_none_dead(links_in(SONOGLIDE_SOURCE));
}

TEST(Links, OfTheInstalledDocumentsLeadSomewhere) {
  const ScratchFolder prefix;
  const std::string install = std::string(SONOGLIDE_CMAKE) + " --install " +
                              shell_word(SONOGLIDE_BUILD) + " --component documents --prefix " +
                              shell_word(prefix.path().string()) + " >" +
                              shell_word((prefix.path() / "log").string());
  ASSERT_EQ(std::system(install.c_str()), 0) << prefix.read("log");
  expect_none_dead(links_in(prefix.path() / SONOGLIDE_DOCUMENTS));
}

TEST(Links, ThatAreDeadAreFound) {
  const ScratchFolder folder;
  for (const char* room : {"firmware", "hal", "host_sim", "tests"}) {
    fs::create_directories(folder.path() / room);
  }
  folder.write("README.md",
               "# One & two\n[a](#one--two) [b](hal) [c](hal/no.md)\n[d](README.md#none)\n");
  const Links links = links_in(folder.path());
  EXPECT_EQ(links.count, 4);
  EXPECT_EQ(links.dead, (std::vector<std::string>{"README.md: ](hal)", "README.md: ](hal/no.md)",
                                                  "README.md: ](README.md#none)"}));
}

}  // namespace
}  // namespace sonoglide::acceptance::links_test
