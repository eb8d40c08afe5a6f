/// The values of one scene table as they are given, each checked.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/scene/tolerance.hpp"
#include "host_sim/scene_file/keys.hpp"
#include "host_sim/scene_file/variant.hpp"

namespace sonoglide::scene_file {

/// Every reading call is for a key that is there, and throws SceneError where its value is not what
/// is allowed.
class TableCursor {
 public:
  /// @param variant  outlives the cursor; an absent table has no values
  TableCursor(const Variant& variant, const KeyTable& keys)
      : variant_(variant), keys_(keys), table_(variant.find(keys.name)) {}
  TableCursor(const Variant& variant, std::string_view table)
      : TableCursor(variant, key_table(table)) {}

  const KeyTable& keys() const { return keys_; }
  bool present() const { return table_ != nullptr; }
  /// Whether --set has removed every key that it had.
  bool emptied() const { return present() && table_->lost_keys && table_->entries.empty(); }
  bool has(std::string_view key) const { return find(key) != nullptr; }
  /// Null where absent.
  const GivenValue* find(std::string_view key) const;

  /// An integer is taken where a real number is meant, never the other way round.
  double real(std::string_view key, const Range& range) const;
  std::int64_t integer(std::string_view key, const Integer& range) const;
  /// Its place among those that are allowed.
  std::size_t word(std::string_view key, const Words& allowed) const;
  /// Different ones in any order.
  std::vector<std::size_t> words(std::string_view key, const Words& allowed) const;
  bool truth(std::string_view key) const;

  using Pair = std::array<double, 2>;
  /// `[lowest, highest]`.
  Pair interval(std::string_view key, const Range& range) const;
  /// rise: each is after the one before. jump: two in succession may be one, at a jump.
  enum class Times { rise, jump };
  static constexpr const char* allowed_pairs = "a list of pairs [[time in s, number], …]";
  /// `[[time_s, value], …]`: at least one pair.
  std::vector<Pair> timed_values(std::string_view key, const Range& time, const Range& value,
                                 Times times) const;

  /// Numbers of a texture over one period.
  static constexpr std::size_t fewest_points = 2;
  static constexpr std::size_t most_points = 1024;
  /// `{ period_m = length, ratio = [value, …] }`, or force_N in place of ratio.
  scene::Texture texture(std::string_view key, const TextureTable& allowed) const;

  /// A key of [tolerance]; its nominal value is left open, and so are the ends that follow from it.
  scene::Tolerance spread(std::string_view key, const Spread& allowed) const;
  /// Every key of the table that is there: in the order of the file, options after it.
  std::vector<std::string> given_keys() const;

  /// The one of two keys that is there; without either, the first.
  std::string_view given_of(std::string_view first, std::string_view second) const {
    return has(second) ? second : first;
  }
  /// @throws SceneError  both of them are there
  void exclude(std::string_view first, std::string_view second) const;

  /// Throws for the key; at the table where the key is absent, at the file's start without table.
  [[noreturn]] void fail(std::string_view key, const std::string& message) const;
  [[noreturn]] void fail_missing(std::string_view key, const std::string& allowed) const;
  /// Throws for the table as a whole.
  [[noreturn]] void fail(const std::string& message) const;
  /// A key that is there, of which the scene makes no use: nothing that it holds may be silently
  /// ignored. Where the variant takes unused keys, it gets it.
  /// @throws SceneError  the variant takes none
  void reject(std::string_view key, std::string_view reason) const;

 private:
  /// A value, or a part of one: spelt out only where an error needs it.
  struct Part {
    std::string_view key;
    std::string_view name = {};  ///< in the table that the key holds; empty: none
    std::optional<std::size_t> element = std::nullopt;
    std::optional<std::size_t> member = std::nullopt;  ///< of the element
  };

  const GivenValue& given(std::string_view key) const { return *find(key); }
  const toml::node& node(std::string_view key) const { return variant_.value(given(key)); }
  Location place() const;
  std::string path_of(const Part& part) const;
  [[noreturn]] void fail_part(const toml::node& node, const Part& part,
                              const std::string& message) const;
  [[noreturn]] void fail_spread(std::string_view key, const std::string& found, bool whole) const;

  double number_in(const toml::node& node, const Part& part, const Range& range) const;
  std::size_t word_in(const toml::node& node, const Part& part, const Words& allowed) const;
  std::vector<double> points_in(const toml::node& node, const Part& part, const Range& range) const;
  Pair ends_in(std::string_view key, const toml::node& node, const Spread& allowed) const;
  scene::Tolerance spread_in(std::string_view key, const toml::table& table,
                             const Spread& allowed) const;
  void check_time(const toml::node& node, const Part& part, const std::vector<Pair>& pairs,
                  Times times) const;
  void check_order(std::string_view key, const Pair& ends) const;

  const Variant& variant_;
  const KeyTable& keys_;
  const SceneTable* table_;
};

/// Whether one value stands before another: the file comes first, then --set, then --vary.
bool is_earlier(const GivenValue& a, const GivenValue& b);

}  // namespace sonoglide::scene_file
