/// Reads the values of one scene table, each checked, and knows which of them were asked for.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host_sim/scene/document.hpp"
#include "host_sim/scene/names.hpp"
#include "host_sim/scene/range.hpp"

namespace sonoglide::scene {

/// Every reading call throws SceneError where the value is not what it asks for; the calls without
/// a default also where the value is missing.
class TableCursor {
 public:
  /// @param table  must outlive the cursor; null for an absent table, whose values are all missing
  TableCursor(const Document& document, std::string_view name);

  bool present() const { return table_ != nullptr; }
  bool has(std::string_view key) const { return find(key) != nullptr; }

  /// An integer is taken where a real number is meant, never the other way round.
  double real(std::string_view key, const Range& range);
  double real(std::string_view key, const Range& range, double absent);
  std::optional<double> optional_real(std::string_view key, const Range& range);

  std::int64_t integer(std::string_view key, std::int64_t low, std::int64_t high,
                       std::int64_t absent);
  std::optional<std::int64_t> optional_integer(std::string_view key, std::int64_t low,
                                               std::int64_t high);

  template <class Value, std::size_t Count>
  Value choice(std::string_view key, const std::array<Named<Value>, Count>& names) {
    return names[word(key, words_of(names))].value;
  }
  template <class Value, std::size_t Count>
  Value choice(std::string_view key, const std::array<Named<Value>, Count>& names, Value absent) {
    return has(key) ? choice(key, names) : absent;
  }
  /// A list of different words; empty where absent.
  template <class Value, std::size_t Count>
  std::vector<Value> choices(std::string_view key, const std::array<Named<Value>, Count>& names) {
    std::vector<Value> values;
    for (const std::size_t index : words(key, words_of(names))) {
      values.push_back(names[index].value);
    }
    return values;
  }

  using Pair = std::array<double, 2>;
  /// `[[time_s, value], …]`: at least one pair, times strictly increasing.
  std::vector<Pair> timed_values(std::string_view key, const Range& time, const Range& value);

  /// The one of two keys that is there; it is an error if both or neither are.
  std::string_view one_of(std::string_view first, std::string_view second) const;
  /// The one of two keys that is there, or none; it is an error if both are.
  std::optional<std::string_view> at_most_one_of(std::string_view first,
                                                 std::string_view second) const;

  /// Throws for the key; at the table where the key is absent, at the file's start without table.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  /// Throws for the table as a whole.
  [[noreturn]] void fail(const std::string& message) const;
  /// Throws for the first value in the file that nothing has asked for: a scene may hold nothing
  /// that is silently ignored.
  void reject_unread(std::string_view reason) const;

 private:
  template <class Value, std::size_t Count>
  static std::vector<std::string_view> words_of(const std::array<Named<Value>, Count>& names) {
    std::vector<std::string_view> words;
    words.reserve(Count);
    for (const Named<Value>& each : names) {
      words.push_back(each.name);
    }
    return words;
  }

  const Entry* find(std::string_view key) const;
  /// Marks the key as read; null where absent.
  const Entry* take(std::string_view key);
  const Entry& require(std::string_view key, const std::string& allowed);
  Location place_of(std::string_view key) const;
  std::string path_of(std::string_view key) const;

  double real_in(const Entry& entry, const toml::node& node, const std::string& path,
                 const Range& range) const;
  std::size_t word_in(const Entry& entry, const toml::node& node, const std::string& path,
                      const std::vector<std::string_view>& allowed) const;
  std::size_t word(std::string_view key, const std::vector<std::string_view>& allowed);
  std::vector<std::size_t> words(std::string_view key,
                                 const std::vector<std::string_view>& allowed);
  Pair pair_in(const Entry& entry, const toml::node& node, const std::string& path,
               const Range& time, const Range& value) const;

  std::string name_;
  const Table* table_;
  Location start_;
  std::set<std::string, std::less<>> read_;
};

}  // namespace sonoglide::scene
