#include "host_sim/scene_file/table_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "host_sim/scene_file/law_keys.hpp"
#include "host_sim/scene_file/member.hpp"

namespace sonoglide::scene_file {
namespace {

/// Puts the value of one key into a scene, or what holds without it.
class Reading {
 public:
  Reading(const TableCursor& cursor, const Key& key, scene::Scene& scene)
      : cursor_(cursor), key_(key), scene_(scene), given_(cursor.has(key.name)) {}

  void operator()(std::monostate /*nowhere*/) const {}
  void operator()(Of<double> number) const { number(scene_) = given_ ? real() : absent(); }
  void operator()(OrZero number) const { (*this)(number.number); }
  void operator()(Of<std::optional<double>> number) const {
    number(scene_) = given_ ? std::optional(real()) : std::nullopt;
  }
  void operator()(Of<int> number) const { number(scene_) = static_cast<int>(integer()); }
  void operator()(Of<std::optional<int>> number) const {
    number(scene_) = given_ ? std::optional(static_cast<int>(integer())) : std::nullopt;
  }
  void operator()(Of<std::uint64_t> number) const {
    number(scene_) = static_cast<std::uint64_t>(integer());
  }
  void operator()(Of<bool> truth) const { truth(scene_) = !given_ || cursor_.truth(key_.name); }

  void operator()(Choice choice) const {
    const Words& words = std::get<Word>(key_.allowed).allowed;
    if (given_) {
      choice.choose(scene_, cursor_.word(key_.name, words));
    } else if (const auto* word = std::get_if<std::string_view>(&key_.absent)) {
      const auto found = std::find(words.begin(), words.end(), *word);
      choice.choose(scene_, static_cast<std::size_t>(found - words.begin()));
    } else if (std::holds_alternative<Required>(key_.absent)) {
      cursor_.fail_missing(key_.name, fmt::format("\"{}\"", fmt::join(words, "\" or \"")));
    }
  }
  void operator()(Of<std::vector<scene::Channel>> channels) const {
    if (given_) {
      for (const std::size_t index :
           cursor_.words(key_.name, std::get<WordList>(key_.allowed).allowed)) {
        channels(scene_).push_back(scene::channels[index].value);
      }
    }
  }
  void operator()(Of<std::optional<scene::FrequencyRange>> frequencies) const {
    if (given_) {
      const auto ends = cursor_.interval(key_.name, std::get<Interval>(key_.allowed).range);
      frequencies(scene_) = scene::FrequencyRange{ends[0], ends[1]};
    }
  }

  void operator()(Of<std::optional<scene::Texture>> texture) const {
    if (given_) {
      texture(scene_) = cursor_.texture(key_.name, std::get<TextureTable>(key_.allowed));
    }
  }

  void operator()(Of<scene::TimedProfile> profile) const {
    if (given_) {
      read_rows(profile(scene_), TableCursor::Times::jump);
    }
  }
  void operator()(InPlaceOf level) const {
    if (given_) {
      (*this)(level.profile);
      level.number(scene_) = scene::value_at(level.profile(scene_), 0.0);
    }
  }
  void operator()(Of<std::vector<scene::SpeedPoint>> points) const {
    if (given_) {
      read_rows(points(scene_), TableCursor::Times::rise);
    }
  }
  void operator()(ConstantSpeed constant) const {
    constant.profile(scene_).push_back({0.0, real()});
  }
  void operator()(Of<std::vector<scene::TargetStep>> steps) const {
    if (given_) {
      read_rows(steps(scene_), TableCursor::Times::rise);
    }
  }
  void operator()(Periods periods) const {
    if (given_) {
      periods.time_s(scene_) = real() / scene_.drive->frequency_Hz;
    }
  }
  void operator()(OwnOfLaw /*law*/) const {
    for (const scene::ContactValues& contact : extreme_contacts(scene_.friction)) {
      const OwnKeys keys = own_keys(scene_.friction.law, contact);
      const OwnKey& own = *keys.find(key_.name);
      if (!given_ && own.required) {
        cursor_.fail_missing(key_.name, own.range.allowed_text());
      } else if (given_ && own.count != nullptr) {
        *own.count = static_cast<int>(cursor_.integer(key_.name, whole(own.range)));
      } else if (given_) {
        *own.number = cursor_.real(key_.name, own.range);
      }
    }
  }

 private:
  Range range() const {
    const Number& number = std::get<Number>(key_.allowed);
    return number.range_in != nullptr ? number.range_in(scene_) : number.range;
  }
  double real() const { return cursor_.real(key_.name, range()); }

  double absent() const {
    if (const auto* number = std::get_if<double>(&key_.absent)) {
      return *number;
    }
    const auto* rule = std::get_if<Rule>(&key_.absent);
    const std::optional<double> number =
        rule != nullptr && rule->number != nullptr ? rule->number(scene_) : std::nullopt;
    if (!number) {
      cursor_.fail_missing(key_.name, range().allowed_text());
    }
    return *number;
  }

  std::int64_t integer() const {
    return given_ ? cursor_.integer(key_.name, std::get<Integer>(key_.allowed))
                  : static_cast<std::int64_t>(std::get<double>(key_.absent));
  }

  template <class Row>
  void read_rows(std::vector<Row>& rows, TableCursor::Times times) const {
    const Profile& allowed = std::get<Profile>(key_.allowed);
    const Range value = allowed.value_in != nullptr ? allowed.value_in(scene_) : allowed.value;
    for (const auto& [time_s, number] :
         cursor_.timed_values(key_.name, allowed.time, value, times)) {
      rows.push_back({time_s, number});
    }
  }

  const TableCursor& cursor_;
  const Key& key_;
  scene::Scene& scene_;
  bool given_;
};

/// Of one key of a table, once the other has been read.
bool is_decided(const Use& use, const KeyTable& of_key, const KeyTable& read) {
  return use.decided_by.empty() ? &of_key == &read : use.decided_by == read.name;
}

/// The first condition, decided by a table, that does not hold; null if there is none.
const Use* first_broken(const Key& key, const KeyTable& of_key, const KeyTable& read,
                        const scene::Scene& scene) {
  const auto broken = std::find_if(key.uses.begin(), key.uses.end(), [&](const Use& use) {
    return is_decided(use, of_key, read) && !use.holds(scene);
  });
  return broken == key.uses.end() ? nullptr : &*broken;
}

/// A key that is an error in itself in this scene.
void check_kind(const TableCursor& cursor, const Key& key, const scene::Scene& scene) {
  for (const Use& use : key.uses) {
    if (use.wrong && !use.holds(scene) && cursor.has(key.name)) {
      cursor.fail(key.name, use.reason(scene));
    }
  }
}

/// Of a key in whose place another may be.
/// @return whether one is
bool is_replaced(const TableCursor& cursor, const Key& key) {
  const std::vector<std::string_view> others = key.others();
  bool replaced = false;
  for (auto other = others.begin(); other != others.end(); ++other) {
    cursor.exclude(key.name, *other);
    std::for_each(others.begin(), other,
                  [&](std::string_view before) { cursor.exclude(before, *other); });
    replaced = replaced || cursor.has(*other);
  }
  if (!others.empty() && !replaced && !cursor.has(key.name) &&
      std::holds_alternative<Instead>(key.absent)) {
    cursor.fail(key.name,
                fmt::format("missing; required: {} or {}", key.name, fmt::join(others, " or ")));
  }
  return replaced;
}

struct Unused {
  const KeyTable* table;
  const Key* key;
  const GivenValue* value;
  std::string reason;
};

using KeyOfTable = std::pair<const KeyTable*, const Key*>;

const std::vector<KeyOfTable>& keys_decided_later() {
  static const std::vector<KeyOfTable> all = [] {
    std::vector<KeyOfTable> later;
    for (const KeyTable& table : key_tables()) {
      for (const Key& key : table.keys) {
        if (!table.of_others && std::any_of(key.uses.begin(), key.uses.end(), [](const Use& use) {
              return !use.decided_by.empty();
            })) {
          later.emplace_back(&table, &key);
        }
      }
    }
    return later;
  }();
  return all;
}

}  // namespace

void read_table(const TableCursor& cursor, scene::Scene& scene) {
  for (const Key& key : cursor.keys().keys) {
    check_kind(cursor, key, scene);
  }
  for (const Key& key : cursor.keys().keys) {
    if (first_broken(key, cursor.keys(), cursor.keys(), scene) == nullptr &&
        !is_replaced(cursor, key)) {
      std::visit(Reading(cursor, key, scene), key.member);
    }
  }
}

void reject_unused(const Variant& variant, const KeyTable& table, const scene::Scene& scene) {
  std::vector<Unused> unused;
  const auto judge = [&](const KeyTable& of_key, const Key& key) {
    const Use* broken = first_broken(key, of_key, table, scene);
    const GivenValue* value =
        broken != nullptr ? TableCursor(variant, of_key).find(key.name) : nullptr;
    if (value != nullptr && !broken->reason(scene).empty()) {
      unused.push_back({&of_key, &key, value, broken->reason(scene)});
    }
  };
  for (const Key& key : table.keys) {
    judge(table, key);
  }
  for (const auto& [of_key, key] : keys_decided_later()) {
    if (of_key != &table) {
      judge(*of_key, *key);
    }
  }
  std::sort(unused.begin(), unused.end(),
            [](const Unused& a, const Unused& b) { return is_earlier(*a.value, *b.value); });
  for (const Unused& each : unused) {
    TableCursor(variant, *each.table).reject(each.key->name, each.reason);
  }
}

}  // namespace sonoglide::scene_file
