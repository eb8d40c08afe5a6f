/// Reads the values of one scene table, each checked, and knows which of them were asked for.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "host_sim/scene/names.hpp"
#include "host_sim/scene/tolerance.hpp"
#include "host_sim/scene_file/keys.hpp"
#include "host_sim/scene_file/variant.hpp"

namespace sonoglide::scene_file {

/// Every reading call throws SceneError where the value is not what the description of its key
/// allows. Where the value is missing it returns the default of the description, and throws if there
/// is none. Calls whose name ends in `_in` take both from their arguments instead.
class TableCursor {
 public:
  /// @param variant  outlives the cursor; the values of an absent table are all missing
  /// @param name     of a table that is described
  TableCursor(const Variant& variant, std::string_view name);

  bool present() const { return table_ != nullptr; }
  bool has(std::string_view key) const { return find(key) != nullptr; }

  /// An integer is taken where a real number is meant, never the other way round.
  double real(std::string_view key);
  /// @param absent  the default, which follows from other keys
  double real(std::string_view key, double absent);
  double real_in(std::string_view key, const Range& range,
                 std::optional<double> absent = std::nullopt);
  std::optional<double> optional_real(std::string_view key);

  std::int64_t integer(std::string_view key);
  std::int64_t integer_in(std::string_view key, const Integer& range, std::int64_t absent);
  std::optional<std::int64_t> optional_integer(std::string_view key);

  /// @param names  those that the description of the key allows, in its order
  template <class Value, std::size_t Count>
  Value choice(std::string_view key, const std::array<scene::Named<Value>, Count>& names) {
    return names[word(key)].value;
  }
  /// A list of different words in any order; empty where absent.
  template <class Value, std::size_t Count>
  std::vector<Value> choices(std::string_view key,
                             const std::array<scene::Named<Value>, Count>& names) {
    std::vector<Value> values;
    for (const std::size_t index : words(key)) {
      values.push_back(names[index].value);
    }
    return values;
  }

  /// The index of the word; absent with the key.
  std::optional<std::size_t> optional_word(std::string_view key) {
    return has(key) ? std::optional(word(key)) : std::nullopt;
  }
  /// True where absent.
  bool truth(std::string_view key);

  using Pair = std::array<double, 2>;
  /// `[lowest, highest]`.
  std::optional<Pair> optional_interval(std::string_view key);
  /// rise: each is after the one before. jump: two in succession may be one, at a jump.
  enum class Times { rise, jump };
  /// `[[time_s, value], …]`: at least one pair.
  std::vector<Pair> timed_values(std::string_view key, Times times = Times::rise);
  std::vector<Pair> timed_values_in(std::string_view key, const Profile& profile, Times times);

  /// A key of [tolerance]; its nominal value is left open, and so are the ends that follow from it.
  scene::Tolerance spread(std::string_view key);
  /// Every key of the table that is there: in the order of the file, options after it.
  std::vector<std::string> given_keys() const;

  /// What the description of the key allows.
  template <class Kind>
  const Kind& allowed(std::string_view key) const {
    return std::get<Kind>(key_of(keys_, key).allowed);
  }

  /// The one of two keys that is there; it is an error if both are. Without either, the first, or
  /// an error where the description wants one of them.
  std::string_view one_of(std::string_view first, std::string_view second) const;

  /// Throws for the key; at the table where the key is absent, at the file's start without table.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  /// Throws for the table as a whole.
  [[noreturn]] void fail(const std::string& message) const;
  /// Throws for the first value in the file that nothing has asked for: a scene may hold nothing
  /// that is silently ignored. Where the variant takes unused keys, it gets all of them instead.
  void reject_unread(std::string_view reason) const;
  /// The same, the reason being the word that another key has.
  void reject_unread_with(std::string_view key, std::string_view word) const;
  /// The same for one key that is there.
  void reject(std::string_view key, std::string_view reason) const;

 private:
  /// A value, or a part of one: spelt out only where an error needs it.
  struct Part {
    std::string_view key;
    std::optional<std::size_t> element = std::nullopt;
    std::optional<std::size_t> member = std::nullopt;  ///< of the element
  };

  const GivenValue* find(std::string_view key) const;
  /// Marks the key as read; null where absent.
  const GivenValue* take(std::string_view key);
  /// The first value that nothing has asked for, options after the file; null if there is none.
  const std::pair<const std::string, GivenValue>* first_unread() const;
  Location place() const;
  Location place_of(std::string_view key) const;
  std::string path_of(const Part& part) const;
  [[noreturn]] void fail_missing(std::string_view key, const std::string& allowed) const;
  [[noreturn]] void fail_part(const GivenValue& entry, const toml::node& node, const Part& part,
                              const std::string& message) const;

  std::int64_t whole_number(std::string_view key, const GivenValue& entry,
                            const Integer& range) const;
  double number_in(const GivenValue& entry, const toml::node& node, const Part& part,
                   const Range& range) const;
  std::size_t word_in(const GivenValue& entry, const toml::node& node, const Part& part,
                      const Words& allowed) const;
  std::size_t word(std::string_view key);
  std::vector<std::size_t> words(std::string_view key);
  Pair pair_in(const GivenValue& entry, const toml::node& node, const Part& part,
               const Profile& profile) const;
  scene::Tolerance spread_in(std::string_view key, const GivenValue& entry,
                             const toml::table& table) const;
  Pair ends_in(std::string_view key, const GivenValue& entry, const toml::node& node,
               const Spread& allowed) const;
  [[noreturn]] void fail_spread(std::string_view key, const std::string& found, bool whole) const;
  void check_time(const GivenValue& entry, const toml::node& node, const Part& part,
                  const std::vector<Pair>& earlier, double time_s, Times times) const;

  const Variant& variant_;
  const KeyTable& keys_;
  const SceneTable* table_;
  std::bitset<most_keys> read_;  ///< by GivenValue::position
};

}  // namespace sonoglide::scene_file
