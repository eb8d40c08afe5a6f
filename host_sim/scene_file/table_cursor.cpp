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

std::string allowed_number(const Range& range) {
  return fmt::format("a number, {}", range.text());
}

std::string allowed_integer(const Integer& range) {
  return fmt::format("an integer, {} to {}", range.low, range.high);
}

/// An integer too large for every bit of it to fit is rounded.
double as_number(const toml::node& node) {
  const toml::value<std::int64_t>* whole = node.as_integer();
  return whole != nullptr ? static_cast<double>(whole->get()) : node.as_floating_point()->get();
}

/// Overrides follow the file.
bool earlier(const GivenValue& a, const GivenValue& b) {
  return std::tuple(a.overridden, a.key_place.line, a.key_place.column) <
         std::tuple(b.overridden, b.key_place.line, b.key_place.column);
}

}  // namespace

TableCursor::TableCursor(const Variant& variant, std::string_view name)
    : variant_(variant), keys_(key_table(name)), table_(variant.find(name)) {}

const GivenValue* TableCursor::find(std::string_view key) const {
  if (table_ == nullptr) {
    return nullptr;
  }
  const auto found = table_->entries.find(key);
  return found == table_->entries.end() ? nullptr : &found->second;
}

const GivenValue* TableCursor::take(std::string_view key) {
  const GivenValue* entry = find(key);
  if (entry != nullptr) {
    read_.set(entry->position);
  }
  return entry;
}

std::string TableCursor::path_of(const Part& part) const {
  std::string path = fmt::format("{}.{}", keys_.name, part.key);
  for (const std::optional<std::size_t>& index : {part.element, part.member}) {
    path += index ? fmt::format("[{}]", *index) : "";
  }
  return path;
}

Location TableCursor::place() const {
  return table_ != nullptr ? table_->place : variant_.document().start();
}

Location TableCursor::place_of(std::string_view key) const {
  const GivenValue* entry = find(key);
  return entry != nullptr ? entry->value_place : place();
}

void TableCursor::fail(std::string_view key, const std::string& message) const {
  throw SceneError(place_of(key), path_of({key}), message);
}

void TableCursor::fail(const std::string& message) const {
  throw SceneError(place(), std::string(keys_.name), message);
}

void TableCursor::fail_missing(std::string_view key, const std::string& allowed) const {
  fail(key, fmt::format("missing; required: {}", allowed));
}

void TableCursor::fail_part(const GivenValue& entry, const toml::node& node, const Part& part,
                            const std::string& message) const {
  throw SceneError(entry.place_of(node), path_of(part), message);
}

const std::pair<const std::string, GivenValue>* TableCursor::first_unread() const {
  const std::pair<const std::string, GivenValue>* first = nullptr;
  if (table_ == nullptr) {
    return first;
  }
  for (const auto& item : table_->entries) {
    if (!read_[item.second.position] && (first == nullptr || earlier(item.second, first->second))) {
      first = &item;
    }
  }
  return first;
}

void TableCursor::reject_unread(std::string_view reason) const {
  const auto* unread = first_unread();
  if (unread == nullptr) {
    return;
  }
  if (variant_.unused() == nullptr) {
    reject(unread->first, reason);
  }
  for (const auto& [key, entry] : table_->entries) {
    if (!read_[entry.position]) {
      reject(key, reason);
    }
  }
}

void TableCursor::reject(std::string_view key, std::string_view reason) const {
  if (variant_.unused() == nullptr) {
    throw SceneError(find(key)->key_place, path_of({key}),
                     fmt::format("not used {}; remove it", reason));
  }
  variant_.unused()->insert(path_of({key}));
}

void TableCursor::reject_unread_with(std::string_view key, std::string_view word) const {
  if (first_unread() != nullptr) {
    reject_unread(fmt::format("with {} = \"{}\"", key, word));
  }
}

double TableCursor::number_in(const GivenValue& entry, const toml::node& node, const Part& part,
                              const Range& range) const {
  if (!node.is_number()) {
    fail_part(entry, node, part,
              fmt::format("is {}; allowed: {}", kind_of(node), allowed_number(range)));
  }
  const double value = as_number(node);
  if (!std::isfinite(value)) {
    fail_part(entry, node, part, fmt::format("is not finite; allowed: {}", allowed_number(range)));
  }
  if (!range.contains(value)) {
    fail_part(entry, node, part,
              fmt::format("{} is out of range; allowed: {}", value, range.text()));
  }
  return value;
}

double TableCursor::real(std::string_view key) {
  const auto* absent = std::get_if<double>(&key_of(keys_, key).absent);
  return real_in(key, allowed<Number>(key).range,
                 absent != nullptr ? std::optional(*absent) : std::nullopt);
}

double TableCursor::real(std::string_view key, double absent) {
  return real_in(key, allowed<Number>(key).range, absent);
}

double TableCursor::real_in(std::string_view key, const Range& range,
                            std::optional<double> absent) {
  const GivenValue* entry = take(key);
  if (entry != nullptr) {
    return number_in(*entry, variant_.value(*entry), {key}, range);
  }
  if (!absent) {
    fail_missing(key, allowed_number(range));
  }
  return *absent;
}

std::optional<double> TableCursor::optional_real(std::string_view key) {
  const Range& range = allowed<Number>(key).range;
  return has(key) ? std::optional(real_in(key, range)) : std::nullopt;
}

std::int64_t TableCursor::whole_number(std::string_view key, const GivenValue& entry,
                                       const Integer& range) const {
  const toml::node& node = variant_.value(entry);
  const toml::value<std::int64_t>* value = node.as_integer();
  if (value == nullptr) {
    fail(key, fmt::format("is {}; allowed: {}", kind_of(node), allowed_integer(range)));
  }
  if (value->get() < range.low || value->get() > range.high) {
    fail(key,
         fmt::format("{} is out of range; allowed: {} to {}", value->get(), range.low, range.high));
  }
  return value->get();
}

std::int64_t TableCursor::integer(std::string_view key) {
  const double absent = std::get<double>(key_of(keys_, key).absent);
  return integer_in(key, allowed<Integer>(key), static_cast<std::int64_t>(absent));
}

std::int64_t TableCursor::integer_in(std::string_view key, const Integer& range,
                                     std::int64_t absent) {
  const GivenValue* entry = take(key);
  return entry != nullptr ? whole_number(key, *entry, range) : absent;
}

std::optional<std::int64_t> TableCursor::optional_integer(std::string_view key) {
  const GivenValue* entry = take(key);
  return entry != nullptr ? std::optional(whole_number(key, *entry, allowed<Integer>(key)))
                          : std::nullopt;
}

std::size_t TableCursor::word_in(const GivenValue& entry, const toml::node& node, const Part& part,
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
    fail_part(entry, node, part, fmt::format("is {}; allowed: {}", kind_of(node), list));
  }
  const auto nearest = nearest_name(text->get(), allowed);
  fail_part(entry, node, part,
            fmt::format("{} is unknown; {}allowed: {}", in_quotes(text->get()),
                        nearest ? fmt::format("did you mean \"{}\"? ", *nearest) : "", list));
}

std::size_t TableCursor::word(std::string_view key) {
  const Words& words = allowed<Word>(key).allowed;
  const GivenValue* entry = take(key);
  if (entry != nullptr) {
    return word_in(*entry, variant_.value(*entry), {key}, words);
  }
  const auto* absent = std::get_if<std::string_view>(&key_of(keys_, key).absent);
  if (absent == nullptr) {
    fail_missing(key, fmt::format("\"{}\"", fmt::join(words, "\" or \"")));
  }
  return static_cast<std::size_t>(std::find(words.begin(), words.end(), *absent) - words.begin());
}

std::vector<std::size_t> TableCursor::words(std::string_view key) {
  const Words& words = allowed<WordList>(key).allowed;
  std::vector<std::size_t> indices;
  const GivenValue* entry = take(key);
  if (entry == nullptr) {
    return indices;
  }
  const toml::node& value = variant_.value(*entry);
  const toml::array* list = value.as_array();
  if (list == nullptr) {
    fail(key, fmt::format("is {}; allowed: a list of \"{}\"", kind_of(value),
                          fmt::join(words, "\", \"")));
  }
  for (std::size_t i = 0; i < list->size(); ++i) {
    const toml::node& node = (*list)[i];
    const Part part{key, i};
    const std::size_t index = word_in(*entry, node, part, words);
    if (std::find(indices.begin(), indices.end(), index) != indices.end()) {
      fail_part(*entry, node, part,
                fmt::format("\"{}\" is there twice; allowed: each once", words[index]));
    }
    indices.push_back(index);
  }
  return indices;
}

TableCursor::Pair TableCursor::pair_in(const GivenValue& entry, const toml::node& node,
                                       const Part& part, const Profile& profile) const {
  const toml::array* pair = node.as_array();
  if (pair == nullptr || pair->size() != 2) {
    const std::string found =
        pair == nullptr ? std::string(kind_of(node)) : fmt::format("an array of {}", pair->size());
    fail_part(entry, node, part, fmt::format("is {}; allowed: a pair [time in s, number]", found));
  }
  return {number_in(entry, (*pair)[0], {part.key, part.element, 0}, profile.time),
          number_in(entry, (*pair)[1], {part.key, part.element, 1}, profile.value)};
}

void TableCursor::check_time(const GivenValue& entry, const toml::node& node, const Part& part,
                             const std::vector<Pair>& earlier, double time_s, Times times) const {
  const std::size_t count = earlier.size();
  if (count == 0 || time_s > earlier.back()[0]) {
    return;
  }
  const double last_s = earlier.back()[0];
  if (times == Times::rise) {
    fail_part(
        entry, node, part,
        fmt::format("time {} s is not after {} s; allowed: times that increase", time_s, last_s));
  }
  if (time_s < last_s) {
    fail_part(entry, node, part,
              fmt::format("time {} s is before {} s; allowed: times that increase, or two of one "
                          "time for a jump",
                          time_s, last_s));
  }
  if (count > 1 && earlier[count - 2][0] == time_s) {
    fail_part(
        entry, node, part,
        fmt::format("is the third pair of time {} s; allowed: at most two, for a jump", time_s));
  }
}

bool TableCursor::truth(std::string_view key) {
  const GivenValue* entry = take(key);
  if (entry == nullptr) {
    return true;
  }
  const toml::node& node = variant_.value(*entry);
  const toml::value<bool>* value = node.as_boolean();
  if (value == nullptr) {
    fail(key, fmt::format("is {}; allowed: true or false", kind_of(node)));
  }
  return value->get();
}

std::optional<TableCursor::Pair> TableCursor::optional_interval(std::string_view key) {
  const GivenValue* entry = take(key);
  if (entry == nullptr) {
    return std::nullopt;
  }
  const Range& range = allowed<Interval>(key).range;
  const toml::node& node = variant_.value(*entry);
  const toml::array* pair = node.as_array();
  if (pair == nullptr || pair->size() != 2) {
    fail(key, fmt::format("is {}; allowed: two numbers [lowest, highest], {}",
                          pair == nullptr ? std::string(kind_of(node))
                                          : fmt::format("an array of {}", pair->size()),
                          range.text()));
  }
  const Pair found{number_in(*entry, (*pair)[0], {key, 0}, range),
                   number_in(*entry, (*pair)[1], {key, 1}, range)};
  if (!(found[0] < found[1])) {
    fail(key, fmt::format("{} is not below {}; allowed: the lowest, then the highest", found[0],
                          found[1]));
  }
  return found;
}

void TableCursor::fail_spread(std::string_view key, const std::string& found, bool whole) const {
  constexpr const char* range = "{ range = [lowest, highest] }";
  fail(key, fmt::format("is {}; allowed: {}", found,
                        whole ? fmt::format("{} of integers", range)
                              : fmt::format("a half width relative to the value, {}, {{ normal = "
                                            "deviation }} or {}",
                                            spread_range.text(), range)));
}

TableCursor::Pair TableCursor::ends_in(std::string_view key, const GivenValue& entry,
                                       const toml::node& node, const Spread& allowed) const {
  const toml::array* pair = node.as_array();
  if (pair == nullptr || pair->size() != 2) {
    fail_spread(key,
                pair == nullptr ? fmt::format("a range that is {}", kind_of(node))
                                : fmt::format("a range of {} values", pair->size()),
                allowed.whole);
  }
  Pair ends{};
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const toml::node& end = (*pair)[i];
    if (allowed.whole && !end.is_integer()) {
      fail_spread(key, fmt::format("a range with {}", kind_of(end)), true);
    }
    ends[i] = number_in(entry, end, {key, i}, allowed.range);
  }
  if (!(ends[0] < ends[1])) {
    fail(key, fmt::format("{} is not below {}; allowed: the lowest, then the highest", ends[0],
                          ends[1]));
  }
  return ends;
}

scene::Tolerance TableCursor::spread_in(std::string_view key, const GivenValue& entry,
                                        const toml::table& table) const {
  const auto& spread = allowed<Spread>(key);
  const toml::node* normal = table.get("normal");
  const toml::node* range = table.get("range");
  if (table.size() != 1 || (normal == nullptr && range == nullptr)) {
    fail_spread(key, "another table", spread.whole);
  }
  scene::Tolerance tolerance{std::string(key), scene::Spread::range, 0.0, 0.0, 0.0, 0.0,
                             spread.whole};
  if (range != nullptr) {
    const Pair ends = ends_in(key, entry, *range, spread);
    tolerance.lowest = ends[0];
    tolerance.highest = ends[1];
    return tolerance;
  }
  if (spread.whole) {
    fail_spread(key, "a standard deviation of integers", true);
  }
  tolerance.spread = scene::Spread::normal;
  tolerance.amount = number_in(entry, *normal, {key}, spread_range);
  tolerance.lowest = spread.range.low;
  tolerance.highest = spread.range.high;
  return tolerance;
}

scene::Tolerance TableCursor::spread(std::string_view key) {
  const auto& spread = allowed<Spread>(key);
  const GivenValue& entry = *take(key);
  const toml::node& node = variant_.value(entry);
  if (const toml::table* table = node.as_table()) {
    return spread_in(key, entry, *table);
  }
  if (spread.whole || !node.is_number()) {
    fail_spread(key, std::string(kind_of(node)), spread.whole);
  }
  return {std::string(key), scene::Spread::half_width, number_in(entry, node, {key}, spread_range)};
}

std::vector<std::string> TableCursor::given_keys() const {
  std::vector<const std::pair<const std::string, GivenValue>*> items;
  if (table_ != nullptr) {
    for (const auto& item : table_->entries) {
      items.push_back(&item);
    }
  }
  std::sort(items.begin(), items.end(),
            [](const auto* a, const auto* b) { return earlier(a->second, b->second); });
  std::vector<std::string> keys;
  keys.reserve(items.size());
  for (const auto* item : items) {
    keys.push_back(item->first);
  }
  return keys;
}

std::vector<TableCursor::Pair> TableCursor::timed_values(std::string_view key, Times times) {
  return timed_values_in(key, allowed<Profile>(key), times);
}

std::vector<TableCursor::Pair> TableCursor::timed_values_in(std::string_view key,
                                                            const Profile& profile, Times times) {
  constexpr const char* allowed = "a list of pairs [[time in s, number], …]";
  const GivenValue* entry = take(key);
  if (entry == nullptr) {
    fail_missing(key, allowed);
  }
  const toml::node& node = variant_.value(*entry);
  const toml::array* list = node.as_array();
  if (list == nullptr) {
    fail(key, fmt::format("is {}; allowed: {}", kind_of(node), allowed));
  }
  if (list->empty()) {
    fail(key, "is empty; allowed: at least one pair [time in s, number]");
  }
  std::vector<Pair> pairs;
  for (std::size_t i = 0; i < list->size(); ++i) {
    const toml::node& element = (*list)[i];
    const Pair pair = pair_in(*entry, element, {key, i}, profile);
    check_time(*entry, element, {key, i}, pairs, pair[0], times);
    pairs.push_back(pair);
  }
  return pairs;
}

std::string_view TableCursor::one_of(std::string_view first, std::string_view second) const {
  if (has(first) && has(second)) {
    const bool first_is_later = earlier(*find(second), *find(first));
    const std::string_view later = first_is_later ? first : second;
    const std::string_view other = first_is_later ? second : first;
    throw SceneError(find(later)->key_place, path_of({later}),
                     fmt::format("excludes {}; allowed: one of the two", other));
  }
  if (has(second)) {
    return second;
  }
  if (!has(first) && std::holds_alternative<Instead>(key_of(keys_, first).absent)) {
    fail(first, fmt::format("missing; required: {} or {}", first, second));
  }
  return first;
}

}  // namespace sonoglide::scene_file
