#include "host_sim/scene/table_cursor.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <tuple>

#include "host_sim/scene/suggestion.hpp"
#include "host_sim/scene/toml_text.hpp"

namespace sonoglide::scene {
namespace {

std::string allowed_number(const Range& range) {
  return fmt::format("a number, {}", range.text());
}

std::string allowed_integer(std::int64_t low, std::int64_t high) {
  return fmt::format("an integer, {} to {}", low, high);
}

/// A word of the file, short enough for a message.
std::string quoted(const std::string& text) {
  constexpr std::size_t longest = 60;
  return text.size() <= longest ? fmt::format("\"{}\"", text)
                                : fmt::format("\"{}\"…", text.substr(0, longest));
}

/// Overrides follow the file.
bool earlier(const Entry& a, const Entry& b) {
  return std::tuple(a.overridden, a.key_place.line, a.key_place.column) <
         std::tuple(b.overridden, b.key_place.line, b.key_place.column);
}

}  // namespace

TableCursor::TableCursor(const Document& document, std::string_view name)
    : name_(name), table_(document.find(name)), start_(document.start()) {}

const Entry* TableCursor::find(std::string_view key) const {
  if (table_ == nullptr) {
    return nullptr;
  }
  const auto found = table_->entries.find(key);
  return found == table_->entries.end() ? nullptr : &found->second;
}

const Entry* TableCursor::take(std::string_view key) {
  read_.emplace(key);
  return find(key);
}

const Entry& TableCursor::require(std::string_view key, const std::string& allowed) {
  const Entry* entry = take(key);
  if (entry == nullptr) {
    fail(key, fmt::format("missing; required: {}", allowed));
  }
  return *entry;
}

std::string TableCursor::path_of(std::string_view key) const {
  return fmt::format("{}.{}", name_, key);
}

Location TableCursor::place_of(std::string_view key) const {
  if (const Entry* entry = find(key)) {
    return entry->value_place;
  }
  return table_ != nullptr ? table_->place : start_;
}

void TableCursor::fail(std::string_view key, const std::string& message) const {
  throw SceneError(place_of(key), path_of(key), message);
}

void TableCursor::fail(const std::string& message) const {
  throw SceneError(table_ != nullptr ? table_->place : start_, name_, message);
}

void TableCursor::reject_unread(std::string_view reason) const {
  if (table_ == nullptr) {
    return;
  }
  const std::pair<const std::string, Entry>* first = nullptr;
  for (const auto& item : table_->entries) {
    if (read_.count(item.first) == 0 && (first == nullptr || earlier(item.second, first->second))) {
      first = &item;
    }
  }
  if (first != nullptr) {
    throw SceneError(first->second.key_place, path_of(first->first),
                     fmt::format("not used {}; remove it", reason));
  }
}

double TableCursor::real_in(const Entry& entry, const toml::node& node, const std::string& path,
                            const Range& range) const {
  if (!node.is_number()) {
    throw SceneError(entry.place_of(node), path,
                     fmt::format("is {}; allowed: {}", kind_of(node), allowed_number(range)));
  }
  const double value = *node.value<double>();
  if (!std::isfinite(value)) {
    throw SceneError(entry.place_of(node), path,
                     fmt::format("is not finite; allowed: {}", allowed_number(range)));
  }
  if (!range.contains(value)) {
    throw SceneError(entry.place_of(node), path,
                     fmt::format("{} is out of range; allowed: {}", value, range.text()));
  }
  return value;
}

double TableCursor::real(std::string_view key, const Range& range) {
  const Entry& entry = require(key, allowed_number(range));
  return real_in(entry, *entry.value, path_of(key), range);
}

std::optional<double> TableCursor::optional_real(std::string_view key, const Range& range) {
  const Entry* entry = take(key);
  if (entry == nullptr) {
    return std::nullopt;
  }
  return real_in(*entry, *entry->value, path_of(key), range);
}

double TableCursor::real(std::string_view key, const Range& range, double absent) {
  return optional_real(key, range).value_or(absent);
}

std::optional<std::int64_t> TableCursor::optional_integer(std::string_view key, std::int64_t low,
                                                          std::int64_t high) {
  const Entry* entry = take(key);
  if (entry == nullptr) {
    return std::nullopt;
  }
  const toml::value<std::int64_t>* value = entry->value->as_integer();
  if (value == nullptr) {
    fail(key,
         fmt::format("is {}; allowed: {}", kind_of(*entry->value), allowed_integer(low, high)));
  }
  if (value->get() < low || value->get() > high) {
    fail(key, fmt::format("{} is out of range; allowed: {} to {}", value->get(), low, high));
  }
  return value->get();
}

std::int64_t TableCursor::integer(std::string_view key, std::int64_t low, std::int64_t high,
                                  std::int64_t absent) {
  return optional_integer(key, low, high).value_or(absent);
}

std::size_t TableCursor::word_in(const Entry& entry, const toml::node& node,
                                 const std::string& path,
                                 const std::vector<std::string_view>& allowed) const {
  const std::string list = fmt::format("\"{}\"", fmt::join(allowed, "\", \""));
  const toml::value<std::string>* text = node.as_string();
  if (text == nullptr) {
    throw SceneError(entry.place_of(node), path,
                     fmt::format("is {}; allowed: {}", kind_of(node), list));
  }
  const auto found = std::find(allowed.begin(), allowed.end(), text->get());
  if (found != allowed.end()) {
    return static_cast<std::size_t>(found - allowed.begin());
  }
  const auto nearest = nearest_name(text->get(), allowed);
  throw SceneError(
      entry.place_of(node), path,
      fmt::format("{} is unknown; {}allowed: {}", quoted(text->get()),
                  nearest ? fmt::format("did you mean \"{}\"? ", *nearest) : "", list));
}

std::size_t TableCursor::word(std::string_view key, const std::vector<std::string_view>& allowed) {
  const Entry& entry = require(key, fmt::format("\"{}\"", fmt::join(allowed, "\" or \"")));
  return word_in(entry, *entry.value, path_of(key), allowed);
}

std::vector<std::size_t> TableCursor::words(std::string_view key,
                                            const std::vector<std::string_view>& allowed) {
  std::vector<std::size_t> indices;
  const Entry* entry = take(key);
  if (entry == nullptr) {
    return indices;
  }
  const toml::array* list = entry->value->as_array();
  if (list == nullptr) {
    fail(key, fmt::format("is {}; allowed: a list of \"{}\"", kind_of(*entry->value),
                          fmt::join(allowed, "\", \"")));
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    const toml::node& node = (*list)[i];
    const std::string path = fmt::format("{}[{}]", path_of(key), i);
    const std::size_t index = word_in(*entry, node, path, allowed);
    if (std::find(indices.begin(), indices.end(), index) != indices.end()) {
      throw SceneError(entry->place_of(node), path,
                       fmt::format("\"{}\" is there twice; allowed: each once", allowed[index]));
    }
    indices.push_back(index);
  }
  return indices;
}

TableCursor::Pair TableCursor::pair_in(const Entry& entry, const toml::node& node,
                                       const std::string& path, const Range& time,
                                       const Range& value) const {
  const toml::array* pair = node.as_array();
  if (pair == nullptr || pair->size() != 2) {
    const std::string found =
        pair == nullptr ? std::string(kind_of(node)) : fmt::format("an array of {}", pair->size());
    throw SceneError(entry.place_of(node), path,
                     fmt::format("is {}; allowed: a pair [time in s, number]", found));
  }
  return {real_in(entry, (*pair)[0], path + "[0]", time),
          real_in(entry, (*pair)[1], path + "[1]", value)};
}

std::vector<TableCursor::Pair> TableCursor::timed_values(std::string_view key, const Range& time,
                                                         const Range& value) {
  constexpr std::string_view allowed = "a list of pairs [[time in s, number], …]";
  const Entry& entry = require(key, std::string(allowed));
  const toml::array* list = entry.value->as_array();
  if (list == nullptr) {
    fail(key, fmt::format("is {}; allowed: {}", kind_of(*entry.value), allowed));
  }
  if (list->empty()) {
    fail(key, "is empty; allowed: at least one pair [time in s, number]");
  }
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const toml::node& node = (*list)[i];
    const std::string path = fmt::format("{}[{}]", path_of(key), i);
    const Pair pair = pair_in(entry, node, path, time, value);
    if (!pairs.empty() && pair[0] <= pairs.back()[0]) {
      throw SceneError(entry.place_of(node), path,
                       fmt::format("time {} s is not after {} s; allowed: times that increase",
                                   pair[0], pairs.back()[0]));
    }
    pairs.push_back(pair);
  }
  return pairs;
}

std::optional<std::string_view> TableCursor::at_most_one_of(std::string_view first,
                                                            std::string_view second) const {
  if (has(first) && has(second)) {
    const bool first_is_later = earlier(*find(second), *find(first));
    const std::string_view later = first_is_later ? first : second;
    const std::string_view other = first_is_later ? second : first;
    throw SceneError(find(later)->key_place, path_of(later),
                     fmt::format("excludes {}; allowed: one of the two", other));
  }
  if (has(first)) {
    return first;
  }
  if (has(second)) {
    return second;
  }
  return std::nullopt;
}

std::string_view TableCursor::one_of(std::string_view first, std::string_view second) const {
  const auto found = at_most_one_of(first, second);
  if (!found) {
    fail(first, fmt::format("missing; required: {} or {}", first, second));
  }
  return *found;
}

}  // namespace sonoglide::scene
