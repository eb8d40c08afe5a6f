#include "host_sim/studies/paper/figures.hpp"

#include <fmt/format.h>

#include <vector>

#include "host_sim/process/output_folder.hpp"
#include "host_sim/studies/paper/figure_style.hpp"
#include "host_sim/studies/paper/runs.hpp"

namespace sonoglide::paper {

const std::vector<NumberedFigure>& figure_list() {
  static const std::vector<NumberedFigure> list = {
      {2, figure_2}, {3, figure_3}, {4, figure_4},   {5, figure_5},   {6, figure_6},  {7, figure_7},
      {8, figure_8}, {9, figure_9}, {10, figure_10}, {11, figure_11}, {12, figure_12}};
  return list;
}

namespace {

std::vector<std::string> file_names(std::optional<int> wanted) {
  std::vector<std::string> names{"table_1.toml", "table_2.toml", "index.html"};
  for (const NumberedFigure& each : figure_list()) {
    if (!wanted || each.number == *wanted) {
      names.push_back(fmt::format("figure_{:02}.csv", each.number));
      names.push_back(fmt::format("figure_{:02}.svg", each.number));
    }
  }
  if (!wanted) {
    names.emplace_back("balance.csv");
  }
  return names;
}

std::vector<Figure> compute(std::optional<int> wanted, const Progress& progress) {
  std::vector<Figure> figures;
  double done = 0.0;
  for (const NumberedFigure& each : figure_list()) {
    if (!wanted || each.number == *wanted) {
      figures.push_back(each.compute());
    }
    // What is left after the figures counts as one more.
    done += 1.0;
    progress(done / static_cast<double>(figure_list().size() + 1));
  }
  return figures;
}

}  // namespace

void write_paper(const std::filesystem::path& out, std::optional<int> figure,
                 const Progress& progress) {
  { const process::OutputFolder probe(out, file_names(figure)); }
  const std::vector<Figure> figures = compute(figure, progress);
  Findings findings;
  if (!figure) {
    findings = {faults(), balances(), dither_claims()};
  }
  progress(1.0);
  process::OutputFolder folder(out);
  for (const Figure& each : figures) {
    folder.write(fmt::format("figure_{:02}.csv", each.number), each.csv);
    folder.write(fmt::format("figure_{:02}.svg", each.number), output::print(sheet(each.charts)));
    for (const File& file : each.files) {
      folder.write(file.name, file.text);
    }
  }
  if (!figure) {
    folder.write("balance.csv", balance_csv(findings.balances));
  }
  folder.write("table_1.toml", table_1_text());
  folder.write("table_2.toml", table_2_text());
  folder.write("index.html", output::to_html(paper_page(figures, findings)));
  folder.commit();
}

namespace {

const char* word(ClaimStatus verdict) {
  switch (verdict) {
    case ClaimStatus::holds:
      return "holds";
    case ClaimStatus::does_not_hold:
      return "does not hold";
    case ClaimStatus::depends:
      break;
  }
  return "depends";
}

output::Table claim_table(const std::vector<Claim>& claims) {
  output::Table table{"", {"What the paper says", "Verdict", "Numbers"}, {}};
  for (const Claim& claim : claims) {
    table.rows.push_back({claim.statement, word(claim.verdict), claim.numbers});
  }
  return table;
}

output::Section section(const Figure& figure) {
  output::Section section;
  section.title = fmt::format("Figure {}: {}", figure.number, figure.title);
  section.text = fmt::format(
      "{0} For print: figure_{2:02}.svg; data: figure_{2:02}.csv. To compute it again: "
      "{1}",
      figure.conditions, figure.command, figure.number);
  section.tables = {claim_table(figure.claims)};
  section.tables.insert(section.tables.end(), figure.tables.begin(), figure.tables.end());
  section.charts = figure.charts;
  return section;
}

output::Section section(const std::vector<Claim>& dither) {
  output::Section section;
  section.title = "Dither and squeal, from the introduction";
  section.text =
      "A mass of 1 kg on a spring of 10 kN/m and a belt at 20 mm/s, with friction that falls with the "
      "velocity (squeal.toml of the example scenes), under a fast drive. sonoglide stability SCENE "
      "--self-excited maps such a scene.";
  section.tables = {claim_table(dither)};
  return section;
}

output::Section section(const std::vector<PrintedFault>& faults) {
  output::Section section;
  section.title = "Where the paper cannot be right as printed";
  section.text = "Table 1 at 384 N and, unless said, a velocity ratio of 0.5.";
  output::Table table{"", {"In print", "Effect, measured", "Here"}, {}};
  for (const PrintedFault& fault : faults) {
    table.rows.push_back({fault.in_print, fault.effect, fault.here});
  }
  section.tables = {table};
  return section;
}

output::Section section(const std::vector<Balance>& balance) {
  output::Section section;
  section.title = "Energy balance, equations (3) to (16)";
  section.text =
      "The paper adds the average of the stored energy to energies of a whole carrier period; what "
      "counts is its change. By its equation (16) the power dissipation ratio is large and "
      "negative; "
      "its own definition, Efu/Ef of equation (8), gives what friction really takes, and with the "
      "change of stored energy in place of the average the balance closes. It also takes the work "
      "of "
      "sliding as Fn Vt T where vibration has lowered the force. Table 1 at 384 N, one carrier "
      "period: "
      "the hundredth from rest, or any on the steady orbit. balance.csv has every quantity.";
  output::Table table{"",
                      {"Start", "Velocity ratio", "Power dissipation ratio, (16) as printed",
                       "The same, true", "Residual as printed", "Residual of the true identity"},
                      {}};
  for (const Balance& b : balance) {
    table.rows.push_back(
        {b.start == "steady" ? "steady orbit" : "from rest", fmt::format("{:g}", b.velocity_ratio),
         fmt::format("{:.1f}", b.printed_dissipation_ratio),
         fmt::format("{:.6f}", b.true_dissipation_ratio), fmt::format("{:.2g}", b.printed_residual),
         fmt::format("{:.1e}", b.true_residual)});
  }
  section.tables = {table};
  return section;
}

}  // namespace

output::Page paper_page(const std::vector<Figure>& figures, const Findings& findings) {
  output::Page page;
  page.title = "Friction reduction by ultrasonic vibration: a paper computed again";
  page.lead =
      "S. Bharadwaj and M. J. Dapino, Characterisation of friction reduction with tangential "
      "ultrasonic vibrations using a SDOF model, Int. J. Vehicle Design 63 (2013) 291-304: each "
      "figure from this solver, what the paper says of it, and whether the numbers bear it out. "
      "The "
      "friction here opposes the motion, V = Vt + x', which is the convention of the paper's "
      "equations "
      "(6) and (8) and not of (1) and (2).";
  for (const Figure& figure : figures) {
    page.sections.push_back(section(figure));
  }
  if (!findings.dither.empty()) {
    page.sections.push_back(section(findings.dither));
  }
  if (!findings.faults.empty()) {
    page.sections.push_back(section(findings.faults));
  }
  if (!findings.balances.empty()) {
    page.sections.push_back(section(findings.balances));
  }
  return page;
}

}  // namespace sonoglide::paper
