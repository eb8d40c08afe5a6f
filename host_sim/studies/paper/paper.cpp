#include "host_sim/studies/paper/paper.hpp"

#include <fmt/format.h>

#include <vector>

#include "host_sim/output/output_folder.hpp"
#include "host_sim/studies/paper/figures.hpp"
#include "host_sim/studies/paper/findings.hpp"
#include "host_sim/studies/paper/table_1.hpp"

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
  { const output::OutputFolder probe(out, file_names(figure)); }
  const std::vector<Figure> figures = compute(figure, progress);
  Findings findings;
  if (!figure) {
    findings = {faults(), balances()};
  }
  progress(1.0);
  output::OutputFolder folder(out);
  for (const Figure& each : figures) {
    folder.write(fmt::format("figure_{:02}.csv", each.number), each.csv);
    folder.write(fmt::format("figure_{:02}.svg", each.number), each.svg);
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

}  // namespace sonoglide::paper
