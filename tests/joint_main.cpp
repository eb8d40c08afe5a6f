// The program of several tests of ctest: --files=a.cpp:b.cpp runs only what these files hold.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>

namespace {

std::set<std::string> files_of(std::string_view option) {
  constexpr std::string_view name = "--files=";
  std::set<std::string> files;
  if (option.substr(0, name.size()) != name) {
    return files;
  }
  option.remove_prefix(name.size());
  while (!option.empty()) {
    const std::size_t end = std::min(option.find(':'), option.size());
    files.emplace(option.substr(0, end));
    option.remove_prefix(std::min(end + 1, option.size()));
  }
  return files;
}

/// A pattern for each test of another file.
/// @throws std::logic_error  such a test has the name of one that is to run, or the files hold none
std::string all_but(const std::set<std::string>& files) {
  std::set<std::string> others;
  std::set<std::string> wanted;
  const testing::UnitTest& all = *testing::UnitTest::GetInstance();
  for (int i = 0; i < all.total_test_suite_count(); ++i) {
    const testing::TestSuite& suite = *all.GetTestSuite(i);
    for (int k = 0; k < suite.total_test_count(); ++k) {
      const testing::TestInfo& test = *suite.GetTestInfo(k);
      auto& names = files.count(test.file()) == 0 ? others : wanted;
      names.insert(std::string(suite.name()) + "." + test.name());
    }
  }
  if (wanted.empty()) {
    throw std::logic_error("no test of this program is in these files");
  }
  std::string patterns;
  for (const std::string& name : others) {
    if (wanted.count(name) != 0) {
      throw std::logic_error("two tests of this program are called " + name);
    }
    patterns += ":" + name;
  }
  return patterns;
}

}  // namespace

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  if (argc > 1 && std::string_view(argv[1]) != "--help") {
    const std::string filter = GTEST_FLAG_GET(filter);
    const bool excludes = filter.find('-') != std::string::npos;
    GTEST_FLAG_SET(filter, filter + (excludes ? "" : "-") + all_but(files_of(argv[1])));
  }
  return RUN_ALL_TESTS();
}
