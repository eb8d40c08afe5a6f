#include "host_sim/studies/identify/impedance/sweep_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "host_sim/studies/identify/impedance/circuit.hpp"
#include "host_sim/studies/identify/unit.hpp"

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;

constexpr const char* what_is_read =
    "magnitude and phase, real and imaginary part, or a magnitude alone, as "
    "impedance_magnitude_ohm,impedance_phase_deg; S11 is read from Touchstone files, .s1p";

const char* subject_in_words(Subject subject) {
  return subject == Subject::admittance ? "an admittance" : "an impedance";
}

std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t most = 20;
  std::string list;
  for (std::size_t i = 0; i < std::min(names.size(), most); ++i) {
    list += fmt::format("{}{}", i == 0 ? "" : ", ", shortened(names[i]));
  }
  return names.size() > most ? list + fmt::format(" and {} more", names.size() - most) : list;
}

/// The columns of a table by what their names say.
class Columns {
 public:
  explicit Columns(const MeasuredTable& table) : table_(table) {
    for (std::size_t i = 0; i < table.names().size(); ++i) {
      columns_.push_back({read_name(table.names()[i]), i});
      has_ratio_ = has_ratio_ || is_of_ratio(table.names()[i]);
    }
  }

  SweepColumn frequency() const {
    const std::vector<SweepColumn> found = of(Role::frequency, Subject::unknown);
    if (found.empty()) {
      refuse_what_is_not_understood();
      throw table_.heading_error(
          fmt::format("no column is a frequency among {}; allowed: a name as frequency_Hz",
                      listed(table_.names())));
    }
    require_one(found);
    return found.front();
  }

  /// Every pair that is there once.
  std::vector<SweepColumns> pairs() const {
    std::vector<SweepColumns> found;
    for (const Subject subject : {Subject::impedance, Subject::admittance}) {
      add_pair(candidates(Role::magnitude, subject), phases(subject), found);
      add_pair(candidates(Role::real, subject), candidates(Role::imaginary, subject), found);
    }
    if (found.empty()) {
      // |Z| beside a phase of Y.
      add_pair(candidates(Role::magnitude, Subject::impedance), phases(Subject::admittance), found);
      add_pair(candidates(Role::magnitude, Subject::admittance), phases(Subject::impedance), found);
    }
    return found;
  }

  /// Of a magnitude that stands beside a pair of others.
  void add_further_magnitudes(std::vector<SweepColumns>& forms) const {
    for (const Subject subject : {Subject::impedance, Subject::admittance}) {
      const std::vector<SweepColumn> found = of(Role::magnitude, subject);
      if (found.size() == 1 && !found.front().name.is_bare_unit &&
          std::none_of(forms.begin(), forms.end(), [&](const SweepColumns& each) {
            return each.first.index == found.front().index;
          })) {
        forms.push_back({found.front(), std::nullopt});
      }
    }
  }

  SweepColumns magnitude_alone() const {
    refuse_what_is_not_understood();
    for (const Role role : {Role::magnitude, Role::phase, Role::real, Role::imaginary}) {
      for (const Subject subject : {Subject::impedance, Subject::admittance, Subject::unknown}) {
        require_one(of(role, subject));
      }
    }
    const auto is_phase = [](const SweepColumn& each) { return each.name.role == Role::phase; };
    const auto phase = std::find_if(columns_.begin(), columns_.end(), is_phase);
    for (const Subject subject : {Subject::impedance, Subject::admittance}) {
      const std::vector<SweepColumn> found = candidates(Role::magnitude, subject);
      if (found.empty()) {
        continue;
      }
      if (phase != columns_.end()) {
        throw error(*phase,
                    "may be the phase of another column; allowed: a name that says of what, "
                    "as impedance_phase_deg");
      }
      if (found.front().name.is_bare_unit) {
        throw error(found.front(), fmt::format("is a unit and no name; allowed: {}", what_is_read));
      }
      return {found.front(), std::nullopt};
    }
    for (const SweepColumn& each : columns_) {
      if (each.name.role == Role::real || each.name.role == Role::imaginary) {
        throw error(each,
                    fmt::format("is half of a pair, and does not tell the capacitances alone; "
                                "allowed: {}",
                                what_is_read));
      }
    }
    throw table_.heading_error(
        fmt::format("no columns of an impedance or admittance among {}; allowed: {}",
                    listed(table_.names()), what_is_read));
  }

  /// Of columns that a person may think are read; beside a magnitude alone, of all others.
  std::string warning_of_unread(const FoundColumns& read) const {
    std::vector<std::string> unread;
    for (const SweepColumn& each : columns_) {
      const auto has = [&](const SweepColumns& form) {
        return form.first.index == each.index || (form.second && form.second->index == each.index);
      };
      const bool is_of_sweep = !read.forms.front().second || each.name.role != Role::none ||
                               !each.name.not_understood.empty();
      if (is_of_sweep && each.index != read.frequency.index &&
          std::none_of(read.forms.begin(), read.forms.end(), has)) {
        unread.push_back(fmt::format("\"{}\"", shortened(table_.names()[each.index])));
      }
    }
    return unread.empty() ? std::string()
                          : fmt::format("Read is {}. Not read: {}.",
                                        read.forms.front().description(), fmt::join(unread, ", "));
  }

  scene_file::SceneError error(const SweepColumn& column, const std::string& message) const {
    return table_.heading_error(
        column.index, fmt::format("\"{}\" {}", shortened(table_.names()[column.index]), message));
  }

 private:
  std::vector<SweepColumn> of(Role role, Subject subject) const {
    std::vector<SweepColumn> found;
    std::copy_if(columns_.begin(), columns_.end(), std::back_inserter(found),
                 [&](const SweepColumn& each) {
                   return each.name.role == role && each.name.subject == subject;
                 });
    return found;
  }

  /// Those that say of what they are; else, of an impedance, those that do not.
  std::vector<SweepColumn> candidates(Role role, Subject subject) const {
    std::vector<SweepColumn> found = of(role, subject);
    return found.empty() && subject == Subject::impedance ? of(role, Subject::unknown) : found;
  }

  /// A phase need not say of what, if nothing else has one.
  std::vector<SweepColumn> phases(Subject subject) const {
    std::vector<SweepColumn> found = of(Role::phase, subject);
    return found.empty() && !has_ratio_ ? of(Role::phase, Subject::unknown) : found;
  }

  static void add_pair(const std::vector<SweepColumn>& first,
                       const std::vector<SweepColumn>& second, std::vector<SweepColumns>& found) {
    if (first.size() == 1 && second.size() == 1) {
      found.push_back({first.front(), second.front()});
    }
  }

  void require_one(const std::vector<SweepColumn>& found) const {
    if (found.size() > 1) {
      throw table_.heading_error(
          found[1].index,
          fmt::format("\"{}\" and \"{}\" are the same; allowed: one of them",
                      table_.names()[found[0].index], table_.names()[found[1].index]));
    }
  }

  void refuse_what_is_not_understood() const {
    for (const SweepColumn& each : columns_) {
      if (!each.name.not_understood.empty()) {
        throw error(each, fmt::format("is not understood: \"{}\" is no unit of it and no name; "
                                      "allowed: {}; units are {}",
                                      each.name.not_understood, what_is_read, known_units()));
      }
    }
  }

  const MeasuredTable& table_;
  std::vector<SweepColumn> columns_;
  bool has_ratio_ = false;
};

std::string sentence_of_assumed_subject(const MeasuredTable& table, const SweepColumns& form) {
  return form.first.name.subject != Subject::unknown
             ? std::string()
             : fmt::format(
                   "\"{}\" does not say of what it is: it is taken for an impedance in ohm.",
                   table.names()[form.first.index]);
}

/// Gives a phase without a unit one. @return a sentence that says so; empty where it has a unit
std::string complete_unit(SweepColumn& phase, const std::vector<double>& phases) {
  if (phase.name.has_unit) {
    return {};
  }
  double most = 0.0;
  for (const double each : phases) {
    most = std::max(most, std::abs(each));
  }
  constexpr double most_in_radians = 3.2;
  const bool radians = most <= most_in_radians;
  phase.name.scale *= radians ? 1.0 : two_pi / 360.0;
  return fmt::format(
      "The phase has no unit in its name; as its largest value is {:.4g} it is taken for {}.", most,
      radians ? "radians" : "degrees");
}

/// Of a magnitude alone its magnitude. Not finite or 0: it is none.
Complex admittance_S(const SweepColumns& columns, double first_cell, double second_cell) {
  const Subject subject = columns.first.name.subject;
  const double value = columns.first.name.value(first_cell);
  const double second = columns.second ? columns.second->name.value(second_cell) : 0.0;
  if (subject == Subject::reflection) {
    const Complex reflection =
        columns.rectangular() ? Complex(value, second) : value * std::polar(1.0, second);
    return (1.0 - reflection) / ((1.0 + reflection) * columns.reference_ohm);
  }
  const bool is_admittance = subject == Subject::admittance;
  if (columns.rectangular()) {
    const Complex given(value, second);
    return is_admittance ? given : 1.0 / given;
  }
  const Subject named = columns.second ? columns.second->name.subject : Subject::unknown;
  const Subject of_phase = named == Subject::unknown ? subject : named;
  return std::polar(std::abs(is_admittance ? value : 1.0 / value),
                    of_phase == Subject::admittance ? second : -second);
}

}  // namespace

std::string SweepColumns::description() const {
  const std::string subject = subject_in_words(first.name.subject);
  return !second         ? "the magnitude of " + subject
         : rectangular() ? "real and imaginary part of " + subject
                         : "magnitude and phase of " + subject;
}

bool are_names_of_a_sweep(const std::vector<std::string>& names) {
  bool has_frequency = false;
  bool has_other = false;
  for (const std::string& each : names) {
    const ColumnName name = read_name(each);
    const bool is_frequency = name.role == Role::frequency;
    has_frequency = has_frequency || is_frequency;
    has_other =
        has_other || (!is_frequency && (name.role != Role::none || !name.not_understood.empty()));
  }
  return has_frequency && has_other;
}

FoundColumns find_columns(const MeasuredTable& table) {
  const Columns columns(table);
  FoundColumns found{columns.frequency(), columns.pairs(), {}};
  if (found.forms.empty()) {
    found.forms = {columns.magnitude_alone()};
  }
  columns.add_further_magnitudes(found.forms);
  for (const std::string& each : {sentence_of_assumed_subject(table, found.forms.front()),
                                  columns.warning_of_unread(found)}) {
    if (!each.empty()) {
      found.warnings.push_back(each);
    }
  }
  return found;
}

std::vector<double> frequencies_Hz(const MeasuredTable& table, const SweepColumn& column) {
  std::vector<double> result = table.numbers(column.index);
  for (std::size_t row = 0; row < result.size(); ++row) {
    result[row] = column.name.value(result[row]);
    if (!(result[row] > 0.0) || !std::isfinite(result[row])) {
      throw table.error(row, column.index, "is no frequency; allowed: above 0");
    }
  }
  return result;
}

std::vector<Complex> admittances_S(const MeasuredTable& table, const MeasuredTable& second_table,
                                   SweepColumns columns, std::vector<std::string>& warnings) {
  const std::vector<double> first = table.numbers(columns.first.index);
  const std::vector<double> second = columns.second ? second_table.numbers(columns.second->index)
                                                    : std::vector<double>(first.size());
  const bool is_magnitude =
      !columns.rectangular() && columns.first.name.subject != Subject::reflection;
  if (columns.second && !columns.rectangular()) {
    if (const std::string assumed = complete_unit(*columns.second, second); !assumed.empty()) {
      warnings.push_back(assumed);
    }
  }
  std::vector<Complex> result(table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    if (is_magnitude && !(columns.first.name.value(first[row]) > 0.0)) {
      throw table.error(row, columns.first.index, "is no magnitude; allowed: above 0");
    }
    result[row] = admittance_S(columns, first[row], second[row]);
    if (!std::isfinite(std::abs(result[row])) || std::abs(result[row]) == 0.0) {
      throw table.error(row, columns.first.index,
                        "has an admittance of 0 or without end; allowed: one of a capacitance");
    }
  }
  return result;
}

}  // namespace sonoglide::identify::impedance
