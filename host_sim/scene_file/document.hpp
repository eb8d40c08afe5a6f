/// A scene file as tables of located values: parsed, overridden, every name known.
#pragma once

#include <toml++/toml.h>

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "host_sim/scene_file/override.hpp"
#include "host_sim/scene_file/scene_error.hpp"
#include "host_sim/scene_file/source.hpp"

namespace sonoglide::scene_file {

/// One value. One from an option has a single place, its `--set` or `--vary`.
struct GivenValue {
  const toml::node* value = nullptr;  ///< null for a varied key
  Location key_place;
  Location value_place;
  bool overridden = false;
  std::size_t varied = 0;  ///< which of the varied keys, where it is one

  /// Where an element of this value stands.
  Location place_of(const toml::node& element) const;
};

struct SceneTable {
  std::string name;
  Location place;
  std::map<std::string, GivenValue, std::less<>> entries;
  bool lost_keys = false;  ///< some of them to --set
};

/// Values live as long as the document. It does not change: any number of threads may read it.
class Document {
 public:
  /// Text larger than this is no scene; the bound keeps a wrong file from filling the memory.
  static constexpr std::size_t max_bytes = 1U << 20U;

  /// @param overrides  `TABLE.KEY=VALUE` each, in the order given; a later one wins; one without
  ///                   VALUE removes the key
  /// @param varied     `TABLE.KEY` each: keys whose values come with every reading. They count as
  ///                   overrides after the others, in errors too
  /// @throws SceneError  not TOML, too large, too deeply nested, a name that no scene has, an
  ///                     override or a varied key that is not of that form
  explicit Document(const Source& source, const std::vector<std::string>& overrides = {},
                    const std::vector<std::string>& varied = {});

  Document(const Document&) = delete;
  Document& operator=(const Document&) = delete;

  /// The table of this name; null where the scene has none.
  const SceneTable* find(std::string_view name) const;
  /// The same with the values of [true_values] in the place of those that they stand for.
  const SceneTable* find_true(std::string_view name) const;

  /// Where the value of `TABLE.KEY` stands, or a whole table; what is left to its default stands
  /// where its table does, or at the beginning of the file.
  Location place_of(std::string_view dotted_key) const;
  /// Whether `TABLE.KEY` has a value in the file or by an override.
  bool gives(std::string_view dotted_key) const { return given(dotted_key) != nullptr; }

  /// Of the source.
  const std::string& name() const { return name_; }

  /// The beginning of the file: the place of what is missing as a whole.
  Location start() const { return {file_, 1, 1}; }

 private:
  const GivenValue* given(std::string_view dotted_key) const;
  void collect();
  void collect_table(const std::string& name, const Location& place, const toml::table& table);
  void apply_override(const std::string& text, std::size_t ordinal);
  void remove(const OverriddenKey& target);
  void vary(const std::string& path, std::size_t index);
  void place_true_values();
  GivenValue& overridden_entry(const OverriddenKey& target);

  std::string file_;
  std::string name_;
  toml::table root_;
  std::deque<toml::table> override_values_;  ///< never moved once in
  std::map<std::string, SceneTable, std::less<>> tables_;
  std::map<std::string, SceneTable, std::less<>> true_tables_;  ///< those that differ
};

}  // namespace sonoglide::scene_file
