#include "host_sim/scene_file/table_cursor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "host_sim/scene_file/suggestion.hpp"
#include "host_sim/scene_file/toml_text.hpp"

namespace sonoglide::scene_file {
namespace {

/// An integer too large for every bit of it to fit is rounded.
double as_number(const toml::node& node) {
  const toml::value<std::int64_t>* whole = node.as_integer();
  return whole != nullptr ? static_cast<double>(whole->get()) : node.as_floating_point()->get();
}

/// `an array of 3`, or the kind of another value.
std::string count_of(const toml::node& node) {
  const toml::array* list = node.as_array();
  return list == nullptr ? std::string(kind_of(node)) : fmt::format("an array of {}", list->size());
}

}  // namespace

bool is_earlier(const GivenValue& a, const GivenValue& b) {
  const auto place = [](const GivenValue& given) {
    return std::tuple(given.overridden, given.value == nullptr, given.key_place.line,
                      given.key_place.column);
  };
  return place(a) < place(b);
}

const GivenValue* TableCursor::find(std::string_view key) const {
  if (table_ == nullptr) {
    return nullptr;
  }
  const auto found = table_->entries.find(key);
  return found == table_->entries.end() ? nullptr : &found->second;
}

std::string TableCursor::path_of(const Part& part) const {
  std::string path = fmt::format("{}.{}", keys_.name, part.key);
  if (!part.name.empty()) {
    path += fmt::format(".{}", part.name);
  }
  for (const std::optional<std::size_t>& index : {part.element, part.member}) {
    path += index ? fmt::format("[{}]", *index) : "";
  }
  return path;
}

Location TableCursor::place() const {
  return table_ != nullptr ? table_->place : variant_.document().start();
}

void TableCursor::fail(std::string_view key, const std::string& message) const {
  const GivenValue* entry = find(key);
  throw SceneError(entry != nullptr ? entry->value_place : place(), path_of({key}), message);
}

void TableCursor::fail(const std::string& message) const {
  throw SceneError(place(), std::string(keys_.name), message);
}

void TableCursor::fail_missing(std::string_view key, const std::string& allowed) const {
  fail(key, fmt::format("missing; required: {}", allowed));
}

void TableCursor::fail_part(const toml::node& node, const Part& part,
                            const std::string& message) const {
  throw SceneError(given(part.key).place_of(node), path_of(part), message);
}

void TableCursor::reject(std::string_view key, std::string_view reason) const {
  if (variant_.unused() == nullptr) {
    throw SceneError(given(key).key_place, path_of({key}),
                     fmt::format("not used {}; remove it", reason));
  }
  variant_.unused()->insert(path_of({key}));
}

double TableCursor::number_in(const toml::node& node, const Part& part, const Range& range) const {
  if (!node.is_number()) {
    fail_part(node, part, fmt::format("is {}; allowed: {}", kind_of(node), range.allowed_text()));
  }
  const double value = as_number(node);
  if (!std::isfinite(value)) {
    fail_part(node, part, fmt::format("is not finite; allowed: {}", range.allowed_text()));
  }
  if (!range.contains(value)) {
    fail_part(node, part, fmt::format("{} is out of range; allowed: {}", value, range.text()));
  }
  return value;
}

double TableCursor::real(std::string_view key, const Range& range) const {
  return number_in(node(key), {key}, range);
}

std::int64_t TableCursor::integer(std::string_view key, const Integer& range) const {
  const toml::value<std::int64_t>* value = node(key).as_integer();
  if (value == nullptr) {
    fail(key, fmt::format("is {}; allowed: an integer, {} to {}", kind_of(node(key)), range.low,
                          range.high));
  }
  if (value->get() < range.low || value->get() > range.high) {
    fail(key,
         fmt::format("{} is out of range; allowed: {} to {}", value->get(), range.low, range.high));
  }
  return value->get();
}

std::size_t TableCursor::word_in(const toml::node& node, const Part& part,
                                 const Words& allowed) const {
  const toml::value<std::string>* text = node.as_string();
  if (text != nullptr) {
    const auto found = std::find(allowed.begin(), allowed.end(), text->get());
    if (found != allowed.end()) {
      return static_cast<std::size_t>(found - allowed.begin());
    }
  }
  const std::string list = fmt::format("\"{}\"", fmt::join(allowed, "\", \""));
  if (text == nullptr) {
    fail_part(node, part, fmt::format("is {}; allowed: {}", kind_of(node), list));
  }
  const auto nearest = nearest_name(text->get(), allowed);
  fail_part(node, part,
            fmt::format("{} is unknown; {}allowed: {}", in_quotes(text->get()),
                        nearest ? fmt::format("did you mean \"{}\"? ", *nearest) : "", list));
}

std::size_t TableCursor::word(std::string_view key, const Words& allowed) const {
  return word_in(node(key), {key}, allowed);
}

std::vector<std::size_t> TableCursor::words(std::string_view key, const Words& allowed) const {
  const toml::array* list = node(key).as_array();
  if (list == nullptr) {
    fail(key, fmt::format("is {}; allowed: a list of \"{}\"", kind_of(node(key)),
                          fmt::join(allowed, "\", \"")));
  }
  std::vector<std::size_t> indices;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const toml::node& node = (*list)[i];
    const Part part{key, {}, i};
    const std::size_t index = word_in(node, part, allowed);
    if (std::find(indices.begin(), indices.end(), index) != indices.end()) {
      fail_part(node, part,
                fmt::format("\"{}\" is there twice; allowed: each once", allowed[index]));
    }
    indices.push_back(index);
  }
  return indices;
}

void TableCursor::check_time(const toml::node& node, const Part& part,
                             const std::vector<Pair>& pairs, Times times) const {
  const std::size_t count = pairs.size();
  if (count < 2 || pairs[count - 1][0] > pairs[count - 2][0]) {
    return;
  }
  const double time_s = pairs[count - 1][0];
  const double last_s = pairs[count - 2][0];
  if (times == Times::rise) {
    fail_part(
        node, part,
        fmt::format("time {} s is not after {} s; allowed: times that increase", time_s, last_s));
  }
  if (time_s < last_s) {
    fail_part(node, part,
              fmt::format("time {} s is before {} s; allowed: times that increase, or two of one "
                          "time for a jump",
                          time_s, last_s));
  }
  if (count > 2 && pairs[count - 3][0] == time_s) {
    fail_part(
        node, part,
        fmt::format("is the third pair of time {} s; allowed: at most two, for a jump", time_s));
  }
}

bool TableCursor::truth(std::string_view key) const {
  const toml::value<bool>* value = node(key).as_boolean();
  if (value == nullptr) {
    fail(key, fmt::format("is {}; allowed: true or false", kind_of(node(key))));
  }
  return value->get();
}

TableCursor::Pair TableCursor::interval(std::string_view key, const Range& range) const {
  const toml::node& value = node(key);
  const toml::array* pair = value.as_array();
  if (pair == nullptr || pair->size() != 2) {
    fail(key, fmt::format("is {}; allowed: two numbers [lowest, highest], {}", count_of(value),
                          range.text()));
  }
  const Pair ends{number_in((*pair)[0], {key, {}, 0}, range),
                  number_in((*pair)[1], {key, {}, 1}, range)};
  check_order(key, ends);
  return ends;
}

void TableCursor::check_order(std::string_view key, const Pair& ends) const {
  if (!(ends[0] < ends[1])) {
    fail(key, fmt::format("{} is not below {}; allowed: the lowest, then the highest", ends[0],
                          ends[1]));
  }
}

std::vector<std::string> TableCursor::given_keys() const {
  std::vector<const std::pair<const std::string, GivenValue>*> items;
  if (table_ != nullptr) {
    for (const auto& item : table_->entries) {
      items.push_back(&item);
    }
  }
  std::sort(items.begin(), items.end(),
            [](const auto* a, const auto* b) { return is_earlier(a->second, b->second); });
  std::vector<std::string> keys;
  keys.reserve(items.size());
  for (const auto* item : items) {
    keys.push_back(item->first);
  }
  return keys;
}

std::vector<TableCursor::Pair> TableCursor::timed_values(std::string_view key, const Range& time,
                                                         const Range& value, Times times) const {
  const toml::array* list = node(key).as_array();
  if (list == nullptr) {
    fail(key, fmt::format("is {}; allowed: {}", kind_of(node(key)), allowed_pairs));
  }
  if (list->empty()) {
    fail(key, "is empty; allowed: at least one pair [time in s, number]");
  }
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const toml::node& element = (*list)[i];
    const toml::array* pair = element.as_array();
    if (pair == nullptr || pair->size() != 2) {
      fail_part(element, {key, {}, i},
                fmt::format("is {}; allowed: a pair [time in s, number]", count_of(element)));
    }
    pairs.push_back({number_in((*pair)[0], {key, {}, i, 0}, time),
                     number_in((*pair)[1], {key, {}, i, 1}, value)});
    check_time(element, {key, {}, i}, pairs, times);
  }
  return pairs;
}

void TableCursor::exclude(std::string_view first, std::string_view second) const {
  if (!has(first) || !has(second)) {
    return;
  }
  const bool first_is_later = is_earlier(given(second), given(first));
  const std::string_view later = first_is_later ? first : second;
  throw SceneError(
      given(later).key_place, path_of({later}),
      fmt::format("excludes {}; allowed: one of the two", first_is_later ? second : first));
}

}  // namespace sonoglide::scene_file
