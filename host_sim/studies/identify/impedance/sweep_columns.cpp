#include "host_sim/studies/identify/impedance/sweep_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "host_sim/studies/identify/impedance/circuit.hpp"
#include "host_sim/studies/identify/text_file.hpp"
#include "host_sim/studies/identify/unit.hpp"

namespace sonoglide::identify::impedance {
namespace {

using Complex = std::complex<double>;
using Names = std::vector<ColumnName>;

constexpr const char* what_is_read =
    "magnitude and phase, real and imaginary part, or a magnitude alone, as "
    "impedance_magnitude_ohm,impedance_phase_deg; S11 is read from Touchstone files, .s1p";

struct Form {
  Role first;
  Role second;
  Subject subject;
  Subject second_subject;
};

/// The last two, |Z| beside a phase of Y, only where there is no other.
constexpr Form all_forms[] = {
    {Role::magnitude, Role::phase, Subject::impedance, Subject::impedance},
    {Role::real, Role::imaginary, Subject::impedance, Subject::impedance},
    {Role::magnitude, Role::phase, Subject::admittance, Subject::admittance},
    {Role::real, Role::imaginary, Subject::admittance, Subject::admittance},
    {Role::magnitude, Role::phase, Subject::impedance, Subject::admittance},
    {Role::magnitude, Role::phase, Subject::admittance, Subject::impedance}};

/// The columns of a table by what their names say.
class Columns {
 public:
  explicit Columns(const MeasuredTable& table) : table_(table) {
    for (const std::string& each : table.names()) {
      columns_.push_back(read_name(each));
      columns_.back().index = columns_.size() - 1;
      has_ratio_ = has_ratio_ || columns_.back().is_ratio;
    }
  }

  ColumnName frequency() const {
    const Names found = of(Role::frequency, Subject::unknown);
    if (found.size() > 1) {
      throw error(found[1], obstacle(found[1], false));
    }
    if (found.empty()) {
      refuse_what_is_not_understood();
      throw table_.heading_error(fmt::format(
          "no column is a frequency among {}; allowed: a name as frequency_Hz", all_names()));
    }
    return found.front();
  }

  std::vector<SweepColumns> forms() const {
    std::vector<SweepColumns> found;
    for (const Form& each : all_forms) {
      const Names first = candidates(each.first, each.subject);
      const Names second = candidates(each.second, each.second_subject);
      const bool is_one = each.subject == each.second_subject;
      if (first.size() == 1 && second.size() == 1 && (is_one || found.empty())) {
        found.push_back({first.front(), second.front()});
      }
    }
    if (found.empty()) {
      found = {{magnitude_alone(), std::nullopt}};
    }
    for (const Subject subject : {Subject::impedance, Subject::admittance}) {
      const Names further = of(Role::magnitude, subject);
      if (further.size() == 1 && !further.front().is_bare_unit && !has(found, further.front())) {
        found.push_back({further.front(), std::nullopt});
      }
    }
    return found;
  }

  /// Of columns that a person may think are read; beside a magnitude alone, of all others.
  void warn_of_unread(FoundColumns& read) const {
    std::vector<std::string> unread;
    for (const ColumnName& each : columns_) {
      const bool is_of_sweep =
          !read.forms.front().second || each.role != Role::none || !each.not_understood.empty();
      if (is_of_sweep && each.index != read.frequency.index && !has(read.forms, each)) {
        unread.push_back(fmt::format("\"{}\"", name(each)));
      }
    }
    if (!unread.empty()) {
      read.warnings.push_back(fmt::format(
          "Read is {}. Not read: {}.", read.forms.front().description(), fmt::join(unread, ", ")));
    }
  }

 private:
  Names of(Role role, Subject subject) const {
    Names found;
    std::copy_if(
        columns_.begin(), columns_.end(), std::back_inserter(found),
        [&](const ColumnName& each) { return each.role == role && each.subject == subject; });
    return found;
  }

  /// Those that say of what they are; else those that do not, which are of an impedance. A phase is of
  /// whatever there is, but of a ratio.
  Names candidates(Role role, Subject subject) const {
    const Names found = of(role, subject);
    const bool may_be_unnamed = role == Role::phase ? !has_ratio_ : subject == Subject::impedance;
    return found.empty() && may_be_unnamed ? of(role, Subject::unknown) : found;
  }

  static bool has(const std::vector<SweepColumns>& forms, const ColumnName& column) {
    return std::any_of(forms.begin(), forms.end(), [&](const SweepColumns& each) {
      return each.first.index == column.index ||
             (each.second && each.second->index == column.index);
    });
  }

  ColumnName magnitude_alone() const {
    refuse_what_is_not_understood();
    Names found = candidates(Role::magnitude, Subject::impedance);
    found = found.empty() ? of(Role::magnitude, Subject::admittance) : found;
    for (const ColumnName& each : columns_) {
      if (const std::string why = obstacle(each, !found.empty()); !why.empty()) {
        throw error(each, why);
      }
    }
    if (found.empty()) {
      throw table_.heading_error(
          fmt::format("no columns of an impedance or admittance among {}; allowed: {}", all_names(),
                      what_is_read));
    }
    return found.front();
  }

  /// Why the table cannot be read as a magnitude alone for a column; empty where it can.
  std::string obstacle(const ColumnName& column, bool has_magnitude) const {
    const auto twin = std::find_if(columns_.begin(), columns_.end(), [&](const ColumnName& each) {
      return each.role == column.role && each.subject == column.subject;
    });
    const bool is_part = column.role == Role::real || column.role == Role::imaginary;
    return column.role == Role::none ? ""
           : twin->index < column.index
               ? fmt::format("and \"{}\" are the same; allowed: one of them", name(*twin))
           : has_magnitude && column.role == Role::phase
               ? "may be the phase of another column; allowed: a name that says of what, as "
                 "impedance_phase_deg"
           : !has_magnitude && is_part
               ? fmt::format(
                     "is half of a pair, and does not determine the capacitances alone; "
                     "allowed: {}",
                     what_is_read)
           : column.role == Role::magnitude && column.is_bare_unit
               ? fmt::format("is a unit and no name; allowed: {}", what_is_read)
               : "";
  }

  void refuse_what_is_not_understood() const {
    for (const ColumnName& each : columns_) {
      if (!each.not_understood.empty()) {
        throw error(each, fmt::format("is not understood: \"{}\" is no unit of it and no name; "
                                      "allowed: {}; units are {}",
                                      each.not_understood, what_is_read, known_units()));
      }
    }
  }

  std::string name(const ColumnName& column) const {
    return shortened(table_.names()[column.index]);
  }

  std::string all_names() const {
    constexpr std::size_t most = 20;
    std::vector<std::string> names;
    for (std::size_t i = 0; i < std::min(columns_.size(), most); ++i) {
      names.push_back(name(columns_[i]));
    }
    const std::size_t more = columns_.size() - names.size();
    return fmt::to_string(fmt::join(names, ", ")) +
           (more > 0 ? fmt::format(" and {} more", more) : "");
  }

  scene_file::SceneError error(const ColumnName& column, const std::string& message) const {
    return table_.heading_error(column.index, fmt::format("\"{}\" {}", name(column), message));
  }

  const MeasuredTable& table_;
  Names columns_;
  bool has_ratio_ = false;
};

/// Gives a phase without a unit one, and says so.
void complete_unit(ColumnName& phase, const std::vector<double>& phases,
                   std::vector<std::string>& warnings) {
  constexpr double most_in_radians = 3.2;
  const auto [least, most] = std::minmax_element(phases.begin(), phases.end());
  const double largest = std::max(-*least, *most);
  const bool radians = largest <= most_in_radians;
  phase.scale *= radians ? 1.0 : two_pi / 360.0;
  warnings.push_back(fmt::format(
      "The phase has no unit in its name; as its largest value is {:.4g} it is taken for {}.",
      largest, radians ? "radians" : "degrees"));
}

/// Of a magnitude alone its magnitude. Not finite or 0: it is none.
Complex admittance_S(const SweepColumns& columns, double value, double second) {
  const Subject subject = columns.first.subject;
  const bool is_admittance = subject == Subject::admittance;
  if (subject == Subject::reflection) {
    const Complex reflection =
        columns.rectangular() ? Complex(value, second) : value * std::polar(1.0, second);
    return (1.0 - reflection) / ((1.0 + reflection) * columns.reference_ohm);
  }
  if (columns.rectangular()) {
    const Complex given(value, second);
    return is_admittance ? given : 1.0 / given;
  }
  const Subject named = columns.second ? columns.second->subject : subject;
  const bool of_admittance = (named == Subject::unknown ? subject : named) == Subject::admittance;
  const double magnitude_S = std::abs(is_admittance ? value : 1.0 / value);
  return std::polar(magnitude_S, of_admittance ? second : -second);
}

}  // namespace

std::string SweepColumns::description() const {
  const std::string subject =
      first.subject == Subject::admittance ? "an admittance" : "an impedance";
  return !second         ? "the magnitude of " + subject
         : rectangular() ? "real and imaginary part of " + subject
                         : "magnitude and phase of " + subject;
}

bool are_names_of_a_sweep(const std::vector<std::string>& names) {
  bool has_frequency = false;
  bool has_other = false;
  for (const std::string& each : names) {
    const ColumnName name = read_name(each);
    bool& has = name.role == Role::frequency ? has_frequency : has_other;
    has = has || name.role != Role::none || !name.not_understood.empty();
  }
  return has_frequency && has_other;
}

FoundColumns find_columns(const MeasuredTable& table) {
  const Columns columns(table);
  FoundColumns found{columns.frequency(), columns.forms(), {}};
  const ColumnName& first = found.forms.front().first;
  if (first.subject == Subject::unknown) {
    found.warnings.push_back(
        fmt::format("\"{}\" does not say of what it is: it is taken for an impedance in ohm.",
                    table.names()[first.index]));
  }
  columns.warn_of_unread(found);
  return found;
}

Sweep sweep_of(const MeasuredTable& table, const MeasuredTable& second_table,
               const ColumnName& frequency, SweepColumns columns) {
  Sweep sweep;
  sweep.has_phase = columns.second.has_value();
  sweep.warnings = table.warnings();
  sweep.frequency_Hz = table.numbers(frequency.index);
  const ColumnName& first = columns.first;
  const std::vector<double> firsts = table.numbers(first.index);
  std::vector<double> seconds(firsts.size());
  if (columns.second) {
    seconds = second_table.numbers(columns.second->index);
    if (!columns.rectangular() && !columns.second->has_unit) {
      complete_unit(*columns.second, seconds, sweep.warnings);
    }
  }
  const bool is_magnitude = !columns.rectangular() && first.subject != Subject::reflection;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    double& each_Hz = sweep.frequency_Hz[row];
    each_Hz = frequency.value(each_Hz);
    if (!(each_Hz > 0.0) || !std::isfinite(each_Hz)) {
      throw table.error(row, frequency.index, "is no frequency; allowed: above 0");
    }
    const double value = first.value(firsts[row]);
    if (is_magnitude && !(value > 0.0)) {
      throw table.error(row, first.index, "is no magnitude; allowed: above 0");
    }
    sweep.admittance_S.push_back(
        admittance_S(columns, value, columns.second ? columns.second->value(seconds[row]) : 0.0));
    if (!std::isnormal(std::abs(sweep.admittance_S.back()))) {
      throw table.error(row, first.index,
                        "has an admittance of 0 or without end; allowed: one of a capacitance");
    }
  }
  return sweep;
}

}  // namespace sonoglide::identify::impedance
