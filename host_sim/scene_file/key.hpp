/// What is told of a key of a scene, once: its name, what it may hold and in which unit, where a scene
/// keeps it, what holds without it, what it means, and which scenes use it.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "host_sim/scene/scene.hpp"

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
  /// `a number, 0 to 100`
  std::string allowed_text() const { return "a number, " + text(); }
};

// Ranges that several keys have.

inline constexpr double largest_force_N = 1e12;
inline constexpr double largest_speed_m_per_s = 1e6;
inline constexpr Range time_range{0.0, 1e9, "s"};
inline constexpr Range speed_range{-largest_speed_m_per_s, largest_speed_m_per_s, "m/s"};
inline constexpr Range force_range{0.0, largest_force_N, "N"};
inline constexpr Range frequency_range{1e-3, 1e9, "Hz"};

inline constexpr double standard_gravity_m_per_s2 = 9.81;
/// Hours of a carrier: more is a mistyped unit.
inline constexpr double most_periods = 1e10;

using Words = std::vector<std::string_view>;

/// A range that follows from keys that have been read before.
using RangeIn = Range (*)(const scene::Scene&);

struct Number {
  Range range;
  RangeIn range_in = nullptr;  ///< narrower than the range; null: the range
};

struct Integer {
  std::int64_t low;
  std::int64_t high;
  std::string_view unit = "";
};

constexpr Integer whole(const Range& range) {
  return {static_cast<std::int64_t>(range.low), static_cast<std::int64_t>(range.high), range.unit};
}

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
  RangeIn value_in = nullptr;  ///< narrower than that of the value; null: that
};

/// `[lowest, highest]`, the one below the other.
struct Interval {
  Range range;
};

/// true or false; true where absent.
struct Truth {};

/// `{ period_m = length, ratio = [value, …] }`, or `force_N` in place of `ratio`.
struct TextureTable {
  Range period;
  Range ratio;
  Range force;
};

/// How far the true value of another key may be from the scene's: a relative half width,
/// `{ normal = deviation }`, relative too, or `{ range = [lowest, highest] }`; of integers the range
/// alone.
struct Spread {
  Range range;         ///< of the other key
  bool whole = false;  ///< that one holds integers
};

using Allowed =
    std::variant<Number, Integer, Word, WordList, Profile, Interval, Truth, TextureTable, Spread>;

/// Of a relative half width or standard deviation.
inline constexpr Range spread_range{0.0, 100.0, "", true};

/// The key must be there wherever it is used.
struct Required {};

/// Of all keys of a table that stand in for another, exactly one must be there; which ones they are,
/// depends on the rest of the scene.
struct Instead {
  std::string_view others;  ///< in words
};

/// What holds without the key, in words.
struct Rule {
  std::string words;
  /// A number that follows from keys that have been read before; null or nullopt: a number that is
  /// not optional must be there.
  std::optional<double> (*number)(const scene::Scene&) = nullptr;
};

/// What holds without the key; a number or a word is its default.
using Absent = std::variant<Required, Instead, double, std::string_view, Rule>;

/// A value of a scene, whose tables that the key needs are there.
template <class Value>
using Of = Value& (*)(scene::Scene&);

/// 0 where the key is absent: the echo then leaves it out.
struct OrZero {
  Of<double> number;
};
/// One of the words, by its place among them; none where the key is absent and has no default.
struct Choice {
  std::optional<std::size_t> (*index)(scene::Scene&);
  void (*choose)(scene::Scene&, std::size_t);
};
/// A time in carrier periods; the scene keeps it in seconds.
struct Periods {
  Of<double> time_s;
};
/// A profile in the place of a number, which is its value at 0 s.
struct InPlaceOf {
  Of<double> number;
  Of<scene::TimedProfile> profile;
};
struct ConstantSpeed {
  Of<std::vector<scene::SpeedPoint>> profile;
};
/// A number of the friction law's own.
struct OwnOfLaw {};

/// Where a scene keeps the value of a key; nowhere for a key that tells of another.
using Member =
    std::variant<std::monostate, Of<double>, Of<std::optional<double>>, OrZero, Of<int>,
                 Of<std::optional<int>>, Of<std::uint64_t>, Of<bool>, Choice,
                 Of<std::vector<scene::Channel>>, Of<std::optional<scene::FrequencyRange>>,
                 Of<scene::TimedProfile>, Of<std::vector<scene::SpeedPoint>>,
                 Of<std::vector<scene::TargetStep>>, Of<std::optional<scene::Texture>>, Periods,
                 InPlaceOf, ConstantSpeed, OwnOfLaw>;

/// A condition on the scene, under which a key is used.
struct Use {
  std::string text;  ///< for the reference of keys; empty where another condition implies it
  std::function<bool(const scene::Scene&)> holds;
  /// What is wrong where it does not hold: `not used OTHERWISE; remove it`. Empty: the key may stay.
  std::string otherwise;
  std::string (*otherwise_in)(const scene::Scene&) = nullptr;  ///< the same, by the scene
  std::string_view decided_by = {};  ///< the table that decides it, if that comes after the key's
  bool wrong = false;  ///< the key is an error in itself there, and the reason its whole message

  std::string reason(const scene::Scene& scene) const {
    return otherwise_in != nullptr ? otherwise_in(scene) : otherwise;
  }
};
using Uses = std::vector<Use>;

/// All of both.
inline Uses operator+(Uses all, const Uses& more) {
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

struct Key {
  std::string_view name;
  Member member;
  Allowed allowed;
  Absent absent;
  std::string meaning;  ///< one line
  Uses uses = {};       ///< all must hold; none: every scene uses the key
  std::array<std::string_view, 2> replaced_by = {};  ///< see others()

  bool used(const scene::Scene& scene) const {
    for (const Use& use : uses) {
      if (!use.holds(scene)) {
        return false;
      }
    }
    return true;
  }
  /// The keys that may be there in its place.
  std::vector<std::string_view> others() const {
    std::vector<std::string_view> names;
    for (const std::string_view each : replaced_by) {
      if (!each.empty()) {
        names.push_back(each);
      }
    }
    return names;
  }
  /// The mode, the laws or the methods that use the key, in words; empty: every scene.
  std::string used_text() const;
};

struct KeyTable {
  std::string_view name;
  bool required;
  std::string meaning;
  std::vector<Key> keys;
  Uses uses = {};
  /// Of a table that a scene may be without: adds it, and tells whether it has it.
  void (*add)(scene::Scene&) = nullptr;
  bool (*has)(const scene::Scene&) = nullptr;
  /// The keys are those of other tables: `"table.key"`, in quotes since TOML takes a dot for more.
  bool of_others = false;
};

}  // namespace sonoglide::scene_file
