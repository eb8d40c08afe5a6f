#include "host_sim/configure/friction/inverse_design.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "firmware/friction/inverse_grid.hpp"
#include "firmware/numeric/float_elementary.hpp"
#include "host_sim/configure/friction/least_vibration.hpp"
#include "host_sim/configure/plant_scales.hpp"

namespace sonoglide::configure {
namespace {

using Grid = friction::InverseGrid;

/// u of the fastest sliding: a row in the middle of those that a ratio from 1/32 on may reach.
constexpr double fastest_row = 8.0;

double quarter_octaves(int count) {
  return numeric::exp2(0.25 * count);
}

template <class Axis>
double line(int index) {
  constexpr int cells = Axis::cells_per_octave;
  if (index == 0) {
    return 0.0;
  }
  const int octave = (index - 1) / cells + Axis::first_octave;
  return std::ldexp(1.0 + static_cast<double>((index - 1) % cells) / cells, octave);
}

/// The ratio of a column, or of a place between two; of the outer ones just inside.
double ratio_of(double place) {
  constexpr double least_gap = 0x1p-10;
  constexpr double least_ratio = 0x1p-5;
  const int column = static_cast<int>(place);
  const double gap = line<Grid::Column>(column);
  const double next = line<Grid::Column>(std::min(column + 1, Grid::columns - 1));
  return std::clamp(1.0 - gap - (place - column) * (next - gap), least_ratio, 1.0 - least_gap);
}

/// The friction force scaled by a factor, at a sliding speed.
scene::Friction scaled_friction(const scene::Friction& contact, double factor,
                                double sliding_m_per_s) {
  scene::Friction scaled = contact;
  if (scene::is<scene::laws::NormalCoulomb>(contact.law)) {
    scaled.coefficient *= factor;
    return scaled;
  }
  // The part of the friction that no normal force makes is viscous.
  constexpr double least_dry = 0.05;
  scene::Friction unloaded = contact;
  unloaded.normal_force_N = 0.0;
  const double viscous_N = scene::undriven_friction_N(contact.law, unloaded, sliding_m_per_s);
  const double all_N = scene::undriven_friction_N(contact.law, contact, sliding_m_per_s);
  scaled.normal_force_N *= std::max(least_dry, (factor * all_N - viscous_N) / (all_N - viscous_N));
  return scaled;
}

/// What the controller takes the contact to be.
scene::Friction nominal_contact(const scene::Scene& scene, const NominalPlant& plant) {
  const double sliding_m_per_s = scene.sliding.fastest_m_per_s();
  scene::Friction contact =
      scaled_friction(scene.friction, scene.model_error.coefficient, sliding_m_per_s);
  contact.contact_stiffness_N_per_m = plant.contact_stiffness_N_per_m;
  return contact;
}

/// Beyond it a table need not go: a few times what full drive gives.
double strongest_m_per_s(const scene::Scene& scene, const NominalPlant& plant) {
  constexpr double room = 4.0;
  const double force_N = room * plant.force_factor * scene.max_drive_force_N();
  const double full_m_per_s =
      scene.resonant() ? force_N / plant.damping_N_s_per_m
                       : peak_vibration_m_per_s(plant, scene.drive->frequency_Hz, force_N);
  const double fastest_m_per_s = scene.sliding.fastest_m_per_s();
  constexpr double most = 1e4;
  constexpr double least = 2.0;
  return std::clamp(full_m_per_s, least * fastest_m_per_s, most * fastest_m_per_s);
}

/// z √reach of each column, of the place in the middle between it and the next, and so on.
using Roots = std::array<double, static_cast<std::size_t>(2 * Grid::columns - 1)>;

using Nodes = std::array<double, static_cast<std::size_t>(Grid::columns)>;

/// Nodes between which straight lines are as far above the curve as below: each is moved by half of what
/// the curve is beside the lines that it begins and ends, but not beyond its neighbours. The last one,
/// ρ = 0, is where the line through the two places before it goes.
Nodes balanced(Roots dense) {
  constexpr std::size_t last = Grid::columns - 1;
  dense[2 * last] = std::max(0.0, 2.0 * dense[2 * last - 1] - dense[2 * last - 2]);
  const auto beside = [&](std::size_t cell) {
    return dense[2 * cell + 1] - 0.5 * (dense[2 * cell] + dense[2 * cell + 2]);
  };
  Nodes nodes{};
  for (std::size_t i = 0; i <= last; ++i) {
    const double before = beside(i > 0 ? i - 1 : 0);
    const double after = beside(i < last ? i : last - 1);
    const auto [low, high] = std::minmax(
        {dense[i > 0 ? 2 * i - 1 : 0], dense[2 * i], dense[i < last ? 2 * i + 1 : 2 * i]});
    nodes[i] = std::clamp(dense[2 * i] + 0.25 * (before + after), low, high);
  }
  return nodes;
}

friction::InverseForm form_of(const scene::FrictionLaw& law) {
  switch (scene::vibration_of(law)) {
    case friction::Vibration::normal:
      return friction::InverseForm::plain;
    case friction::Vibration::along:
      // A contact that yields may do so under a slower vibration too.
      return scene::is_elastic(law) ? friction::InverseForm::over_ratio
                                    : friction::InverseForm::beyond_sliding;
    default:
      return friction::InverseForm::over_ratio;
  }
}

/// z² reach. @param speed_ratio  v̂/Vt
double square_of(friction::InverseForm form, double ratio, double speed_ratio) {
  switch (form) {
    case friction::InverseForm::beyond_sliding:
      return std::max(0.0, ratio * (speed_ratio - 1.0));
    case friction::InverseForm::over_ratio:
      return ratio * speed_ratio;
    case friction::InverseForm::plain:
      break;
  }
  return speed_ratio;
}

bool is_constant(const scene::Scene& scene) {
  const auto& profile = scene.sliding.profile;
  return !scene.load && std::all_of(profile.begin(), profile.end(), [&](const auto& point) {
    return std::abs(point.velocity_m_per_s) == std::abs(profile.front().velocity_m_per_s);
  });
}

bool learns(const scene::Scene& scene) {
  return scene.controller->calibration_s.value_or(0.0) > 0.0 ||
         scene.controller->relearn_every_s.has_value();
}

/// Roots over u, from the lowest u on, a quarter of an octave apart.
class Survey {
 public:
  Survey(const scene::Scene& scene, const NominalPlant& plant, InverseDesign& design)
      : contact_(nominal_contact(scene, plant)),
        omega_(scene.drive->rate_rad_per_s()),
        fastest_m_per_s_(scene.sliding.fastest_m_per_s()),
        strongest_m_per_s_(strongest_m_per_s(scene, plant)),
        over_force_(design.over_force),
        form_(design.form) {
    constexpr int octave = 4;
    // Iwan's table is the straighter over u: from a row to the next the ratio changes as well.
    const bool levels = design.over_force && scene::is_elastic(contact_.law) &&
                        (scene::is<scene::laws::Iwan>(contact_.law) || learns(scene));
    const int slower = is_constant(scene) ? 0 : 7 * octave;
    const int before = std::max(slower, levels ? 2 * octave : 0);
    const int after = levels ? octave + 1 : 0;
    lowest_ = fastest_row * quarter_octaves(-before);
    for (int i = -before; i <= after; ++i) {
      lines_.push_back(
          roots(fastest_row * quarter_octaves(i), i == 0 ? &design.least_ratio : nullptr));
    }
  }

  /// z √reach at a row, linear over ln u.
  Roots at_row(double reduced_travel) const {
    Roots found{};
    const auto last = static_cast<double>(lines_.size() - 1);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double u = reduced_travel * ratio_of(0.5 * static_cast<double>(i));
      const double place = u > lowest_ ? std::min(4.0 * numeric::log2(u / lowest_), last) : 0.0;
      const auto index = static_cast<std::size_t>(place);
      const double low = lines_[index][i];
      const double high = lines_[std::min(index + 1, lines_.size() - 1)][i];
      found[i] = low + (place - static_cast<double>(index)) * (high - low);
    }
    return found;
  }

 private:
  Roots roots(double u, std::optional<double>* least_ratio) const {
    const double sliding_m_per_s =
        over_force_ ? fastest_m_per_s_ : fastest_m_per_s_ * (u / fastest_row);
    const scene::Friction contact =
        over_force_ ? scaled_friction(contact_, fastest_row / u, sliding_m_per_s) : contact_;
    // At a slower sliding the drive goes farther beyond it.
    const double slower = over_force_ ? std::max(1.0, fastest_row / u) : 1.0;
    LeastVibration least(contact, omega_, sliding_m_per_s, slower * strongest_m_per_s_);
    Roots found{};
    for (std::size_t i = 0; i < found.size(); ++i) {
      const double ratio = ratio_of(0.5 * static_cast<double>(i));
      const double speed_ratio = least.vibration_m_per_s(ratio) / sliding_m_per_s;
      found[i] = numeric::sqrt(square_of(form_, ratio, speed_ratio));
    }
    if (least_ratio != nullptr) {
      *least_ratio = least.least_ratio();
    }
    return found;
  }

  scene::Friction contact_;
  double omega_;
  double fastest_m_per_s_;
  double strongest_m_per_s_;
  bool over_force_;
  friction::InverseForm form_;
  double lowest_ = fastest_row;
  std::vector<Roots> lines_;
};

}  // namespace

bool is_tabulated(const scene::Scene& scene) {
  return scene::friction_map(scene.friction.law) == scene::FrictionMap::tabulated &&
         scene.friction.limit_N() > 0.0 && scene.sliding.fastest_m_per_s() > 0.0;
}

double required_vibration_m_per_s(const scene::Scene& scene, const NominalPlant& plant,
                                  double friction_ratio) {
  const scene::Friction contact = nominal_contact(scene, plant);
  return LeastVibration(contact, scene.drive->rate_rad_per_s(), scene.sliding.fastest_m_per_s(),
                        strongest_m_per_s(scene, plant))
      .vibration_m_per_s(friction_ratio);
}

InverseDesign design_inverse(const scene::Scene& scene, const NominalPlant& plant) {
  InverseDesign design;
  design.reference_m_per_s = scene.sliding.fastest_m_per_s() / fastest_row;
  design.over_force = is_constant(scene) || scene::is<scene::laws::Iwan>(scene.friction.law);
  design.form = form_of(scene.friction.law);
  const Survey survey(scene, plant, design);
  std::array<Nodes, static_cast<std::size_t>(Grid::rows)> roots{};
  double largest = 1e-6;  // of a friction that no vibration lowers
  for (std::size_t row = 0; row < roots.size(); ++row) {
    roots[row] = balanced(survey.at_row(line<Grid::Row>(static_cast<int>(row))));
    largest = std::max(largest, *std::max_element(roots[row].begin(), roots[row].end()));
  }
  constexpr double below_one = 1.0 - 0x1p-14;
  design.reach = largest / below_one * (largest / below_one);
  for (std::size_t row = 0; row < roots.size(); ++row) {
    std::transform(
        roots[row].begin(), roots[row].end(), design.table[row].begin(), [&](double root) {
          const double z = root / largest * below_one;
          return static_cast<std::uint16_t>(std::lround(std::ldexp(z, Grid::entry_bits)));
        });
  }
  return design;
}

}  // namespace sonoglide::configure
