/// Every key of a scene, told once: what it may hold, what it means, and what holds without it. The
/// reader, the suggestions, the reference and the JSON Schema are made from this list;
/// scene_values.hpp tells which value of a scene each key holds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace sonoglide::scene_file {

/// From low to high, both allowed unless low_open; in text `1e-12 to 1e+06 kg`.
struct Range {
  double low;
  double high;
  std::string_view unit = "";
  bool low_open = false;

  /// False for NaN.
  bool contains(double value) const {
    return (low_open ? value > low : value >= low) && value <= high;
  }
  std::string text() const;
};

inline constexpr double standard_gravity_m_per_s2 = 9.81;
/// Hours of a carrier: more is a mistyped unit.
inline constexpr double most_periods = 1e10;

using Words = std::vector<std::string_view>;

struct Number {
  Range range;
};

struct Integer {
  std::int64_t low;
  std::int64_t high;
  std::string_view unit = "";
};

/// One of the words.
struct Word {
  Words allowed;
};

/// A list of different words.
struct WordList {
  Words allowed;
};

/// `[[time in s, value], …]`
struct Profile {
  Range time;
  Range value;
};

/// `[lowest, highest]`, the one below the other.
struct Interval {
  Range range;
};

/// true or false; true where absent.
struct Truth {};

/// How far the true value of another key may be from the scene's: a relative half width,
/// `{ normal = deviation }`, relative too, or `{ range = [lowest, highest] }`; of integers the range
/// alone.
struct Spread {
  Range range;         ///< of the other key
  bool whole = false;  ///< that one holds integers
};

using Allowed = std::variant<Number, Integer, Word, WordList, Profile, Interval, Truth, Spread>;

/// Of a relative half width or standard deviation.
inline constexpr Range spread_range{0.0, 100.0, "", true};

/// The key must be there wherever it is used.
struct Required {};

/// Of all keys of a table that stand in for another, exactly one must be there; which pair, depends
/// on the rest of the scene.
struct Instead {
  std::string_view other;
};

/// What holds without the key, in words.
struct Rule {
  std::string words;
};

/// What holds without the key; a number or a word is its default.
using Absent = std::variant<Required, Instead, double, std::string_view, Rule>;

struct Key {
  std::string_view name;
  Allowed allowed;
  Absent absent;
  std::string meaning;    ///< one line
  std::string used = {};  ///< the mode, the laws or the methods that use the key; empty: every one
};

/// A table has fewer keys than this.
inline constexpr std::size_t most_keys = 128;

struct KeyTable {
  std::string_view name;
  bool required;
  std::string meaning;
  std::vector<Key> keys;
  /// The keys are those of other tables: `"table.key"`, in quotes since TOML takes a dot for more.
  bool of_others = false;
};

/// Every table with its keys, in the order in which scenes are read and echoed.
const std::vector<KeyTable>& key_tables();

/// The table of this name; null if there is none.
const KeyTable* find_table(std::string_view name);
/// Its key of this name; null if there is none.
const Key* find_key(const KeyTable& table, std::string_view name);

/// @throws std::logic_error  no scene has such a table
const KeyTable& key_table(std::string_view name);

/// @throws std::logic_error  the table has no such key
const Key& key_of(const KeyTable& table, std::string_view name);

/// `kg`, `m/s`, `periods`; empty for words and for numbers without a unit. Of a profile, that of its
/// values.
std::string_view unit_of(const Key& key);

/// Adds each once, as the laws describe them; laws may share a key.
void add_law_keys(std::vector<Key>& keys);

}  // namespace sonoglide::scene_file
