#include "host_sim/process/regular_expression.hpp"

#include <regex>

namespace sonoglide::process {
namespace {

Match match_of(const std::smatch& found) {
  return {found.begin(), found.end()};
}

}  // namespace

struct RegularExpression::Compiled {
  std::regex form;
};

RegularExpression::RegularExpression(const std::string& pattern)
    : compiled_(std::make_shared<const Compiled>(Compiled{std::regex(pattern)})) {}

Match RegularExpression::match(const std::string& text) const {
  std::smatch found;
  return std::regex_match(text, found, compiled_->form) ? match_of(found) : Match();
}

Match RegularExpression::search(const std::string& text) const {
  std::smatch found;
  return std::regex_search(text, found, compiled_->form) ? match_of(found) : Match();
}

std::vector<Match> RegularExpression::search_all(const std::string& text) const {
  std::vector<Match> all;
  for (std::sregex_iterator each(text.begin(), text.end(), compiled_->form), end; each != end;
       ++each) {
    all.push_back(match_of(*each));
  }
  return all;
}

std::string RegularExpression::replace(const std::string& text, const std::string& by) const {
  return std::regex_replace(text, compiled_->form, by);
}

}  // namespace sonoglide::process
